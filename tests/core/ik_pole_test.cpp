// The bend faces its pole, root and tip do not move, and nothing jumps.
#include "ik_hostile.hpp"
#include "tests/labels.hpp"

namespace tendril::test::ik_pole_test {
namespace {

using ik::Method;
using ik::Options;
using ik::PoleTurn;
using ik::Status;

double size(glm::dvec3 v) {
    return std::sqrt(dot(v, v));
}

/// The component of `v` perpendicular to the line.
glm::dvec3 off(glm::dvec3 v, glm::dvec3 line) {
    return v - line * (dot(v, line) / dot(line, line));
}

double angle_between(glm::dvec3 a, glm::dvec3 b) {
    return std::atan2(size(cross(a, b)), dot(a, b));
}

/// The angle between the pole and the weighted sum of the offsets, about the line from root to tip; 0 if
/// straight.
double pole_error(const Joints& joints, std::span<const float> lengths, glm::vec3 pole) {
    const glm::dvec3 root(joints.front()), line = glm::dvec3(joints.back()) - root;
    glm::dvec3 bend(0.0);
    for (std::size_t i = 1; i + 1 < joints.size(); ++i)
        bend += off(glm::dvec3(joints[i]) - root, line) * static_cast<double>(lengths[i - 1] + lengths[i]);
    const double reach = reach_of(lengths);
    if (size(bend) < 1e-3 * reach * reach) return 0.0;
    return angle_between(bend, off(glm::dvec3(pole) - root, line));
}

Options facing(glm::vec3 pole, PoleTurn turn = PoleTurn::WholeChain) {
    Options options{.pole = pole, .pole_turn = turn};
    return options;
}

TEST(IkPole, TheBendFacesThePoleAfterOneSolveByAnyMethod) {
    Random random(1);
    for (int k = 0; k < 2000; ++k) {
        const Lengths lengths = some_lengths(2 + random.below(10), random);
        const Joints start = random.chance(4) ? straight_joints(lengths) : some_pose(lengths, random);
        const glm::vec3 target = some_direction(random) * some_span(lengths, 0.2f, 0.97f, random);
        const glm::vec3 pole = random.point(4.0f);
        if (size(off(pole, target)) < 0.1) continue;
        for (const Method method : iterating_methods) {
            Joints joints = start;
            const ik::Report report = KeptSolver(lengths).solve(method, joints, target, facing(pole));
            EXPECT_LT(pole_error(joints, lengths, pole), 2e-3) << name(method) << ", solve " << k;
            EXPECT_NEAR(report.residual, distance(joints.back(), target), 1e-6 * reach_of(lengths));
        }
    }
}

TEST(IkPole, FacingThePoleMovesNeitherRootNorTip) {
    Random random(2);
    for (const PoleTurn turn : {PoleTurn::WholeChain, PoleTurn::EachJoint}) {
        for (int k = 0; k < 500; ++k) {
            const Lengths lengths = some_lengths(3 + random.below(8), random);
            Joints joints = some_pose(lengths, random);
            const glm::vec3 target = some_direction(random) * some_span(lengths, 0.2f, 0.9f, random);
            Recorder recorder;
            KeptSolver(lengths).solve(Method::Fabrik, joints, target, facing(random.point(3.0f), turn),
                                      &recorder);
            // The pole steps at the end are the final turn.
            auto step = recorder.steps.rbegin();
            for (; step != recorder.steps.rend() && step->phase == ik::Phase::Pole; ++step) {
                if (step->iteration == 0) break;
                EXPECT_NE(step->joint, 0u);
                EXPECT_NE(step->joint, lengths.size());
            }
            EXPECT_TRUE(Holds(joints, lengths));
        }
    }
}

TEST(IkPole, EachJointFacesThePoleInItsOwnPlane) {
    Random random(3);
    int faced = 0, all = 0;
    for (int k = 0; k < 200; ++k) {
        const Lengths lengths = some_lengths(3 + random.below(5), random);
        Joints joints = some_pose(lengths, random);
        const auto reach = static_cast<float>(reach_of(lengths));
        const glm::vec3 target = some_direction(random) * some_span(lengths, 0.5f, 0.8f, random);
        const glm::vec3 pole = some_direction(random) * (3.0f * reach);
        KeptSolver(lengths).solve(Method::Fabrik, joints, target, facing(pole, PoleTurn::EachJoint));
        EXPECT_TRUE(Holds(joints, lengths));
        for (std::size_t i = 1; i + 1 < joints.size(); ++i) {
            const glm::dvec3 line = glm::dvec3(joints[i + 1]) - glm::dvec3(joints[i - 1]);
            const glm::dvec3 bend = off(glm::dvec3(joints[i]) - glm::dvec3(joints[i - 1]), line);
            if (size(bend) < 0.05) continue;
            ++all;
            faced += angle_between(bend, off(glm::dvec3(pole) - glm::dvec3(joints[i - 1]), line)) < 0.05;
        }
    }
    std::printf("%d of %d joints face the pole\n", faced, all);
    EXPECT_GT(faced, all * 98 / 100);
}

TEST(IkPole, RepeatedSolvesComeToRest) {
    Random random(4);
    for (int k = 0; k < 500; ++k) {
        const Lengths lengths = some_lengths(2 + random.below(8), random);
        Joints joints = some_pose(lengths, random);
        const glm::vec3 target = some_direction(random) * some_span(lengths, 0.2f, 0.95f, random);
        const glm::vec3 pole = random.point(4.0f);
        const double reach = reach_of(lengths);
        if (size(off(pole, target)) < 0.1 * reach) continue;
        KeptSolver solver(lengths);
        solver.solve(Method::Fabrik, joints, target, facing(pole));
        Joints settled = joints;
        // The tip was within tolerance of the target; it now moves onto the line to it.
        for (int again = 0; again < 10; ++again) solver.solve(Method::Fabrik, joints, target, facing(pole));
        for (std::size_t i = 0; i < joints.size(); ++i)
            EXPECT_LT(distance(joints[i], settled[i]), 0.02 * reach);
        settled = joints;
        solver.solve(Method::Fabrik, joints, target, facing(pole));
        for (std::size_t i = 0; i < joints.size(); ++i)
            EXPECT_LT(distance(joints[i], settled[i]), 1e-5 * reach);
    }
}

TEST(IkPole, APoleOnTheLineKeepsThePlane) {
    const Lengths lengths(4, 0.25f);
    Joints joints{{0, 0, 0}, {0.25f, 0, 0}, {0.5f, 0, 0}, {0.75f, 0, 0}, {1, 0, 0}};
    KeptSolver solver(lengths);
    solver.solve(Method::Fabrik, joints, {0.7f, 0, 0}, facing({0.3f, 0.6f, 0.8f}));
    const Joints before = joints;
    for (const glm::vec3 pole : {glm::vec3(5, 0, 0), glm::vec3(-1, 0, 0), glm::vec3(0, 0, 0)}) {
        solver.solve(Method::Fabrik, joints, {0.7f, 0, 0}, facing(pole));
        for (std::size_t i = 0; i < joints.size(); ++i) EXPECT_LT(distance(joints[i], before[i]), 1e-3);
    }
}

/// To face the pole at once would take half a turn in a few steps. The chain turns at a limited rate.
TEST(IkPole, APoleCrossingTheLineTurnsTheChainAtALimitedRate) {
    const Lengths lengths(4, 0.25f);
    for (const PoleTurn turn : {PoleTurn::WholeChain, PoleTurn::EachJoint}) {
        Joints joints = straight_joints(lengths);
        KeptSolver solver(lengths);
        double worst = 0.0;
        const auto solve = [&](float y) {
            const Joints before = joints;
            solver.solve(Method::Fabrik, joints, {0.7f, 0, 0}, facing({0.3f, y, 0.0003f}, turn));
            EXPECT_TRUE(Holds(joints, lengths));
            for (std::size_t i = 0; i < joints.size(); ++i)
                worst = std::max(worst, distance(joints[i], before[i]));
        };
        solve(0.01f);
        worst = 0.0;
        for (int k = 0; k <= 2000; ++k) solve(1e-5f * static_cast<float>(1000 - k));
        EXPECT_GT(worst, 1e-4) << "it goes with it";
        EXPECT_LT(worst, 1e-3) << "5e-4, and 20 times 1e-5";
        for (int k = 0; k < 3000; ++k) solve(-0.01f);
        if (turn == PoleTurn::EachJoint) continue;  // so near, joints see the pole on different sides
        EXPECT_LT(pole_error(joints, lengths, {0.3f, -0.01f, 0.0003f}), 1e-3) << "it has caught up";
    }
}

TEST(IkPole, AConstantTwistTurnsNoFaster) {
    const Lengths lengths(2, 0.5f);
    Joints joints = straight_joints(lengths);
    KeptSolver solver(lengths);
    double worst = 0.0;
    for (int k = -1; k <= 2000; ++k) {
        const glm::vec3 before = joints[1];
        Options options = facing({0.3f, 1e-5f * static_cast<float>(1000 - k), 0.0003f});
        options.twist = 1.0f;
        solver.solve(Method::TwoBone, joints, {0.7f, 0, 0}, options);
        if (k >= 0) worst = std::max(worst, distance(joints[1], before));
    }
    EXPECT_LT(worst, 1e-3);
}

TEST(IkPole, ANewOrJumpedPoleIsFacedAtOnce) {
    Random random(5);
    const Lengths lengths(6, 1.0f / 6.0f);
    const glm::vec3 target(0.1f, 0.6f, 0.2f);
    Joints joints = some_pose(lengths, random);
    KeptSolver solver(lengths);
    solver.solve(Method::Fabrik, joints, target);
    for (int k = 0; k < 20; ++k) {
        const glm::vec3 pole = some_direction(random);
        if (size(off(pole, target)) < 0.2) continue;
        solver.solve(Method::Fabrik, joints, target, facing(pole));
        EXPECT_LT(pole_error(joints, lengths, pole), 1e-3);
    }
}

/// A smooth walk in steps of 0.0001: distances in [least, most] of the reach, the pole at least `clear` off
/// the line.
class Walk {
  public:
    Walk(glm::vec3 pole, double least, double most, Random& random)
        : random_(random), pole_(pole), least_(least), max_(most), distance_(0.5 * (least + most)) {
        do {
            direction_ = glm::dvec3(some_direction(random));
        } while (!is_clear());
    }
    bool is_clear() const { return size(off(pole_, direction_)) >= 0.05; }
    glm::vec3 next() {
        spin_ = spin_ * 0.999 + glm::dvec3(random_.point(0.05f));
        speed_ = speed_ * 0.999 + static_cast<double>(random_.around(0.05f));
        if (distance_ < least_ + 0.02) speed_ = std::abs(speed_);
        if (distance_ > max_ - 0.02) speed_ = -std::abs(speed_);
        if (size(off(pole_, direction_)) < 0.07) spin_ = cross(direction_, -off(pole_, direction_)) * 50.0;
        const glm::dvec3 velocity = cross(spin_, direction_) + direction_ * speed_;
        glm::dvec3 at = direction_ * distance_ + velocity * (1e-4 / std::max(size(velocity), 1e-9));
        direction_ = at / size(at);
        distance_ = std::clamp(size(at), least_, max_);
        return direction_ * distance_;
    }

