// A solver's state is a value: restored from a copy, the same solves give the same bits.
#include "ik_limited_support.hpp"
#include "tests/says.hpp"

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
    EXPECT_TRUE(test::says(check(good, 3).message(), "ik::State rotations 3 2"));
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

}  // namespace
}  // namespace tendril::test::ik_state_test
