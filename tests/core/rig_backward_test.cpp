// Backward solves, and explanations of an element's pose.
#include <gtest/gtest.h>

#include "random.hpp"
#include "rig_rigs.hpp"
#include "tendril/rig/backward.hpp"
#include "tendril/rig/explain.hpp"

namespace tendril::rig {
namespace {

double around(test::Random& random, double range) {
    return static_cast<double>(random.around(1.0f)) * range;
}
glm::dquat any_rotation(test::Random& random, double max_degrees) {
    const double x = around(random, 1), y = around(random, 1), z = around(random, 1);
    const double angle = around(random, max_degrees);
    return turned(angle, glm::dvec3(x, y, z) + glm::dvec3(1e-3)).rotation;
}

/// Sets random controls, solves, keeps the bones' pose, resets the controls, solves backward and returns the
/// residuals.
BackwardReport there_and_back(const Definition& definition, std::uint64_t seed, double max_degrees) {
    test::Random random(seed);
    Held rig(definition);
    const std::vector<Value> rest = rig.state.controls;
    for (std::size_t i = 0; i < definition.elements.size(); ++i) {
        if (!definition.elements[i].control) continue;
        Value value = rig.state.controls[i];
        if (std::holds_alternative<double>(value)) value = 0.5 + around(random, 0.5);
        if (std::holds_alternative<bool>(value)) value = random.chance(2);
        if (auto* vector = std::get_if<glm::dvec3>(&value))
            for (int axis = 0; axis < 3; ++axis) (*vector)[axis] += around(random, 0.8);
        if (std::holds_alternative<glm::dquat>(value)) value = any_rotation(random, max_degrees);
        EXPECT_TRUE(rig.rig.set_control(rig.state, i, value));
    }
    rig.solve();
    for (std::size_t i = 0; i < rest.size(); ++i) {
        if (!definition.elements[i].control) continue;
        EXPECT_TRUE(rig.rig.set_control(rig.state, i, rest[i]));
    }
    // Keep only the bones' pose.
    return solve_backward(rig.rig, rig.state, rig.workspace);
}

void expect_nothing_left(const BackwardReport& report, std::uint64_t seed) {
    for (const Residual& left : report.elements) {
        EXPECT_LT(left.metres, 1e-4) << seed;
        EXPECT_LT(left.radians, 1e-4) << seed;
        EXPECT_LT(left.scale, 1e-4) << seed;
    }
}

TEST(RigBackward, RecoversAnyPoseThatTheRigCanExpress) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        expect_nothing_left(there_and_back(fk_rig(4), seed, 100), seed);
        expect_nothing_left(there_and_back(fk_rig(4, false), seed, 100), seed);
        expect_nothing_left(there_and_back(aim_rig(), seed, 100), seed);
        expect_nothing_left(there_and_back(loop_rig(5, true), seed, 100), seed);
        expect_nothing_left(there_and_back(loop_rig(5, false), seed, 100), seed);
    }
}

TEST(RigBackward, ReportsTheBoneThatCannotReachItsPose) {
    Held rig(fk_rig(4));
    // A bone longer than any control can make it.
    ASSERT_TRUE(rig.rig.set_element(rig.state, rig.element("b3"), Space::Local, at(0, 1.5, 0)));
    ASSERT_TRUE(rig.rig.set_element(rig.state, rig.element("b3"), Space::Local, at(0, 1.0, 0)));
    rig.solve();
    rig.state.elements.put(rig.rig.id(rig.element("b3")), Space::Local, at(0, 1.5, 0));
    const BackwardReport report = solve_backward(rig.rig, rig.state, rig.workspace);
    ASSERT_TRUE(report.worst);
    EXPECT_EQ(rig.rig.definition().elements[*report.worst].name, "b3");
    EXPECT_NEAR(report.elements[*report.worst].metres, 0.5, 1e-3);
    EXPECT_LT(report.elements[rig.element("b1")].metres, 0.05);
}

TEST(RigBackward, RespectsTheLimitsOfControls) {
    Held rig(aim_rig());
    ASSERT_TRUE(rig.control("look", glm::dvec3(1, 1, 0)));
    rig.solve();
    // Out of the control's range.
    Transform head = rig.local("head");
    head.rotation = turned(80, {0, 1, 0}).rotation;
    rig.state.elements.put(rig.rig.id(rig.element("head")), Space::Local, head);
    const BackwardReport report = solve_backward(rig.rig, rig.state, rig.workspace);
    const auto look = std::get<glm::dvec3>(rig.state.controls[rig.element("look")]);
    EXPECT_LE(std::abs(look.x), 1.0);
    EXPECT_LE(std::abs(look.y), 1.0);
    EXPECT_GT(report.elements[rig.element("head")].radians, 0.5);
    EXPECT_EQ(*report.worst, rig.element("head"));
}

