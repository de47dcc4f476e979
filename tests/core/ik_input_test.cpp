// Bad input is refused without moving a bit; hostile input never produces NaN.

#include "field_values.hpp"
#include "ik_support.hpp"

namespace tendril::test::ik_input_test {
namespace {

using ik::Limit;
using ik::Method;
using ik::Options;
using ik::Report;
using ik::Status;

const Lengths lengths{1.0f, 0.5f};  // two, accepted by every method

/// Whether the report says that, and puts the tip infinitely far from its target.
testing::AssertionResult refuses(const Report& report, const std::string& why) {
    EXPECT_EQ(report.status, Status::InvalidInput);
    EXPECT_EQ(report.residual, infinity);
    return says(report.accepted.message(), "solve " + why);
}

/// `why` in the form of says().
void expect_refused(const std::string& why, const Options& options, glm::vec3 target = {0.5f, 0.5f, 0.5f},
                    Joints start = {{0, 0, 0}, {1, 0, 0}, {1, 0.5f, 0}}) {
    for (const Method method : ik::all_methods) {
        KeptSolver solver(lengths);
        Joints joints = start;
        Recorder recorder;
        EXPECT_TRUE(refuses(solver.solve(method, joints, target, options, &recorder), why)) << name(method);
        EXPECT_TRUE(same_bits(joints, start)) << name(method);
        EXPECT_TRUE(recorder.steps.empty() && recorder.iterations.empty()) << name(method);
    }
}

TEST(IkInput, NonFiniteAndTooLargeNumbersAreRefused) {
    for (const float bad : {nan, infinity, -infinity, 1.1e9f, -2e9f})
        for (int axis = 0; axis < 3; ++axis) {
            glm::vec3 point(0.5f);
            point[axis] = bad;
            const std::string at = std::string(".") + "xyz"[axis];
            expect_refused("target" + at, {}, point);
            expect_refused("pole" + at, {.pole = point});
            for (std::size_t joint = 0; joint < 3; ++joint) {
                Joints start{{0, 0, 0}, {1, 0, 0}, {1, 0.5f, 0}};
                start[joint][axis] = bad;
                expect_refused("joints[" + std::to_string(joint) + "]" + at, {}, {1, 1, 0}, start);
            }
        }
}

TEST(IkInput, AnyOptionOutOfRangeIsRefused) {
    const auto each = [](std::span<const Field> table, auto object_in) {
        for (const Field& row : table) {
            if (row.get == nullptr || row.count != nullptr) continue;
            for (const FieldValue& bad : values_out_of_range(row)) {
                Options options;
                row.set(object_in(options), bad);
                expect_refused(row.name, options);
            }
        }
    };
    each(fields<Options>(), [](Options& options) { return static_cast<void*>(&options); });
    each(fields<ik::Plane>(), [](Options& options) { return static_cast<void*>(&options.plane.emplace()); });
}

TEST(IkInput, LimitsOfTheWrongCountOrWithAFaultAreRefused) {
    const std::vector<Limit> good(2), one(1), three(3);
    expect_refused("limits 2 in number 1", {.limits = one});
    expect_refused("limits", {.limits = three});
    const std::vector<Limit> limits{Limit{}, Limit::hinge({0, 0, 1}, 1.0f, 0.5f)};
    expect_refused("limits[1] valid", {.limits = limits});
}

TEST(IkInput, BadPlanesAreRefused) {
    ik::Plane plane{{0, 0, 1}};
    expect_refused("plane.normal 1e-6", {.plane = ik::Plane{glm::vec3(0.0f)}});
    for (const ik::AngleLimit bad : {ik::AngleLimit{1, 0}, {nan, 0}, {-4, 0}, {0, 4}}) {
        const ik::AngleLimit limits[] = {{}, bad};
        plane.limits = limits;
        expect_refused("plane.limits[1] valid", {.plane = plane});
    }
    const ik::AngleLimit one[1]{};
    plane.limits = one;
    expect_refused("plane.limits 2 1", {.plane = plane});
    const Limit solid[2]{};
    expect_refused("limits", {.limits = solid, .plane = ik::Plane{{0, 0, 1}}});
}

TEST(IkInput, AWrongNumberOfJointsOrBonesIsRefused) {
    KeptSolver solver(Lengths(4, 1.0f));
    Joints joints(4);
    EXPECT_TRUE(refuses(solver.solve(Method::Fabrik, joints, {1, 1, 1}), "joints 5 4"));
    EXPECT_TRUE(refuses(solver.solve(Method::Fabrik, std::span<glm::vec3>(), {1, 1, 1}), "joints 5 0"));
    Chain chain = straight(4);
    const Chain before = chain;
    EXPECT_TRUE(refuses(solver.solve(Method::Fabrik, chain, {1, 1, 1}), "chain segments 5 4"));
    EXPECT_TRUE(same_bits(chain, before));
    joints = straight_joints(Lengths(4, 1.0f));
    const Joints start = joints;
    EXPECT_FALSE(solver.solve(Method::TwoBone, joints, {1, 1, 1}).accepted);
    EXPECT_TRUE(refuses(solver.solve(static_cast<Method>(99), joints, {1, 1, 1}), "method 99"));
    EXPECT_TRUE(same_bits(joints, start));
}

TEST(IkInput, AChainThatWouldLeaveItsRangeDoesNotMove) {
    Chain chain = straight(3, 8e8f);
    const Chain before = chain;
    KeptSolver solver(chain);
    EXPECT_EQ(solver.solve(Method::Fabrik, chain, {0, 1e9f, 0}).status, Status::InvalidInput);
    EXPECT_TRUE(same_bits(chain, before));
}

TEST(IkInput, ASolverRefusesBadLengthsAndDirections) {
    using ik::Solver;
    EXPECT_EQ(Solver::make(Lengths{1.0f, -1.0f}).code(), ErrorCode::InvalidArgument);
    EXPECT_FALSE(Solver::make(Lengths{nan}));
    EXPECT_FALSE(Solver::make(Lengths{1.1e9f}));
    const std::vector<glm::vec3> two{{1, 0, 0}, {0, 1, 0}}, not_unit{{1, 0, 0}, {0, 2, 0}};
    EXPECT_TRUE(Solver::make(lengths, two));
    EXPECT_FALSE(Solver::make(Lengths{1.0f}, two));
    EXPECT_FALSE(Solver::make(lengths, not_unit));
    EXPECT_TRUE(says(Solver::make(Lengths{1.0f, -1.0f}).message(), "Solver lengths[1] finite 0 1e9 -1"));
    EXPECT_EQ(Solver(Chain()).bones(), 0u);
    EXPECT_EQ(Solver(straight(1)).bones(), 0u);
}

float hostile_length(Random& random) {
    constexpr float some[] = {0.0f, 1e-30f, 1e-9f, 1e-4f, 0.3f, 1.0f, 17.0f, 1e5f, 1e9f};
    return some[random.below(9)];
}

glm::vec3 hostile_point(const Joints& joints, Random& random) {
    if (!joints.empty() && random.chance(3)) return joints[random.below(joints.size())];
    constexpr float ranges[] = {0.0f, 1e-30f, 1e-6f, 0.5f, 8.0f, 1e4f, 1e9f};
    return random.point(ranges[random.below(7)]);
}

TEST(IkInput, HostileButValidInputNeverGivesNaN) {
    Random random(20261121);
    for (int i = 0; i < 20'000; ++i) {
        Lengths some(random.below(7));
        for (float& length : some) length = hostile_length(random);
        Joints joints;
        for (std::size_t j = 0; j <= some.size(); ++j) joints.push_back(hostile_point(joints, random));
        const glm::vec3 target = hostile_point(joints, random);
        Options options{.max_iterations = 1 + static_cast<int>(random.below(20)),
                        .every_iteration = random.chance(4),
                        .snap_back = random.chance(3) ? part(random) : 0.0f,
                        .soft_zone = random.chance(3) ? part(random) : 0.0f};
        if (random.chance(3)) options.pole = hostile_point(joints, random);
        if (random.chance(4)) options.tolerance = random.chance(2) ? 0.0f : 1e9f;
        const Method method = ik::all_methods[random.below(ik::all_methods.size())];
        KeptSolver solver(some);
        const glm::vec3 root = joints.front();
        const Report report = solver.solve(method, joints, target, options);
        EXPECT_EQ(report.status == Status::InvalidInput, method == Method::TwoBone && some.size() != 2);
        EXPECT_EQ(std::isfinite(report.residual), report.accepted.ok()) << name(method) << ", case " << i;
        EXPECT_TRUE(same_bits(joints.front(), root)) << name(method) << ", case " << i;
        for (const glm::vec3& joint : joints)
            EXPECT_TRUE(std::isfinite(joint.x) && std::isfinite(joint.y) && std::isfinite(joint.z))
                << name(method) << ", case " << i;
    }
}

}  // namespace
}  // namespace tendril::test::ik_input_test
