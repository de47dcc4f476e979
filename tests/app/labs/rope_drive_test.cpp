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

TEST_F(RopeDrive, AGroundThatMovesCarriesARope) {
    lie_on_the_ground();
    run("rope.collider.drive", {{"name", "ground"}, {"velocity", {0, 0, 2}}});
    wait(120);
    EXPECT_NEAR(world().velocity(0).z, 2.0f, 0.05f);
    EXPECT_EQ(state().at("colliders")[0].at("drive").at("velocity"), Json({0, 0, 2}));
    EXPECT_EQ(rope::centre(world().find_collider("ground")->shape), glm::vec3(0.0f));
    EXPECT_FALSE(at_rest(part()));
}

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

TEST_F(RopeDrive, RefusesWhatItCannotDrive) {
    lie_on_the_ground();
    expect_refused("rope.collider.drive", {{"name", "sea"}, {"spin_deg", 1}}, {"sea"});
}

TEST_F(RopeDrive, HairLeansInTheWind) {
    run("rope.clear");
    run("rope.hair.add", {{"centre", {0, 2, 0}}, {"strands", 1}, {"spread", 0}, {"length", 0.5}});
    run("rope.wind", {{"velocity", {8, 0, 0}}, {"gusts", 0}});
    wait(300);
    EXPECT_GT(world().position(world().size() - 1).x, 0.1f);
}

TEST_F(RopeDrive, StillAirSlowsAFall) {
    const auto fallen = [&](bool still_air) {
        run("rope.clear");
        run("rope.wind", {{"velocity", {0, 0, 0}}, {"still_air", still_air}});
        run("rope.cloth.add", {{"corner", {0, 90, 0}}, {"along", {1, 0, 0}}, {"down", {0, 0, 1}}});
        wait(90);
        return 90.0f - world().position(100).y;
    };
    const float without = fallen(false);
    EXPECT_LT(fallen(true), 0.4f * without);
    EXPECT_TRUE(world().settings().still_air);
}

}  // namespace
}  // namespace tendril::app
