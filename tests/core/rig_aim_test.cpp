// The promises of aim(), including degenerate targets.
#include "rig_support.hpp"
#include "tendril/rig/aim.hpp"
#include "tests/says.hpp"

namespace tendril::test {
namespace {

using namespace rig;

double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(norm(glm::cross(a, b)), glm::dot(a, b));
}
glm::dvec3 unit(const glm::dvec3& v) {
    return v / norm(v);
}
AimTarget some_kind(Random& random) {
    return random.chance(2) ? AimTarget::Location : AimTarget::Direction;
}
AimOptions some_options(Random& random) {
    AimOptions options;
    options.primary = {some_vector(random, 1.0), some_vector(random, 5.0), some_kind(random), 1.0};
    options.secondary = {some_vector(random, 1.0), some_vector(random, 5.0), some_kind(random), 1.0};
    return options;
}
glm::dvec3 way_to(const AimPart& part, const Transform& item) {
    return unit(part.kind == AimTarget::Location ? part.target - item.translation : part.target);
}

TEST(RigAim, ThePrimaryAxisPointsAtItsTargetAndTheSecondaryAsNearlyAsThatAllows) {
    Random random(1);
    for (int i = 0; i < 2'000; ++i) {
        const Transform item = some_transform(random);
        const AimOptions options = some_options(random);
        const AimResult aimed = aim(item, options);
        ASSERT_EQ(aimed.primary, AimWarning::None);
        ASSERT_EQ(aimed.secondary, AimWarning::None);
        const glm::dquat& rotation = aimed.transform.rotation;
        const glm::dvec3 axis = unit(rotation * options.primary.axis);
        EXPECT_LE(distance(axis, way_to(options.primary, item)), 1e-9);
        const glm::dvec3 second = unit(rotation * options.secondary.axis),
                         goal = way_to(options.secondary, item);
        const double reached = angle_between(second, goal);
        for (const double degrees : {-1.0, -0.01, 0.01, 1.0, 90.0, 180.0})
            EXPECT_LE(reached, angle_between(about(axis, degrees) * second, goal) + 1e-9);
        EXPECT_LE(std::abs(norm(rotation) - 1.0), 1e-14);
        EXPECT_EQ(aimed.transform.translation, item.translation);
        EXPECT_EQ(aimed.transform.scale, item.scale);
    }
}

TEST(RigAim, AimingTwiceChangesNothing) {
    Random random(2);
    double worst = 0.0;
    for (int i = 0; i < 2'000; ++i) {
        const AimOptions options = some_options(random);
        const Transform once = aim(some_transform(random), options).transform;
        worst = std::max(worst, distance(aim(once, options).transform, once));
    }
    EXPECT_LE(worst, 1e-9);
}

TEST(RigAim, AWeightBlendsTheAxisTowardsTheTarget) {
    AimOptions options{.primary = {{1, 0, 0}, {0, 1, 0}, AimTarget::Direction, 0.5}};
    const auto axis = [&](const glm::dvec3& local) { return aim({}, options).transform.rotation * local; };
    EXPECT_LE(distance(axis({1, 0, 0}), unit({1, 1, 0})), 1e-15);
    options.weight = 0.5;  // a quarter in total
    EXPECT_LE(distance(axis({1, 0, 0}), unit({3, 1, 0})), 1e-15);
    options.primary.weight = 0.0;
    options.secondary = {{0, 1, 0}, {0, 0, 1}, AimTarget::Direction, 1.0};
    EXPECT_LE(distance(axis({0, 1, 0}), unit({0, 1, 1})), 1e-15);
    EXPECT_LE(distance(axis({1, 0, 0}), {1, 0, 0}), 1e-15);
}

TEST(RigAim, AWeightOfZeroLeavesTheItemToTheBit) {
    Random random(3);
    for (int i = 0; i < 100; ++i) {
        AimOptions options = some_options(random);
        const Transform item = some_transform(random);
        (i % 2 ? options.weight : options.primary.weight) = 0.0;
        if (i % 2 == 0) options.secondary.weight = 0.0;
        EXPECT_TRUE(same_bits(aim(item, options).transform, item));
        options = some_options(random);
        options.max_speed = 0.0;
        EXPECT_TRUE(same_bits(aim(item, options, 1.0).transform, item));
    }
}

TEST(RigAim, TheOppositeDirectionIsHalfATurn) {
    Random random(4);
    for (int i = 0; i < 500; ++i) {
        Transform item;
        item.rotation = some_rotation(random);
        AimOptions options;
        options.primary = {some_vector(random, 1.0), {}, AimTarget::Direction, 1.0};
        options.primary.target = -(item.rotation * options.primary.axis);
        AimResult aimed = aim(item, options);
        EXPECT_EQ(aimed.primary, AimWarning::None);
        EXPECT_LE(
            distance(unit(aimed.transform.rotation * options.primary.axis), unit(options.primary.target)),
            1e-6);
        EXPECT_LE(distance(aim(aimed.transform, options).transform, aimed.transform), 1e-6);
        options.primary.weight = 0.5;
        aimed = aim(item, options);
        EXPECT_NEAR(angle_between(aimed.transform.rotation * options.primary.axis, options.primary.target),
                    pi / 2, 1e-6)
            << "half way to the opposite";

        // The secondary axis perpendicular to the primary one, with its target opposite.
        options.primary.weight = 1.0;
        options.primary.target = item.rotation * options.primary.axis;
        options.secondary = {
            glm::cross(options.primary.axis, some_vector(random, 1.0)), {}, AimTarget::Direction, 1.0};
        options.secondary.target = -(item.rotation * options.secondary.axis);
        aimed = aim(item, options);
        EXPECT_LE(
            distance(unit(aimed.transform.rotation * options.secondary.axis), unit(options.secondary.target)),
            1e-6);
        EXPECT_LE(
            distance(unit(aimed.transform.rotation * options.primary.axis), unit(options.primary.target)),
            1e-9);
    }
}

TEST(RigAim, APartWithNothingToGoByIsSkippedWithAWarning) {
    Random random(5);
    const Transform item = some_transform(random);
    const AimPart good{{1, 0, 0}, {0, 1, 0}, AimTarget::Direction, 1.0};
    const auto expect = [&](const AimPart& primary, const AimPart& secondary, AimWarning first,
                            AimWarning second) {
        const AimResult aimed = aim(item, {.primary = primary, .secondary = secondary});
        EXPECT_EQ(aimed.primary, first);
        EXPECT_EQ(aimed.secondary, second);
        EXPECT_TRUE(is_finite(aimed.transform));
        return aimed.transform;
    };
    AimPart off = good, none = good, here = good, still = good, parallel = good;
    off.weight = 0.0;
    none.axis = {0, 0, 0};
    here.kind = AimTarget::Location, here.target = item.translation;
    still.target = {0, 0, 0};
    parallel.axis = {-3, 0, 0}, parallel.target = {1, 2, 3};
    using enum AimWarning;
    EXPECT_TRUE(same_bits(expect(none, off, ZeroAxis, None), item));
    EXPECT_TRUE(same_bits(expect(here, off, TargetAtItem, None), item));
    EXPECT_TRUE(same_bits(expect(still, off, TargetAtItem, None), item));
    EXPECT_TRUE(same_bits(expect(none, good, ZeroAxis, ZeroAxis), item));
    EXPECT_TRUE(same_bits(expect(off, parallel, None, AxesParallel), item));

    AimPart second{{0, 1, 0}, {0, 5, 0}, AimTarget::Direction, 1.0};
    const Transform alone = expect(good, off, None, None);
    EXPECT_TRUE(same_bits(expect(good, second, None, TargetOnAxis), alone));
    second.target = {0, 0, 0};
    EXPECT_TRUE(same_bits(expect(good, second, None, TargetAtItem), alone));
    second.axis = {0, 0, 0};
    EXPECT_TRUE(same_bits(expect(good, second, None, ZeroAxis), alone));
    second = {{0, 1, 0}, {1, 2, 3}, AimTarget::Direction, 1.0};
    expect(here, second, TargetAtItem, None);  // the secondary aim still applies
    for (const AimWarning each : {ZeroAxis, TargetAtItem, TargetOnAxis, AxesParallel})
        EXPECT_STRNE(name(each), "");
}

TEST(RigAim, AMaximumSpeedLimitsTheTurn) {
    AimOptions options{.primary = {{1, 0, 0}, {0, 1, 0}, AimTarget::Direction, 1.0}};
    options.max_speed = pi / 4;
    Transform item;
    for (int i = 0; i < 4; ++i) item = aim(item, options, 0.25).transform;
    EXPECT_LE(distance(item.rotation, about({0, 0, 1}, 45)), 1e-14);
    item = aim(item, options, 10.0).transform;
    EXPECT_LE(distance(item.rotation, about({0, 0, 1}, 90)), 1e-14);
    for (const double dt : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
        EXPECT_TRUE(same_bits(aim({}, options, dt).transform, Transform{}));
}

TEST(RigAim, OptionsFromOutsideAreChecked) {
    const auto message = [](auto change) {
        AimOptions options;
        change(options);
        return std::string(check(options).message());
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(message([](AimOptions&) {}), "");
    EXPECT_TRUE(test::says(message([](AimOptions& o) {
                               o.primary.axis = {0, 0, 0};
                           }),
                           "aim primary.axis longer 1e-9 0"));
    EXPECT_TRUE(test::says(message([&](AimOptions& o) { o.secondary.target.z = nan; }),
                           "aim secondary.target.z finite 1e9 nan"));
    EXPECT_TRUE(test::says(message([](AimOptions& o) { o.weight = 1.5; }), "aim weight 0 1 1.5"));
    EXPECT_TRUE(
        test::says(message([&](AimOptions& o) { o.primary.weight = nan; }), "aim primary.weight 0 1 nan"));
    EXPECT_TRUE(test::says(message([](AimOptions& o) { o.max_speed = -1; }), "aim max_speed 0 -1"));
}

}  // namespace
}  // namespace tendril::test
