// A chain in a plane, in the program: commands, state, files, undo, drags, the trailing modes, code, presets.
#include <cmath>
#include <glm/geometric.hpp>

#include "app/document/command.hpp"
#include "app/labs/chain/code.hpp"
#include "app/labs/kit/code_text.hpp"
#include "app/view/camera.hpp"
#include "tests/app/labs/chain_support.hpp"
#include "tests/app/support/play.hpp"

namespace tendril::app {
namespace {

class ChainPlaneTest : public ChainTest {
  protected:
    /// Mode Reach in the plane z = 0.
    void flat_with(int bones) {
        reach_with(bones);
        run("chain.plane", {{"normal", {0, 0, 1}}});
    }
    float furthest_off(glm::vec3 normal = {0, 0, 1}) const {
        float off = 0.0f;
        const glm::vec3 root = part().chain.position(0), along = glm::normalize(normal);
        for (const Segment& each : part().chain.segments())
            off = std::max(off, std::abs(glm::dot(each.position - root, along)));
        return off;
    }
    void target(float x, float y, float z = 0.0f) { run("chain.target", {{"to", {x, y, z}}}); }
    float angle(std::size_t bone) const {
        const glm::vec3 b = part().chain.position(bone + 1) - part().chain.position(bone);
        return glm::degrees(std::atan2(b.y, b.x));
    }
};

TEST_F(ChainPlaneTest, StateHasPlaneDistanceAndSide) {
    reach_with(4);
    EXPECT_FALSE(state().contains("plane"));
    run("chain.plane", {{"normal", {0, 0, 2}}});
    run("chain.bend", {{"side", "right"}});
    target(2.0f, 1.0f, 0.75f);
    EXPECT_EQ(state()["plane"], (Json{{"normal", {0, 0, 1}}}));
    EXPECT_NEAR(state()["off_plane"].get<double>(), 0.75, 1e-5);
    EXPECT_EQ(state()["side"], "right");
    EXPECT_EQ(part().result->report.status, ik::Status::Converged);
    EXPECT_LE(furthest_off(), 4e-6f);
    EXPECT_LE(part().result->report.residual, 4e-3f);
    run("chain.plane", {{"off", true}});
    EXPECT_FALSE(state().contains("plane"));
    target(2.0f, 1.0f, 0.75f);
    EXPECT_GT(furthest_off(), 0.5f);
}

TEST_F(ChainPlaneTest, TheSideIsKeptWhileTheTargetCrossesTheBase) {
    flat_with(5);
    for (const char* const side : {"left", "right"}) {
        run("chain.bend", {{"side", side}});
        target(3.0f, 0.4f);
        run("chain.bend", {{"side", "free"}});
        for (float x = 3.0f; x > -3.0f; x -= 0.05f) {
            target(x, 0.4f);
            EXPECT_EQ(state()["side"], side) << x;
        }
    }
}

TEST_F(ChainPlaneTest, AnglesAreLimitedFromTheBoneBeforeAndFromTheBase) {
    flat_with(3);
    run("chain.angle_limit", {{"index", 1}, {"min_deg", -20}, {"max_deg", 30}});
    run("chain.angle_limit", {{"index", 2}, {"min_deg", -10}, {"max_deg", 10}, {"from", "base"}});
    for (const float x : {2.5f, 0.5f, -2.0f}) {
        target(x, 1.5f);
        const float bend = std::remainder(angle(1) - angle(0), 360.0f);
        EXPECT_GE(bend, -20.1f) << x;
        EXPECT_LE(bend, 30.1f) << x;
        EXPECT_LE(std::abs(angle(2)), 10.1f) << x;
    }
    // A full turn from the bone before is no limit; once all are gone, the list is empty.
    EXPECT_EQ(part().reach.plane->limits.size(), 3u);
    run("chain.angle_limit", {{"joints", {0, 1, 2}}, {"min_deg", -180}, {"max_deg", 180}, {"from", "bone"}});
    EXPECT_TRUE(part().reach.plane->limits.empty());
}

TEST_F(ChainPlaneTest, LimitsStayWithTheirBones) {
    flat_with(4);
    run("chain.angle_limit", {{"index", 2}, {"min_deg", -20}, {"max_deg", 30}});
    const ik::AngleLimit limit = part().reach.plane->limits[2];
    run("chain.insert", {{"index", 1}, {"length", 0.5}});
    EXPECT_EQ(angle_limit_of(*part().reach.plane, 3), limit);
    run("chain.remove", {{"index", 0}});
    EXPECT_EQ(angle_limit_of(*part().reach.plane, 2), limit);
    EXPECT_EQ(part().reach.plane->limits.size(), part().chain.size() - 1);
}

TEST_F(ChainPlaneTest, ErrorsAreReported) {
    reach_with(3);
    expect_refused("chain.bend", {{"side", "left"}}, {"not in a plane"});
    expect_refused("chain.angle_limit", {{"index", 1}, {"min_deg", -20}}, {"not in a plane"});
    expect_refused("chain.plane", {}, {"needs either normal or off"});
    expect_refused("chain.plane", {{"normal", {0, 0, 0}}}, {"longer than"});
    run("chain.plane", {{"normal", {0, 0, 1}}});
    expect_refused("chain.angle_limit", {{"index", 1}, {"min_deg", 20}, {"max_deg", 10}}, {"min is over max"});
    expect_refused("chain.angle_limit", {{"index", 3}, {"min_deg", -20}}, {"tail"});
    expect_refused("chain.limit", {{"index", 1}, {"kind", "hinge"}}, {"angle_limit"});
    run("chain.preset", {{"name", "tail"}});
    expect_refused("chain.plane", {{"normal", {0, 0, 1}}}, {"curve", "control points"});
}

TEST_F(ChainPlaneTest, LimitsReturnWhenThePlaneIsRemoved) {
    reach_with(4);
    run("chain.limit", {{"index", 2}, {"kind", "hinge"}});
    const ik::Limit hinge = limit_of(part().reach, 2);
    run("chain.plane", {{"normal", {0, 0, 1}}});
    EXPECT_TRUE(part().reach.limits.empty());
    EXPECT_EQ(chain_part(reopened()).reach, part().reach);
    run("chain.plane", {{"normal", {1, 0, 1}}});
    run("chain.insert", {{"index", 1}, {"length", 0.5}});
    run("chain.plane", {{"off", true}});
    EXPECT_EQ(limit_of(part().reach, 3), hinge);
}

TEST_F(ChainPlaneTest, EveryModeAndDragStaysInThePlane) {
    run("chain.preset", {{"name", "tentacle"}, {"count", 8}});
    const auto expect_flat = [&](const char* after) { EXPECT_LE(furthest_off(), 1e-5f) << after; };
    for (const char* const mode : {"forward", "backward", "fixed", "with_index", "reach"}) {
        SCOPED_TRACE(mode);
        run("chain.mode", {{"mode", mode}});
        run("chain.plane", {{"normal", {0, 0, 1}}});
        expect_flat("plane");
        target(1.0f, 3.0f, 0.8f);
        expect_flat("target");
        run("chain.pull", {{"index", 4}, {"to", {0.5f, 2.0f, -0.4f}}});
        expect_flat("pull");
        run("chain.pull", {{"joints", {2, 5}}, {"points", {{0.4f, 1.2f, 1}, {0.1f, 2.5f, -1}}}});
        expect_flat("pull of two");
        run("chain.add", {{"length", 0.5f}, {"position", {0, 9, 3}}});
        expect_flat("add");
        run("chain.plane", {{"off", true}});
    }
}

TEST_F(ChainPlaneTest, ADraggedJointKeepsLimitsOnBothSides) {
    run("chain.preset", {{"name", "flat_tail"}, {"count", 9}});
    run("chain.pull", {{"index", 4}, {"to", {1.2f, 3.6f, 0.5f}}});
    EXPECT_LE(furthest_off(), 1e-5f);
    for (std::size_t bone = 1; bone < 8; ++bone)
        EXPECT_LE(std::abs(std::remainder(angle(bone) - angle(bone - 1), 360.0f)), 25.3f) << bone;
}

TEST_F(ChainPlaneTest, PresetsReachTheirTargetsOrNameTheActiveLimit) {
    for (const char* const name : {"flat_arm", "flat_tail", "flat_mixed"}) {
        run("chain.preset", {{"name", name}});
        ASSERT_TRUE(part().reach.plane) << name;
        EXPECT_EQ(part().result->report.status, ik::Status::Converged) << name;
    }
    run("chain.preset", {{"name", "arm"}});
    EXPECT_FALSE(part().reach.plane);
    run("chain.preset", {{"name", "flat_arm"}});
    target(0.2f, 2.6f);
    ASSERT_EQ(part().result->report.status, ik::Status::Limited);
    EXPECT_TRUE(part().result->active_limit);
}

TEST_F(ChainPlaneTest, CodeHasThePlane) {
    run("chain.preset", {{"name", "flat_mixed"}});
    run("chain.bend", {{"side", "left"}});
    const std::string code = chain_code(part());
    for (const char* const each :
         {"options.plane = ik::Plane{glm::vec3{0.0f, 0.0f, 1.0f}, ik::Side::Left, angle_limits};",
          "ik::AngleFrom::Base}"})
        EXPECT_TRUE(test::has(code, each));
}

// The mouse: the ends of a limit's arc.

class LimitDrag {
  public:
    LimitDrag() {
        script.command("chain.preset", {{"name", "flat_arm"}})
            .command("camera.frame", {{"what", "all"}})
            .command("camera.set", {{"yaw_deg", 0}, {"pitch_deg", 0}, {"orthographic", true}});
        const Json state = test::state_after(script);
        root_ = test::handle(state, "segment.0");
        const float pixels_per_metre = glm::distance(root_, test::handle(state, "segment.1")) / 1.6f;
        radius_ = std::min(0.75f * 1.6f * pixels_per_metre, 90.0f);
    }
    /// A pixel on the arc around the root, degrees to the left of +X.
    glm::vec2 at(float degrees) const {
        const float angle = glm::radians(degrees);
        return root_ + radius_ * glm::vec2(std::cos(angle), -std::sin(angle));
    }
    void drag(float from, float to) {
        std::vector<glm::vec2> way;
        for (int i = 0; i <= 6; ++i) way.push_back(at(from + (to - from) * static_cast<float>(i) / 6.0f));
        script.drag(way);
    }
    /// The limit of the bone at the root, degrees.
    glm::vec2 limit() const {
        const Json limits =
            test::scene_after(script).at("labs").at("chain").at("reach").at("plane").at("limits");
        return {limits.at(0).at("min_deg").get<float>(), limits.at(0).at("max_deg").get<float>()};
    }

    test::ScriptText script;

  private:
    glm::vec2 root_{0.0f};
    float radius_ = 0.0f;
};

TEST(ChainPlaneMouse, TheEndsOfAnArcAreDraggedToWholeDegrees) {
    LimitDrag arc;
    EXPECT_EQ(arc.limit(), glm::vec2(-90, 120));
    arc.drag(120.0f, 60.3f);
    EXPECT_EQ(arc.limit(), glm::vec2(-90, 60));
    arc.drag(-90.0f, -20.0f);
    EXPECT_EQ(arc.limit(), glm::vec2(-20, 60));
    arc.script.key("ctrl+z");
    EXPECT_EQ(arc.limit(), glm::vec2(-90, 60)) << "a drag is one step";
    arc.drag(-90.0f, 80.0f);
    EXPECT_EQ(arc.limit(), glm::vec2(59, 60)) << "not past the other end";
    arc.script.key("ctrl+z");
    arc.drag(60.0f, 250.0f);
    EXPECT_EQ(arc.limit(), glm::vec2(-90, 180)) << "not past half a turn";
    arc.script.key("ctrl+z").key("ctrl+z");
    EXPECT_EQ(arc.limit(), glm::vec2(-90, 120));
}

}  // namespace
}  // namespace tendril::app
