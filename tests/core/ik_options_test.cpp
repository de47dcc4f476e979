// The methods in the rows of fields<Options>(): an option that a method honours changes the result in some
// case; one that it does not honour never changes anything.
#include "ik_limit_support.hpp"

namespace tendril::test::ik_options_test {
namespace {

using ik::Method;

struct Case {
    Arm arm;
    Joints start;
    glm::vec3 target{0.0f};
    bool limited = false;
    ik::Options base;  ///< limits are set in solve()
};

struct Outcome {
    ik::Report report;
    Joints joints;
    std::vector<glm::quat> rotations;
    std::vector<float> residuals;
    bool operator==(const Outcome&) const = default;
};

/// Solves with options modified by `change`; -1 in the residuals marks entries that were not written.
template <class Change>
Outcome solve(Method method, const Case& each, Change change) {
    KeptSolver solver = each.arm.solver();
    Outcome outcome{{}, each.start, {}, std::vector<float>(64, -1.0f)};
    ik::Options options = each.base;
    if (each.limited) options.limits = each.arm.limits;
    change(options, outcome.residuals);
    outcome.report = solver.solve(method, outcome.joints, each.target, options);
    outcome.rotations.assign(solver.rotations().begin(), solver.rotations().end());
    return outcome;
}

/// Sets one option to a value other than its default. Sets both stretch options, as neither acts alone.
void set(const Field& option, ik::Options& options, std::span<float> residuals, const Case& each) {
    const float reach = each.arm.reach();
    const ik::Options changed{.tolerance = 0.1f * reach,
                              .max_iterations = 1,
                              .every_iteration = true,
                              .limits = each.arm.limits,
                              .plane = ik::Plane{{0.3f, 0.2f, 1.0f}},
                              .pole = glm::vec3(0.1f, -0.7f, 1.0f) * reach,
                              .pole_turn = ik::PoleTurn::EachJoint,
                              .snap_back = 0.7f,
                              .tip_orientation = glm::quat(0.5f, 0.5f, -0.5f, 0.5f),
                              .soft_zone = 0.4f,
                              .damping = 0.9f,
                              .start_stretch_ratio = 0.5f,
                              .max_stretch_scale = 1.5f,
                              .twist = 0.8f,
                              .weight = 0.4f,
                              .restarts = 0,
                              .rotations = true};
    const std::string name = option.name;
    if (name == "limits")
        options.limits = changed.limits;
    else if (name == "residuals")
        options.residuals = residuals;
    else if (name == "plane")
        options.plane = changed.plane, options.limits = {};  // a plane has limits of its own
    else
        option.set(&options, option.get(&changed));
    if (name == "start_stretch_ratio") options.max_stretch_scale = changed.max_stretch_scale;
    if (name == "max_stretch_scale") options.start_stretch_ratio = changed.start_stretch_ratio;
}

std::vector<Case> some_cases(Method method, bool limited) {
    std::vector<Case> cases;
    Random random(31);
    for (int number = 0; number < 40; ++number) {
        Case each;
        const std::size_t bones = method == Method::TwoBone ? 2 : 4 + random.below(3);
        each.arm = some_arm(random, bones);
        each.limited = limited;
        each.start = number % 4 == 0 ? each.arm.at_rest() : some_pose(each.arm.lengths, random);
        each.target = number % 3 == 0 ? some_tip(each.arm, random) : random.point(each.arm.reach());
        each.base.max_iterations = 60;
        each.base.damping = 0.2f;
        if (number % 2 == 0) each.base.pole = random.point(2.0f * each.arm.reach());
        if (number % 5 == 0) each.base.soft_zone = 0.2f;
        if (number % 7 == 0) each.base.snap_back = 0.3f;
        cases.push_back(each);
    }
    return cases;
}

int changed_cases(Method method, const Field& option, bool limited) {
    int changed = 0;
    for (const Case& each : some_cases(method, limited)) {
        const auto as_it_is = [](ik::Options&, std::span<float>) {};
        const auto otherwise = [&](ik::Options& options, std::span<float> residuals) {
            set(option, options, residuals, each);
        };
        const Outcome a = solve(method, each, as_it_is), b = solve(method, each, otherwise);
        EXPECT_NE(a.report.status, ik::Status::InvalidInput);
        EXPECT_NE(b.report.status, ik::Status::InvalidInput) << option.name;
        changed += a != b;
    }
    return changed;
}

TEST(IkOptions, TheTableListsTheOptionsOfEachMethod) {
    for (const Method method : ik::all_methods)
        for (const Field& option : fields<ik::Options>())
            for (const bool limited : {false, true}) {
                if (option.name == std::string("limits") && limited) continue;
                const int changed = changed_cases(method, option, limited);
                EXPECT_EQ(changed > 0, honours(method, option, limited))
                    << name(method) << ", " << option.name << (limited ? " within limits" : " without limits")
                    << ": " << changed << " of 40 changed";
            }
}

TEST(IkOptions, TwoBoneNeedsTwoBones) {
    EXPECT_TRUE(check_takes(Method::TwoBone, 2));
    EXPECT_TRUE(says(check_takes(Method::TwoBone, 5).message(), "Two-bone two bones"));
    EXPECT_TRUE(check_takes(Method::Ccd, 5));
    EXPECT_FALSE(check_takes(static_cast<Method>(99), 5));
}

// ---- Weight

/// Unit vectors along the bones.
Joints directions(const Joints& joints) {
    Joints result;
    for (std::size_t i = 1; i < joints.size(); ++i)
        result.push_back(glm::normalize(joints[i] - joints[i - 1]));
    return result;
}

double angle_between(glm::vec3 a, glm::vec3 b) {
    return std::atan2(distance(glm::cross(a, b), {0, 0, 0}), double(glm::dot(a, b)));
}

TEST(IkWeight, BonesTurnByTheWeightAndKeepTheirLengths) {
    Random random(32);
    for (const Method method : iterating_methods) {
        for (int number = 0; number < 40; ++number) {
            const Lengths lengths = some_lengths(2 + random.below(6), random);
            const Joints start = some_pose(lengths, random);
            const glm::vec3 target = random.point(static_cast<float>(reach_of(lengths)));
            Joints whole = start, some = start, none = start;
            const float weight = part(random);
            const ik::Report report = KeptSolver(lengths).solve(method, whole, target);
            EXPECT_EQ(KeptSolver(lengths).solve(method, some, target, {.weight = weight}), report);
            EXPECT_EQ(KeptSolver(lengths).solve(method, none, target, {.weight = 0.0f}), report);
            EXPECT_TRUE(same_bits(none, start));
            EXPECT_TRUE(Holds(some, lengths));
            const Joints from = directions(start), to = directions(whole), is = directions(some);
            for (std::size_t i = 0; i < is.size(); ++i) {
                const double all = angle_between(from[i], to[i]);
                if (all > 3.1) continue;  // half a turn: the direction of turning is free
                EXPECT_NEAR(angle_between(from[i], is[i]), double(weight) * all, 2e-3);
                EXPECT_NEAR(angle_between(is[i], to[i]), (1.0 - double(weight)) * all, 2e-3);
            }
        }
    }
}

TEST(IkWeight, BlendedPosesAreWithinTheirLimits) {
    Random random(33);
    for (int number = 0; number < 200; ++number) {
        const Arm arm = some_arm(random, 2 + random.below(4));
        KeptSolver solver = arm.solver();
        Joints joints = arm.at_rest();
        for (int frame = 0; frame < 4; ++frame) {
            const glm::vec3 target = random.point(arm.reach());
            const ik::Report report =
                solver.solve(Method::Fabrik, joints, target,
                             {.max_iterations = 40, .limits = arm.limits, .weight = part(random)});
            ASSERT_NE(report.status, ik::Status::InvalidInput);
            EXPECT_TRUE(Holds(joints, arm.lengths));
            EXPECT_TRUE(WithinLimits(arm, joints, solver.rotations()));
        }
    }
}

TEST(IkWeight, AStretchIsBlendedToo) {
    const Lengths lengths{1, 1};
    KeptSolver solver(lengths);
    Joints joints = straight_joints(lengths, {0, 1, 0});
    const ik::Options options{.start_stretch_ratio = 0.5f, .max_stretch_scale = 1.6f, .weight = 0.5f};
    EXPECT_EQ(solver.solve(Method::TwoBone, joints, {1.6f, 0, 0}, options).status, ik::Status::Converged);
    EXPECT_NEAR(distance(joints[0], joints[1]), 1.3, 1e-5);
    EXPECT_NEAR(distance(joints[1], joints[2]), 1.3, 1e-5);
}

// ---- What actually ran

TEST(IkReport, CountsStepsRestartsAndPerturbations) {
    Random random(34);
    int steps = 0, restarts = 0, closed = 0, perturbations = 0;
    for (int number = 0; number < 100; ++number) {
        const Arm arm = some_arm(random, ArmKind::Mixed, 5);
        Joints joints = arm.at_rest();
        const ik::Report report = arm.solver().solve(Method::Fabrik, joints, some_tip(arm, random),
                                                     {.max_iterations = 200, .limits = arm.limits});
        steps += report.least_squares_steps, restarts += report.restarts;
        EXPECT_LE(report.least_squares_steps, report.iterations);
        joints = arm.at_rest();
        const ik::Report calm =
            arm.solver().solve(Method::Fabrik, joints, some_tip(arm, random),
                               {.max_iterations = 200, .limits = arm.limits, .restarts = 0});
        EXPECT_EQ(calm.restarts, 0);
        const Lengths lengths(5, 1.0f);
        joints = straight_joints(lengths);
        const ik::Report plain = KeptSolver(lengths).solve(Method::Ccd, joints, {number < 50 ? 3 : 7, 0, 0});
        closed += plain.closed_form, perturbations += plain.perturbations;
        EXPECT_EQ(plain.least_squares_steps + plain.restarts, 0);
    }
    EXPECT_GT(steps, 100);
    EXPECT_GT(restarts, 4);
    EXPECT_EQ(closed, 50);
    EXPECT_GE(perturbations, 50);
    Arm two = some_arm(random, ArmKind::Hinges, 2);
    Joints joints = two.at_rest();
    const ik::Report report = two.solver().solve(Method::TwoBone, joints, {0.3f, 0.4f, 0.5f},
                                                 {.every_iteration = true, .limits = two.limits});
    EXPECT_TRUE(report.closed_form);
    EXPECT_EQ(report.least_squares_steps, 99);
}

// The soft zone: the chain slows before it is straight, without jumps, and reports the true residual.

using ik::Report;
using ik::Status;

const Lengths lengths(4, 1.0f);

struct Result {
    Report report;
    double out;  ///< distance of the tip from its root
};

Result reach_for(float distance_from_root, float zone) {
    KeptSolver solver(lengths);
    Joints joints = straight_joints(lengths, {0, 1, 0});
    const glm::vec3 target(distance_from_root, 0, 0);
    const Report report =
        solver.solve(Method::Fabrik, joints, target, {.tolerance = 1e-5f, .soft_zone = zone});
    EXPECT_NEAR(report.residual, distance(joints.back(), target), 1e-5);
    EXPECT_TRUE(Holds(joints, lengths));
    return {report, distance(joints.back(), joints.front())};
}

TEST(IkSoftReach, NothingChangesBeforeTheZone) {
    for (const float far : {0.5f, 2.0f, 3.19f}) {
        const Result result = reach_for(far, 0.2f);
        EXPECT_EQ(result.report.status, Status::Converged) << far;
        EXPECT_NEAR(result.out, far, 2e-5);
    }
}

TEST(IkSoftReach, InTheZoneItStaysShortAndReportsIt) {
    for (const float far : {3.5f, 3.9f, 4.0f, 5.0f, 100.0f}) {
        const Result result = reach_for(far, 0.2f);
        EXPECT_EQ(result.report.status, Status::Stretched) << far;
        EXPECT_LT(result.out, 4.0);
        EXPECT_NEAR(result.report.residual, static_cast<double>(far) - result.out, 1e-4);
        // The curve in the header, with a = 3.2 and z = 0.8.
        const double x = (static_cast<double>(far) - 3.2) / 0.8;
        EXPECT_NEAR(result.out, 3.2 + 0.8 * x / std::sqrt(1.0 + x * x), 1e-4);
    }
}

TEST(IkSoftReach, IsContinuousAndNeverSnaps) {
    double before = reach_for(2.7f, 0.3f).out, step_before = 0.01;
    for (int i = 1; i <= 300; ++i) {
        const double out = reach_for(2.7f + 0.01f * static_cast<float>(i), 0.3f).out;
        const double step = out - before;
        if (out < 3.99) {  // beyond, steps are rounding errors
            EXPECT_GT(step, 0.0) << i;
        }
        EXPECT_LE(step, 0.0101) << i;
        EXPECT_NEAR(step, step_before, 3e-4) << i;  // the slope is continuous, too
        before = out, step_before = step;
    }
    EXPECT_LT(before, 4.0);
}

TEST(IkSoftReach, WithoutAZoneItSnaps) {
    EXPECT_EQ(reach_for(4.2f, 0.0f).report.status, Status::Stretched);
    EXPECT_NEAR(reach_for(4.2f, 0.0f).out, 4.0, 1e-5);
}

TEST(IkSoftReach, TheWholeReachMayBeSoftWithoutFoldingTooFar) {
    const Lengths heavy{2.0f, 0.3f};
    KeptSolver solver(heavy);
    for (const float far : {0.2f, 1.0f, 1.6f, 1.71f, 1.8f, 2.2f, 9.0f}) {
        Joints joints = straight_joints(heavy);
        const Report report = solver.solve(Method::Fabrik, joints, {0, far, 0}, {.soft_zone = 1.0f});
        EXPECT_TRUE(Holds(joints, heavy));
        EXPECT_NEAR(report.residual, distance(joints.back(), {0, far, 0}), 1e-5);
        if (far < 1.7f) {
            EXPECT_EQ(report.status, Status::TooClose) << far;
        }
    }
}

}  // namespace
}  // namespace tendril::test::ik_options_test
