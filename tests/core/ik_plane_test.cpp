// Chains in a plane: they stay in it, keep their side, arrive like chains in space, and respect angle limits.
#include "ik_support.hpp"
#include "tendril/ik/many.hpp"

namespace tendril::test {
namespace {

using ik::AngleFrom;
using ik::AngleLimit;
using ik::Side;
using ik::Status;

constexpr float turn = 3.14159265f;

/// An orthonormal frame: the plane's normal and two axes in it, `left` to the left of `ahead`.
struct Frame {
    glm::vec3 normal, ahead, left;
    glm::vec3 at(float angle) const { return ahead * std::cos(angle) + left * std::sin(angle); }
};

Frame some_frame(Random& random) {
    const glm::quat by = some_turn(random, turn);
    return {by * glm::vec3(0, 0, 1), by * glm::vec3(1, 0, 0), by * glm::vec3(0, 1, 0)};
}

constexpr Frame flat{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}};

/// How a chain starts: random, straight, folded, or back and forth on one line.
enum class Start { Random, Straight, Folded, Collinear };

Joints start_pose(Start start, const Lengths& lengths, const Frame& frame, float line, Random& random) {
    Joints joints{random.point(1.0f)};
    for (std::size_t i = 0; i < lengths.size(); ++i) {
        const bool back = start == Start::Folded ? i % 2 == 1 : start == Start::Collinear && random.chance(2);
        const float angle = start == Start::Random ? random.around(turn) : line + (back ? turn : 0.0f);
        joints.push_back(joints.back() + frame.at(angle) * lengths[i]);
    }
    return joints;
}

double off(const Joints& joints, glm::vec3 normal) {
    double furthest = 0.0;
    for (const glm::vec3& joint : joints)
        furthest = std::max(furthest, std::abs(glm::dot(glm::dvec3(joint) - glm::dvec3(joints.front()),
                                                        glm::normalize(glm::dvec3(normal)))));
    return furthest;
}

/// Signed bend of the chain to the left of the line from root to tip, as a fraction of its reach.
double bend(const Joints& joints, const Lengths& lengths, const Frame& frame) {
    const double reach = reach_of(lengths);
    const glm::dvec3 root = joints.front(), line = glm::dvec3(joints.back()) - root;
    if (glm::length(line) < 0.011 * reach) return 0.0;
    const glm::dvec3 left = glm::cross(glm::dvec3(frame.normal), glm::normalize(line));
    double sum = 0.0;
    for (std::size_t i = 1; i + 1 < joints.size(); ++i)
        sum +=
            glm::dot(glm::dvec3(joints[i]) - root, left) * static_cast<double>(lengths[i - 1] + lengths[i]);
    return sum / (2.0 * reach * reach);
}

/// Amount by which a bone's angle is outside its limit, radians.
double excess(const Joints& joints, std::span<const AngleLimit> limits, const Frame& frame) {
    double most = 0.0, before = 0.0;
    for (std::size_t i = 0; i < limits.size(); ++i) {
        const glm::dvec3 bone = glm::dvec3(joints[i + 1]) - glm::dvec3(joints[i]);
        const double heading =
            std::atan2(glm::dot(bone, glm::dvec3(frame.left)), glm::dot(bone, glm::dvec3(frame.ahead)));
        const double angle = limits[i].from == AngleFrom::Base
                                 ? heading
                                 : std::remainder(heading - before, 2.0 * static_cast<double>(turn));
        before = heading;
        most = std::max(
            {most, static_cast<double>(limits[i].min) - angle, angle - static_cast<double>(limits[i].max)});
    }
    return most;
}

ik::Options in_plane(const Frame& frame, std::span<const AngleLimit> limits = {}) {
    ik::Options options{.max_iterations = 200, .plane = ik::Plane{frame.normal * 3.0f, Side::Free, limits}};
    return options;
}

// 100 000 chains, once: all arrive, at most 1e-7 R off the plane; 99.9 percent in at most 9 iterations from
// random poses, and in 3 from the others (in space: 6 and 16).
TEST(IkPlane, ChainsOfAllStartsArriveInThePlane) {
    Random random(1);
    std::array<std::vector<int>, 4> iterations;
    for (int number = 0; number < 4000; ++number) {
        const auto start = static_cast<Start>(number % 4);
        const std::size_t count[] = {10, 30, 2 + random.below(39)};
        const Lengths lengths = some_lengths(count[number / 4 % 3], random);
        const auto reach = static_cast<float>(reach_of(lengths));
        const Frame frame = some_frame(random);
        const float line = random.around(turn);
        Joints joints = start_pose(start, lengths, frame, line, random);
        const float nearest =
            std::max(2.0f * *std::max_element(lengths.begin(), lengths.end()) - reach, 0.0f);
        const float away = std::max(1.001f * nearest, between(random, 0.0f, 0.999f) * reach);
        const float angle =
            start == Start::Random ? random.around(turn) : line + (random.chance(2) ? turn : 0.0f);
        const float beside = random.around(1.0f);
        const glm::vec3 target = joints.front() + frame.at(angle) * away + frame.normal * beside;
        KeptSolver solver(lengths);
        const ik::Report report = solver.solve(ik::Method::Fabrik, joints, target, in_plane(frame));
        ASSERT_EQ(report.status, Status::Converged) << number;
        ASSERT_LE(off(joints, frame.normal), 1e-6 * static_cast<double>(reach)) << number;
        ASSERT_NEAR(report.off_plane, std::abs(beside), 1e-5f) << number;
        const glm::vec3 dropped = target - frame.normal * beside;
        ASSERT_NEAR(distance(joints.back(), dropped), static_cast<double>(report.residual),
                    2e-6 * static_cast<double>(reach));
        ASSERT_TRUE(Holds(joints, lengths)) << number;
        if (number / 4 % 3 < 2) iterations[static_cast<std::size_t>(start)].push_back(report.iterations);
    }
    for (std::vector<int>& of : iterations) {
        std::sort(of.begin(), of.end());
        EXPECT_LE(of[of.size() * 999 / 1000], 12);
    }
}

// For every combination of other options.
TEST(IkPlane, EveryMethodAndOptionStaysInThePlane) {
    Random random(2);
    for (int number = 0; number < 2000; ++number) {
        const ik::Method method = ik::all_methods[static_cast<std::size_t>(number) % ik::all_methods.size()];
        const std::size_t bones = method == ik::Method::TwoBone ? 2 : 1 + random.below(8);
        const Lengths lengths = some_lengths(bones, random);
        const Frame frame = some_frame(random);
        std::vector<AngleLimit> limits(random.chance(2) ? bones : 0);
        for (AngleLimit& limit : limits)
            limit = {random.around(1.0f) - 1.0f, random.around(1.0f) + 1.0f, AngleFrom{random.chance(2)}};
        ik::Options options = in_plane(frame, limits);
        options.plane->bend = Side{static_cast<std::uint8_t>(random.below(3))};
        if (random.chance(2)) options.pole = random.point(3.0f);
        options.pole_turn = random.chance(2) ? ik::PoleTurn::EachJoint : ik::PoleTurn::WholeChain;
        if (random.chance(3)) options.snap_back = random.part();
        if (random.chance(3)) options.soft_zone = random.part();
        if (random.chance(3)) options.weight = random.part();
        if (random.chance(4)) options.tip_orientation = some_turn(random, turn);
        options.twist = random.around(3.0f);
        options.max_stretch_scale = random.chance(2) ? 2.0f : 1.0f;
        Joints joints = some_pose(lengths, random, random.point(1.0f));
        KeptSolver solver(lengths);
        const double size = reach_of(lengths) * static_cast<double>(options.max_stretch_scale);
        for (int frame_number = 0; frame_number < 3; ++frame_number) {
            const glm::vec3 target = joints.front() + random.point(1.2f * static_cast<float>(size));
            const ik::Report report = solver.solve(method, joints, target, options);
            ASSERT_NE(report.status, Status::InvalidInput) << number;
            ASSERT_LE(off(joints, frame.normal), 1e-6 * size) << number << " " << ik::name(method);
            ASSERT_TRUE(check(solver.state, bones));
        }
    }
}

// 440 000 steps of each method, once, from straight chains of 2 to 12 bones: the side never changes, and no
// joint moves by more than 9 target steps (CCD, which curls the chain: by more than 50 in 178 cases).
TEST(IkPlane, TheSideIsKeptWhileTheTargetPassesTheRoot) {
    Random random(3);
    for (int number = 0; number < 12; ++number) {
        const std::size_t bones = 2 + static_cast<std::size_t>(number) % 6;
        Lengths lengths = some_lengths(bones, random);
        if (bones == 2) lengths = {0.5f, 0.5f};
        for (float& length : lengths) length = 0.5f + 0.5f * length;
        const float reach = static_cast<float>(reach_of(lengths)), step = 2e-3f * reach;
        const Side wanted = number % 2 == 0 ? Side::Left : Side::Right;
        ik::Options options = in_plane(flat);
        options.tolerance = 1e-4f * reach;
        options.plane->bend = wanted;
        Joints joints = straight_joints(lengths), before;
        KeptSolver solver(lengths);
        for (float x = 0.95f * reach; x > -0.95f * reach; x -= step) {
            solver.solve(ik::Method::Fabrik, joints, {x, 0.05f * reach, 0.3f}, options);
            options.plane->bend = Side::Free;  // then the chain keeps its own
            ASSERT_EQ(solver.state.side, wanted) << number << " at " << x;
            const double now = bend(joints, lengths, flat);
            ASSERT_TRUE(std::abs(now) < 2e-4 || (now > 0.0) == (wanted == Side::Left))
                << number << " at " << x;
            double most = 0.0;
            for (std::size_t i = 0; i < before.size(); ++i)
                most = std::max(most, distance(before[i], joints[i]));
            ASSERT_LE(most, 60.0 * static_cast<double>(step)) << number << " at " << x;
            before = joints;
        }
    }
}

// A folded chain, its tip at its root or not, does not stay a zigzag, whose side rounding would decide. Of 1
// 100 000 steps, once, along lines that pass the root at 0.05 to 0.5 R, one is longer than this.
TEST(IkPlane, AFoldedChainUnfoldsSmoothly) {
    Random random(3);
    for (int number = 0; number < 60; ++number) {
        const std::size_t bones = 2 + static_cast<std::size_t>(number) % 11;
        Lengths lengths = some_lengths(bones, random);
        for (float& length : lengths) length = number % 2 == 0 ? 1.0f : 0.5f + 0.5f * length;
        const auto reach = static_cast<float>(reach_of(lengths)), step = 2e-3f * reach;
        const Joints folded = start_pose(Start::Folded, lengths, flat, random.around(turn), random);
        const float angle = random.around(turn), height = between(random, 0.06f, 0.5f) * reach;
        const Side wanted = number % 4 < 2 ? Side::Left : Side::Right;
        ik::Options options = in_plane(flat);
        options.tolerance = 1e-4f * reach;
        options.plane->bend = wanted;
        Joints joints = folded, before;
        KeptSolver solver(lengths);
        for (float x = 0.85f * reach; x > -0.85f * reach; x -= step) {
            const glm::vec3 target = joints.front() + flat.at(angle) * x + flat.at(angle + turn / 2) * height;
            if (distance(target, joints.front()) > 0.98 * static_cast<double>(reach)) continue;
            solver.solve(ik::Method::Fabrik, joints, target, options);
            options.plane->bend = Side::Free;
            ASSERT_EQ(solver.state.side, wanted) << number << " at " << x;
            for (std::size_t i = 1; before.empty() && i < bones; ++i) {
                const glm::vec3 bone = joints[i] - joints[i - 1], next = joints[i + 1] - joints[i];
                ASSERT_EQ(glm::cross(bone, next).z < 0.0f, wanted == Side::Left) << number << " zigzags";
            }
            for (std::size_t i = 0; i < before.size(); ++i)
                ASSERT_LE(distance(before[i], joints[i]), 60.0 * static_cast<double>(step))
                    << number << " at " << x;
            before = joints;
        }
    }
}

TEST(IkPlane, AStraightChainBendsToItsSide) {
    const Lengths lengths{1, 1, 1, 1};
    for (const Side side : {Side::Left, Side::Right}) {
        KeptSolver solver(lengths);
        Joints joints = straight_joints(lengths);
        ik::Options options = in_plane(flat);
        options.plane->bend = side;
        solver.solve(ik::Method::Fabrik, joints, {3, 0, 0}, options);
        EXPECT_EQ(bend(joints, lengths, flat) > 0.0, side == Side::Left);
        // The state keeps the side while the chain is straight.
        options.plane->bend = Side::Free;
        solver.solve(ik::Method::Fabrik, joints, {9, 0, 0}, options);
        EXPECT_EQ(solver.state.side, side);
        joints = straight_joints(lengths);
        solver.solve(ik::Method::Fabrik, joints, {3, 0, 0}, options);
        EXPECT_EQ(bend(joints, lengths, flat) > 0.0, side == Side::Left);
    }
}

TEST(IkPlane, APoleChoosesTheSide) {
    const Lengths lengths{1, 1, 1};
    KeptSolver solver(lengths);
    Joints joints = straight_joints(lengths);
    ik::Options options = in_plane(flat);
    options.plane->bend = Side::Left;
    options.pole = glm::vec3(1, -2, 5);
    solver.solve(ik::Method::Fabrik, joints, {2, 0, 0}, options);
    EXPECT_EQ(solver.state.side, Side::Right);
    options.pole = glm::vec3(1, 2, 5);
    solver.solve(ik::Method::Fabrik, joints, {2, 0, 0}, options);
    EXPECT_EQ(solver.state.side, Side::Left);
    EXPECT_GT(bend(joints, lengths, flat), 0.0);
    options.pole = glm::vec3(1, 0, 5);  // on the line: the requested side is used
    options.plane->bend = Side::Right;
    solver.solve(ik::Method::Fabrik, joints, {2, 0, 0}, options);
    EXPECT_EQ(solver.state.side, Side::Right);
}

TEST(IkPlane, TwoBonesMatchTheClosedForm) {
    const Lengths lengths{1.0f, 0.8f};
    for (const Side side : {Side::Left, Side::Right}) {
        KeptSolver solver(lengths);
        Joints joints = straight_joints(lengths);
        ik::Options options = in_plane(flat);
        options.plane->bend = side;
        const ik::Report report = solver.solve(ik::Method::TwoBone, joints, {0.9f, 1.2f, 0.4f}, options);
        EXPECT_TRUE(report.closed_form);
        EXPECT_NEAR(report.residual, 0.0f, 1e-6f);
        EXPECT_NEAR(report.off_plane, 0.4f, 1e-6f);
        const double corner = std::acos((1.0 + 2.25 - 0.64) / (2.0 * 1.5));
        const double angle = std::atan2(1.2, 0.9) + (side == Side::Left ? corner : -corner);
        EXPECT_NEAR(static_cast<double>(joints[1].x), std::cos(angle), 1e-5);
        EXPECT_NEAR(static_cast<double>(joints[1].y), std::sin(angle), 1e-5);
        options.max_stretch_scale = 2.0f;
        EXPECT_EQ(solver.solve(ik::Method::TwoBone, joints, {0, 2.7f, 0}, options).status, Status::Converged);
        EXPECT_NEAR(joints[1].y, 1.5f, 1e-5f);
    }
}

// 6 000 chains of 3 to 40 bones each, once: all arrive, with or without limits measured from the base.
TEST(IkPlane, ReachesTargetsOfPosesWithinTheLimits) {
    Random random(4);
    for (const bool mixed : {false, true}) {
        int arrived = 0;
        const int count = 400;
        for (int number = 0; number < count; ++number) {
            const Frame frame = some_frame(random);
            const Lengths lengths = some_lengths(3 + random.below(10), random);
            std::vector<AngleLimit> limits(lengths.size(), {-turn / 4, turn / 4});
            for (AngleLimit& limit : limits) {
                if (!mixed || random.chance(3)) continue;
                const float middle = random.around(1.2f), half = between(random, 0.2f, 1.0f);
                limit = {middle - half, middle + half, AngleFrom::Base};
            }
            glm::vec3 target(0.0f);
            float heading = 0.0f;
            for (std::size_t i = 0; i < limits.size(); ++i) {
                const float angle = between(random, limits[i].min, limits[i].max);
                heading = limits[i].from == AngleFrom::Base ? angle : heading + angle;
                target += frame.at(heading) * lengths[i];
            }
            const std::vector<glm::vec3> rest(lengths.size(), frame.ahead);
            KeptSolver solver(lengths, rest);
            Joints joints = straight_joints(lengths, frame.ahead);
            const ik::Report report =
                solver.solve(ik::Method::Fabrik, joints, target, in_plane(frame, limits));
            arrived += report.status == Status::Converged ? 1 : 0;
            ASSERT_LE(excess(joints, limits, frame), glm::radians(0.1)) << number;
            ASSERT_LE(off(joints, frame.normal), 1e-6 * reach_of(lengths)) << number;
        }
        EXPECT_GE(arrived, count * 99 / 100) << mixed;
    }
}

TEST(IkPlane, ABoneFromTheBaseDoesNotTurnWithTheChain) {
    const Lengths lengths{1, 1, 1};
    const AngleLimit limits[] = {{}, {-turn / 2, turn / 2}, {-0.1f, 0.1f, AngleFrom::Base}};
    for (const ik::Method method : iterating_methods) {
        KeptSolver solver(lengths);
        Joints joints = straight_joints(lengths);
        solver.solve(method, joints, {0.9f, 1.7f, 0}, in_plane(flat, limits));
        EXPECT_LE(excess(joints, limits, flat), glm::radians(0.1)) << ik::name(method);
        EXPECT_NEAR(distance(joints.back(), {0.9f, 1.7f, 0}), 0.0, 0.01) << ik::name(method);
    }
}

TEST(IkPlane, TheLimitThatStopsTheTipIsNamed) {
    const Lengths lengths{1, 1, 1};
    const AngleLimit limits[] = {{}, {-0.2f, 0.2f}, {}};
    KeptSolver solver(lengths);
    Joints joints = straight_joints(lengths);
    const ik::Options options = in_plane(flat, limits);
    const glm::vec3 target{0, 0.4f, 0};
    const ik::Report report = solver.solve(ik::Method::Fabrik, joints, target, options);
    ASSERT_EQ(report.status, Status::Limited);
    const auto active = solver.explain(joints, target, options);
    ASSERT_TRUE(active);
    EXPECT_EQ(active->joint, 1u);
    EXPECT_NEAR(std::abs(active->limit), 0.2f, 1e-3f);
}

// A chain that has arrived keeps its bits; one in another plane is moved into this one.
TEST(IkPlane, AnArrivedChainKeepsItsBits) {
    Random random(5);
    const Frame frame = some_frame(random);
    const Lengths lengths = some_lengths(6, random);
    const AngleLimit wide[6]{};
    for (const auto limits : {std::span<const AngleLimit>(), std::span<const AngleLimit>(wide)}) {
        KeptSolver solver(lengths);
        Joints joints = start_pose(Start::Random, lengths, frame, 0.0f, random);
        const glm::vec3 target = joints.front() + frame.at(1.0f) * 1.5f;
        ik::Options options = in_plane(frame, limits);
        for (int i = 0; i < 3; ++i) solver.solve(ik::Method::Fabrik, joints, target, options);
        const Joints before = joints;
        solver.solve(ik::Method::Fabrik, joints, joints.back(), options);
        for (std::size_t i = 0; i < joints.size(); ++i) EXPECT_LE(distance(joints[i], before[i]), 1e-6) << i;
    }
}

/// Chains with all kinds of starts and targets in and out of reach, off the plane.
struct FlatCrowd {
    FlatCrowd(std::size_t count, const Lengths& of, Random& random) : frame(some_frame(random)), lengths(of) {
        const auto reach = static_cast<float>(reach_of(lengths));
        for (std::size_t i = 0; i < count; ++i) {
            const float line = random.around(turn);
            Joints pose = start_pose(static_cast<Start>(i % 4), lengths, frame, line, random);
            if (i % 9 == 0)
                for (std::size_t j = 1; j < pose.size(); ++j) pose[j] += random.point(0.3f);
            const float angle = i % 3 == 0 ? line : random.around(turn);
            targets.push_back(pose.front() + frame.at(angle) * between(random, 0.0f, 1.1f * reach) +
                              frame.normal * random.around(1.0f));
            joints.insert(joints.end(), pose.begin(), pose.end());
        }
    }
    std::span<const glm::vec3> chain(const Joints& of, std::size_t i) const {
        return std::span(of).subspan(i * (lengths.size() + 1), lengths.size() + 1);
    }

