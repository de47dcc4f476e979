// Mode Reach: effects of each command, refusals, and the text for an active limit.
#include <cmath>
#include <glm/trigonometric.hpp>

#include "tests/app/labs/chain_support.hpp"
#include "tests/app/support/temp_folder.hpp"
#include "tests/says.hpp"

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
    refuses("chain.limit", {{"index", 1}, {"kind", "hinge"}, {"min_deg", 50}, {"max_deg", 20}}, "50");
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

TEST_F(ChainReach, KeepsAndSavesItsTargetWhileAnotherModeIsOn) {
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

}  // namespace
}  // namespace tendril::app
