// The Rope lab at speeds without a whole number of substeps per tick: the picture is of the tick's own time.
#include "app/labs/rope/rope_time.hpp"
#include "tests/app/labs/rope_support.hpp"

namespace tendril::app {
namespace {

class RopePose : public RopeTest {
  protected:
    RopePose() {
        run("rope.clear");
        run("rope.add", {{"from", {0, 2, 0}}, {"to", {0, 1, 0}}, {"segments", 8}, {"pin_start", true}});
        run("time.play");
    }
    /// Drags the start along X at 10 m/s; returns by how much each picture is off, metres.
    std::vector<double> drag(int ticks) {
        std::vector<double> off;
        for (int i = 1; i <= ticks; ++i) {
            x_ += 10.0 * tick_seconds * static_cast<double>(workspace.clock.speed);
            run("rope.pin", {{"rope", "rope"}, {"particle", 0}, {"at", {x_, 2, 0}}});
            wait(1);
            const Json shown = state().at("ropes")[0].at("particles")[0].at("position");
            off.push_back(std::abs(shown[0].get<double>() - x_));
            const auto handle = lab().handle(workspace, particle_pick(0));
            off.push_back(std::abs(static_cast<double>(handle->frame.position.x) - x_));
        }
        return off;
    }

  private:
    double x_ = 0.0;
};

TEST_F(RopePose, ASwingingBallIsWhereItSwings) {
    run("rope.collider.add", {{"name", "ball"}, {"kind", "sphere"}, {"centre", {3, 1, 0}}, {"radius", 0.2}});
    run("rope.collider.swing", {{"name", "ball"}, {"by", {1, 0, 0}}, {"period", 1}});
    run("rope.settings", {{"substep", 0.007}});
    for (int i = 0; i < 60; ++i) {
        wait(1);
        const glm::vec3 shown = rope::centre(world().shape(*world().find_collider("ball")));
        EXPECT_LT(glm::distance(shown, swing_point(part().swings[0], part().time)), 1e-4f) << i;
    }
}

}  // namespace
}  // namespace tendril::app
