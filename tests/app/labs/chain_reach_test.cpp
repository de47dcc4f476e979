// Mode Reach: effects of each command, refusals, and the text for an active limit.
#include <glm/trigonometric.hpp>

#include "app/labs/kit/code_text.hpp"
#include "app/view/camera.hpp"
#include "tests/app/labs/chain_support.hpp"
#include "tests/app/support/play.hpp"

namespace tendril::app {
namespace {

class ChainReach : public ChainTest {
  protected:
    /// Two bones of 1 m whose elbow bends from 0 to 145 degrees in the plane of the view.
    void elbow() {
        reach_with(2);
        run("chain.limit",
            {{"index", 1}, {"kind", "hinge"}, {"axis", {0, 0, 1}}, {"min_deg", 0}, {"max_deg", 145}});
    }
    /// Distance from shoulder to tip of two bones of 1 m with the elbow bent by `degrees`.
    static float distance_at(float degrees) { return 2.0f * std::cos(glm::radians(0.5f * degrees)); }
};

TEST_F(ChainReach, ASolveThatMovesNothingIsReportedToo) {
    run("chain.mode", {{"mode", "reach"}});
    run("chain.target", {{"to", {7, 0, 0}}});
    EXPECT_EQ(state()["solve"]["report"]["status"], "Converged");
}

TEST_F(ChainReach, ADefaultToleranceFollowsTheReachAndEachModeHasItsOwnIterations) {
    run("chain.solver", {{"tolerance", 0.25}});
    run("chain.solver", {{"default_tolerance", true}});
    run("chain.mode", {{"mode", "reach"}});
    EXPECT_NEAR(state()["tolerance"].get<float>(), 7e-3f, 1e-6f);
    run("chain.mode", {{"mode", "reach"}, {"iterations", 3}, {"tolerance", 0.5}});
    EXPECT_EQ(state()["iterations"], 3);
    EXPECT_EQ(state()["tolerance"], 0.5);
    run("chain.mode", {{"mode", "fixed"}});
    EXPECT_EQ(state()["iterations"], 1);
}

TEST_F(ChainReach, AnElbowJustOutOfRangeIsNamedWithItsLimitAndTheAngleNeeded) {
    elbow();
    run("chain.target", {{"to", {distance_at(162.0f), 0, 0}}});
    const Json reach = state()["solve"];
    EXPECT_EQ(reach["report"]["status"], "Limited");
    EXPECT_TRUE(test::says(reach["explanation"], "joint 1 hinge 145 degrees 162"));
    EXPECT_EQ(reach["active_limit"]["joint"], 1);
    EXPECT_NEAR(reach["active_limit"]["limit_deg"].get<float>(), 145.0f, 0.01f);
    EXPECT_NEAR(reach["active_limit"]["needed_deg"].get<float>(), 162.0f, 1.0f);
    EXPECT_NEAR(reach["report"]["residual"].get<float>(), distance_at(145.0f) - distance_at(162.0f), 2e-3f);

    run("chain.target", {{"to", {distance_at(140.0f), 0, 0}}});
    EXPECT_EQ(state()["solve"]["report"]["status"], "Converged");
    EXPECT_EQ(state()["solve"]["explanation"], nullptr);
}

TEST_F(ChainReach, ALimitBendsTheChainAsSoonAsItIsSet) {
    elbow();
    run("chain.limit", {{"index", 1}, {"min_deg", 30}});
    EXPECT_EQ(state()["solve"]["limits"][1]["min_deg"], 30.0);
    EXPECT_EQ(state()["solve"]["limits"][1]["max_deg"], 145.0) << "what is left out is kept";
    const glm::vec3 upper = part().chain.position(1) - part().chain.position(0);
    const glm::vec3 lower = part().chain.position(2) - part().chain.position(1);
    EXPECT_GE(glm::degrees(std::acos(std::min(1.0f, glm::dot(upper, lower)))), 29.9f);
    run("chain.limit", {{"index", 1}, {"kind", "free"}});
    EXPECT_TRUE(part().reach.limits.empty());
}

TEST_F(ChainReach, LimitsStayWithTheirSegments) {
    reach_with(5);
    run("chain.limit", {{"index", 2}, {"kind", "hinge"}, {"max_deg", 90}});
    run("chain.insert", {{"index", 1}, {"length", 0.5}});
    EXPECT_EQ(limit_of(part().reach, 3).kind, ik::JointKind::Hinge);
    EXPECT_EQ(part().reach.limits.size(), 6u);
    run("chain.remove", {{"index", 0}});
    EXPECT_EQ(limit_of(part().reach, 2).kind, ik::JointKind::Hinge);
    EXPECT_EQ(part().reach.limits.size(), 5u);
    run("chain.add", {{"length", 1}});
    EXPECT_EQ(part().reach.limits.size(), 6u);
    run("chain.target", {{"to", {2, 2, 0}}});
    run("chain.clear");
    EXPECT_TRUE(part().reach.limits.empty());
}

TEST_F(ChainReach, ASceneFromBeforeModeReachOpens) {
    Json scene = save_scene(workspace);
    scene["labs"]["chain"].erase("reach");
    run("chain.solver", {{"name", "ccd"}});
    load_scene(workspace, scene);
    EXPECT_EQ(part().reach, ReachSettings());
}

/// State must not refer to bones that were just added or removed.
TEST_F(ChainReach, AJointIsDraggedRightAfterAnotherWasRemoved) {
    reach_with(5);
    run("chain.target", {{"to", {2, 2, 0}}});
    run("chain.remove", {{"index", 1}});
    run("chain.pull", {{"index", 2}, {"to", {0.5, 1.2, 0.3}}});
    EXPECT_LT(glm::distance(part().chain.position(2), glm::vec3(0.5f, 1.2f, 0.3f)), 1e-2f);
}

TEST_F(ChainReach, LimitsAreRefusedIfTheSceneWouldBeTooLarge) {
    run("chain.preset", {{"name", "start"}, {"count", 100001}});
    expect_refused("chain.limit", {{"index", 0}, {"kind", "pivot"}}, {"100000"});
}

TEST_F(ChainReach, ANewToleranceGivesANewReport) {
    elbow();
    run("chain.target", {{"to", {distance_at(162.0f), 0, 0}}});
    EXPECT_EQ(state()["solve"]["report"]["status"], "Limited");
    run("chain.solver", {{"tolerance", 100}});
    run("chain.target", {{"to", {distance_at(162.0f), 0, 0}}});
    EXPECT_EQ(state()["solve"]["report"]["status"], "Converged");
}

TEST_F(ChainReach, BadInputIsRefusedWithTheReason) {
    reach_with(4);
    refuses("chain.solver", {{"name", "two_bone"}}, "Two-bone needs exactly two bones; this chain has 4");
    refuses("chain.pole", Json::object(), "off");
    refuses("chain.pole", {{"to", {0, 1, 0}}, {"off", true}}, "combined");
    refuses("chain.limit", {{"index", 4}, {"kind", "hinge"}}, "tail");
    refuses("chain.limit", {{"index", 9}, {"kind", "hinge"}}, "9");
    refuses("chain.limit", {{"index", 1}, {"kind", "hinge"}, {"min_deg", 50}, {"max_deg", 20}}, "50.0");
    refuses("chain.limit", {{"index", 1}, {"kind", "hinge"}, {"axis", {0, 0, 0}}}, "axis");
    refuses("chain.limit", {{"index", 1}, {"kind", "hinge"}, {"axis", {1, 0, 0}}}, "bone");
}

TEST_F(ChainReach, ANewLimitIncludesThePose) {
    for (const char* kind : {"hinge", "ball_and_socket", "saddle", "gliding", "suture", "pivot"}) {
        for (const Json& target : {Json{2, 1, 0}, Json{2, -1, 0}, Json{1, 0.5, 1}}) {
            reach_with(4);
            run("chain.target", {{"to", target}});
            const std::vector<glm::vec3> before = positions(part().chain);
            run("chain.limit", {{"index", 2}, {"kind", kind}});
            for (std::size_t i = 0; i < before.size(); ++i)
                EXPECT_LT(glm::distance(part().chain.position(i), before[i]), 2e-3f)
                    << kind << " " << target << " moves joint " << i;
        }
    }
}

TEST_F(ChainReach, AHingeBendsInTheJointsPresentDirection) {
    reach_with(2);
    run("chain.target", {{"to", {1.5, 0.2, 0}}});
    const auto bend = [&] {
        const auto at = [&](std::size_t i) { return part().chain.position(i); };
        return glm::cross(at(1) - at(0), at(2) - at(1)).z;
    };
    const bool up = bend() > 0.0f;
    run("chain.limit", {{"index", 1}, {"kind", "hinge"}});
    const ik::Limit limit = part().reach.limits[1];
    EXPECT_EQ(std::abs(limit.axis.z), 1.0f);
    EXPECT_FLOAT_EQ(glm::degrees(limit.max - limit.min), 145.0f);
    EXPECT_EQ(limit.max > -limit.min, up == (limit.axis.z > 0.0f));
    run("chain.target", {{"to", {1.0, 0.4, 0}}});
    EXPECT_EQ(bend() > 0.0f, up);
}

TEST_F(ChainReach, AModeBeginsWithItsJointOnTheTarget) {
    for (const char* mode : {"forward", "backward", "fixed", "with_index"}) {
        reach_with(5);
        run("chain.target", {{"to", {3, 2, 0}}});
        run("chain.select", {{"index", 2}});
        const auto before = part().chain.segments();
        const std::vector<Segment> pose(before.begin(), before.end());
        run("chain.mode", {{"mode", mode}});
        EXPECT_EQ(part().target, part().chain.position(led_joint(part()))) << mode;
        EXPECT_TRUE(std::ranges::equal(part().chain.segments(), pose)) << mode << " alone moves nothing";
    }
    EXPECT_EQ(part().index, 2u) << "with index takes the selected joint";
}

TEST_F(ChainReach, KeepsItsTargetWhileAnotherModeIsOn) {
    reach_with(4);
    run("chain.target", {{"to", {2, 1, 0}}});
    run("chain.mode", {{"mode", "forward"}});
    EXPECT_EQ(part().target, part().chain.position(0));
    run("chain.mode", {{"mode", "reach"}});
    EXPECT_EQ(part().target, glm::vec3(2, 1, 0));
    EXPECT_FALSE(part().result) << "nothing was solved for it yet";
    run("chain.mode", {{"mode", "with_index"}, {"index", 1}});
    run("microscope.open");
    EXPECT_EQ(part().target, glm::vec3(2, 1, 0)) << "the microscope looks at a reach";
}

TEST_F(ChainReach, SavesItsTargetWhileAnotherModeIsOn) {
    reach_with(4);
    run("chain.target", {{"to", {2, 1, 0}}});
    run("chain.mode", {{"mode", "forward"}});
    const Json saved = part().save();
    const auto opened = part().load(saved, "chain");
    EXPECT_EQ(opened->save(), saved);
    EXPECT_TRUE(dynamic_cast<const ChainPart&>(*opened) == part());
    workspace.document.set(chain_lab, opened);
    run("chain.mode", {{"mode", "reach"}});
    EXPECT_EQ(part().target, glm::vec3(2, 1, 0));

    Json old = saved;  // of a version that did not save it
    old.erase("reach_target");
    workspace.document.set(chain_lab, part().load(old, "chain"));
    run("chain.mode", {{"mode", "reach"}});
    EXPECT_EQ(part().target, part().chain.position(4)) << "Reach begins at its tip";

    Json wrong = saved;
    wrong["reach_target"] = {1, 2};
    EXPECT_TRUE(test::says(test::message_of([&] { part().load(wrong, "chain"); }), "chain.reach_target"));

    run("chain.mode", {{"mode", "forward"}});
    run("chain.motion", {{"path", "circle"}});
    run("chain.mode", {{"mode", "reach"}});
    EXPECT_EQ(part().load(part().save(), "chain")->save(), part().save()) << "of a moving target, too";
}

// A chain in a plane, in the program: commands, state, files, undo, drags, the trailing modes, code, presets.

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
    expect_refused("chain.angle_limit", {{"index", 1}, {"min_deg", 20}, {"max_deg", 10}},
                   {"min is over max"});
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
