// A target that crosses the line to the pole: the chain must not flip to the other side in one step.
#include "ik_support.hpp"

namespace tendril::test::ik_pole_sweep_test {
namespace {

using ik::Method;
using ik::PoleTurn;

struct Sweep {
    double step = 0.0;  ///< target motion per solve, metres
    PoleTurn turn = PoleTurn::WholeChain;
    glm::dvec3 normal{0.0};  ///< normal of the arc's plane
    bool forgets = false;    ///< reset the state before every solve
};

/// The chain follows a target on an arc of radius 3 m, from one radian before the pole's direction to one
/// after. Returns the maximum ratio of any joint's motion to the target's in a tick.
double worst_ratio(Method method, const Lengths& lengths, const Sweep& sweep) {
    constexpr double radius = 3.0;
    const glm::vec3 pole{2, 1, 0};
    const glm::dvec3 middle = glm::normalize(glm::dvec3(pole)) * radius;
    KeptSolver solver(lengths);
    Joints joints = straight_joints(lengths);
    const ik::Options options{.tolerance = 1e-4f, .pole = pole, .pole_turn = sweep.turn};
    const auto at = [&](double angle) { return glm::vec3(turned(middle, sweep.normal, angle)); };
    glm::vec3 target = at(-1.0);
    for (int i = 0; i < 100; ++i) solver.solve(method, joints, target, options);  // settle first
    double worst = 0.0;
    for (double angle = -1.0; angle <= 1.0; angle += sweep.step / radius) {
        if (sweep.forgets) solver.state.reset();
        const Joints before = joints;
        const glm::vec3 next = at(angle);
        const double moved = distance(next, target);
        target = next;
        EXPECT_NE(solver.solve(method, joints, target, options).status, ik::Status::InvalidInput);
        if (moved == 0.0) continue;
        for (std::size_t i = 0; i < joints.size(); ++i)
            worst = std::max(worst, distance(before[i], joints[i]) / moved);
    }
    EXPECT_TRUE(Holds(joints, lengths));
    return worst;
}

TEST(IkPoleSweep, NoJointJumpsAsTheTargetCrossesThePole) {
    for (const std::size_t bones : {5u, 6u}) {  // five and six bones
        const Lengths lengths(bones, 1.0f);
        for (const double step : {0.025, 0.005, 0.0005})
            for (const PoleTurn turn : {PoleTurn::WholeChain, PoleTurn::EachJoint}) {
                const glm::dvec3 along = glm::normalize(glm::dvec3(2, 1, 0));
                const glm::dvec3 up(0, 0, 1), across = glm::cross(up, along);
                for (const double tilt : {0.0, 0.5, 1.57079632679}) {
                    const glm::dvec3 normal = up * std::cos(tilt) + across * std::sin(tilt);
                    const double ratio = worst_ratio(Method::Fabrik, lengths, {step, turn, normal});
                    EXPECT_LE(ratio, 50.0)
                        << bones << " bones, steps of " << step << " m, "
                        << (turn == PoleTurn::EachJoint ? "each joint" : "whole chain") << ", tilt " << tilt;
                }
            }
    }
}

TEST(IkPoleSweep, WithoutStateJointsJump) {
    const Lengths lengths(5, 1.0f);
    EXPECT_GT(worst_ratio(Method::Fabrik, lengths, {0.025, PoleTurn::WholeChain, {0, 0, 1}, true}), 50.0);
    EXPECT_GT(worst_ratio(Method::Fabrik, lengths, {0.005, PoleTurn::WholeChain, {0, 0, 1}, true}), 50.0);
}

TEST(IkPoleSweep, OtherMethodsDoNotJump) {
    const Lengths lengths(5, 1.0f);
    for (const Method method : iterating_methods)
        for (const PoleTurn turn : {PoleTurn::WholeChain, PoleTurn::EachJoint})
            EXPECT_LE(worst_ratio(method, lengths, {0.005, turn, {0, 0, 1}}), 50.0)
                << name(method) << (turn == PoleTurn::EachJoint ? ", each joint" : ", whole chain");
    EXPECT_LE(worst_ratio(Method::TwoBone, Lengths{2, 2}, {0.005, PoleTurn::WholeChain, {0, 0, 1}}), 50.0);
}

}  // namespace
}  // namespace tendril::test::ik_pole_sweep_test
