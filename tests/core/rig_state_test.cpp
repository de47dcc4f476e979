// Values set by the user, a rig's memory, and how both survive edits and rollbacks.
#include <gtest/gtest.h>

#include "memory.hpp"
#include "rig_rigs.hpp"

namespace tendril::rig::rig_state_test {
namespace {

TEST(RigState, SpringsLagAndComeToRest) {
    Definition definition{
        .elements = {control("head", ControlKind::Position), {.name = "tip", .initial = at(0, 1, 0)}},
        .units = {
            {.name = "trail", .operation = SpringInterpolate{.target = FromElement{"head"}, .strength = 2.0}},
            {.name = "follow", .operation = SetTransform{.item = "tip", .transform = Transform()}}}};
    definition.units[1].operation = TransformLocation{.location = FromUnit{"trail"}};
    Held rig(definition);
    EXPECT_FALSE(rig.solve(1.0 / 60)) << "at rest on its target";
    ASSERT_TRUE(rig.control("head", glm::dvec3(1, 0, 0)));
    EXPECT_TRUE(rig.solve(1.0 / 60));
    const double soon = std::get<glm::dvec3>(rig.unit("trail").outputs[0]).x;
    EXPECT_GT(soon, 0.0);
    EXPECT_LT(soon, 0.2);
    // Without time, units with memory do not move.
    const State before = rig.state;
    rig.solve(0.0);
    EXPECT_EQ(before, rig.state);
    int ticks = 0;
    while (rig.solve(1.0 / 60) && ++ticks < 10'000) {
    }
    EXPECT_LT(ticks, 1000);
    EXPECT_NEAR(std::get<glm::dvec3>(rig.unit("trail").outputs[0]).x, 1.0, 1e-6);
}

TEST(RigState, AnAimOfLimitedSpeedStaysWithinIt) {
    Definition definition = aim_rig();
    std::get<Aim>(definition.units[0].operation).max_speed = 90.0;
    Held rig(definition);
    rig.solve(0.1);
    glm::dquat last = rig.global("head").rotation;
    ASSERT_TRUE(rig.control("look", glm::dvec3(1, 1, 0)));
    bool moving = true;
    int steps = 0;
    for (; moving && steps < 100; ++steps) {
        moving = rig.solve(0.02);
        const glm::dquat now = rig.global("head").rotation;
        EXPECT_LE(2.0 * std::acos(std::min(1.0, std::abs(glm::dot(now, last)))), glm::radians(1.8) + 1e-6);
        last = now;
    }
    EXPECT_GT(steps, 10);
    EXPECT_LT(steps, 100);
    const Transform head = rig.global("head");
    expect_near(head.rotation * glm::dvec3(0, 0, 1),
                glm::normalize(rig.global("look").translation - head.translation), 1e-9);
}

TEST(RigState, ControlsStayWithinTheirLimits) {
    Held rig(aim_rig());
    ASSERT_TRUE(rig.control("look", glm::dvec3(5, -7, 3)));
    rig.solve();
    EXPECT_EQ(std::get<glm::dvec3>(rig.state.controls[2]), glm::dvec3(1, -1, 0));
    expect_near(rig.global("look").translation, {1, 0.3, 2});
    EXPECT_FALSE(rig.control("look", glm::dvec3(std::nan(""), 0, 0)));
    EXPECT_FALSE(rig.control("look", 1.0));
    EXPECT_FALSE(rig.control("head", Transform()));
    EXPECT_EQ(std::get<glm::dvec3>(rig.state.controls[2]), glm::dvec3(1, -1, 0))
        << "refused is refused as a whole";
    ASSERT_TRUE(rig.rig.set_element(rig.state, rig.element("look"), Space::Local, at(0, 2, 2)));
    rig.solve();
    expect_near(rig.global("look").translation, {0, 2, 2});
}

TEST(RigState, AControlWithRestOutsideItsLimitsStartsAtTheNearestEnd) {
    Definition definition;
    definition.elements = {
        {.name = "square",
         .kind = ElementKind::Control,
         .initial = at(1, 2, 3),
         .control = Control{.kind = ControlKind::Vector2d, .minimum = glm::dvec3(0.5, -1, 0)}},
        {.name = "place",
         .kind = ElementKind::Control,
         .initial = at(1, 2, 3),
         .control = Control{.kind = ControlKind::Position, .maximum = glm::dvec3(0, 9, 9)}}};
    Held rig(definition);
    for (int i = 0; i < 3; ++i) {
        expect_near(rig.global("square").translation, {1.5, 2, 3});
        expect_near(rig.global("place").translation, {0, 2, 3});
        rig.solve();
    }
    // This moves the rest pose; the control's value is relative to it.
    ASSERT_TRUE(rig.rig.set_element(rig.state, 0, Space::Global, at(4, 4, 4)));
    expect_near(rig.global("square").translation, {4, 4, 4});
    ASSERT_TRUE(rig.control("square", glm::dvec3(0)));
    expect_near(rig.global("square").translation, {4, 4, 4});
    // One limit is enough, and no solve is needed first.
    ASSERT_TRUE(rig.rig.set_element(rig.state, 1, Space::Global, at(5, 5, 5)));
    expect_near(rig.global("place").translation, {0, 5, 5});
}

TEST(RigState, LimitsThatAKindDoesNotUseAreIgnored) {
    const glm::dvec3 low(0, 0, 5), high(1, 1, -5);
    Definition square, dial;
    square.elements = {{.name = "square",
                        .kind = ElementKind::Control,
                        .control = Control{.kind = ControlKind::Vector2d, .minimum = low, .maximum = high}}};
    EXPECT_TRUE(Rig::make(square));
    square.elements[0].control->kind = ControlKind::Position;
    EXPECT_FALSE(Rig::make(square));
    EXPECT_EQ(rest_value({.kind = ControlKind::Bool}, {}), Value(false));
}

TEST(RigState, ChangingATypeClearsItsMemory) {
    Definition definition{
        .elements = {{.name = "bone", .initial = at(1, 0, 0)}, {.name = "other"}},
        .curves = {{.name = "smile", .value = 0.25}},
        .units = {{.name = "spring", .operation = SpringInterpolate{.target = Value(1.0)}}}};
    Held rig(definition);
    rig.solve(0.1);
    ASSERT_TRUE(rig.rig.set_curve(rig.state, 0, 0.75));
    ASSERT_TRUE(rig.rig.set_element(rig.state, 0, Space::Local, at(7, 0, 0)));
    ASSERT_TRUE(rig.rig.set_element(rig.state, 1, Space::Local, at(7, 0, 0)));
    std::get<SpringInterpolate>(definition.units[0].operation).target = Value(glm::dvec3(1, 2, 3));
    definition.elements[0].initial = at(2, 0, 0);
    definition.elements.push_back({.name = "new"});
    const Rig edited = Rig::make(definition).value();
    State state = edited.adopted(rig.rig, rig.state);
    ASSERT_TRUE(edited.fits(state));
    EXPECT_TRUE(std::holds_alternative<std::monostate>(state.units[0].memory[0].held));
    EXPECT_EQ(state.curves[0], 0.75);
    EXPECT_EQ(state.elements.get(edited.id(0), Space::Local).translation.x, 2.0) << "its rest has changed";
    EXPECT_EQ(state.elements.get(edited.id(1), Space::Local).translation.x, 7.0);
    Workspace workspace(edited);
    edited.solve(state, 0.1, workspace);
    EXPECT_EQ(state.units[0].outputs[0], Value(glm::dvec3(1, 2, 3)));
    EXPECT_EQ(state.curves[0], 0.75) << "the next solve starts from it, too";
}

TEST(RigState, AGlobalPoseIsKeptBelowAMovedControl) {
    Definition definition{.elements = {{.name = "control", .kind = ElementKind::Control},
                                       {.name = "a", .parent = "control", .initial = at(1, 0, 0)},
                                       {.name = "b", .parent = "a", .initial = at(0, 1, 0)}}};
    for (const Propagate propagate : {Propagate::Yes, Propagate::No}) {
        Held rig(definition);
        Transform moved = turned(90, {0, 0, 1});
        moved.translation = {1, 0, 0};
        ASSERT_TRUE(rig.control("control", moved));
        const Transform child = rig.global("b");
        Transform wanted = turned(30, {1, 0, 0});
        wanted.translation = {3, 3, 0};
        ASSERT_TRUE(rig.rig.set_element(rig.state, 1, Space::Global, wanted, propagate));
        for (int i = 0; i < 2; ++i) {
            expect_near(rig.global("a").translation, wanted.translation);
            EXPECT_NEAR(std::abs(glm::dot(rig.global("a").rotation, wanted.rotation)), 1.0, 1e-12);
            expect_near(rig.global("b").translation, propagate == Propagate::No
                                                         ? child.translation
                                                         : compose(wanted, at(0, 1, 0)).translation);
            expect_near(rig.rig.start_pose(rig.state, 1).translation, wanted.translation);
            rig.solve();
        }
    }
}

TEST(RigState, AChainWithNewEndsIsSolved) {
    Definition definition;
    for (int i = 0; i < 5; ++i)
        definition.elements.push_back({.name = numbered("b", i),
                                       .parent = i > 0 ? numbered("b", i - 1) : std::string(),
                                       .initial = at(i > 0 ? 1 : 0, 0, 0)});
    definition.units = {
        {.name = "reach", .operation = Fabrik{.root = "b0", .tip = "b4", .target = glm::dvec3(1, 1.2, 0.5)}}};
    Held rig(definition, 0.0);
    for (const auto& [root, tip] : {std::pair{"b0", "b3"}, std::pair{"b1", "b4"}, std::pair{"b1", "b3"}}) {
        auto& reach = std::get<Fabrik>(definition.units[0].operation);
        reach.root = root;
        reach.tip = tip;
        const Rig edited = Rig::make(definition).value();
        Workspace workspace(edited);
        // Once adopted, once as an older file may contain it.
        for (State state : {edited.adopted(rig.rig, rig.state), rig.state}) {
            edited.solve(state, 0.0, workspace);
            EXPECT_EQ(state.units[0].warning, Warning::None) << root << ' ' << tip;
            expect_near(state.elements.get(edited.id(*edited.element(tip)), Space::Global).translation,
                        {1, 1.2, 0.5}, 2e-3);
        }
    }
}

TEST(RigState, MemoryStaysWithItsElement) {
    Definition definition;
    for (const char* name : {"left", "right"})
        definition.elements.push_back({.name = name, .kind = ElementKind::Control});
    ForEach trail{.roots = {"left", "right"}};
    trail.body = {{.name = "spring",
                   .operation = SpringInterpolate{.target = FromElement{.element = ThisElement()},
                                                  .critical_damping = 0.2}}};
    definition.units = {{.name = "trail", .operation = trail}};
    Held rig(definition);
    rig.solve(0.1);
    ASSERT_TRUE(rig.control("left", at(1, 0, 0)));
    ASSERT_TRUE(rig.control("right", at(0, 5, 0)));
    rig.solve(0.1);
    const std::vector<UnitMemory> before = rig.state.units[1].memory;
    ASSERT_NE(before[0], before[1]);
    // In reverse order, with a new one in between; then with one removed.
    definition.elements.push_back({.name = "new", .parent = "right"});
    std::get<ForEach>(definition.units[0].operation).roots = {"right", "left"};
    const Rig edited = Rig::make(definition).value();
    const State state = edited.adopted(rig.rig, rig.state);
    ASSERT_TRUE(edited.fits(state));
    ASSERT_EQ(state.units[1].memory.size(), 3u);
    EXPECT_EQ(state.units[1].memory[0], before[1]);
    EXPECT_EQ(state.units[1].memory[1], UnitMemory());
    EXPECT_EQ(state.units[1].memory[2], before[0]);
    std::get<ForEach>(definition.units[0].operation).roots = {"left"};
    const Rig fewer = Rig::make(definition).value();
    EXPECT_EQ(fewer.adopted(edited, state).units[1].memory, std::vector<UnitMemory>{before[0]});
}

TEST(RigState, TheInputPoseIsTheStartOfASolve) {
    Held rig(loop_rig(3));
    ASSERT_TRUE(rig.control("dial", 1.0));
    rig.solve();
    ASSERT_TRUE(rig.rig.set_element(rig.state, 0, Space::Global, at(0, 5, 0)));
    rig.solve();
    rig.solve();
    expect_near(rig.global("b0").translation, {0, 5, 0});
    expect_near(rig.global("b1").translation,
                glm::dvec3(0, 5, 0) + turned(30, {0, 0, 1}).rotation * glm::dvec3(1, 0, 0));
    EXPECT_FALSE(rig.rig.set_element(rig.state, 0, Space::Global, {.scale = {1, 0, 1}}));
    EXPECT_FALSE(rig.rig.set_element(rig.state, 99, Space::Global, {}));
}

TEST(RigState, AnEditKeepsTheStateOfOldElements) {
    Held rig(loop_rig(3));
    ASSERT_TRUE(rig.control("dial", 1.0));
    rig.solve();
    Definition more = rig.rig.definition();
    more.elements.insert(more.elements.begin(), {.name = "other"});
    more.elements.push_back({.name = "b3", .parent = "b2", .initial = at(1, 0, 0)});
    const Rig edited = Rig::make(more).value();
    EXPECT_FALSE(edited.fits(rig.state));
    State state = edited.adopted(rig.rig, rig.state);
    ASSERT_TRUE(edited.fits(state));
    EXPECT_EQ(std::get<double>(state.controls[*edited.element("dial")]), 1.0);
    expect_near(state.elements.get(edited.id(*edited.element("b2")), Space::Global).translation,
                rig.global("b2").translation);
}

TEST(RigState, AllocatesNothing) {
    for (const Definition& definition : {aim_rig(), fk_rig(), loop_rig()}) {
        Held rig(definition);
        test::without_memory([&] { rig.solve(0.01); });
    }
}

/// A unit that inverts a switch needs no time; easing waits for time.
TEST(RigState, UnitsWithoutEasingFollowWithoutTime) {
    Definition definition{.elements = {control("dial", ControlKind::Float)}};
    const FromElement dial{.element = "dial", .of = Of::ControlValue};
    definition.units = {
        {.name = "not", .operation = AlphaInterpolate{.value = dial, .scale = -1.0, .bias = 1.0}},
        {.name = "eased", .operation = AlphaInterpolate{.value = dial, .interp = true}}};
    Held rig(definition);
    rig.solve(1.0 / 60);
    ASSERT_TRUE(rig.control("dial", 1.0));
    rig.solve(0.0);
    EXPECT_EQ(std::get<double>(rig.unit("not").outputs[0]), 0.0);
    EXPECT_EQ(std::get<double>(rig.unit("eased").outputs[0]), 0.0);
    rig.solve(1.0 / 60);
    EXPECT_GT(std::get<double>(rig.unit("eased").outputs[0]), 0.0);
    EXPECT_LT(std::get<double>(rig.unit("eased").outputs[0]), 0.5);
}

/// A workspace keeps no state, not even the lengths of a cached solver while a scale changes slowly.
TEST(RigState, WorkspacesCanBeReplacedWhileBonesGrow) {
    Definition definition;
    definition.elements = {{.name = "size", .kind = ElementKind::Control, .control = Control{}},
                           control("goal", ControlKind::Position, at(1, 1, 0)),
                           {.name = "a", .parent = "size"},
                           {.name = "b", .parent = "a", .initial = at(0.7, 0.1, 0)},
                           {.name = "c", .parent = "b", .initial = at(0.5, 0, 0.2)},
                           {.name = "d", .parent = "c", .initial = at(0.6, 0, 0)}};
    definition.units = {
        {.name = "reach", .operation = Fabrik{.root = "a", .tip = "d", .target = FromElement{"goal"}}}};
    Held kept(definition), fresh(definition);
    for (int i = 0; i < 200; ++i) {
        const double size = 1.0 + 3e-8 * i;
        for (Held* each : {&kept, &fresh}) {
            ASSERT_TRUE(each->control("size", Transform{.scale = {size, size, size}}));
            ASSERT_TRUE(each->control("goal", glm::dvec3(1.0 - 0.002 * i, 0.9, 0.003 * i)));
            each->solve(1.0 / 60);
        }
        fresh.workspace = Workspace(fresh.rig);
        ASSERT_EQ(kept.state, fresh.state) << i;
    }
}

/// Children that stay in place when their parent is set without propagation also stay after a solve. So do
/// controls, whose values change.
TEST(RigState, WithoutPropagationChildrenStayAfterTheSolve) {
    Definition definition;
    const auto control = [](const char* name, ControlKind kind) {
        return Element{.name = name,
                       .kind = ElementKind::Control,
                       .parent = "parent",
                       .initial = at(0, 1, 0),
                       .control = Control{.kind = kind}};
    };
    definition.elements = {control("parent", ControlKind::Transform),
                           control("transform", ControlKind::Transform),
                           control("position", ControlKind::Position),
                           control("rotation", ControlKind::Rotation),
                           control("square", ControlKind::Vector2d),
                           control("dial", ControlKind::Float),
                           {.name = "bone", .parent = "parent", .initial = at(1, 0, 0)},
                           {.name = "below", .parent = "transform", .initial = at(0, 0, 1)}};
    definition.elements[0].parent.clear();
    Held rig(definition);
    ASSERT_TRUE(rig.control("parent", at(5, 5, 5)));
    ASSERT_TRUE(rig.control("transform", at(3, 1, 0)));
    ASSERT_TRUE(rig.control("position", glm::dvec3(0, 4, 1)));
    ASSERT_TRUE(rig.control("rotation", turned(50, {1, 2, 3}).rotation));
    ASSERT_TRUE(rig.control("square", glm::dvec3(0.5, 2, 0)));
    rig.solve();
    std::vector<Transform> before;
    for (const Element& each : definition.elements) before.push_back(rig.global(each.name));
    Transform to = turned(80, {3, 2, 1});
    to.translation = {7, -1, 2};
    for (const char* parent : {"parent", "transform"}) {
        ASSERT_TRUE(rig.rig.set_element(rig.state, rig.element(parent), Space::Global, to, Propagate::No));
        before[rig.element(parent)] = to;
        for (int solves = 0; solves < 2; ++solves, rig.solve())
            for (std::size_t i = 0; i < before.size(); ++i) {
                SCOPED_TRACE(definition.elements[i].name);
                const Transform now = rig.global(definition.elements[i].name);
                expect_near(now.translation, before[i].translation);
                EXPECT_NEAR(std::abs(glm::dot(now.rotation, before[i].rotation)), 1.0, 1e-12);
            }
    }
}

}  // namespace
}  // namespace tendril::rig::rig_state_test