/// Two bones on one control, with targets that cannot both be satisfied.
TEST(RigBackward, SharesTheResidualByLeastSquares) {
    Definition definition{
        .elements = {{.name = "a"}, {.name = "b"}, control("place", ControlKind::Position)}};
    for (const char* bone : {"a", "b"})
        definition.units.push_back(
            {.name = std::string("move ") += bone,
             .operation =
                 ParentConstraint{.item = bone, .parents = {{.item = "place"}}, .maintain_offset = false}});
    for (const double most : {9.0, 0.5, -2.0}) {
        definition.elements[2].control->maximum = glm::dvec3(most, 9, 9);
        Held rig(definition);
        rig.state.elements.put(rig.rig.id(0), Space::Global, at(0, 1, 3));
        rig.state.elements.put(rig.rig.id(1), Space::Global, at(2, 1, 0));
        const BackwardReport report = solve_backward(rig.rig, rig.state, rig.workspace);
        const double x = std::min(most, 1.0);
        const auto place = std::get<glm::dvec3>(rig.state.controls[2]);
        EXPECT_NEAR(place.x, x, 1e-6) << most;
        EXPECT_NEAR(place.y, 1.0, 1e-6) << most;
        EXPECT_NEAR(place.z, 1.5, 1e-6) << most;
        EXPECT_NEAR(report.elements[0].metres, std::hypot(x, 1.5), 1e-6);
        EXPECT_NEAR(report.elements[1].metres, std::hypot(2 - x, 1.5), 1e-6);
        EXPECT_EQ(*report.worst, x < 1.0 ? 1u : *report.worst);
    }
}

/// A bone 1 m from the control that rotates it, with a position target at rest and a rotation target at a
/// right angle: at the minimum of d^2 + r^2 a^2 the derivative is zero.
TEST(RigBackward, MetresPerRadianWeightsRotations) {
    Definition definition{
        .elements = {{.name = "root"},
                     {.name = "bone", .parent = "root", .initial = at(1, 0, 0)},
                     control("dial", ControlKind::Rotation)},
        .units = {{.name = "turn",
                   .operation = SetRotation{
                       .item = "root", .rotation = FromElement{.element = "dial", .of = Of::Rotation}}}}};
    const double right = std::acos(0.0);
    for (const double radius : {0.0, 0.1, 0.7, 5.0}) {
        Held rig(definition);
        Transform wanted = turned(90, {0, 0, 1});
        wanted.translation = {1, 0, 0};
        rig.state.elements.put(rig.rig.id(1), Space::Global, wanted);
        solve_backward(rig.rig, rig.state, rig.workspace, {.metres_per_radian = radius});
        const glm::dvec3 tip = rig.global("bone").translation;
        const double angle = std::atan2(tip.y, tip.x), r = radius > 0.0 ? radius : 1.0;
        // The root's rotation also has a target, at rest.
        EXPECT_NEAR(std::sin(angle) - r * r * (right - angle) + r * r * angle, 0.0, 1e-4) << radius;
        EXPECT_NEAR(tip.z, 0.0, 1e-6);
    }
}

TEST(RigBackward, ResidualsIncludeScale) {
    Held rig({.elements = {{.name = "a"}, {.name = "b", .parent = "a", .initial = at(1, 0, 0)}}});
    rig.state.elements.put(rig.rig.id(1), Space::Local, at(1, 0.1, 0));
    rig.state.elements.put(rig.rig.id(0), Space::Global, {.scale = {1, 1, 1.5}}, Propagate::No);
    const BackwardReport report = solve_backward(rig.rig, rig.state, rig.workspace);
    EXPECT_EQ(*report.worst, 0u);
    EXPECT_NEAR(report.elements[0].scale, 0.5, 1e-12);
    EXPECT_NEAR(report.elements[1].metres, 0.1, 1e-9);
}

TEST(RigBackward, TriesSwitchesBothWays) {
    Definition definition = fk_rig(2);
    definition.elements.push_back(control("on", ControlKind::Bool));
    definition.units.push_back({.name = "bend",
                                .operation = OffsetTransform{.item = "b0", .offset = at(0, 0, 2)},
                                .when = value_of("on")});
    Held rig(definition);
    ASSERT_TRUE(rig.control("on", true));
    rig.solve();
    ASSERT_TRUE(rig.control("on", false));
    const BackwardReport report = solve_backward(rig.rig, rig.state, rig.workspace);
    EXPECT_TRUE(std::get<bool>(rig.state.controls[rig.element("on")]));
    expect_nothing_left(report, 0);
}

