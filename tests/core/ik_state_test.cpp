// A solver's state is a value: restored from a copy, the same solves give the same bits.
#include <map>

#include "ik_limit_support.hpp"

namespace tendril::test::ik_state_test {
namespace {

using ik::Method;
using ik::PoleTurn;
using ik::State;

/// A simulation in progress: joints, state and a moving target.
struct Scene {
    Arm arm;
    Method method = Method::Fabrik;
    bool limited = false;
    bool with_pole = false;
    PoleTurn turn = PoleTurn::WholeChain;
    Joints joints;
    State state;
    glm::vec3 target{0.0f};
};

Scene some_scene(Random& random, int number) {
    Scene scene;
    scene.method = ik::all_methods[static_cast<std::size_t>(number) % ik::all_methods.size()];
    const std::size_t bones = scene.method == Method::TwoBone ? 2 : 2 + random.below(7);
    scene.arm = some_arm(random, bones);
    scene.limited = random.chance(2);
    scene.with_pole = random.chance(2);
    scene.turn = random.chance(2) ? PoleTurn::WholeChain : PoleTurn::EachJoint;
    scene.joints = scene.arm.at_rest();
    scene.state = State(bones);
    scene.target = scene.joints.back();
    return scene;
}

/// One frame: the target moves, sometimes far, and the chain follows. All results are appended to `out`.
void frame(ik::Solver& solver, Scene& scene, Random& random, std::vector<float>& out) {
    const float reach = scene.arm.reach();
    scene.target =
        random.chance(20) ? random.point(1.3f * reach) : scene.target + random.point(0.03f * reach);
    ik::Options options;
    if (scene.limited) options.limits = scene.arm.limits;
    if (scene.with_pole) options.pole = glm::vec3(0.3f, 1.0f, -0.5f) * reach;
    options.pole_turn = scene.turn;
    options.rotations = true;
    options.max_iterations = 30;
    options.weight = random.chance(4) ? part(random) : 1.0f;
    const ik::Report report = solver.solve(scene.method, scene.joints, scene.state, scene.target, options);
    ASSERT_NE(report.status, ik::Status::InvalidInput);
    out.push_back(report.residual);
    out.push_back(static_cast<float>(report.iterations));
    for (const glm::vec3& p : scene.joints) out.insert(out.end(), {p.x, p.y, p.z});
    for (const glm::quat& q : scene.state.rotations) out.insert(out.end(), {q.w, q.x, q.y, q.z});
}

std::vector<float> play(ik::Solver& solver, Scene& scene, std::uint32_t seed, int frames) {
    std::vector<float> out;
    Random random(seed);
    for (int i = 0; i < frames; ++i) frame(solver, scene, random, out);
    return out;
}

bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
    return a.size() == b.size() &&
           (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0);
}

TEST(IkState, RollbackGivesTheSameBits) {
    Random random(71);
    for (int number = 0; number < 70; ++number) {
        Scene scene = some_scene(random, number);
        KeptSolver kept = scene.arm.solver();
        ik::Solver solver = ik::Solver::make(scene.arm.lengths, scene.arm.rest).value();
        ik::Solver other = ik::Solver::make(scene.arm.lengths, scene.arm.rest).value();
        play(solver, scene, 1, 20);
        const Scene saved = scene;
        const std::vector<float> first = play(solver, scene, 2, 100);
        const State end = scene.state;
        scene.joints = saved.joints, scene.state = saved.state, scene.target = saved.target;
        EXPECT_TRUE(same_bits(play(solver, scene, 2, 100), first)) << number;
        EXPECT_EQ(scene.state, end) << number;
        // Any solver can continue the solve.
        Scene elsewhere = saved;
        EXPECT_TRUE(same_bits(play(other, elsewhere, 2, 100), first)) << number;
    }
}

TEST(IkState, RotationsAreUpdatedIfRequested) {
    Random random(73);
    for (int number = 0; number < 140; ++number) {
        Scene scene = some_scene(random, number);
        ik::Solver solver = ik::Solver::make(scene.arm.lengths, scene.arm.rest).value();
        play(solver, scene, static_cast<std::uint32_t>(number), 10);
        std::vector<glm::quat> local(scene.state.bones());
        ASSERT_TRUE(local_rotations(scene.state, local));
        glm::quat whole(1, 0, 0, 0);
        for (std::size_t i = 0; i < local.size(); ++i) {
            whole = whole * local[i];
            const glm::vec3 bone = scene.joints[i + 1] - scene.joints[i];
            const glm::vec3 said = scene.state.rotations[i] * scene.arm.rest[i] * scene.arm.lengths[i];
            EXPECT_LE(distance(said, bone), 1e-4) << name(scene.method) << " " << i;
            EXPECT_GE(std::abs(glm::dot(whole, scene.state.rotations[i])), 1.0f - 1e-5f);
        }
    }
}

TEST(IkState, RotationsStayIfNotRequested) {
    const Lengths lengths(5, 1.0f);
    KeptSolver solver(lengths);
    Joints joints = straight_joints(lengths);
    const State before = solver.state;
    solver.solve(Method::Fabrik, joints, {1, 2, 1});
    EXPECT_EQ(solver.state, before);
    solver.solve(Method::Fabrik, joints, {1, 2, 1.5f}, {.rotations = true});
    EXPECT_NE(solver.state, before);
    solver.state.reset();
    EXPECT_EQ(solver.state, before);
}

TEST(IkState, AnInvalidStateIsRefused) {
    const Lengths lengths(2, 1.0f);
    const State good(2);
    EXPECT_TRUE(check(good, 2));
    EXPECT_TRUE(says(check(good, 3).message(), "ik::State rotations 3 2"));
    const auto expect_refused = [&](auto spoil, const char* message) {
        State bad = good;
        bad.pole.valid = true;
        spoil(bad);
        EXPECT_STREQ(check(bad, 2).message(), message);
        ik::Solver solver = ik::Solver::make(lengths).value();
        Joints joints = straight_joints(lengths);
        const Joints start = joints;
        EXPECT_EQ(solver.solve(Method::Fabrik, joints, bad, {1, 1, 0}).status, ik::Status::InvalidInput);
        EXPECT_TRUE(test::same_bits(joints, start));
    };
    expect_refused([](State& s) { s.rotations[1].w = 2.0f; },
                   "ik::State: rotations[1] must be of length 1, got 2");
    expect_refused([](State& s) { s.rotations[0].x = nan; },
                   "ik::State: rotations[0] must be of length 1, got nan");
    expect_refused([](State& s) { s.rotations.pop_back(); },
                   "ik::State: rotations must be 2 in number, got 1");
    expect_refused([](State& s) { s.pole.joints.pop_back(); },
                   "ik::State: pole.joints must be 3 in number, got 2");
    expect_refused([](State& s) { s.pole.joints[2].y = infinity; },
                   "ik::State: pole.joints[2] must be finite, got inf");
    expect_refused([](State& s) { s.pole.twist = nan; }, "ik::State: pole.twist must be finite, got nan");
    expect_refused([](State& s) { s.pole.pole.x = nan; }, "ik::State: pole.pole must be finite, got nan");
    expect_refused([](State& s) { s.pole.turn = static_cast<PoleTurn>(7); },
                   "ik::State: pole.turn must be 0 or 1, got 7");
    expect_refused(
        [](State& s) {
            s.pole.valid = false;
            s.limits.valid = true;
            s.limits.damping = nan;
        },
        "ik::State: limits.damping must be from 0 to 100, got nan");
    std::vector<glm::quat> small(1);
    EXPECT_FALSE(local_rotations(good, small));
}

// Solving allocates nothing: every method, with every option, with and without class Chain.

using ik::Limit;
using ik::Options;
using ik::Status;

TEST(IkMemory, SolvingAllocatesNothing) {
    Random random(7);
    for (const Method method : ik::all_methods) {
        const std::size_t bones = method == Method::TwoBone ? 2 : 12;
        const Lengths lengths = some_lengths(bones, random);
        const auto reach = static_cast<float>(reach_of(lengths));
        KeptSolver solver(lengths);
        const std::vector<Limit> limits(bones, Limit::of(ik::JointKind::BallAndSocket));
        std::vector<float> residuals(10);
        const Options options[] = {{},
                                   {.tolerance = 0.0f},
                                   {.pole = glm::vec3(0, 9, 0)},
                                   {.pole = glm::vec3(0, 9, 0), .pole_turn = ik::PoleTurn::EachJoint},
                                   {.limits = limits},
                                   {.limits = limits, .tip_orientation = glm::quat(1, 0, 0, 0)},
                                   {.snap_back = 0.4f, .tip_orientation = glm::quat(1, 0, 0, 0)},
                                   {.soft_zone = 0.2f, .residuals = residuals}};
        for (const Options& each : options)
            for (const float far : {0.0f, 0.3f, 0.7f, 0.995f, 1.5f}) {
                Joints joints = random.chance(3) ? straight_joints(lengths) : some_pose(lengths, random);
                const glm::vec3 target = some_direction(random) * (far * reach);
                Status status = Status::InvalidInput;
                without_memory([&] {
                    status = solver.solve(method, joints, target, each).status;
                    solver.explain(joints, target, each);
                });
                EXPECT_NE(status, Status::InvalidInput) << name(method);
            }
    }
}

TEST(IkMemory, SolvingAChainAllocatesNothing) {
    Chain chain = straight(20);
    KeptSolver solver(chain);
    Status status = Status::InvalidInput;
    without_memory([&] { status = solver.solve(Method::Fabrik, chain, {3, 4, 5}).status; });
    EXPECT_EQ(status, Status::Converged);
    EXPECT_TRUE(Holds(chain));
}

// The observer sees everything: replaying its steps from the start gives the same bits. And it changes
// nothing.

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
    EXPECT_TRUE(test::same_bits(joints, unwatched));
    EXPECT_TRUE(test::same_bits(recorder.replay(start), joints));
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
}  // namespace tendril::test::ik_state_test
