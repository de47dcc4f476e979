// Hand IK, look-at and self-collision, by the lab's commands and --state.
#include <array>
#include <glm/gtc/quaternion.hpp>

#include "humanoid_support.hpp"

namespace tendril::app {
namespace {

using HumanoidHands = HumanoidTest;

TEST_F(HumanoidHands, BlendByTheTargetsWeight) {
    run("humanoid.clip", {{"name", "punch"}, {"time", 0.1}});
    const glm::dvec3 clip = bone("LeftHand"), wanted = clip + glm::dvec3(0.1, 0.1, 0.05);
    run("humanoid.target",
        {{"effector", "left_hand"}, {"to", {wanted.x, wanted.y, wanted.z}}, {"weight", 0.5}});
    run("humanoid.hand_ik", {{"on", true}});
    EXPECT_LT(glm::distance(bone("LeftHand"), glm::mix(clip, wanted, 0.5)), 5e-3);
    run("humanoid.target", {{"effector", "left_hand"}, {"weight", 1}});
    EXPECT_LT(glm::distance(bone("LeftHand"), wanted), 1e-3);
    run("humanoid.target", {{"effector", "left_hand"}, {"weight", 0.005}});
    EXPECT_EQ(bone("LeftHand"), clip) << "under 0.01 it is off";
    run("humanoid.hand_ik", {{"on", false}});
    EXPECT_LT(glm::distance(bone("LeftHand"), wanted), 1e-3) << "the body reaches for it again";
}

TEST_F(HumanoidHands, TimesMayBeTypedInAnyOrder) {
    run("humanoid.target", {{"effector", "left_hand"}});
    run("humanoid.hand_ik", {{"on", true}, {"hand", "left"}, {"curve", true}});
    const auto times = [&] {
        const HandCurve& curve = *part().ik.hand_ik.curves[0];
        return std::array{curve.begin, curve.full, curve.until, curve.end};
    };
    run("humanoid.hand_ik", {{"hand", "left"}, {"begin", 1.0}});  // beyond all the others
    EXPECT_EQ(times(), (std::array{1.0, 1.0, 1.0, 1.0}));
    run("humanoid.hand_ik", {{"hand", "left"}, {"full", 1.2}});
    run("humanoid.hand_ik", {{"hand", "left"}, {"until", 1.5}});
    run("humanoid.hand_ik", {{"hand", "left"}, {"end", 1.75}});
    EXPECT_EQ(times(), (std::array{1.0, 1.2, 1.5, 1.75}));
    run("humanoid.hand_ik", {{"hand", "left"}, {"end", 0.5}});
    EXPECT_EQ(times(), (std::array{0.5, 0.5, 0.5, 0.5}));
    expect_refused("humanoid.hand_ik", {{"begin", 0.6}, {"full", 0.5}},
                   {"from", "full from", "full to", "must be in ascending order"});
}

TEST_F(HumanoidHands, NeedABody) {
    run("humanoid.map", {{"bone", "LeftHand"}});
    for (const char* command :
         {"humanoid.hand_ik", "humanoid.look_at", "humanoid.self_collision", "humanoid.balance"}) {
        expect_refused(command, {{"on", true}}, {"full-body IK is off: LeftHand is missing"});
        run(command, {{"on", false}});
    }
}

using HumanoidLook = HumanoidTest;

TEST_F(HumanoidLook, TurnsTheHeadToATarget) {
    run("humanoid.look_at", {{"on", true}});
    const glm::dvec3 ahead = vector(state().at("look_at").at("target"));
    EXPECT_GT(ahead.z, 1.0) << "ahead of the head where nothing was given";
    const glm::dvec3 target(1.2, 1.9, 1.2);
    run("humanoid.look_at", {{"to", {target.x, target.y, target.z}}});
    tick(120);
    const glm::dvec3 forward = quaternion(bones().at("Head").at("rotation")) * glm::dvec3(0, 0, 1);
    EXPECT_GT(glm::dot(forward, glm::normalize(target - bone("Head"))), std::cos(glm::radians(3.0)));
    EXPECT_LT(state().at("look_at").at("left_deg").get<double>(), 3.0);
    run("humanoid.look_at", {{"weight", 0}});
    EXPECT_EQ(bone("Neck"), glm::dvec3(0, 1.5, 0));
    run("humanoid.look_at", {{"on", false}});
    EXPECT_EQ(quaternion(bones().at("Head").at("rotation")), glm::dquat(1, 0, 0, 0));
}

}  // namespace
}  // namespace tendril::app
