// The observer sees everything: replaying its steps from the start gives the same bits. And it changes
// nothing.
#include <map>

#include "ik_support.hpp"

namespace tendril::test::ik_observer_test {
namespace {

using ik::Limit;
using ik::Method;
using ik::Options;
using ik::Phase;
using ik::Report;

/// Solves with and without an observer, expects the same result, and returns the recording.
Recorder expect_faithful(Method method, const Lengths& lengths, const Joints& start, glm::vec3 target,
                         const Options& options) {
    KeptSolver watched(lengths), alone(lengths);
    Joints joints = start, unwatched = start;
    Recorder recorder;
    const Report report = watched.solve(method, joints, target, options, &recorder);
    EXPECT_EQ(alone.solve(method, unwatched, target, options), report);
    EXPECT_TRUE(same_bits(joints, unwatched));
    EXPECT_TRUE(same_bits(recorder.replay(start), joints));
    EXPECT_FALSE(recorder.iterations.empty());
    for (std::size_t i = 0; i < recorder.iterations.size(); ++i)
        EXPECT_EQ(recorder.iterations[i], static_cast<int>(i));
    int order = 0;
    for (const ik::Step& step : recorder.steps) {
        EXPECT_GE(step.order, order);  // steps that move nothing leave gaps
        EXPECT_TRUE(step.joint < start.size());
        order = step.order;
    }
    return recorder;
}

Options some_options(Random& random, const std::vector<Limit>& limits, std::size_t bones) {
    Options options{.max_iterations = 1 + static_cast<int>(random.below(30))};
    if (random.chance(3)) options.tolerance = 0.0f;
    if (random.chance(2)) options.pole = random.point(4.0f);
    if (random.chance(3)) options.pole_turn = ik::PoleTurn::EachJoint;
    if (random.chance(3)) options.limits = std::span(limits).first(bones);
    if (random.chance(3)) options.snap_back = 0.3f;
    if (random.chance(4)) options.soft_zone = 0.2f;
    if (random.chance(5)) options.tip_orientation = glm::quat(0.6f, 0.0f, 0.8f, 0.0f);
    if (random.chance(3)) options.max_stretch_scale = 1.5f;
    return options;
}

TEST(IkObserver, ReplayedStepsGiveTheResult) {
    Random random(8);
    std::vector<Limit> limits(12, Limit::of(ik::JointKind::BallAndSocket));
    limits[1] = Limit::hinge({0, 0, 1}, -1.0f, 1.0f);
    std::map<Phase, int> phases;
    for (int i = 0; i < 3000; ++i) {
        const Method method = ik::all_methods[random.below(ik::all_methods.size())];
        const Lengths lengths = some_lengths(method == Method::TwoBone ? 2 : 2 + random.below(8), random);
        Joints start = random.chance(3) ? straight_joints(lengths) : some_pose(lengths, random);
        if (random.chance(8)) start.back() += random.point(1.0f);  // torn
        const glm::vec3 target = random.chance(4) ? glm::vec3(random.around(3.0f), 0, 0)
                                                  : random.point(static_cast<float>(reach_of(lengths)));
        SCOPED_TRACE(std::string(name(method)) + ", case " + std::to_string(i));
        const Recorder recorder =
            expect_faithful(method, lengths, start, target, some_options(random, limits, lengths.size()));
        for (const ik::Step& step : recorder.steps) ++phases[step.phase];
        if (::testing::Test::HasFailure()) return;
    }
    for (const Phase phase :
         {Phase::Prepare, Phase::ForwardReaching, Phase::BackwardReaching, Phase::Accelerate, Phase::Rotate,
          Phase::Gradient, Phase::Pole, Phase::Analytic, Phase::RestoreBest})
        EXPECT_GT(phases[phase], 0) << name(phase);
}

TEST(IkObserver, OneIterationOfFourBonesIsEightPulls) {
    const Lengths lengths(4, 1.0f);
    const Joints start{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {2, 1, 0}, {2, 1, 1}};
    const Recorder recorder =
        expect_faithful(Method::FabrikPlain, lengths, start, {1, 2, 0}, {.max_iterations = 1});
    std::vector<std::pair<std::size_t, std::size_t>> pulls;  // which joint, and whose distance it takes
    for (const ik::Step& step : recorder.steps) {
        EXPECT_EQ(step.iteration, 1);
        if (step.neighbour != ik::no_joint) pulls.emplace_back(step.joint, step.neighbour);
    }
    const std::vector<std::pair<std::size_t, std::size_t>> expected{{3, 4}, {2, 3}, {1, 2}, {0, 1},
                                                                    {1, 0}, {2, 1}, {3, 2}, {4, 3}};
    EXPECT_EQ(pulls, expected);
    EXPECT_EQ(recorder.steps.size(), 10u);  // plus tip to target and root to its position
    EXPECT_EQ(recorder.iterations, (std::vector<int>{0, 1}));
}

TEST(IkObserver, OutOfReachIsASingleAnswer) {
    const Lengths lengths(3, 1.0f);
    const Recorder recorder =
        expect_faithful(Method::Fabrik, lengths, straight_joints(lengths), {0, 5, 0}, {});
    EXPECT_EQ(recorder.iterations, std::vector<int>{0});
    ASSERT_EQ(recorder.steps.size(), 3u);
    for (const ik::Step& step : recorder.steps) EXPECT_EQ(step.phase, Phase::Analytic);
    EXPECT_NEAR(recorder.residuals.front(), 2.0f, 1e-5f);
}

}  // namespace
}  // namespace tendril::test::ik_observer_test