    Frame frame;
    Lengths lengths;
    Joints joints, targets;
};

TEST(IkPlane, ManyEqualTheScalarSolver) {
    Random random(9);
    const std::size_t chains = 250;
    std::size_t all = 0, equal = 0, fallbacks = 0;
    for (const std::size_t bones : {1u, 2u, 4u, 10u, 30u})
        for (const Side side : {Side::Free, Side::Left, Side::Right}) {
            FlatCrowd crowd(chains, some_lengths(bones, random), random);
            crowd.targets[3].x = std::numeric_limits<float>::quiet_NaN();
            const auto reach = reach_of(crowd.lengths);
            ik::Options options = in_plane(crowd.frame);
            options.plane->bend = side;
            auto batch = ik::Batch::make(chains, bones, 2).value();
            ASSERT_TRUE(batch.set_lengths(crowd.lengths));
            Joints joints = crowd.joints;
            std::vector<ik::ManyReport> reports(chains);
            const ik::ManySummary summary = solve_many(batch, joints, crowd.targets, reports,
                                                       {.max_iterations = 200, .plane = options.plane});
            EXPECT_EQ(summary.invalid, 1u);
            fallbacks += summary.scalar_fallbacks;
            for (std::size_t i = 0; i < chains; ++i) {
                Joints expected(crowd.chain(crowd.joints, i).begin(), crowd.chain(crowd.joints, i).end());
                KeptSolver solver(crowd.lengths);
                const ik::Report report =
                    solver.solve(ik::Method::Fabrik, expected, crowd.targets[i], options);
                ASSERT_EQ(reports[i].status, report.status) << bones << " bones, chain " << i;
                ASSERT_EQ(reports[i].iterations, report.iterations) << bones << " bones, chain " << i;
                const std::span<const glm::vec3> found = crowd.chain(joints, i);
                for (std::size_t j = 0; j <= bones; ++j)
                    ASSERT_LE(distance(found[j], expected[j]), 1e-4 * reach)
                        << bones << " bones, chain " << i;
                if (report.status == Status::Converged) ++all, equal += same_bits(found, expected) ? 1 : 0;
                if (i == 3) continue;
                ASSERT_LE(off(Joints(found.begin(), found.end()), crowd.frame.normal), 1e-6 * reach);
            }
            // The batch's own joints, other thread counts and other vector units give the same.
            auto own = ik::Batch::make(chains, bones).value();
            ASSERT_TRUE(own.set_lengths(crowd.lengths));
            for (const std::string_view unit : ik::vector_units()) {
                ASSERT_TRUE(own.set_joints(crowd.joints));
                solve_many(own, crowd.targets, {},
                           {.max_iterations = 200, .plane = options.plane, .vector_unit = unit});
                Joints copied(joints.size());
                ASSERT_TRUE(own.copy_joints(copied));
                EXPECT_TRUE(same_bits(copied, joints)) << unit;
            }
        }
    EXPECT_GE(equal, all * 99 / 100) << "of " << all << " that converge, to the bit";
    EXPECT_LE(fallbacks, all * 5 / 100);
}

TEST(IkPlane, ManyWithinLimitsUseTheScalarSolver) {
    Random random(10);
    const std::size_t chains = 60, bones = 5;
    const FlatCrowd crowd(chains, some_lengths(bones, random), random);
    const std::vector<AngleLimit> limits(bones, {-1.0f, 1.0f});
    auto batch = ik::Batch::make(chains, bones).value();
    ASSERT_TRUE(batch.set_lengths(crowd.lengths));
    Joints joints = crowd.joints;
    std::vector<ik::ManyReport> reports(chains);
    const ik::Options options = in_plane(crowd.frame, limits);
    const ik::ManySummary summary =
        solve_many(batch, joints, crowd.targets, reports, {.max_iterations = 200, .plane = options.plane});
    EXPECT_EQ(summary.scalar_fallbacks, chains);
    for (std::size_t i = 0; i < chains; ++i) {
        Joints expected(crowd.chain(crowd.joints, i).begin(), crowd.chain(crowd.joints, i).end());
        KeptSolver solver(crowd.lengths);
        EXPECT_EQ(solver.solve(ik::Method::Fabrik, expected, crowd.targets[i], options).status,
                  reports[i].status);
        ASSERT_TRUE(same_bits(crowd.chain(joints, i), expected)) << i;
    }
}

TEST(IkPlane, AnObserverSeesWorldCoordinates) {
    Random random(6);
    const Frame frame = some_frame(random);
    const Lengths lengths = some_lengths(5, random);
    KeptSolver solver(lengths);
    Joints joints = start_pose(Start::Random, lengths, frame, 0.0f, random);
    Recorder recorder;
    const glm::vec3 target = joints.front() + frame.at(2.0f) * 1.2f;
    solver.solve(ik::Method::Fabrik, joints, target, in_plane(frame), &recorder);
    ASSERT_FALSE(recorder.steps.empty());
    glm::vec3 tip{0.0f};
    for (const ik::Step& step : recorder.steps)
        if (step.joint == lengths.size()) tip = step.to;
    EXPECT_NEAR(distance(tip, joints.back()), 0.0, 1e-6);
}

TEST(IkPlane, RotationsFollowTheBones) {
    Random random(7);
    const Frame frame = some_frame(random);
    const Lengths lengths = some_lengths(5, random);
    std::vector<glm::vec3> rest;
    for (std::size_t i = 0; i < lengths.size(); ++i) rest.push_back(some_direction(random));
    KeptSolver solver(lengths, rest);
    Joints joints = start_pose(Start::Random, lengths, frame, 0.0f, random);
    ik::Options options = in_plane(frame);
    options.rotations = true;
    solver.solve(ik::Method::Fabrik, joints, joints.front() + frame.at(2.0f), options);
    for (std::size_t i = 0; i < lengths.size(); ++i) {
        const glm::vec3 bone = glm::normalize(joints[i + 1] - joints[i]);
        EXPECT_NEAR(distance(solver.state.rotations[i] * rest[i], bone), 0.0, 1e-4) << i;
    }
}

TEST(IkPlane, NumbersAtTheEndsOfTheirRangesAreSafe) {
    Random random(8);
    for (int number = 0; number < 300; ++number) {
        Lengths bones(1 + random.below(5));
        for (float& bone : bones)
            bone = random.chance(3) ? 0.0f : std::ldexp(1.0f, int(random.below(50)) - 25);
        Joints joints = some_pose(bones, random, random.point(random.chance(2) ? 1e8f : 1.0f));
        if (random.chance(2)) std::fill(joints.begin(), joints.end(), joints.front());
        ik::Options options = in_plane({random.point(random.chance(2) ? 1e-3f : 1e8f), {}, {}});
        if (glm::length(options.plane->normal) < 1e-6f) continue;
        const std::vector<AngleLimit> limits(bones.size(), {-0.5f, 0.5f});
        if (random.chance(2)) options.plane->limits = limits;
        KeptSolver solver(bones);
        const auto method = iterating_methods[random.below(iterating_methods.size())];
        const glm::vec3 target = random.chance(3) ? joints.front() : random.point(1e3f);
        ASSERT_NE(solver.solve(method, joints, target, options).status, Status::InvalidInput);
        for (const glm::vec3& joint : joints) ASSERT_TRUE(std::isfinite(joint.x + joint.y + joint.z));
    }
}

}  // namespace
}  // namespace tendril::test