/// Solves fourteen rotation controls, all turned, with a limit on the work.
BackwardReport bounded(const BackwardOptions& options, State& state) {
    Held rig(fk_rig(14));
    const State rest = rig.state;
    for (int i = 0; i < 14; ++i)
        EXPECT_TRUE(rig.control(numbered("c", i), turned(10.0 + 3.0 * i, {1, 0, 1}).rotation));
    rig.solve();
    rig.state.controls = rest.controls;
    const BackwardReport report = solve_backward(rig.rig, rig.state, rig.workspace, options);
    state = rig.state;
    if (report.iterations == 0) {
        EXPECT_EQ(state.controls, rest.controls) << "nothing was done";
    }
    return report;
}

TEST(RigBackward, StopsAtItsWorkLimitAndReportsIt) {
    State state, whole_state;
    const BackwardReport whole = bounded({}, whole_state);
    EXPECT_FALSE(whole.stopped);
    expect_nothing_left(whole, 0);
    double last = 1e9;
    int stops = 0;
    for (std::uint64_t work = 100; work < 100'000'000; work *= 2) {
        const BackwardReport report = bounded({.max_work = work}, state);
        double left = 0.0;
        for (const Residual& each : report.elements) left += each.metres + each.radians;
        EXPECT_LE(report.iterations, whole.iterations);
        EXPECT_LE(report.solves, whole.solves);
        if (report.stopped) {
            ++stops;
            EXPECT_GT(left, 1e-3);
            EXPECT_LE(left, last * 1.5) << "more work, less left, but for what trades places";
            last = left;
        } else {
            EXPECT_EQ(state, whole_state);
        }
        // A forward solve counts as at least Rig::work, so the limit bounds solves too.
        const std::uint64_t one = Held(fk_rig(14)).rig.work();
        EXPECT_LE(static_cast<std::uint64_t>(report.solves) * one, work + 2 * one);
    }
    EXPECT_GT(stops, 4);
    EXPECT_LT(stops, 20);
    const BackwardReport once = bounded({.max_iterations = 1}, state);
    EXPECT_TRUE(once.stopped);
    EXPECT_EQ(once.iterations, 1);
}

TEST(RigBackward, WorkCountsEveryElementUnitVisitAndBone) {
    const auto work = [](const Definition& definition) { return Rig::make(definition).value().work(); };
    EXPECT_EQ(work({}), 0u);
    Definition line;
    for (int i = 0; i < 30; ++i)
        line.elements.push_back({.name = numbered("b", i),
                                 .parent = i > 0 ? numbered("b", i - 1) : std::string(),
                                 .initial = at(0, i > 0 ? 1 : 0, 0)});
    const std::uint64_t elements = work(line);
    EXPECT_EQ(elements, 30u);
    const auto with = [&](const Operation& operation) {
        Definition more = line;
        more.units = {{.name = "unit", .operation = operation}};
        return work(more) - elements;
    };
    const std::uint64_t turn = with(SetRotation{.item = "b0"});
    EXPECT_GT(turn, 0u);
    const std::uint64_t short_chain = with(Fabrik{.root = "b0", .tip = "b5"}),
                        long_chain = with(Fabrik{.root = "b0", .tip = "b29"});
    EXPECT_EQ((short_chain - turn) * 5, long_chain - turn) << "6 joints and 30";
    ForEach loop{.roots = {"b0"}, .include_parent = true, .recursive = true};
    const std::uint64_t empty = with(loop);
    loop.body.push_back({.name = "inner", .operation = SetRotation{.item = ThisElement()}});
    EXPECT_EQ(with(loop) - empty, 30 * turn);
}

TEST(RigBackward, ARigWithoutControlsOrBonesIsSolvedAtOnce) {
    Held nothing({});
    EXPECT_FALSE(solve_backward(nothing.rig, nothing.state, nothing.workspace).worst);
    Held bones({.elements = {{.name = "a"}}});
    ASSERT_TRUE(bones.rig.set_element(bones.state, 0, Space::Local, at(1, 0, 0)));
    EXPECT_EQ(solve_backward(bones.rig, bones.state, bones.workspace).elements[0].metres, 0.0);
}

TEST(RigExplain, NamesTheUnitsThatMovedAnElementAndByHowMuch) {
    Held rig(fk_rig(2));
    ASSERT_TRUE(rig.control("c0", turned(90, {0, 0, 1}).rotation));
    rig.solve();
    const Explanation why = explain(rig.rig, rig.state, rig.element("b1"), rig.workspace);
    EXPECT_NEAR(why.units[0].metres, std::sqrt(2.0), 1e-9);
    EXPECT_NEAR(why.units[0].radians, glm::radians(90.0), 1e-6);
    EXPECT_NEAR(why.units[1].metres, 0.0, 1e-9);
    EXPECT_NEAR(why.units[1].radians, 0.0, 1e-6);
}

}  // namespace
}  // namespace tendril::rig
