// What Rig::make refuses, and its messages.
#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "rig_rigs.hpp"
#include "tests/says.hpp"

namespace tendril::rig {
namespace {

std::string refusal(const Definition& definition) {
    const auto rig = Rig::make(definition);
    return rig ? "" : rig.message();
}

/// Two bones, a float and a transform control, and one unit.
Definition with(Operation operation) {
    Definition rig;
    rig.elements = {
        {.name = "root"},
        {.name = "hand", .parent = "root", .initial = at(1, 0, 0)},
        {.name = "dial", .kind = ElementKind::Control, .control = Control{.kind = ControlKind::Float}}};
    rig.curves = {{.name = "smile"}};
    rig.units = {{.name = "first", .operation = std::move(operation)}};
    return rig;
}

TEST(RigMake, TakesTheSmallRigs) {
    EXPECT_EQ(refusal(aim_rig()), "");
    EXPECT_EQ(refusal(fk_rig()), "");
    EXPECT_EQ(refusal(loop_rig()), "");
    EXPECT_EQ(refusal({}), "");
}

TEST(RigMake, RefusesElementsThatMakeNoTree) {
    EXPECT_TRUE(test::says(refusal({.elements = {{.name = "a"}, {.name = "a"}}}), "element a another name"));
    EXPECT_TRUE(test::says(refusal({.elements = {{.name = ""}}}), "elements[0] name empty"));
    EXPECT_TRUE(test::says(refusal({.elements = {{.name = "a", .parent = "b"}}}), "element a b parent"));
    EXPECT_TRUE(
        test::says(refusal({.elements = {{.name = "a", .parent = "a"}}}), "element a parent a below"));
    const std::string cycle = refusal(
        {.elements = {
             {.name = "a", .parent = "c"}, {.name = "b", .parent = "a"}, {.name = "c", .parent = "b"}}});
    EXPECT_NE(cycle.find("is itself below it"), std::string::npos) << cycle;
    EXPECT_EQ(refusal({.elements = {{.name = "a", .initial = {.scale = {1, 0, 1}}}}}).substr(0, 12),
              "element \"a\":");
    EXPECT_EQ(refusal({.elements = {{.name = "a", .initial = at(std::nan(""), 0, 0)}}}).substr(0, 12),
              "element \"a\":");
    EXPECT_TRUE(test::says(refusal({.elements = {{.name = "a", .control = Control{}}}}),
                           "element a control settings"));
}

TEST(RigMake, TakesParentsAfterTheirChildren) {
    Held rig({.elements = {{.name = "child", .parent = "parent", .initial = at(1, 0, 0)},
                           {.name = "parent", .initial = at(0, 1, 0)}}});
    EXPECT_EQ(rig.global("child").translation, glm::dvec3(1, 1, 0));
}

TEST(RigMake, RefusesControlsOutOfOrder) {
    const auto control = [](Control settings) {
        return refusal(
            {.elements = {{.name = "a", .kind = ElementKind::Control, .control = std::move(settings)}}});
    };
    EXPECT_TRUE(test::says(control({.kind = ControlKind::Vector2d, .axes = {1, 1}}),
                           "element a control.axes different"));
    EXPECT_TRUE(test::says(
        control({.kind = ControlKind::Float, .minimum = glm::dvec3(1.0), .maximum = glm::dvec3(0.0)}),
        "element a control.minimum maximum 1"));
    EXPECT_NE(control({.minimum = glm::dvec3(std::numeric_limits<double>::infinity(), 0, 0)}), "");
}

TEST(RigMake, RefusesInputsThatNameWhatIsNotThere) {
    EXPECT_TRUE(test::says(refusal(with(SetTransform{.item = "nobody"})), "unit first item nobody"));
    EXPECT_TRUE(test::says(refusal(with(Aim{.item = "hand", .primary = {.target = FromElement{"nobody"}}})),
                           "unit first primary.target nobody"));
    EXPECT_TRUE(test::says(refusal(with(EvaluateCurve{.value = FromUnit{"nobody"}})),
                           "unit first value unit nobody"));
    EXPECT_TRUE(
        test::says(refusal(with(EvaluateCurve{.value = FromUnit{"first"}})), "unit first value unit first"));
    EXPECT_TRUE(test::says(refusal(with(SetCurve{.curve = "frown"})), "unit first curve frown"));
    EXPECT_TRUE(test::says(refusal(with(ForEach{.roots = {"root", "nobody"}})), "unit first roots nobody"));
    EXPECT_TRUE(test::says(
        refusal(with(EvaluateCurve{.value = FromElement{.element = "hand", .of = Of::ControlValue}})),
        "unit first value hand not control"));
    EXPECT_TRUE(test::says(refusal(with(ParentConstraint{.item = "hand"})), "unit first parents empty"));
    EXPECT_TRUE(test::says(refusal(with(ForEach{})), "unit first roots empty"));
}

TEST(RigMake, RefusesSpringsOutOfTheirRange) {
    EXPECT_TRUE(
        test::says(refusal(with(SpringInterpolate{.strength = -1.0})), "unit first strength 0 1e4 Hz -1"));
    EXPECT_TRUE(test::says(refusal(with(SpringInterpolate{.critical_damping = 1001.0})),
                           "unit first critical_damping 0 1000 1001"));
    EXPECT_TRUE(test::says(refusal(with(SpringInterpolate{.target_velocity_amount = 2.0})),
                           "unit first target_velocity_amount 0 1 2"));
}

TEST(RigMake, RefusesInputsOfTheWrongType) {
    EXPECT_TRUE(test::says(refusal(with(EvaluateCurve{.value = FromElement{"hand"}})),
                           "unit first value number vector"));
    EXPECT_TRUE(test::says(refusal(with(SetRotation{
                               .item = "hand", .rotation = FromElement{.element = "hand", .of = Of::Scale}})),
                           "unit first rotation rotation vector"));
    EXPECT_TRUE(test::says(refusal(with(SpringInterpolate{.target = Value(true)})),
                           "unit first target number vector rotation bool"));
    EXPECT_TRUE(test::says(
        refusal(with(SpringInterpolate{.target = Value(glm::dvec3(0)), .force = Input<Value>(Value(1.0))})),
        "unit first force vector number"));
    Definition chained = with(FromTwoVectors{});
    chained.units.push_back({.name = "second", .operation = EvaluateCurve{.value = FromUnit{"first"}}});
    EXPECT_TRUE(test::says(refusal(chained), "unit second value number rotation"));
    chained.units[1].operation = SetRotation{.item = "hand", .rotation = FromUnit{"first", "speed"}};
    EXPECT_TRUE(test::says(refusal(chained), "unit second rotation unit first output speed"));
}

TEST(RigMake, GivesATransformWhereAVectorOrARotationIsTaken) {
    Definition rig = with(AimMath{.transform = at(1, 2, 3)});
    rig.units.push_back({.name = "at", .operation = TransformLocation{.location = FromUnit{"first"}}});
    rig.units.push_back(
        {.name = "turn", .operation = SetRotation{.item = "hand", .rotation = FromUnit{"first"}}});
    EXPECT_EQ(refusal(rig), "");
}

TEST(RigMake, RefusesWhatOnlyAForEachKnowsOutsideOfOne) {
    EXPECT_TRUE(
        test::says(refusal(with(SetTransform{.item = ThisElement()})), "unit first item each for-each"));
    EXPECT_TRUE(
        test::says(refusal(with(EvaluateCurve{.value = Each::Ratio})), "unit first value each for-each"));
    EXPECT_TRUE(test::says(
        refusal(with(ForEach{.roots = {"root"},
                             .body = {{.name = "inner", .operation = ForEach{.roots = {"root"}}}}})),
        "unit inner body for-each another"));
    Definition outside =
        with(ForEach{.roots = {"root"}, .body = {{.name = "inner", .operation = FromTwoVectors{}}}});
    outside.units.push_back(
        {.name = "late", .operation = SetRotation{.item = "hand", .rotation = FromUnit{"inner"}}});
    EXPECT_TRUE(test::says(refusal(outside), "unit late rotation unit inner for-each"));
}

TEST(RigMake, RefusesNumbersOutOfTheirRange) {
    Definition heavy = with(SetTransform{.item = "hand"});
    heavy.units[0].weight = 1.5;
    EXPECT_TRUE(test::says(refusal(heavy), "unit first weight 0 1 1.5"));
    heavy.units[0].weight = std::nan("");
    EXPECT_TRUE(test::says(refusal(heavy), "unit first weight 0 1 nan"));
    EXPECT_TRUE(test::says(refusal(with(Aim{.item = "hand", .primary = {.weight = -1.0}})),
                           "unit first primary.weight 0 1 -1"));
    EXPECT_TRUE(test::says(
        refusal(with(ParentConstraint{.item = "hand", .parents = {{.item = "root", .weight = -1.0}}})),
        "unit first parents[0].weight negative -1"));
    EXPECT_NE(refusal(with(OffsetTransform{.item = "hand", .offset = Transform{.scale = {0, 1, 1}}})), "");
    EXPECT_NE(refusal(with(SetTransform{.item = "hand", .transform = at(1e10, 0, 0)})), "");
    EXPECT_NE(refusal(with(EvaluateCurve{.curve = {.keys = {{.time = 1}, {.time = 1}}}})), "");
}

TEST(RigMake, RefusesTwoUnitsOfOneName) {
    Definition rig =
        with(ForEach{.roots = {"root"}, .body = {{.name = "first", .operation = FromTwoVectors{}}}});
    EXPECT_TRUE(test::says(refusal(rig), "unit first another name"));
    rig.units[0].name = "";
    EXPECT_TRUE(test::says(refusal(rig), "unit name empty"));
}

TEST(RigMake, RefusesChainsThatAreNone) {
    EXPECT_TRUE(test::says(refusal(with(Fabrik{.root = "hand", .tip = "root"})),
                           "unit first tip root below root hand"));
    EXPECT_TRUE(
        test::says(refusal(with(TwoBone{.root = "root", .tip = "hand"})), "unit first two root hand 1"));
}

}  // namespace
}  // namespace tendril::rig
