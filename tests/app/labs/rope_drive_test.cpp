// Wind on everything, and colliders that move and turn steadily, by commands of the Rope lab.
#include "app/labs/rope/rope_time.hpp"
#include "tests/app/labs/rope_support.hpp"
#include "tests/says.hpp"

namespace tendril::app {
namespace {

class RopeDrive : public RopeTest {
  protected:
    void lie_on_the_ground() {
        run("rope.clear");
        run("rope.collider.add",
            {{"name", "ground"}, {"kind", "plane"}, {"point", {0, 0, 0}}, {"normal", {0, 1, 0}}});
        run("rope.add", {{"from", {0, 0.02, 0}}, {"to", {1, 0.02, 0}}, {"segments", 8}});
    }
};

TEST_F(RopeDrive, ABoxThatTurnsIsShownTurned) {
    run("rope.clear");
    run("rope.collider.add",
        {{"name", "box"}, {"kind", "box"}, {"centre", {0, 1, 0}}, {"half_extents", {1, 0.1, 1}}});
    run("rope.collider.drive", {{"name", "box"}, {"spin_deg", 90}});
    wait(60);
    const auto box = std::get<rope::Box>(world().shape(*world().find_collider("box")));
    EXPECT_NEAR(2.0f * std::acos(box.rotation.w), glm::radians(90.0f), 1e-3f);
    run("rope.collider.drive", {{"name", "box"}, {"spin_deg", 0}});
    EXPECT_FALSE(world().find_collider("box")->drive.any());
    run("undo");
    EXPECT_TRUE(world().find_collider("box")->drive.any());
}

}  // namespace
}  // namespace tendril::app
