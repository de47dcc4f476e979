// Guarantees of aim(), also for degenerate targets.
#include "rig_rigs.hpp"
#include "rig_support.hpp"
#include "tendril/rig/collect.hpp"
#include "tendril/rig/euler.hpp"
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
    AimOptions options{
        .primary = {some_vector(random, 1.0), some_vector(random, 5.0), some_kind(random), 1.0},
        .secondary = {some_vector(random, 1.0), some_vector(random, 5.0), some_kind(random), 1.0}};
    return options;
}
glm::dvec3 way_to(const AimPart& part, const Transform& item) {
    return unit(part.kind == AimTarget::Location ? part.target - item.translation : part.target);
}

TEST(RigAim, ThePrimaryAxisHitsItsTargetTheSecondaryAsNearlyAsPossible) {
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
    for (int i = 0; i < 2'000; ++i) {
        const AimOptions options = some_options(random);
        const Transform once = aim(some_transform(random), options).transform;
        EXPECT_LE(distance(aim(once, options).transform, once), 1e-9);
    }
}

TEST(RigAim, AWeightBlendsTheAxisTowardsTheTarget) {
    AimOptions options{.primary = {{1, 0, 0}, {0, 1, 0}, AimTarget::Direction, 0.5}};
    const auto axis = [&](const glm::dvec3& local) { return aim({}, options).transform.rotation * local; };
    EXPECT_LE(distance(axis({1, 0, 0}), unit({1, 1, 0})), 1e-15);
    options.weight = 0.5;  // 0.25 in total
    EXPECT_LE(distance(axis({1, 0, 0}), unit({3, 1, 0})), 1e-15);
    options.primary.weight = 0.0;
    options.secondary = {{0, 1, 0}, {0, 0, 1}, AimTarget::Direction, 1.0};
    EXPECT_LE(distance(axis({0, 1, 0}), unit({0, 1, 1})), 1e-15);
    EXPECT_LE(distance(axis({1, 0, 0}), {1, 0, 0}), 1e-15);
}

TEST(RigAim, AWeightOfZeroLeavesTheItemBitForBit) {
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
        Transform item{.rotation = some_rotation(random)};
        AimOptions options{.primary = {some_vector(random, 1.0), {}, AimTarget::Direction, 1.0}};
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

TEST(RigAim, ADegeneratePartIsSkippedWithAWarning) {
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

TEST(RigAim, InvalidOptionsAreRefused) {
    const auto message = [](auto change) {
        AimOptions options;
        change(options);
        return std::string(check(options).message());
    };
    EXPECT_EQ(message([](AimOptions&) {}), "");
    EXPECT_TRUE(test::says(message([](AimOptions& o) {
                               o.primary.axis = {0, 0, 0};
                           }),
                           "aim primary.axis longer 1e-9 0"));
    EXPECT_TRUE(test::says(message([](AimOptions& o) { o.weight = 1.5; }), "aim weight 0 1 1.5"));
}

// The parent constraint, and the elements of a for-each.

using Parents = std::vector<ConstraintParent>;

ConstraintChild some_child(Random& random) {
    const Transform global = some_transform(random), initial = some_transform(random);
    return {global, initial, some_transform(random)};
}
ConstraintParent some_parent(Random& random, double weight = 1.0) {
    const Transform global = some_transform(random);
    return {global, some_transform(random), weight};
}

TEST(RigParentConstraint, OneParentIsFollowedWithAndWithoutOffset) {
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

TEST(RigParentConstraint, AParentAtRestKeepsTheChildAtItsInitialPose) {
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

TEST(RigParentConstraint, WithoutActiveParentsTheChildStaysBitForBit) {
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

TEST(RigParentConstraint, AWeightOfHalfMovesTheChildHalfWay) {
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

TEST(RigParentConstraint, TenKilometresFromTheOriginIsAsAccurate) {
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
    // The child's pose under the first parent decides, not that parent's own rotation.
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

TEST(RigCollect, DepthFirstFromTheRootInOrderOfCreation) {
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
        test::says(collect_children(tree, {}, {}, list).message(), "collect_children root empty handle"));
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

namespace tendril::rig {
namespace {

// Springs as units: parameters out of range, and when springs move.

/// Parameters driven by controls may have any value.
TEST(RigSpring, ASpringsParametersAreClampedWithAWarning) {
    Definition definition{
        .elements = {control("dial", ControlKind::Float), control("turn", ControlKind::Rotation)}};
    const FromElement dial{.element = "dial", .of = Of::ControlValue};
    definition.units = {{.name = "spring",
                         .operation = SpringInterpolate{
                             .target = value_of("turn"), .strength = 2.0, .critical_damping = dial}}};
    Held rig(definition);
    ASSERT_TRUE(rig.control("dial", -0.5));
    const glm::dquat turned = glm::angleAxis(1.0, glm::dvec3(0, 1, 0));
    rig.solve(0.01);
    EXPECT_EQ(rig.unit("spring").warning, Warning::ParameterOutOfRange);
    ASSERT_TRUE(rig.control("turn", turned));
    for (int i = 0; i < 10; ++i) rig.solve(0.01);
    const auto clamped = std::get<glm::dquat>(rig.unit("spring").outputs[0]);
    EXPECT_NEAR(glm::length(clamped), 1.0, 1e-12);
    Held undamped(definition);
    undamped.solve(0.01);
    ASSERT_TRUE(undamped.control("turn", turned));
    for (int i = 0; i < 10; ++i) undamped.solve(0.01);
    EXPECT_EQ(undamped.unit("spring").warning, Warning::None);
    EXPECT_EQ(std::get<glm::dquat>(undamped.unit("spring").outputs[0]), clamped) << "it swings as with 0";
}

TEST(RigSpring, AForceWithoutASpringMovesWithTime) {
    Definition definition{
        .units = {{.name = "drift",
                   .operation = SpringInterpolate{
                       .target = Value(0.0), .strength = 0.0, .force = Input<Value>(Value(2.0))}}}};
    Held rig(definition);
    EXPECT_TRUE(rig.solve(0.01)) << "it starts at rest, and does not stay so";
    for (int i = 0; i < 100; ++i) EXPECT_TRUE(rig.solve(0.01));
    EXPECT_NEAR(std::get<double>(rig.unit("drift").outputs[1]), 2.0, 1e-9);
}

TEST(RigSpring, ASpringAtATurningPointStillMoves) {
    Definition definition{
        .elements = {control("dial", ControlKind::Float)},
        .units = {{.name = "swing",
                   .operation = SpringInterpolate{
                       .target = value_of("dial"), .strength = 1.0, .critical_damping = 0.0}}}};
    Held rig(definition);
    rig.solve(0.25);
    ASSERT_TRUE(rig.control("dial", 1.0));
    // Each step is a quarter of a cycle: every second one ends at a turning point, at rest.
    for (int i = 0; i < 12; ++i) EXPECT_TRUE(rig.solve(0.25)) << i;
}

}  // namespace
}  // namespace tendril::rig
