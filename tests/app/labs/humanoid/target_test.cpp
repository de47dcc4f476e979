// Targets and limits: the body reaches for its targets, by the lab's commands and --state.
#include <algorithm>
#include <glm/gtc/quaternion.hpp>

#include "app/labs/humanoid/humanoid_runtime.hpp"
#include "humanoid_support.hpp"

namespace tendril::app {
namespace {

class HumanoidTargets : public HumanoidTest {
  protected:
    void target(const char* effector, double x, double y, double z) {
        run("humanoid.target", {{"effector", effector}, {"to", {x, y, z}}});
    }
    Json chain(const std::string& end) const {
        const Json chains = state().at("chains");
        for (const Json& each : chains)
            if (each.at("end") == end) return each;
        ADD_FAILURE() << "no chain ends at " << end;
        return {};
    }
    double residual(const std::string& end) const { return chain(end).at("residual").get<double>(); }
};

TEST_F(HumanoidTargets, AreReachedWithoutATick) {
    run("humanoid.clip", {{"name", "punch"}, {"time", 0.4}});
    target("left_hand", 0.35, 1.5, 0.45);
    target("right_hand", -0.4, 1.0, 0.3);
    target("left_foot", 0.2, 0.3, 0.2);
    target("head", 0.05, 1.48, 0.1);
    target("hips", 0.02, 0.9, 0.0);
    EXPECT_LT(glm::distance(bone("LeftHand"), glm::dvec3(0.35, 1.5, 0.45)), 1e-3);
    EXPECT_LT(glm::distance(bone("RightHand"), glm::dvec3(-0.4, 1.0, 0.3)), 1e-3);
    EXPECT_LT(glm::distance(bone("LeftFoot"), glm::dvec3(0.2, 0.3, 0.2)), 1e-3);
    EXPECT_LT(glm::distance(bone("Head"), glm::dvec3(0.05, 1.48, 0.1)), 1e-3);
    EXPECT_LT(glm::distance(bone("Hips"), glm::dvec3(0.02, 0.9, 0.0)), 1e-3);
    for (const char* end : {"LeftHand", "RightHand", "LeftFoot", "Head", "Hips"})
        EXPECT_LT(residual(end), 1e-3) << end;
    EXPECT_EQ(residual("RightFoot"), 0.0);
}

TEST_F(HumanoidTargets, WithoutAPositionKeepTheEffectorInPlace) {
    run("humanoid.clip", {{"name", "walk"}, {"time", 0.3}});
    const glm::dvec3 hand = bone("LeftHand");
    run("humanoid.target", {{"effector", "left_hand"}});
    EXPECT_LT(glm::distance(bone("LeftHand"), hand), 1e-5);
    run("humanoid.clip", {{"time", 0.5}});
    const glm::dvec3 along = hand + glm::dvec3(0.0, 0.0, 0.2);  // the walk advances at 1 m/s
    EXPECT_LT(glm::distance(bone("LeftHand"), along), 1e-3) << "the walk goes on, and the target with it";
    run("humanoid.clip", {{"time", 0.6}, {"targets_travel", false}});
    EXPECT_LT(glm::distance(bone("LeftHand"), along), 1e-3) << "or the target stays";
}

TEST_F(HumanoidTargets, GoToSeveralEffectorsAtOnce) {
    const Json hands{"right_hand", "left_hand"};
    run("humanoid.target", {{"effectors", hands}, {"points", {{-0.5, 1.2, 0.3}, {0.5, 1.1, 0.3}}}});
    const auto targets = [&] { return state().at("body").at("targets"); };
    EXPECT_EQ(targets().at("right_hand").at("position"), (Json{-0.5, 1.2, 0.3}));
    EXPECT_EQ(targets().at("left_hand").at("position"), (Json{0.5, 1.1, 0.3}));
    run("humanoid.target",
        {{"effectors", hands}, {"rotations", {{0, 0, 0, 1}, {0, 1, 0, 0}}}, {"weight", 2.5}});
    EXPECT_EQ(quaternion(targets().at("left_hand").at("rotation")), glm::dquat(0, 0, 1, 0));
    EXPECT_EQ(targets().at("right_hand").at("weight"), 2.5);
    run("humanoid.target", {{"effectors", hands}, {"weight", 0}});
    EXPECT_TRUE(targets().empty());
    run("undo");
    EXPECT_EQ(targets().size(), 2u) << "one step for all";
    const Json points{{0, 1, 0}, {0, 1, 0}};
    const auto refuses = [&](Json arguments, const char* what) {
        expect_refused("humanoid.target", arguments, {what});
    };
    refuses({{"weight", 1}}, "needs either effector or effectors");
    refuses({{"effectors", {"head", "tail"}}, {"points", points}},
            "effectors: there is no effector \"tail\"");
    refuses({{"effectors", {"head", "head"}}, {"points", points}}, "\"head\" is listed twice");
    refuses({{"effectors", {"head", 3}}, {"points", points}}, "3 is not a name");
    refuses({{"effectors", Json::array()}}, "effectors: []");
    refuses({{"effectors", Json::array({"head"})}, {"points", points}},
            "1 points, one for each of effectors");
    refuses({{"effectors", hands}, {"points", {{0, 1, 0}, {0, "x", 0}}}}, "points.1");
    refuses({{"effectors", hands}, {"rotations", {{0, 0, 0, 1}, {0, 0, 0, 9}}}}, "rotations.1");
    refuses({{"effectors", hands}, {"to", {0, 1, 0}}}, "to is for one effector");
    refuses({{"effector", "head"}, {"points", points}}, "points is for effectors");
}

TEST_F(HumanoidTargets, StopAtLimitsWhichSaySo) {
    target("hips", 0.0, 1.0, 0.0);
    target("head", 0.0, 1.6, 0.0);
    target("left_hand", -0.2, 1.4, -0.5);  // behind the back, where no arm can go
    const double limited = residual("LeftHand");
    const Json active = chain("LeftHand").at("active_limits");
    EXPECT_NE(std::ranges::find(active, Json("LeftUpperArm")), active.end()) << active;
    EXPECT_GT(limited, 0.01);
    run("humanoid.limits", {{"from", "none"}});
    EXPECT_EQ(state().at("body").at("limits"), "none");
    const Json free = state().at("chains");
    for (const Json& each : free) EXPECT_TRUE(each.at("active_limits").empty());
    EXPECT_LT(residual("LeftHand"), limited);
    run("humanoid.limits", {{"from", "motion"}});
    EXPECT_EQ(state().at("body").at("limits"), "motion");
    EXPECT_GT(residual("LeftHand"), 0.01) << "the clips never go there";
}

TEST_F(HumanoidTargets, StateOfAnotherBodyIsIgnored) {
    target("left_hand", 0.4, 1.5, 0.7);
    Json scene = save_scene(workspace);
    scene["labs"][humanoid_lab]["ik"]["body"]["turns"].erase(0);
    load_scene(workspace, scene);
    EXPECT_LT(glm::distance(bone("LeftHand"), glm::dvec3(0.4, 1.5, 0.7)), 1e-3);
}

}  // namespace
}  // namespace tendril::app