  private:
    Random& random_;
    glm::dvec3 pole_, direction_, spin_{0.0};
    double least_, max_, distance_, speed_ = 0.0;
};

struct Jumps {
    double worst = 0.0;  ///< largest motion of a joint in one step, metres
    int steps = 0, unfaced = 0;
};

/// Chains of 1 m, solved for the walk's start and then along it, each from its last pose.
Jumps walk(Method method, PoleTurn turn, std::size_t bones, int paths, int steps, Random& random) {
    Jumps jumps;
    for (int path = 0; path < paths; ++path) {
        Lengths lengths = random.chance(2) ? Lengths(bones, 1.0f) : some_lengths(bones, random);
        const auto reach = static_cast<float>(reach_of(lengths));
        for (float& length : lengths) length /= reach;
        const double longest = *std::max_element(lengths.begin(), lengths.end());
        const glm::vec3 pole = some_offset(random, 0.15f, 1.5f);
        // A long bone leaves an inner hole with an edge as steep as full reach: stay clear of it, too.
        const double least = std::max(0.05, 2.0 * longest - 1.0 + (bones == 2 ? 0.06 : 0.02));
        if (least > 0.9) continue;
        Walk walk(pole, least, 0.99, random);
        Joints joints = random.chance(2) ? straight_joints(lengths) : some_pose(lengths, random);
        KeptSolver solver(lengths);
        solver.solve(method, joints, walk.next(), facing(pole, turn));
        for (int k = 0; k < steps; ++k) {
            const Joints before = joints;
            const ik::Report report = solver.solve(method, joints, walk.next(), facing(pole, turn));
            EXPECT_TRUE(report.status == Status::Converged || method == Method::JacobianTranspose ||
                        method == Method::Ccd || method == Method::FabrikPlain);
            if (!walk.is_clear()) continue;
            ++jumps.steps;
            jumps.unfaced += pole_error(joints, lengths, pole) > 0.02;
            for (std::size_t i = 0; i < joints.size(); ++i)
                jumps.worst = std::max(jumps.worst, distance(joints[i], before[i]));
        }
    }
    return jumps;
}

LABEL(slow, "IkPole.TheDefaultNeverJumpsAlongARandomPath");

TEST(IkPole, TheDefaultNeverJumpsAlongARandomPath) {
    Random random(given_seed());
    for (const std::size_t bones : {2u, 3u, 4u, 6u, 10u, 20u}) {
        const Jumps jumps = walk(Method::Fabrik, PoleTurn::WholeChain, bones, 12, 5000, random);
        std::printf("%2zu bones, %d steps of 0.1 mm: no joint moves over %.2f mm\n", bones, jumps.steps,
                    1e3 * jumps.worst);
        EXPECT_GT(jumps.steps, 20'000);
        EXPECT_LT(jumps.worst, 0.005);
        EXPECT_LE(jumps.unfaced, jumps.steps / 200) << "nor does it lag behind";
    }
}

TEST(IkPole, EachJointMethodNeverJumpsEither) {
    Random random(given_seed());
    // Not with three: turned into one plane, they can fold onto a line, which no smooth motion can leave.
    for (const std::size_t bones : {2u, 5u, 6u, 10u}) {
        const Jumps jumps = walk(Method::Fabrik, PoleTurn::EachJoint, bones, 10, 4000, random);
        std::printf("%2zu bones: %.2f mm\n", bones, 1e3 * jumps.worst);
        EXPECT_LT(jumps.worst, 0.005);
    }
}

TEST(IkPole, OtherMethodsNeverJumpEither) {
    Random random(given_seed());
    for (const Method method : {Method::FabrikPlain, Method::Dls, Method::SvdDls}) {
        const Jumps jumps = walk(method, PoleTurn::WholeChain, 6, 8, 3000, random);
        std::printf("%s: %.2f mm\n", name(method), 1e3 * jumps.worst);
        EXPECT_LT(jumps.worst, 0.005);
    }
    const Jumps jumps = walk(Method::TwoBone, PoleTurn::WholeChain, 2, 20, 5000, random);
    std::printf("two_bone: %.2f mm\n", 1e3 * jumps.worst);
    EXPECT_LT(jumps.worst, 0.005);
}

TEST(IkPole, SurvivesAnyInput) {
    Random random(given_seed());
    for (int k = 0; k < 4000; ++k) {
        SCOPED_TRACE("solve " + std::to_string(k));
        const Lengths lengths = hostile_lengths(random);
        if (reach_of(lengths) > 500.0) continue;
        const Joints start = hostile_pose(lengths, random);
        Options options = facing(hostile_target(start, lengths, random));
        if (random.chance(2)) options.pole_turn = PoleTurn::EachJoint;
        options.max_iterations = 20;
        const Method method = iterating_methods[random.below(iterating_methods.size())];
        expect_invariants(method, lengths, start, hostile_target(start, lengths, random), options);
    }
}

// A target that crosses the line to the pole: the chain must not flip to the other side in one step.

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
}  // namespace tendril::test::ik_pole_test
