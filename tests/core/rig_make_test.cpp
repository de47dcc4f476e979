// What Rig::make refuses, and how it says so.
#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "rig_rigs.hpp"

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
    EXPECT_EQ(refusal({.elements = {{.name = "a"}, {.name = "a"}}}),
              "element \"a\": another has this name already");
    EXPECT_EQ(refusal({.elements = {{.name = ""}}}), "elements[0]: its name is empty");
    EXPECT_EQ(refusal({.elements = {{.name = "a", .parent = "b"}}}),
              "element \"a\": there is no element \"b\" for its parent");
    EXPECT_EQ(refusal({.elements = {{.name = "a", .parent = "a"}}}),
              "element \"a\": its parent \"a\" is itself below it");
    const std::string cycle = refusal(
        {.elements = {
             {.name = "a", .parent = "c"}, {.name = "b", .parent = "a"}, {.name = "c", .parent = "b"}}});
    EXPECT_NE(cycle.find("is itself below it"), std::string::npos) << cycle;
    EXPECT_EQ(refusal({.elements = {{.name = "a", .initial = {.scale = {1, 0, 1}}}}}).substr(0, 12),
              "element \"a\":");
    EXPECT_EQ(refusal({.elements = {{.name = "a", .initial = at(std::nan(""), 0, 0)}}}).substr(0, 12),
              "element \"a\":");
    EXPECT_EQ(refusal({.elements = {{.name = "a", .control = Control{}}}}),
              "element \"a\": only a control can have a control's settings");
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
    EXPECT_EQ(control({.kind = ControlKind::Vector2d, .axes = {1, 1}}),
              "element \"a\": control.axes must be two different ones");
    EXPECT_EQ(control({.kind = ControlKind::Float, .minimum = glm::dvec3(1.0), .maximum = glm::dvec3(0.0)}),
              "element \"a\": control.minimum must be at most the maximum, got 1");
    EXPECT_NE(control({.minimum = glm::dvec3(std::numeric_limits<double>::infinity(), 0, 0)}), "");
}

TEST(RigMake, RefusesInputsThatNameWhatIsNotThere) {
    EXPECT_EQ(refusal(with(SetTransform{.item = "nobody"})),
              "unit \"first\": item: there is no element \"nobody\"");
    EXPECT_EQ(refusal(with(Aim{.item = "hand", .primary = {.target = FromElement{"nobody"}}})),
              "unit \"first\": primary.target: there is no element \"nobody\"");
    EXPECT_EQ(refusal(with(EvaluateCurve{.value = FromUnit{"nobody"}})),
              "unit \"first\": value: no unit \"nobody\" runs before this one");
    EXPECT_EQ(refusal(with(EvaluateCurve{.value = FromUnit{"first"}})),
              "unit \"first\": value: no unit \"first\" runs before this one");
    EXPECT_EQ(refusal(with(SetCurve{.curve = "frown"})),
              "unit \"first\": curve: there is no curve \"frown\"");
    EXPECT_EQ(refusal(with(ForEach{.roots = {"root", "nobody"}})),
              "unit \"first\": roots: there is no element \"nobody\"");
    EXPECT_EQ(refusal(with(EvaluateCurve{.value = FromElement{.element = "hand", .of = Of::ControlValue}})),
              "unit \"first\": value: \"hand\" is no control and has no value");
    EXPECT_EQ(refusal(with(ParentConstraint{.item = "hand"})),
              "unit \"first\": parents must have at least one");
    EXPECT_EQ(refusal(with(ForEach{})), "unit \"first\": roots must have at least one");
}

TEST(RigMake, RefusesSpringsOutOfTheirRange) {
    EXPECT_EQ(refusal(with(SpringInterpolate{.strength = -1.0})),
              "unit \"first\": strength must be 0 to 1e4 Hz, got -1");
    EXPECT_EQ(refusal(with(SpringInterpolate{.critical_damping = 1001.0})),
              "unit \"first\": critical_damping must be 0 to 1000, got 1001");
    EXPECT_EQ(refusal(with(SpringInterpolate{.target_velocity_amount = 2.0})),
              "unit \"first\": target_velocity_amount must be 0 to 1, got 2");
}

