// The parent constraint, and the collections of a for-each.
#include "rig_support.hpp"
#include "tendril/rig/collect.hpp"
#include "tendril/rig/euler.hpp"
#include "tendril/rig/parent_constraint.hpp"
#include "tests/says.hpp"

namespace tendril::test {
namespace {

using namespace rig;
using Parents = std::vector<ConstraintParent>;

ConstraintChild some_child(Random& random) {
    const Transform global = some_transform(random), initial = some_transform(random);
    return {global, initial, some_transform(random)};
}
ConstraintParent some_parent(Random& random, double weight = 1.0) {
    const Transform global = some_transform(random);
    return {global, some_transform(random), weight};
}

TEST(RigParentConstraint, OneParentIsFollowedWithItsOffsetOrWithout) {
    Random random(1);
    for (int i = 0; i < 200; ++i) {
        const ConstraintChild child = some_child(random);
        const Parents parents{some_parent(random, 0.3)};
        const Transform kept = parent_constraint(child, parents);
        EXPECT_LE(distance(relative(parents[0].global, kept),
                           relative(parents[0].initial_global, child.initial_global)),
                  1e-13);
        EXPECT_LE(distance(parent_constraint(child, parents, {.maintain_offset = false}), parents[0].global),
                  1e-15);
    }
}

TEST(RigParentConstraint, AParentThatHasNotMovedLeavesTheChildAtItsInitialPose) {
    Random random(2);
    ConstraintChild child = some_child(random);
    child.initial_global.scale = {1, 2, 3};
    Parents parents{some_parent(random), some_parent(random, 4.0)};
    for (ConstraintParent& each : parents) each.initial_global = each.global;
    EXPECT_LE(distance(parent_constraint(child, parents), child.initial_global), 1e-13);
}

TEST(RigParentConstraint, WeightsAreRelativeToEachOther) {
    Random random(3);
    const ConstraintChild child = some_child(random);
    Parents parents{some_parent(random, 1.0), some_parent(random, 3.0), some_parent(random, 0.0)};
    const Transform mean = parent_constraint(child, parents, {.maintain_offset = false});
    EXPECT_LE(distance(mean.translation,
                       0.25 * parents[0].global.translation + 0.75 * parents[1].global.translation),
              1e-14);
    for (ConstraintParent& each : parents) each.weight *= 1e6;
    EXPECT_LE(distance(parent_constraint(child, parents, {.maintain_offset = false}), mean), 1e-14);
}

TEST(RigParentConstraint, WithNothingToFollowTheChildStaysToTheBit) {
    Random random(4);
    const ConstraintChild child = some_child(random);
    Parents parents{some_parent(random, 0.0), some_parent(random, -1.0),
                    some_parent(random, std::numeric_limits<double>::quiet_NaN())};
    EXPECT_TRUE(same_bits(parent_constraint(child, parents), child.global));
    EXPECT_TRUE(same_bits(parent_constraint(child, {}), child.global));
    parents[0].weight = 1.0;
    EXPECT_TRUE(same_bits(parent_constraint(child, parents, {.weight = 0.0}), child.global));
    constexpr std::array<bool, 3> off{};
    EXPECT_TRUE(same_bits(parent_constraint(child, parents, {.filter = {off, off, off}}), child.global));
    EXPECT_FALSE(same_bits(parent_constraint(child, parents), child.global));
}

TEST(RigParentConstraint, AWeightOfHalfGoesHalfTheWay) {
    Random random(14);
    const ConstraintChild child = some_child(random);
    const Parents parents{some_parent(random), some_parent(random)};
    const Transform whole = parent_constraint(child, parents);
    const Transform half = parent_constraint(child, parents, {.weight = 0.5});
    EXPECT_TRUE(same_bits(half, blend(child.global, whole, 0.5)));
    EXPECT_GT(distance(half, whole), 0.1);
}

TEST(RigParentConstraint, TheFilterIsInTheChildsLocalSpace) {
    Random random(5);
    for (int i = 0; i < 500; ++i) {
        const ConstraintChild child = some_child(random);
        const Parents parents{some_parent(random)};
        TransformFilter filter;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            filter.translation[axis] = random.chance(2);
            filter.rotation[axis] = random.chance(2);
            filter.scale[axis] = random.chance(2);
        }
        const Transform got = relative(child.space, parent_constraint(child, parents, {.filter = filter}));
        const Transform to = relative(child.space, parent_constraint(child, parents));
        const Transform from = relative(child.space, child.global);
        const glm::dvec3 now = to_euler(got.rotation), before = to_euler(from.rotation),
                         after = to_euler(to.rotation);
        for (int axis = 0; axis < 3; ++axis) {
            const auto at = static_cast<std::size_t>(axis);
            EXPECT_NEAR(got.translation[axis], (filter.translation[at] ? to : from).translation[axis], 1e-12);
            EXPECT_NEAR(got.scale[axis], (filter.scale[at] ? to : from).scale[axis], 1e-12);
            EXPECT_LE(
                std::abs(std::remainder(now[axis] - (filter.rotation[at] ? after : before)[axis], 2 * pi)),
                1e-6);
        }
    }
}

TEST(RigParentConstraint, TheFilterMixesEulerAngles) {
    Random random(15);
    const auto some = [&](int kind) {
        const bool at_x = random.chance(4), at_z = random.chance(4);
        const double x = at_x ? pi : random.around(3.14f), z = at_z ? -pi : random.around(3.14f);
        const double from_pole = std::pow(10.0, random.around(3.0f) - 4.0);
        const double y = kind == 0   ? random.around(1.57f)
                         : kind == 1 ? pi / 2 - from_pole
                                     : from_pole - pi / 2;
        return from_euler({x, y, z});
    };
    for (int i = 0; i < 10'000; ++i) {
        const glm::dquat from = some(i % 3), to = some(i / 3 % 3);
        const int mask = i % 8;
        TransformFilter filter;
        glm::dvec3 wanted = to_euler(from);
        for (int axis = 0; axis < 3; ++axis) {
            filter.rotation[static_cast<std::size_t>(axis)] = (mask >> axis & 1) != 0;
            if ((mask >> axis & 1) != 0) wanted[axis] = to_euler(to)[axis];
        }
        const glm::dquat got = filtered({.rotation = from}, {.rotation = to}, filter).rotation;
        EXPECT_LE(distance(got, from_euler(wanted)), 1e-13) << i;
        EXPECT_NEAR(glm::length(got), 1.0, 1e-15);
    }
}

TEST(RigParentConstraint, AWeightMovesTheChildContinuously) {
    Random random(6);
    for (int round = 0; round < 20; ++round) {
        const ConstraintChild child = some_child(random);
        Parents parents{some_parent(random), some_parent(random), some_parent(random)};
        const std::size_t changed = random.below(3);
        ParentConstraintOptions options{.maintain_offset = round % 2 == 0};
        options.filter.translation[1] = round % 3 != 0;
        Transform last;
        double fine = 0.0;
        for (int i = 0; i <= 4000; ++i) {
            parents[changed].weight = static_cast<double>(i) / 1000.0;
            const Transform now = parent_constraint(child, parents, options);
            if (i > 0) fine = std::max(fine, distance(now, last));
            last = now;
        }
        EXPECT_LE(fine, 0.02) << "a thousandth of a weight of two others";
    }
}

TEST(RigParentConstraint, TenKilometresOutNothingFlipsOrShakes) {
    Random random(7);
    const ConstraintChild near = some_child(random);
    const Parents parents{some_parent(random), some_parent(random, 2.0)};
    const glm::dvec3 away{1e4, -1e4, 1e4};
    ConstraintChild far = near;
    for (Transform* each : {&far.global, &far.initial_global, &far.space}) each->translation += away;
    Parents far_parents = parents;
    for (ConstraintParent& each : far_parents)
        each.global.translation += away, each.initial_global.translation += away;
    ParentConstraintOptions options;
    options.filter.rotation = {true, false, true};
    options.filter.translation = {true, false, true};
    Transform there = parent_constraint(far, far_parents, options);
    there.translation -= away;
    EXPECT_LE(distance(there, parent_constraint(near, parents, options)), 1e-10);
}

TEST(RigParentConstraint, RotationsAreAveragedOnTheFirstParentsHemisphere) {
    const ConstraintChild child;
    Parents parents{{.global = {.rotation = about({0, 0, 1}, 20)}},
                    {.global = {.rotation = about({0, 0, 1}, 60)}}};
    const ParentConstraintOptions options{.maintain_offset = false};
    EXPECT_LE(distance(parent_constraint(child, parents, options).rotation, about({0, 0, 1}, 40)), 1e-15);
    parents[1].global.rotation = -parents[1].global.rotation;
    EXPECT_LE(distance(parent_constraint(child, parents, options).rotation, about({0, 0, 1}, 40)), 1e-15);
    // What counts is the child's pose under the first parent, not that parent's own rotation.
    ConstraintChild turned;
    turned.initial_global.rotation = about({0, 0, 1}, 179);
    const Parents offset{{}, {.global = {.rotation = about({0, 0, 1}, 4)}}};
    EXPECT_LE(distance(parent_constraint(turned, offset).rotation, about({0, 0, 1}, 181)), 1e-15);
    // Half a turn either way from a first parent of weight 0: they cancel, and the heavier one wins.
    parents = {{.weight = 0.0},
               {.global = {.rotation = {0, 1, 0, 0}}, .weight = 1.0},
               {.global = {.rotation = {0, -1, 0, 0}}, .weight = 1.0}};
    EXPECT_LE(distance(parent_constraint(child, parents, options).rotation, {0, 1, 0, 0}), 1e-15);
}

TEST(RigCollect, DepthFirstFromTheRootInTheOrderOfAdding) {
    Hierarchy tree;
    const auto add = [&](ElementId parent) { return *tree.add(ElementKind::Bone, parent, {}); };
    const ElementId root = add({}), a = add(root), b = add(root), a1 = add(a), b1 = add(b), a2 = add(a),
                    other = add({});
    const auto collected = [&](bool include_parent, bool recursive) {
        std::vector<ElementId> list{other};  // appends to the list
        EXPECT_TRUE(collect_children(tree, root, {include_parent, recursive}, list).ok());
        return list;
    };
    EXPECT_EQ(collected(true, true), (std::vector{other, root, a, a1, a2, b, b1}));
    EXPECT_EQ(collected(false, true), (std::vector{other, a, a1, a2, b, b1}));
    EXPECT_EQ(collected(true, false), (std::vector{other, root, a, b}));
    EXPECT_EQ(collected(false, false), (std::vector{other, a, b}));
    std::vector<ElementId> list;
    EXPECT_TRUE(
        test::says(collect_children(tree, {}, {}, list).message(), "collect_children root handle empty"));
    EXPECT_TRUE(list.empty());
}

TEST(RigCollect, TheRatioRunsFromZeroToOne) {
    EXPECT_EQ(loop_ratio(0, 5), 0.0);
    EXPECT_EQ(loop_ratio(1, 5), 0.25);
    EXPECT_EQ(loop_ratio(4, 5), 1.0);
    EXPECT_EQ(loop_ratio(0, 1), 0.0);
    EXPECT_EQ(loop_ratio(0, 0), 0.0);
}

}  // namespace
}  // namespace tendril::test
