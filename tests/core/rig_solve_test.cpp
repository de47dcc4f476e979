// Forward solves: each unit on a small rig, and properties of all units.
#include "rig_rigs.hpp"
#include "tendril/ik/curve.hpp"
#include "tests/says.hpp"

namespace tendril::rig {
namespace {

TEST(RigSolve, SolvingTwiceEqualsSolvingOnce) {
    for (const Definition& definition : {aim_rig(), fk_rig(), loop_rig(), loop_rig(5, false)}) {
        Held rig(definition);
        for (std::size_t i = 0; i < definition.elements.size(); ++i) {
            if (!definition.elements[i].control) continue;
            Value value = rig.state.controls[i];
            if (std::holds_alternative<double>(value)) value = 0.7;
            if (std::holds_alternative<glm::dquat>(value)) value = turned(20, {0, 0, 1}).rotation;
            ASSERT_TRUE(rig.rig.set_control(rig.state, i, value));
        }
        rig.solve();
        rig.state.elements.resolve_all();
        const State once = rig.state;
        rig.solve();
        EXPECT_EQ(once, rig.state);
    }
}

TEST(RigSolve, EachElementHasItsRatioWithinItsRoot) {
    Definition definition{.elements = {{.name = "a"},
                                       {.name = "a1", .parent = "a"},
                                       {.name = "a2", .parent = "a1"},
                                       {.name = "b"},
                                       {.name = "b1", .parent = "b"}},
                          .curves = {{.name = "sum"}}};
    // Each moves by its own ratio.
    const auto along = [](const char* name, Each each, glm::dvec3 axis) {
        return Unit{.name = name,
                    .operation = SetTransform{.item = ThisElement(),
                                              .transform = Transform{.translation = axis},
                                              .space = Space::Local},
                    .weight = each};
    };
    definition.units = {{.name = "each",
                         .operation = ForEach{.roots = {"a", "b"},
                                              .include_parent = false,
                                              .body = {along("ratio", Each::Ratio, {1, 0, 0})}}}};
    Held rig(definition, 0.0);
    expect_near(rig.local("a1").translation, {0, 0, 0});  // the first of two
    expect_near(rig.local("a2").translation, {1, 0, 0});  // the last of two
    expect_near(rig.local("b1").translation, {0, 0, 0});  // a single one
}

TEST(RigSolve, AWeightOfZeroLeavesEverythingBitForBit) {
    Definition definition = aim_rig();
    definition.elements[1].initial.rotation = glm::normalize(glm::dquat(0.3, 0.1, -0.7, 0.2));
    definition.elements.push_back({.name = "tip", .parent = "head", .initial = at(0, 0.2, 0.1)});
    const std::vector<Operation> operations = {
        std::get<Aim>(definition.units[0].operation),
        ParentConstraint{.item = "head", .parents = {{.item = "look"}}, .maintain_offset = false},
        OffsetTransform{.item = "head", .offset = turned(50, {1, 1, 0})},
        SetTransform{.item = "head", .transform = at(3, 3, 3)},
        SetRotation{.item = "head", .rotation = turned(50, {1, 1, 0}).rotation},
        Fabrik{.root = "neck", .tip = "tip", .target = FromElement{"look"}},
        TwoBone{.root = "neck", .tip = "tip", .target = FromElement{"look"}},
        Spline{.root = "neck", .tip = "tip", .points = {"neck", "look"}}};
    for (const Operation& operation : operations) {
        definition.units = {{.name = "unit", .operation = operation, .weight = 0.0}};
        Held rig(definition);
        const State before = rig.state;
        rig.solve(0.1);
        for (const ElementId id : {rig.rig.id(0), rig.rig.id(1), rig.rig.id(4)})
            for (const Space space : {Space::Local, Space::Global}) {
                State original = before;
                EXPECT_EQ(rig.state.elements.get(id, space), original.elements.get(id, space))
                    << operation_name(operation.index());
            }
        // The same holds if it is disabled, or if `when` is false.
        definition.units[0].weight = 1.0;
        definition.units[0].enabled = false;
        Held off(definition);
        off.solve(0.1);
        EXPECT_EQ(off.global("head"), rig.global("head"));
        definition.units[0].enabled = true;
        definition.units[0].when = false;
        Held when(definition);
        when.solve(0.1);
        EXPECT_EQ(when.global("head"), rig.global("head"));
        definition.units[0].when = true;
        Held on(definition);
        on.solve(0.1);
        EXPECT_NE(on.state.elements.get(on.rig.id(1), Space::Global),
                  rig.state.elements.get(rig.rig.id(1), Space::Global))
            << operation_name(operation.index());
    }
}

TEST(RigSolve, ChainsReachTheirTargets) {
    Definition definition;
    definition.elements = {{.name = "a", .initial = at(0, 0, 0)},
                           {.name = "b", .parent = "a", .initial = at(0, 1, 0)},
                           {.name = "c", .parent = "b", .initial = at(0.1, 1, 0)},
                           control("target", ControlKind::Position, at(1, 0.8, 0.3)),
                           {.name = "pole", .kind = ElementKind::Null, .initial = at(0, 0, -5)}};
    for (const Operation& operation :
         {Operation(TwoBone{
              .root = "a", .tip = "c", .target = FromElement{"target"}, .pole_target = FromElement{"pole"}}),
          Operation(Fabrik{.root = "a",
          .tip = "c",
          .target = FromElement{"target"},
          .pole_target = FromElement{"pole"}})}) {
        definition.units = {{.name = "reach", .operation = operation}};
        Held rig(definition);
        for (const glm::dvec3& to :
             {glm::dvec3(1, 0.8, 0.3), glm::dvec3(-1, 0.5, 0.2), glm::dvec3(0.2, -1, 1)}) {
            ASSERT_TRUE(rig.control("target", to));
            rig.solve();
            expect_near(rig.global("c").translation, to, 2e-3);
            EXPECT_LT(std::get<double>(rig.unit("reach").outputs[0]), 2e-3);
            EXPECT_NEAR(glm::length(rig.global("b").translation), 1.0, 1e-6);
            EXPECT_LT(rig.global("b").translation.z, 0.0) << "the elbow points at its pole";
        }
        // The same, 10 km from the origin.
        ASSERT_TRUE(rig.rig.set_element(rig.state, 0, Space::Global, at(1e4, 0, 1e4)));
        ASSERT_TRUE(rig.control("target", glm::dvec3(1e4 + 1, 0.8, 1e4 + 0.3)));
        rig.solve();
        expect_near(rig.global("c").translation, {1e4 + 1, 0.8, 1e4 + 0.3}, 2e-3);
    }
}

// Three bones along +Y, and a curve with three control points.
Definition spline_rig() {
    Definition definition{.elements = {{.name = "a", .initial = at(0, 0, 0)},
                                       {.name = "b", .parent = "a", .initial = turned(30, {0, 1, 0})},
                                       {.name = "c", .parent = "b", .initial = at(0, 1, 0)},
                                       {.name = "d", .parent = "c", .initial = at(0, 1, 0)}}};
    definition.elements[1].initial.translation = {0, 1, 0};
    for (const auto& [name, place] :
         {std::pair("p", at(2, 0, 0)), std::pair("q", at(3, 1, 0.5)), std::pair("r", at(5, 1, 0))})
        definition.elements.push_back({.name = name,
                                       .kind = ElementKind::Control,
                                       .initial = place,
                                       .control = Control{.kind = ControlKind::Position}});
    definition.units = {
        {.name = "spline", .operation = Spline{.root = "a", .tip = "d", .points = {"p", "q", "r"}}}};
    return definition;
}

TEST(RigSolve, ASplineLaysBonesOnACurveAndRollsThem) {
    Definition definition = spline_rig();
    Held rig(definition, 0.0);
    const std::vector<glm::vec3> points{{2, 0, 0}, {3, 1, 0.5}, {5, 1, 0}};
    const std::vector<float> lengths(3, 1.0f);
    const std::vector<glm::vec3> rest(3, glm::vec3(0, 1, 0));
    std::vector<glm::vec3> joints(4);
    ik::State state(3);
    ik::CurveMemory memory;
    ik::place_along(points, {lengths, rest}, joints, state, memory);
    const char* const names[] = {"a", "b", "c", "d"};
    for (std::size_t i = 0; i < 4; ++i) expect_near(rig.global(names[i]).translation, joints[i], 1e-5);
    const glm::dquat b = rig.global("b").rotation,
                     expected = glm::dquat(state.rotations[1]) * turned(30, {0, 1, 0}).rotation;
    EXPECT_NEAR(std::abs(glm::dot(b, expected)), 1.0, 1e-6) << "the rest twist is kept";
    EXPECT_NEAR(std::get<double>(rig.unit("spline").outputs[0]),
                static_cast<double>(glm::distance(joints[3], points[2])), 1e-5);

    std::get<Spline>(definition.units[0].operation).roll_end_deg = 90.0;
    Held rolled(definition, 0.0);
    expect_near(rolled.global("d").translation, rig.global("d").translation, 1e-5);
    const glm::dquat turn = rolled.global("c").rotation * glm::conjugate(rig.global("c").rotation);
    EXPECT_NEAR(std::abs(turn.w), std::sqrt(0.5), 1e-6);

    definition.units[0].weight = 0.5;
    Held half(definition, 0.0);
    expect_near(half.global("a").translation, {1, 0, 0}, 1e-9);
}

TEST(RigSolve, ASplineFitsItsBonesToTheCurve) {
    Definition definition = spline_rig();
    auto& spline = std::get<Spline>(definition.units[0].operation);
    spline.fit = true;
    Held rig(definition, 0.0);
    const auto output = [&](std::size_t at) { return std::get<double>(rig.unit("spline").outputs[at]); };
    EXPECT_LE(output(0), 1e-5) << "the tip is on the last point";
    const double factor = output(3);
    EXPECT_GT(std::abs(factor - 1.0), 0.05);
    EXPECT_EQ(output(1), 0.0);
    for (const auto& [from, to] : {std::pair("a", "b"), std::pair("b", "c"), std::pair("c", "d")})
        EXPECT_NEAR(glm::distance(rig.global(from).translation, rig.global(to).translation), factor, 1e-5);
    EXPECT_EQ(rig.global("d").scale, glm::dvec3(1.0));
    rig.solve();
    EXPECT_EQ(output(3), factor) << "the bones begin at their own lengths again";

    spline.max_factor = 0.0;  // no fit
    Held loose(definition, 0.0);
    EXPECT_EQ(std::get<double>(loose.unit("spline").outputs[3]), 1.0);
    EXPECT_GT(std::get<double>(loose.unit("spline").outputs[0]), 0.1);
}

TEST(RigSolve, ASplineFollowsItsNewPoints) {
    Definition definition = spline_rig();
    const Rig rig = *Rig::make(definition);
    std::get<Spline>(definition.units[0].operation).points = {"r", "q", "p"};
    Held changed(definition);
    changed.rig = *rig.with_unit(definition.units[0]);
    changed.workspace = Workspace(changed.rig);
    changed.solve();
    expect_near(changed.global("a").translation, {5, 1, 0}, 1e-9);
}

TEST(RigSolve, ASplineReportsTheLengthPastItsCurve) {
    Definition definition = spline_rig();
    std::get<Spline>(definition.units[0].operation).points = {"p", "q"};
    Held rig(definition, 0.0);
    const std::vector<Value>& outputs = rig.unit("spline").outputs;
    EXPECT_EQ(std::get<double>(outputs[1]), 2.0) << "bones";
    EXPECT_NEAR(std::get<double>(outputs[2]), 1.5, 1e-5) << "metres";
    EXPECT_NEAR(std::get<double>(outputs[0]), 1.5, 1e-5);
}

// A roll of 2e8 degrees is out of range; a bone of no length is valid.
TEST(RigSolve, AnUnsolvableSplineWarnsAndLeavesItsBones) {
    Definition definition = spline_rig();
    std::get<Spline>(definition.units[0].operation).roll_end_deg = 2e8;
    Held rig(definition, 0.0);
    EXPECT_EQ(rig.unit("spline").warning, Warning::CannotSolve);
    EXPECT_EQ(rig.global("b").translation, glm::dvec3(0, 1, 0));
    std::get<Spline>(definition.units[0].operation).roll_end_deg = 0.0;
    definition.elements[2].initial.translation = glm::dvec3(0.0);
    Held pointed(definition, 0.0);
    EXPECT_EQ(pointed.unit("spline").warning, Warning::None);
    EXPECT_NEAR(glm::distance(pointed.global("c").translation, pointed.global("d").translation), 1.0, 1e-9);
}

TEST(RigSolve, ASplineNeedsTwoExistingPoints) {
    Definition definition = spline_rig();
    auto& spline = std::get<Spline>(definition.units[0].operation);
    spline.points = {"p"};
    EXPECT_TRUE(test::says(Rig::make(definition).message(), "spline points at least 2 1"));
    spline.points = {"p", "x"};
    EXPECT_TRUE(test::says(Rig::make(definition).message(), "spline points no element x"));
    spline.points = {"p", "q"};
    spline.max_factor = 101.0;
    EXPECT_TRUE(test::says(Rig::make(definition).message(), "spline max_factor 0 to 100 101"));
}

TEST(RigSolve, AChainOfHalfWeightTurnsHalfWay) {
    Definition definition{.elements = {{.name = "a"},
                                       {.name = "b", .parent = "a", .initial = at(0, 1, 0)},
                                       {.name = "c", .parent = "b", .initial = at(0.1, 1, 0)}}};
    const glm::dvec3 target(1, -0.5, 0.3);
    for (const Operation& operation : {Operation(TwoBone{.root = "a", .tip = "c", .target = target}),
                                       Operation(Fabrik{.root = "a", .tip = "c", .target = target})}) {
        definition.units = {{.name = "reach", .operation = operation}};
        Held whole(definition), none(definition, 0.0);
        definition.units[0].weight = 0.5;
        Held half(definition, 0.0);
        for (const char* bone : {"a", "b"}) {
            const glm::dquat wanted = blend(none.local(bone).rotation, whole.local(bone).rotation, 0.5);
            EXPECT_NEAR(std::abs(glm::dot(half.local(bone).rotation, wanted)), 1.0, 1e-12) << bone;
            EXPECT_LT(std::abs(glm::dot(whole.local(bone).rotation, wanted)), 0.99) << bone;
        }
        EXPECT_EQ(half.local("c").translation, none.local("c").translation);
    }
}

TEST(RigSolve, CurvesAreWrittenAndStartOverInEachSolve) {
    Definition definition = loop_rig(1);
    definition.curves = {{.name = "smile", .value = 0.25}};
    definition.units = {
        {.name = "ease", .operation = EvaluateCurve{.value = value_of("dial"), .curve = {.target_max = 2.0}}},
        {.name = "smile", .operation = SetCurve{.curve = "smile", .value = FromUnit{"ease"}}, .weight = 0.5}};
    Held rig(definition);
    ASSERT_TRUE(rig.control("dial", 0.5));
    for (int i = 0; i < 3; ++i) {
        rig.solve();
        EXPECT_DOUBLE_EQ(rig.state.curves[0], 0.625);
    }
    ASSERT_TRUE(rig.rig.set_curve(rig.state, 0, 0.75));
    rig.solve();
    EXPECT_DOUBLE_EQ(rig.state.curves[0], 0.875);
    EXPECT_FALSE(rig.rig.set_curve(rig.state, 0, std::nan("")));
    EXPECT_FALSE(rig.rig.set_curve(rig.state, 1, 0.0));
}

TEST(RigSolve, SkippedUnitsWarnAndKeepThePose) {
    Definition definition = aim_rig();
    auto& aim = std::get<Aim>(definition.units[0].operation);
    aim.primary.target = FromElement{"head"};
    aim.secondary.reset();
    Held at_item(definition);
    const Transform before = at_item.global("head");
    at_item.solve();
    EXPECT_EQ(at_item.unit("aim").warning, Warning::TargetAtItem);
    EXPECT_EQ(at_item.global("head"), before);
    EXPECT_STRNE(message(Warning::TargetAtItem), "");

    aim.primary.axis = glm::dvec3(0.0);
    Held no_axis(definition, 0.0);
    EXPECT_EQ(no_axis.unit("aim").warning, Warning::ZeroAxis);

    Definition none = fk_rig(1);
    std::get<ParentConstraint>(none.units[0].operation).parents[0].weight = 0.0;
    Held no_weight(none, 0.0);
    EXPECT_EQ(no_weight.unit("follow0").warning, Warning::ZeroWeights);

    Definition heavy = loop_rig(2);
    heavy.elements.back().control->maximum = glm::dvec3(9.0);
    Held out_of_range(heavy);
    ASSERT_TRUE(out_of_range.control("dial", 3.0));
    out_of_range.solve();
    EXPECT_EQ(out_of_range.unit("turn").warning, Warning::WeightOutOfRange);
    ASSERT_TRUE(out_of_range.control("dial", 1.0));
    out_of_range.solve();
    EXPECT_EQ(out_of_range.unit("turn").warning, Warning::None) << "a warning lasts as long as its reason";
}

/// With a single element, the first iteration is also the last.
TEST(RigSolve, AWarningInABodyLastsAsLongAsItsReason) {
    Definition definition{.elements = {{.name = "bone"},
                                       control("dial", ControlKind::Float),
                                       control("on", ControlKind::Bool)}};
    definition.units = {
        {.name = "all",
         .operation = ForEach{.roots = {"bone"},
                              .body = {{.name = "turn",
                                        .operation = OffsetTransform{.item = ThisElement(),
                                                                     .offset = turned(30, {0, 0, 1})},
                                        .weight = value_of("dial")}}},
         .when = value_of("on")}};
    Held rig(definition);
    const auto warning = [&](bool on, double dial) {
        EXPECT_TRUE(rig.control("on", on));
        EXPECT_TRUE(rig.control("dial", dial));
        rig.solve();
        return rig.unit("turn").warning;
    };
    EXPECT_EQ(warning(true, 3.0), Warning::WeightOutOfRange);
    EXPECT_EQ(warning(true, 1.0), Warning::None);
    EXPECT_EQ(warning(true, 3.0), Warning::WeightOutOfRange);
    EXPECT_EQ(warning(false, 3.0), Warning::None) << "a unit that does not run warns of nothing";
}

TEST(RigSolve, GrowthOutOfRangeIsIgnored) {
    Definition definition;
    for (int i = 0; i < 40; ++i)
        definition.elements.push_back(
            {.name = numbered("b", static_cast<int>(i)),
             .parent = i > 0 ? numbered("b", static_cast<int>(i - 1)) : std::string(),
             .initial = at(1, 0, 0)});
    definition.units = {
        {.name = "all",
         .operation =
             ForEach{.roots = {"b0"},
                     .body = {{.name = "grow",
                               .operation = OffsetTransform{
                                   .item = ThisElement(),
                                   .offset = Transform{.translation = {1, 0, 0}, .scale = {10, 10, 10}}}}}}}};
    Held rig(definition, 0.0);
    EXPECT_EQ(rig.unit("grow").warning, Warning::OutOfRange);
    for (int i = 0; i < 40; ++i) {
        const Transform pose = rig.global(numbered("b", static_cast<int>(i)));
        EXPECT_TRUE(std::isfinite(pose.translation.x) && std::isfinite(pose.scale.x));
    }
}

}  // namespace
}  // namespace tendril::rig
