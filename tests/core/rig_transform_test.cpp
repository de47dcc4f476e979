// Transforms, Euler angles and simple operations on them.
#include "rig_support.hpp"
#include "tendril/rig/euler.hpp"
#include "tendril/rig/transform_units.hpp"

namespace tendril::test {
namespace {

using namespace rig;

TEST(RigTransform, ComposingScalesThenTurnsThenAdds) {
    const Transform parent{{1, 2, 3}, about({0, 0, 1}, 90), {2, 3, -4}},
        child{{1, 1, 1}, about({0, 0, 1}, 90), {5, 5, 5}};
    const Transform global = compose(parent, child);
    EXPECT_LE(distance(global.translation, {1 - 3, 2 + 2, 3 - 4}), 1e-15);
    EXPECT_LE(distance(global.rotation, about({0, 0, 1}, 180)), 1e-15);
    EXPECT_EQ(global.scale, glm::dvec3(10, 15, -20));
}

TEST(RigTransform, RelativeUndoesComposing) {
    Random random(1);
    double worst = 0.0;
    for (int i = 0; i < 10'000; ++i) {
        const Transform parent = some_transform(random), child = some_transform(random);
        worst = std::max(worst, distance(relative(parent, compose(parent, child)), child));
        worst = std::max(worst, distance(compose(parent, relative(parent, child)), child));
    }
    EXPECT_LE(worst, 1e-14);
}

TEST(RigTransform, TheInverseOfAScaleOfZeroCountsAsZero) {
    Transform flat;
    flat.scale = {0, 1e-300, 2};
    const Transform local = relative(flat, {{1, 2, 3}, {1, 0, 0, 0}, {4, 5, 6}});
    EXPECT_EQ(local.translation, glm::dvec3(0, 0, 1.5));
    EXPECT_EQ(local.scale, glm::dvec3(0, 0, 3));
}

TEST(RigTransform, NoProductBecomesInfinite) {
    Transform large{{1e99, -1e99, 1e99}, {1, 0, 0, 0}, {1e99, 1e-99, -1e99}};
    for (int i = 0; i < 10; ++i) {
        const Transform product = compose(large, large), quotient = relative(large, product);
        EXPECT_TRUE(is_finite(product));
        EXPECT_TRUE(is_finite(quotient));
        EXPECT_TRUE(is_finite(relative(quotient, large)));
        large = product;
    }
}

TEST(RigTransform, BlendingBeginsAtTheOneAndEndsAtTheOtherToTheBit) {
    Random random(4);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (int i = 0; i < 100; ++i) {
        const Transform a = some_transform(random), b = some_transform(random);
        for (const double part : {0.0, -1.0, nan}) EXPECT_TRUE(same_bits(blend(a, b, part), a));
        for (const double part : {1.0, 2.0}) EXPECT_TRUE(same_bits(blend(a, b, part), b));
        const Transform near_a = blend(a, b, 1e-9), near_b = blend(a, b, 1.0 - 1e-9);
        EXPECT_LE(distance(near_a, a), 1e-7);
        EXPECT_LE(distance(near_b, b), 1e-7);
        EXPECT_LE(std::abs(norm(blend(a, b, 0.3).rotation) - 1.0), 1e-15);
    }
    const glm::dquat half = blend(about({1, 0, 0}, 10), about({1, 0, 0}, 70), 0.5);
    EXPECT_LE(distance(half, about({1, 0, 0}, 40)), 1e-15);
    const glm::dquat small = blend(about({1, 0, 0}, 0), about({1, 0, 0}, 1e-4), 0.25);
    EXPECT_LE(distance(small, about({1, 0, 0}, 0.25e-4)), 1e-15);
}

TEST(RigTransform, WhatIsNormalisedStaysToTheBit) {
    Random random(9);
    for (int i = 0; i < 10'000; ++i) {
        const glm::dquat once = some_rotation(random), twice = normalised(once);
        EXPECT_EQ(std::memcmp(&once, &twice, sizeof once), 0);
    }
    EXPECT_EQ(normalised({0, 0, 0, 0}), glm::dquat(1, 0, 0, 0));
    const Expected<Transform> long_one = checked({.rotation = {0, 3e8, 0, 4e8}}, "test");
    ASSERT_TRUE(long_one.ok());
    EXPECT_LE(distance(long_one->rotation, {0, 0.6, 0, 0.8}), 1e-15);
}

TEST(RigEuler, AnglesAndRotationAgreeBothWays) {
    Random random(6);
    double worst = 0.0;
    for (int i = 0; i < 10'000; ++i) {
        const glm::dquat rotation = some_rotation(random);
        const glm::dvec3 angles = to_euler(rotation);
        EXPECT_LE(std::abs(angles.x), pi);
        EXPECT_LE(std::abs(angles.y), pi / 2);
        EXPECT_LE(std::abs(angles.z), pi);
        const glm::dquat by_axes = glm::angleAxis(angles.z, glm::dvec3(0, 0, 1)) *
                                   glm::angleAxis(angles.y, glm::dvec3(0, 1, 0)) *
                                   glm::angleAxis(angles.x, glm::dvec3(1, 0, 0));
        worst = std::max({worst, distance(by_axes, rotation), distance(from_euler(angles), rotation)});
    }
    EXPECT_LE(worst, 1e-14);
}

TEST(RigEuler, ThePolesAreClean) {
    Random random(7);
    for (const double side : {-1.0, 1.0}) {
        for (const double from_pole : {0.0, 1e-12, 1e-9, 1e-8, 1e-6, 1e-3}) {
            const double x = some_double(random, 3.0), z = some_double(random, 3.0);
            const glm::dquat rotation = from_euler({x, side * (pi / 2 - from_pole), z});
            const glm::dvec3 angles = to_euler(rotation);
            EXPECT_LE(distance(from_euler(angles), rotation), 2e-9);
            EXPECT_LE(std::abs(angles.y - side * (pi / 2 - from_pole)), 1e-12);
            if (from_pole <= 1e-9)
                EXPECT_EQ(angles.z, 0.0);
            else
                EXPECT_LE(std::abs(angles.z - z), 1e-6);
        }
    }
}

TEST(RigUnits, AWeightOfZeroLeavesTheItemToTheBit) {
    Random random(10);
    for (int i = 0; i < 100; ++i) {
        const Transform item = some_transform(random), other = some_transform(random);
        const Transform third = some_transform(random), fourth = some_transform(random);
        EXPECT_TRUE(same_bits(offset_transform(item, other, 0.0), item));
        EXPECT_TRUE(same_bits(set_transform(item, other, 0.0), item));
        EXPECT_TRUE(same_bits(set_rotation(item, other.rotation, 0.0), item));
        EXPECT_TRUE(same_bits(project_to_parent(item, other, third, fourth, 0.0), item));
        EXPECT_TRUE(same_bits(set_transform(item, other), other));
        EXPECT_TRUE(same_bits(project_to_parent(item, other, third, fourth, 1.0),
                              project_to_parent(other, third, fourth)));
    }
}

TEST(RigUnits, AnOffsetIsInTheItemsOwnSpace) {
    const Transform item{{1, 0, 0}, about({0, 0, 1}, 90), {2, 2, 2}};
    const Transform all = offset_transform(item, {{1, 0, 0}, about({1, 0, 0}, 90), {3, 1, 1}});
    EXPECT_LE(distance(all, {{1, 2, 0}, item.rotation * about({1, 0, 0}, 90), {6, 2, 2}}), 1e-15);
    const Transform half = offset_transform(item, {{1, 0, 0}, about({1, 0, 0}, 90), {3, 1, 1}}, 0.5);
    EXPECT_LE(distance(half, {{1, 1, 0}, item.rotation * about({1, 0, 0}, 45), {4, 2, 2}}), 1e-15);
}

TEST(RigUnits, ProjectedToTheSameParentInAnotherPoseAChildFollowsIt) {
    Random random(12);
    const Transform child = some_transform(random), before = some_transform(random),
                    after = some_transform(random);
    EXPECT_LE(distance(project_to_parent(child, before, before), child), 1e-14);
    const Transform there = project_to_parent(child, before, after);
    EXPECT_LE(distance(relative(after, there), relative(before, child)), 1e-14);
}

TEST(RigUnits, FromTwoVectorsIsTheShortestArc) {
    Random random(13);
    for (int i = 0; i < 1'000; ++i) {
        const glm::dvec3 from = some_vector(random, 5.0), to = i % 4 ? some_vector(random, 5.0) : -from;
        const glm::dquat turn = from_two_vectors(from, to);
        EXPECT_LE(distance(turn * (from / norm(from)), to / norm(to)), 1e-7);
        EXPECT_LE(std::abs(norm(turn) - 1.0), 1e-15);
        const double angle = 2.0 * std::acos(std::min(1.0, std::abs(turn.w)));
        EXPECT_NEAR(angle, std::acos(std::clamp(glm::dot(from, to) / norm(from) / norm(to), -1.0, 1.0)),
                    1e-6);
    }
    EXPECT_EQ(from_two_vectors({0, 0, 0}, {1, 0, 0}), glm::dquat(1, 0, 0, 0));
    EXPECT_EQ(from_two_vectors({1, 0, 0}, {0, 0, 0}), glm::dquat(1, 0, 0, 0));
}

TEST(RigUnits, LocationsMoveAndDirectionsOnlyTurn) {
    const Transform transform{{1, 2, 3}, about({0, 0, 1}, 90), {2, 3, 4}};
    EXPECT_LE(distance(transform_location(transform, {1, 1, 1}), {1 - 3, 2 + 2, 3 + 4}), 1e-15);
    EXPECT_LE(distance(transform_direction(transform, {1, 1, 1}), {-1, 1, 1}), 1e-15);
}

}  // namespace
}  // namespace tendril::test
