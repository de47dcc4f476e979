// The two-bone solver against trigonometry in double.
#include "ik_hostile.hpp"
#include "tendril/ik/two_bone.hpp"

namespace tendril::test::ik_two_bone_test {
namespace {

using ik::Method;
using ik::Status;
using ik::TwoBone;
using ik::TwoBoneOptions;
using ik::TwoBoneResult;

glm::dvec3 unit(glm::dvec3 v) {
    return v / std::sqrt(dot(v, v));
}

TwoBone some_limb(Random& random) {
    const Lengths lengths{between(random, 0.2f, 1.5f), between(random, 0.2f, 1.5f)};
    const Joints joints = some_pose(lengths, random, random.point(2.0f));
    return {joints[0], joints[1], joints[2], lengths[0], lengths[1]};
}

glm::vec3 reachable(const TwoBone& limb, Random& random) {
    const float least = std::abs(limb.upper - limb.lower) + 0.001f, most = limb.upper + limb.lower - 0.001f;
    return limb.root + some_offset(random, least, most);
}

/// The component of a point perpendicular to the line from root to target, normalised.
glm::dvec3 side(const TwoBone& limb, glm::vec3 target, glm::dvec3 point) {
    const glm::dvec3 line = unit(glm::dvec3(target) - glm::dvec3(limb.root));
    const glm::dvec3 arm = point - glm::dvec3(limb.root);
    return unit(arm - line * dot(arm, line));
}

/// Expected middle joint: the law of cosines gives the angle at the root, in the plane of the pole, rotated
/// by the twist (Rodrigues).
glm::dvec3 expected_mid(const TwoBone& limb, glm::vec3 target, glm::dvec3 towards, double scale,
                        double twist) {
    const glm::dvec3 root(limb.root), arm = glm::dvec3(target) - root, line = unit(arm);
    const double a = scale * static_cast<double>(limb.upper), b = scale * static_cast<double>(limb.lower);
    const double d = std::sqrt(dot(arm, arm));
    const double angle = std::acos(std::clamp((a * a + d * d - b * b) / (2.0 * a * d), -1.0, 1.0));
    const glm::dvec3 to = side(limb, target, towards);
    const glm::dvec3 bend = to * std::cos(twist) + cross(line, to) * std::sin(twist);
    return root + line * (a * std::cos(angle)) + bend * (a * std::sin(angle));
}

TEST(IkTwoBone, IsAccurateToFloatPrecision) {
    Random random(1);
    double worst = 0.0;
    for (int k = 0; k < 20'000; ++k) {
        const TwoBone limb = some_limb(random);
        const glm::vec3 target = reachable(limb, random), pole = limb.root + random.point(3.0f);
        TwoBoneOptions options{.pole = pole};
        if (random.chance(2)) options.twist = random.around(6.0f);
        const TwoBoneResult result = ik::two_bone(limb, target, options);
        ASSERT_EQ(result.status, Status::Converged);
        EXPECT_TRUE(same_bits(result.tip, target));
        EXPECT_EQ(result.residual, 0.0f);
        EXPECT_EQ(result.scale, 1.0f);
        const glm::dvec3 expected =
            expected_mid(limb, target, glm::dvec3(pole), 1.0, static_cast<double>(options.twist));
        worst = std::max(worst, distance(result.mid, glm::vec3(expected)));
    }
    std::printf("worst deviation %.2g m\n", worst);
    EXPECT_LT(worst, 1e-6);
}

TEST(IkTwoBone, WithoutAPoleItKeepsItsBendSide) {
    Random random(2);
    for (int k = 0; k < 5000; ++k) {
        const TwoBone limb = some_limb(random);
        const glm::vec3 target = reachable(limb, random);
        const TwoBoneResult result = ik::two_bone(limb, target);
        // The shortest rotation of the line (Rodrigues) takes the old side to the new one.
        const glm::dvec3 from = unit(glm::dvec3(limb.tip) - glm::dvec3(limb.root));
        const glm::dvec3 to = unit(glm::dvec3(target) - glm::dvec3(limb.root)), normal = cross(from, to);
        if (std::sqrt(dot(normal, normal)) < 1e-3) continue;
        const glm::dvec3 axis = unit(normal);
        const double c = dot(from, to), s = std::sqrt(dot(normal, normal));
        const glm::dvec3 mid = glm::dvec3(limb.mid) - glm::dvec3(limb.root);
        const glm::dvec3 turned = mid * c + cross(axis, mid) * s + axis * (dot(axis, mid) * (1.0 - c));
        const glm::dvec3 expected = expected_mid(limb, target, glm::dvec3(limb.root) + turned, 1.0, 0.0);
        const glm::dvec3 old_side = mid - from * dot(mid, from);
        if (dot(old_side, old_side) < 1e-3) continue;
        EXPECT_LT(distance(result.mid, glm::vec3(expected)), 2e-5);
        // A second solve moves nothing.
        const TwoBone there{limb.root, result.mid, result.tip, limb.upper, limb.lower};
        EXPECT_LT(distance(ik::two_bone(there, target).mid, result.mid), 2e-4);
    }
}

TEST(IkTwoBone, AStraightLimbBendsToAFixedSide) {
    const TwoBone straight{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, 1.0f, 1.0f};
    for (const glm::vec3 target : {glm::vec3(1.5f, 0, 0), glm::vec3(-1.5f, 0, 0), glm::vec3(0, 1, 0)}) {
        const TwoBoneResult a = ik::two_bone(straight, target), b = ik::two_bone(straight, target);
        EXPECT_TRUE(same_bits(a.mid, b.mid));
        EXPECT_NEAR(distance(a.mid, straight.root), 1.0, 1e-6);
        EXPECT_NEAR(distance(a.mid, target), 1.0, 1e-6);
        EXPECT_EQ(a.status, Status::Converged);
    }
}

TEST(IkTwoBone, APoleOnTheLineKeepsTheSide) {
    const TwoBone limb{{0, 0, 0}, {1, 1, 0}, {2, 0, 0}, 1.4142135f, 1.4142135f};
    const TwoBoneResult result = ik::two_bone(limb, {2, 0, 0}, {.pole = glm::vec3(5, 0, 0)});
    EXPECT_LT(distance(result.mid, limb.mid), 1e-6);
}

TEST(IkTwoBone, OutOfReachItIsStraightAndTooCloseFolded) {
    const TwoBone limb{{0, 0, 0}, {0, 1, 0}, {0, 1.5f, 0}, 1.0f, 0.5f};
    const TwoBoneResult out = ik::two_bone(limb, {0, 0, 4});
    EXPECT_EQ(out.status, Status::Stretched);
    EXPECT_FLOAT_EQ(out.residual, 2.5f);
    EXPECT_LT(distance(out.mid, {0, 0, 1}), 1e-6);
    EXPECT_LT(distance(out.tip, {0, 0, 1.5f}), 1e-6);
    const TwoBoneResult close = ik::two_bone(limb, {0, 0, 0.2f});
    EXPECT_EQ(close.status, Status::TooClose);
    EXPECT_FLOAT_EQ(close.residual, 0.3f);
    EXPECT_LT(distance(close.tip, {0, 0, 0.5f}), 1e-6);
    const TwoBone thigh{{0, 0, 0}, {0, 0.5f, 0}, {0, 1.5f, 0}, 0.5f, 1.0f};
    const TwoBoneResult behind = ik::two_bone(thigh, {0, 0, 0.2f});
    EXPECT_EQ(behind.status, Status::TooClose);
    EXPECT_LT(distance(behind.mid, {0, 0, -0.5f}), 1e-6);
    EXPECT_LT(distance(behind.tip, {0, 0, 0.5f}), 1e-6);
}

TEST(IkTwoBone, StretchingNeverMissesATargetWithinReach) {
    const TwoBone limb{{0, 0, 0}, {1, 0, 0}, {1.1f, 0, 0}, 1.0f, 0.1f};
    for (const float start : {0.3f, 0.8f})
        for (float far = 0.91f; far < 1.09f; far += 0.005f) {
            const TwoBoneResult result =
                ik::two_bone(limb, {far, 0, 0}, {.start_stretch_ratio = start, .max_stretch_scale = 10.0f});
            EXPECT_EQ(result.status, Status::Converged) << start << ' ' << far;
            EXPECT_LT(result.residual, 1e-5f) << start << ' ' << far;
        }
}

TEST(IkTwoBone, StretchesByItsOptions) {
    const TwoBone limb{{0, 0, 0}, {1, 1, 0}, {2, 0, 0}, 1.0f, 1.0f};
    const TwoBoneOptions options{
        .pole = glm::vec3(0, 5, 0), .start_stretch_ratio = 0.8f, .max_stretch_scale = 1.5f};
    const auto at = [&](float d) { return ik::two_bone(limb, {d, 0, 0}, options); };
    EXPECT_EQ(at(1.6f).scale, 1.0f);
    EXPECT_FLOAT_EQ(at(2.0f).scale, 1.25f);
    EXPECT_FLOAT_EQ(at(2.4f).scale, 1.5f);
    EXPECT_FLOAT_EQ(at(2.9f).scale, 1.5f);
    EXPECT_EQ(at(2.9f).status, Status::Converged);
    EXPECT_EQ(at(3.2f).status, Status::Stretched);
    EXPECT_FLOAT_EQ(at(3.2f).residual, 0.2f);
    // The elbow keeps its angle while the bones grow: only the size changes.
    EXPECT_NEAR(at(2.4f).mid.y / at(1.6f).mid.y, 1.5f, 1e-5f);
    // With a ratio of 1, it is straight before it stretches.
    const TwoBoneResult full = ik::two_bone(limb, {2.5f, 0, 0}, {.max_stretch_scale = 2.0f});
    EXPECT_EQ(full.status, Status::Converged);
    EXPECT_LT(distance(full.mid, {1.25f, 0, 0}), 1e-6);
    Random random(3);
    for (int k = 0; k < 5000; ++k) {
        const TwoBone any = some_limb(random);
        const glm::vec3 target = any.root + some_offset(random, 0.5f, 4.0f);
        TwoBoneOptions some{.pole = random.point(5.0f),
                            .start_stretch_ratio = between(random, 0.1f, 1.0f),
                            .max_stretch_scale = between(random, 1.0f, 2.0f)};
        const TwoBoneResult r = ik::two_bone(any, target, some);
        EXPECT_NEAR(distance(any.root, r.mid), any.upper * r.scale, 1e-5);
        EXPECT_NEAR(distance(r.mid, r.tip), any.lower * r.scale, 1e-5);
        const double most = 1.0 * (any.upper + any.lower) * some.max_stretch_scale;
        const double left = std::max(distance(any.root, target) - most, 0.0);
        if (r.status != Status::TooClose) {
            EXPECT_NEAR(r.residual, left, 1e-5);
        }
    }
}

/// Smooth paths give smooth joints, also where the bones start or stop stretching, and where they turn.
TEST(IkTwoBone, FollowsWithoutJumps) {
    Random random(4);
    for (int path = 0; path < 40; ++path) {
        TwoBone limb{{0, 0, 0}, {0.3f, 0.4f, 0}, {0.6f, 0, 0}, 0.5f, 0.5f};
        const TwoBoneOptions options{.pole = some_offset(random, 1.0f, 2.0f),
                                     .start_stretch_ratio = between(random, 0.5f, 0.9f),
                                     .max_stretch_scale = 1.5f};
        const glm::vec3 from = some_direction(random), to = some_direction(random),
                        via = some_direction(random);
        glm::vec3 last(0.0f);
        for (int k = 0; k <= 20'000; ++k) {
            const float t = static_cast<float>(k) / 20'000.0f;
            const float radius = 0.7f + 0.6f * std::sin(9.0f * t);
            const glm::vec3 way = from * (1 - t) * (1 - t) + via * (2 * t * (1 - t)) + to * (t * t);
            const double size = distance(way, {});
            const glm::vec3 target = way * static_cast<float>(radius / size);
            const glm::dvec3 line = glm::dvec3(way) / size, pole(*options.pole);
            const glm::dvec3 off = pole - line * dot(pole, line);
            const TwoBoneResult r = ik::two_bone(limb, target, options);
            const bool counts = k > 0 && size > 0.2 && dot(off, off) > 0.09;
            if (counts) {
                EXPECT_LT(distance(r.mid, limb.mid), 50.0 * distance(target, last)) << "step " << k;
            }
            limb.mid = r.mid;
            limb.tip = r.tip;
            last = target;
        }
    }
}

TEST(IkTwoBone, MatchesTheChainSolver) {
    Random random(5);
    for (int k = 0; k < 2000; ++k) {
        const TwoBone limb = some_limb(random);
        const glm::vec3 target = reachable(limb, random);
        ik::Options options;
        if (random.chance(2)) options.pole = random.point(3.0f);
        if (random.chance(2)) options.twist = random.around(3.0f);
        options.start_stretch_ratio = between(random, 0.5f, 1.0f);
        options.max_stretch_scale = between(random, 1.0f, 2.0f);
        Joints joints{limb.root, limb.mid, limb.tip};
        float told = -1.0f;
        options.residuals = {&told, 1};
        KeptSolver solver(Lengths{limb.upper, limb.lower});
        const ik::Report report = solver.solve(Method::TwoBone, joints, target, options);
        const TwoBoneResult result = ik::two_bone(limb, target,
                                                  {.pole = options.pole,
                                                   .start_stretch_ratio = options.start_stretch_ratio,
                                                   .max_stretch_scale = options.max_stretch_scale,
                                                   .twist = options.twist});
        EXPECT_EQ(report, (ik::Report{result.status, 1, result.residual, true}));
        EXPECT_TRUE(same_bits(joints[1], result.mid));
        EXPECT_TRUE(same_bits(joints[2], result.tip));
        EXPECT_EQ(told, result.residual);
    }
}

TEST(IkTwoBone, SurvivesAnyInput) {
    Random random(given_seed());
    const float sizes[] = {0.0f, 1e-20f, 1e-3f, 1.0f, 1.0f, 7.0f, 1e3f, 1e9f};
    const auto any_point = [&] {
        const std::size_t size = random.below(8);
        return random.chance(3) ? glm::vec3(0.0f) : some_direction(random) * sizes[size];
    };
    for (int k = 0; k < 50'000; ++k) {
        const TwoBone limb{any_point(), any_point(), any_point(), sizes[random.below(8)],
                           sizes[random.below(8)]};
        TwoBoneOptions options{.max_stretch_scale = random.chance(2) ? 1.0f : 2.0f};
        if (random.chance(2)) options.pole = any_point();
        if (random.chance(3)) options.twist = random.around(1e9f);
        const glm::vec3 target = any_point();
        const TwoBoneResult r = ik::two_bone(limb, target, options);
        ASSERT_NE(r.status, Status::InvalidInput);
        for (const glm::vec3 p : {r.mid, r.tip})
            ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) << "solve " << k;
        const double upper = 1.0 * limb.upper * r.scale, lower = 1.0 * limb.lower * r.scale;
        const double rounding = 1e-6 * (upper + lower + distance(limb.root, {}) + distance(r.tip, {}));
        EXPECT_NEAR(distance(limb.root, r.mid), upper, rounding) << "solve " << k;
        EXPECT_NEAR(distance(r.mid, r.tip), lower, rounding) << "solve " << k;
    }
    for (int k = 0; k < 3000; ++k) {
        SCOPED_TRACE("chain " + std::to_string(k));
        const Lengths lengths{between(random, 0.001f, 3.0f), random.chance(10) ? 0.0f : part(random)};
        const Joints start = hostile_pose(lengths, random);
        ik::Options options;
        if (random.chance(2)) options.pole = hostile_target(start, lengths, random);
        expect_invariants(Method::TwoBone, lengths, start, hostile_target(start, lengths, random), options);
    }
}

}  // namespace
}  // namespace tendril::test::ik_two_bone_test
