// Every kind of control under the mouse, in the running program: real events, with picking.
#include <glm/trigonometric.hpp>

#include "app/document/refused.hpp"
#include "rig_support.hpp"

namespace tendril::test {
namespace {

using namespace app;

class RigMouse : public RigAppTest {
  protected:
    /// A single control, seen at an angle.
    void one(const char* kind, const Json& more = Json::object()) {
        run("rig.clear");
        Json arguments{{"name", "it"}, {"kind", "control"}, {"control", kind}};
        arguments.update(more);
        run("rig.element.add", arguments);
        look_from(5);
    }
    void select(const char* name = "it") { run("rig.select", {{"element", name}}); }
    Json value(const std::string& name = "it") { return element(name).at("value"); }
    Json selected() { return app_.state().at("selected").at("element"); }
};

double number(const Json& list, std::size_t i) {
    return list.at(i).get<double>();
}

TEST_F(RigMouse, AFloatIsDraggedAlongItsRailAndStopsAtItsEnds) {
    one("float", {{"minimum", -1}, {"maximum", 3}});
    drag(at("it"), {{10.0f, 0.0f}, {40.0f, 0.0f}});
    const double inside = value().get<double>();
    EXPECT_GT(inside, 0.1);
    EXPECT_LT(inside, 3.0);
    drag(at("it"), {{100.0f, 0.0f}, {3000.0f, 0.0f}});
    EXPECT_EQ(value(), 3.0);
    drag(at("it"), {{-100.0f, 0.0f}, {-3000.0f, 0.0f}});
    EXPECT_EQ(value(), -1.0);
}

TEST_F(RigMouse, AFloatWithoutLimitsContinuesBeyondItsRail) {
    one("float");
    drag(at("it"), {{100.0f, 0.0f}, {300.0f, 0.0f}});
    EXPECT_GT(value().get<double>(), 1.5);
}

TEST_F(RigMouse, ATwoDimensionalControlStopsAtItsRectangle) {
    one("vector2d", {{"axes", {"z", "y"}}, {"minimum", {-0.5, -0.25}}, {"maximum", {0.5, 0.75}}});
    drag(at("it"), {{40.0f, -40.0f}, {400.0f, -1500.0f}});
    const Json corner = value();
    EXPECT_EQ(std::abs(number(corner, 0)), 0.5);
    EXPECT_EQ(number(corner, 1), 0.75);
    drag(at("it"), {{0.0f, 40.0f}, {0.0f, 2000.0f}});
    EXPECT_EQ(number(value(), 1), -0.25);
    EXPECT_NEAR(number(value(), 0), number(corner, 0), 1e-4)
        << "straight down in the picture is down its second axis";
}

TEST_F(RigMouse, ABoolIsToggledByAClick) {
    one("bool");
    click(at("it"));
    EXPECT_EQ(value(), true);
    EXPECT_EQ(selected(), "it");
    wait(30);
    click(at("it"));
    EXPECT_EQ(value(), false);
}

TEST_F(RigMouse, APositionIsDraggedFreelyAndByItsArrowsWithinItsBox) {
    one("position", {{"minimum", {-0.5, -0.5, -0.5}}, {"maximum", {0.5, 0.5, 0.5}}});
    drag(at("it"), {{20.0f, 0.0f}, {30.0f, -30.0f}});
    const Json moved = value();
    EXPECT_GT(number(moved, 1), 0.05);
    select();
    drag(at("it.move_x"), {{10.0f, 5.0f}, {40.0f, 10.0f}});
    EXPECT_GT(number(value(), 0), number(moved, 0) + 0.05);
    EXPECT_NEAR(number(value(), 1), number(moved, 1), 1e-6);
    EXPECT_NEAR(number(value(), 2), number(moved, 2), 1e-6);
    const Json before = value();
    drag(at("it.move_zx"), {{10.0f, 10.0f}, {25.0f, 20.0f}});
    EXPECT_NE(value(), before);
    EXPECT_NEAR(number(value(), 1), number(before, 1), 1e-6);
    drag(at("it.move_y"), {{0.0f, -60.0f}, {0.0f, -900.0f}});
    EXPECT_EQ(number(value(), 1), 0.5);
}

TEST_F(RigMouse, ARotationTurnsByItsOwnRingsAndByTheGizmo) {
    one("rotation");
    EXPECT_FALSE(has_handle("it.rotate_y"));
    select();
    const glm::vec2 centre = at("it"), from = at("it.rotate_z") - centre;
    const std::size_t before = steps();
    drag(centre + from, {1.1f * from + glm::vec2(from.y, -from.x) * 0.2f - from,
                         glm::vec2(from.y, -from.x) - from});  // a quarter turn anticlockwise
    const Json turned = value();
    EXPECT_NEAR(number(turned, 0), 0.0, 1e-6);
    EXPECT_NEAR(number(turned, 1), 0.0, 1e-6);
    const double degrees = glm::degrees(2.0 * std::acos(std::abs(number(turned, 3))));
    EXPECT_GT(degrees, 50.0);
    EXPECT_LT(degrees, 130.0);
    EXPECT_EQ(steps(), before + 1) << "one drag, one step";
    run("undo");
    EXPECT_EQ(number(value(), 3), 1.0);
    // The ring that is always visible; its near side moves to the right.
    run("rig.select");
    const float metre = 720.0f / (2.0f * 5.0f * std::tan(0.35f));
    const glm::vec2 ring = centre + glm::vec2(0.0f, 0.14f * metre * std::sin(glm::radians(25.0f)));
    drag(ring, {{10.0f, 0.0f}, {20.0f, 0.0f}});
    EXPECT_NEAR(number(value(), 0), 0.0, 1e-6);
    EXPECT_GT(number(value(), 1), 0.02) << value();
    EXPECT_NEAR(number(value(), 2), 0.0, 1e-6);
}

TEST_F(RigMouse, ATransformIsMovedTurnedAndScaledByItsGizmo) {
    one("transform", {{"minimum", {-0.4, -0.4, -0.4}}, {"maximum", {0.4, 0.4, 0.4}}});
    select();
    const Json rest = value();
    drag(at("it.scale_y"), {{0.0f, -20.0f}, {0.0f, -50.0f}});
    EXPECT_GT(number(value()["scale"], 1), 1.3);
    EXPECT_EQ(number(value()["scale"], 0), 1.0);
    EXPECT_EQ(value()["translation"], rest["translation"]);
    const Json scaled = value();
    drag(at("it.rotate_y"), {{12.0f, 0.0f}, {40.0f, 0.0f}});
    EXPECT_NE(value()["rotation"], scaled["rotation"]);
    EXPECT_EQ(value()["scale"], scaled["scale"]) << "to the bit";
    drag(at("it.move_y"), {{0.0f, -60.0f}, {0.0f, -600.0f}});
    EXPECT_EQ(number(value()["translation"], 1), 0.4);
}

/// Its space moves while a part of its gizmo is held.
class RigMovingSpace : public RigMouse {
  protected:
    RigMovingSpace() {
        run("rig.clear");
        run("rig.element.add", {{"name", "cart"}, {"kind", "control"}});
        run("rig.element.add", {{"name", "it"},
                                {"kind", "control"},
                                {"space", "cart"},
                                {"local", {{"translation", {0, 0.3, 0}}, {"scale", {1, 2, 3}}}}});
        look_from(6);
        run("rig.motion",
            {{"name", "cart"}, {"path", "circle"}, {"radius", 0.5}, {"period", 1}, {"turn", true}});
        select();
        run("time.play");
    }
};

TEST_F(RigMovingSpace, ARingTurnsAndDoesNotMove) {
    const Json rest = value();
    const Json from = element("it")["global"]["translation"];
    drag(at("it.rotate_y"), {{10.0f, 0.0f}, {20.0f, 5.0f}, {30.0f, 5.0f}, {40.0f, 8.0f}, {50.0f, 8.0f}});
    EXPECT_NE(element("it")["global"]["translation"], from) << "its space goes on";
    EXPECT_NE(value()["rotation"], rest["rotation"]);
    EXPECT_EQ(value()["translation"], rest["translation"]) << "to the bit";
    EXPECT_EQ(value()["scale"], rest["scale"]);
}

TEST_F(RigMovingSpace, ABoxScalesItsAxisAndNothingElse) {
    const Json rest = value();
    drag(at("it.scale_y"), {{0.0f, -10.0f}, {0.0f, -20.0f}, {0.0f, -30.0f}, {0.0f, -40.0f}});
    EXPECT_GT(number(value()["scale"], 1), 2.2);
    EXPECT_EQ(number(value()["scale"], 0), 1.0);
    EXPECT_EQ(number(value()["scale"], 2), 3.0);
    EXPECT_EQ(value()["translation"], rest["translation"]);
    EXPECT_EQ(value()["rotation"], rest["rotation"]);
}

/// Perpendicular to the arrow, the pointer has no effect and the control follows its space.
TEST_F(RigMovingSpace, AnArrowMovesAlongItself) {
    const Json rest = value();
    drag(at("it.move_y"), {{0.0f, -10.0f}, {0.0f, -20.0f}, {0.0f, -30.0f}, {0.0f, -40.0f}});
    EXPECT_GT(number(value()["translation"], 1), 0.35);
    EXPECT_NEAR(number(value()["translation"], 0), 0.0, 1e-5);
    EXPECT_NEAR(number(value()["translation"], 2), 0.0, 1e-5);
    EXPECT_EQ(value()["rotation"], rest["rotation"]);
    EXPECT_EQ(value()["scale"], rest["scale"]);
}

/// The grabbed point depends on the eye's position: zooming would move the handle away from the pointer.
TEST_F(RigMouse, TheWheelDoesNothingWhileAGizmoIsHeld) {
    one("transform");
    select();
    const auto distance = [&] { return app_.workspace().camera.distance; };
    const float before = distance();
    const glm::vec2 from = at("it.move_y");
    drag(from, {{0.0f, -10.0f}, {0.0f, -40.0f}}, false);
    const Json moved = value();
    send(MouseWheel{2.0f});
    EXPECT_EQ(distance(), before);
    send(MouseMove{from + glm::vec2(0.0f, -41.0f)});
    send(MouseMove{from + glm::vec2(0.0f, -40.0f)});
    EXPECT_NEAR(number(value()["translation"], 1), number(moved["translation"], 1), 1e-5);
    press(false);
    send(MouseWheel{2.0f});
    EXPECT_LT(distance(), before);
}

TEST_F(RigMouse, ADragInAPauseKeepsTheTake) {
    run("rig.preset", {{"name", "secondary"}});
    run("rig.control.set", {{"name", "head"}, {"value", {{"translation", {0.2, 1, 0}}}}});
    run("time.play");
    wait(60);
    run("time.pause");
    const Json skull = element("skull");
    run("rig.time", {{"tick", 20}});
    const Json earlier = element("skull");
    run("rig.time", {{"tick", 60}});
    EXPECT_EQ(element("skull"), skull);
    drag(at("head"), {{20.0f, 0.0f}, {40.0f, -10.0f}, {60.0f, -20.0f}, {80.0f, -20.0f}});
    const Json moved = element("skull");
    EXPECT_NE(moved["global"], skull["global"]);
    EXPECT_EQ(app_.state()["take"]["began"], 0);
    EXPECT_EQ(app_.state()["take"]["played_to"], 60);
    run("rig.time", {{"tick", 20}});
    EXPECT_EQ(element("skull"), earlier);
    run("rig.time", {{"tick", 60}});
    EXPECT_EQ(element("skull"), moved);
}

TEST_F(RigMouse, EscapeDuringADragRestoresTheOldValue) {
    one("transform");
    select();
    const Json rest = value();
    drag(at("it.rotate_x"), {{0.0f, 15.0f}, {0.0f, 60.0f}}, false);
    EXPECT_NE(value(), rest);
    send(KeyTap{*chord_from_name("escape")});
    EXPECT_EQ(value(), rest);
    send(MouseMove{{600.0f, 400.0f}});
    press(false);
    EXPECT_EQ(value(), rest);
}

TEST_F(RigMouse, ADoubleClickResetsAControl) {
    one("vector2d", {{"local", {{"translation", {0.1, 0.2, 0.3}}}}});
    drag(at("it"), {{20.0f, 0.0f}, {50.0f, -30.0f}});
    EXPECT_NE(value(), (Json{0.0, 0.0}));
    wait(30);
    click(at("it"));
    EXPECT_NE(value(), (Json{0.0, 0.0})) << "one click selects";
    click(at("it"));
    EXPECT_EQ(value(), (Json{0.0, 0.0}));
    EXPECT_THROW(run("rig.control.reset", {{"name", "nobody"}}), Refused);
}

TEST_F(RigMouse, AClickSelectsAndAClickInEmptySpaceDeselects) {
    click(at("nose"));
    EXPECT_EQ(selected(), "nose");
    click({330.0f, 200.0f});
    EXPECT_EQ(selected(), "");
}

TEST_F(RigMouse, ShiftAddsABoxSelectsAndDeleteRemovesAll) {
    one("position");
    run("rig.element.add", {{"name", "bone"}, {"local", {{"translation", {0.8, 0, 0}}}}});
    run("rig.element.add", {{"name", "switch"},
                            {"kind", "control"},
                            {"control", "bool"},
                            {"local", {{"translation", {0, 0.9, 0}}}}});
    const auto selection = [&] { return app_.state().at("selection"); };
    const auto hold = [&](Key key, bool down) { send(KeyChange{key, down}); };
    click(at("bone"));
    hold(Key::Shift, true);
    click(at("switch"));
    EXPECT_EQ(selection(), (Json{"bone", "switch"}));
    EXPECT_EQ(selected(), "switch");
    EXPECT_EQ(value("switch"), false) << "it is selected, not switched";
    click(at("it"));
    click(at("bone"));
    EXPECT_EQ(selection(), (Json{"it", "switch"}));
    click({330.0f, 200.0f});
    EXPECT_EQ(selection(), (Json{"it", "switch"})) << "Shift on nothing adds nothing";
    hold(Key::Shift, false);
    EXPECT_TRUE(has_handle("it.move_x")) << "the last one that a gizmo can drag has it";
    wait(30);
    click(at("it"));
    EXPECT_EQ(selection(), Json::array({"it"})) << "one of several, clicked, is the only one";
    EXPECT_TRUE(has_handle("it.move_x"));
    click({330.0f, 200.0f});
    EXPECT_EQ(selection(), Json::array());
    hold(Key::Ctrl, true);
    const glm::vec2 from = at("it") - glm::vec2(60.0f, -60.0f), to = at("bone") + glm::vec2(60.0f, -60.0f);
    drag(from, {0.5f * (to - from), to - from});
    hold(Key::Ctrl, false);
    EXPECT_EQ(selection(), (Json{"it", "bone"}));
    send(MouseMove{at("it")});
    press(true);
    send(MouseMove{at("it") + glm::vec2(30.0f, 0.0f)});
    send(KeyTap{*chord_from_name("delete")});
    EXPECT_EQ(selection(), (Json{"it", "bone"})) << "not in a drag";
    press(false);
    send(KeyTap{*chord_from_name("delete")});
    EXPECT_TRUE(element("it").is_null());
    EXPECT_TRUE(element("bone").is_null());
    EXPECT_FALSE(element("switch").is_null());
    run("undo");
    EXPECT_EQ(selection(), (Json{"it", "bone"}));
}

TEST_F(RigMouse, ABonesGizmoSetsThePoseThatEverySolveStartsWith) {
    const Json nose = element("nose"), head = element("head");
    select("nose");
    drag(at("nose.move_y"), {{0.0f, -20.0f}, {0.0f, -50.0f}});
    EXPECT_GT(number(element("nose")["local"]["translation"], 1), 0.1);
    EXPECT_EQ(element("head"), head);
    run("rig.solve");
    EXPECT_GT(number(element("nose")["local"]["translation"], 1), 0.1);
    EXPECT_FALSE(has_handle("nose.scale_x"));
}

}  // namespace
}  // namespace tendril::test