TEST(RigMake, RefusesInputsOfTheWrongType) {
    EXPECT_EQ(refusal(with(EvaluateCurve{.value = FromElement{"hand"}})),
              "unit \"first\": value takes a number, got a vector");
    EXPECT_EQ(refusal(with(
                  SetRotation{.item = "hand", .rotation = FromElement{.element = "hand", .of = Of::Scale}})),
              "unit \"first\": rotation takes a rotation, got a vector");
    EXPECT_EQ(refusal(with(SpringInterpolate{.target = Value(true)})),
              "unit \"first\": target takes a number, a vector or a rotation, got a bool");
    EXPECT_EQ(
        refusal(with(SpringInterpolate{.target = Value(glm::dvec3(0)), .force = Input<Value>(Value(1.0))})),
        "unit \"first\": force takes a vector here, got a number");
    Definition chained = with(FromTwoVectors{});
    chained.units.push_back({.name = "second", .operation = EvaluateCurve{.value = FromUnit{"first"}}});
    EXPECT_EQ(refusal(chained), "unit \"second\": value takes a number, got a rotation");
    chained.units[1].operation = SetRotation{.item = "hand", .rotation = FromUnit{"first", "speed"}};
    EXPECT_EQ(refusal(chained), "unit \"second\": rotation: unit \"first\" has no output \"speed\"");
}

TEST(RigMake, GivesATransformWhereAVectorOrARotationIsTaken) {
    Definition rig = with(AimMath{.transform = at(1, 2, 3)});
    rig.units.push_back({.name = "at", .operation = TransformLocation{.location = FromUnit{"first"}}});
    rig.units.push_back(
        {.name = "turn", .operation = SetRotation{.item = "hand", .rotation = FromUnit{"first"}}});
    EXPECT_EQ(refusal(rig), "");
}

TEST(RigMake, RefusesWhatOnlyAForEachKnowsOutsideOfOne) {
    EXPECT_EQ(refusal(with(SetTransform{.item = ThisElement()})),
              "unit \"first\": item: {\"item\": \"each\"} is only known inside a for-each");
    EXPECT_EQ(refusal(with(EvaluateCurve{.value = Each::Ratio})),
              "unit \"first\": value: {\"each\": ...} is only known inside a for-each");
    EXPECT_EQ(refusal(with(ForEach{.roots = {"root"},
                                   .body = {{.name = "inner", .operation = ForEach{.roots = {"root"}}}}})),
              "unit \"inner\": body: a for-each cannot stand in the body of another");
    Definition outside =
        with(ForEach{.roots = {"root"}, .body = {{.name = "inner", .operation = FromTwoVectors{}}}});
    outside.units.push_back(
        {.name = "late", .operation = SetRotation{.item = "hand", .rotation = FromUnit{"inner"}}});
    EXPECT_EQ(refusal(outside),
              "unit \"late\": rotation: unit \"inner\" runs inside a for-each, once an element");
}

TEST(RigMake, RefusesNumbersOutOfTheirRange) {
    Definition heavy = with(SetTransform{.item = "hand"});
    heavy.units[0].weight = 1.5;
    EXPECT_EQ(refusal(heavy), "unit \"first\": weight must be 0 to 1, got 1.5");
    heavy.units[0].weight = std::nan("");
    EXPECT_EQ(refusal(heavy), "unit \"first\": weight must be 0 to 1, got nan");
    EXPECT_EQ(refusal(with(Aim{.item = "hand", .primary = {.weight = -1.0}})),
              "unit \"first\": primary.weight must be 0 to 1, got -1");
    EXPECT_EQ(refusal(with(ParentConstraint{.item = "hand", .parents = {{.item = "root", .weight = -1.0}}})),
              "unit \"first\": parents[0].weight must not be negative, got -1");
    EXPECT_NE(refusal(with(OffsetTransform{.item = "hand", .offset = Transform{.scale = {0, 1, 1}}})), "");
    EXPECT_NE(refusal(with(SetTransform{.item = "hand", .transform = at(1e10, 0, 0)})), "");
    EXPECT_NE(refusal(with(EvaluateCurve{.curve = {.keys = {{.time = 1}, {.time = 1}}}})), "");
}

TEST(RigMake, RefusesTwoUnitsOfOneName) {
    Definition rig =
        with(ForEach{.roots = {"root"}, .body = {{.name = "first", .operation = FromTwoVectors{}}}});
    EXPECT_EQ(refusal(rig), "unit \"first\": another unit has this name already");
    rig.units[0].name = "";
    EXPECT_EQ(refusal(rig), "unit \"\": its name is empty");
}

TEST(RigMake, RefusesChainsThatAreNone) {
    EXPECT_EQ(refusal(with(Fabrik{.root = "hand", .tip = "root"})),
              "unit \"first\": tip \"root\" must be below root \"hand\"");
    EXPECT_EQ(refusal(with(TwoBone{.root = "root", .tip = "hand"})),
              "unit \"first\": needs exactly two bones from \"root\" to \"hand\", got 1");
}

}  // namespace
}  // namespace tendril::rig
