// Several elements dragged by one gizmo: each gets a value of its own, in one undo step.
#include <algorithm>
#include <glm/gtc/quaternion.hpp>
#include <random>

#include "several_support.hpp"
#include "tests/app/e2e/monkey.hpp"
#include "tests/says.hpp"

namespace tendril::app {
namespace {

class SeveralValues : public SeveralElements {};

TEST_F(SeveralValues, EachGetsItsOwnInWhateverOrderTheyStand) {
    controls_and_bones();
    const std::size_t before = steps();
    run("rig.control.set",
        {{"names", {"dial", "right", "left"}}, {"values", {0.25, {4, nullptr, 6}, {0, 5, 0.5}}}});
    EXPECT_EQ(steps(), before + 1);
    EXPECT_EQ(value("dial"), 0.25);
    EXPECT_EQ(value("right"), (Json{4.0, 0.0, 6.0})) << "of more than one kind";
    EXPECT_EQ(value("left"), (Json{0.0, 1.0, 0.5})) << "within its limits";
    for (const bool parent_first : {true, false}) {
        const double z = parent_first ? 1.0 : 2.0;
        const Json a = transform(1, 2, z), b = transform(3, 4, z + 0.5);
        const Json names = parent_first ? Json{"a", "b"} : Json{"b", "a"};
        run("rig.element.set",
            {{"names", names}, {"space", "global"}, {"transforms", parent_first ? Json{a, b} : Json{b, a}}});
        EXPECT_NEAR(glm::distance(translation("a"), {1, 2, z}), 0.0, 1e-9);
        EXPECT_NEAR(glm::distance(translation("b"), {3, 4, z + 0.5}), 0.0, 1e-9);
    }
    run("undo");
    EXPECT_NEAR(translation("b").z, 1.5, 1e-9);
}

TEST_F(SeveralValues, WhatDoesNotFitIsRefusedAndChangesNothing) {
    controls_and_bones();
    const Json at{0, 0, 0};
    const auto controls = [&](const Json& names, const Json& values) {
        return Json{{"names", names}, {"values", values}};
    };
    expect_refused("rig.control.set", controls({"left", "right"}, Json::array({at})),
                   {"values", "2 values, one for each of names"});
    expect_refused("rig.control.set", controls({"left", "left"}, {at, at}), {"names: list each once"});
    expect_refused("rig.control.set", controls({"left", "dial"}, {at, at}), {"values.1"});
    expect_refused("rig.control.set", controls({"left", "a"}, {at, at}), {"\"a\" is not a control"});
    expect_refused("rig.control.set", controls({"left", "nobody"}, {at, at}), {"names: ", "nobody"});
    expect_refused("rig.control.set", {{"name", "left"}, {"values", Json::array({at})}},
                   {"values is for names"});
    expect_refused("rig.control.set", {{"names", {"left", "right"}}, {"value", at}, {"values", {at, at}}},
                   {"needs either value or values"});
    expect_refused("rig.element.set", {{"names", {"a", "b"}}}, {"needs either transform or transforms"});
    expect_refused("rig.element.set", {{"names", {"a", "b"}}, {"transforms", {Json::object(), 3}}},
                   {"transforms.1", "3"});
    for (const Json& bad : {Json(nullptr), Json("all"), Json(7), Json::object(), Json{"x", "y"}})
        EXPECT_FALSE(refused("rig.control.set", controls({"left", "right"}, bad)).empty()) << bad;
}

/// In the running program: the mouse on the gizmo, with picking.
class SeveralDragged : public testing::Test {
  protected:
    SeveralDragged() {
        for (const auto& [name, arguments] :
             std::initializer_list<std::pair<const char*, Json>>{{"lab.open", {{"name", rig_lab}}},
                                                                 {"time.pause", Json::object()},
                                                                 {"rig.clear", Json::object()},
                                                                 {"camera.set",
                                                                  {{"target", {0, 0, 0}},
                                                                   {"yaw_deg", 30},
                                                                   {"pitch_deg", 25},
                                                                   {"distance", 6},
                                                                   {"orthographic", true}}}})
            app_.run({name, arguments});
        add("whole", "transform", -1.0);
        add("place", "position", 0.0, {{"maximum", {9, 0.3, 9}}, {"minimum", {-9, -9, -9}}});
        add("turn", "rotation", 1.0);
        add("dial", "float", -0.5);
        app_.run({"rig.element.add", Json{{"name", "bone"}, {"local", transform(0.5, 0.5, 0)}}});
        app_.run({"rig.element.add",
                  Json{{"name", "below"}, {"parent", "bone"}, {"local", transform(0.2, 0.2, 0)}}});
    }
    void add(const char* name, const char* kind, double x, const Json& more = Json::object()) {
        Json arguments{{"name", name}, {"kind", "control"}, {"control", kind}, {"local", transform(x, 0, 0)}};
        arguments.update(more);
        app_.run({"rig.element.add", arguments});
    }
    void select(const Names& names) { app_.run({"rig.select", Json{{"elements", names}}}); }
    void drag(const std::string& part, const std::vector<glm::vec2>& way, bool drop = true) {
        const glm::vec2 from = test::handle(app_.state(), part);
        send(MouseMove{from});
        send(MousePress{MouseButton::Left, true});
        for (const glm::vec2 by : way) send(MouseMove{from + by});
        if (drop) send(MousePress{MouseButton::Left, false});
    }
    void send(const Event& event) { app_.tick(&event); }
    glm::dvec3 at(const std::string& name) {
        const Json t = element(name)["global"]["translation"];
        return {t[0].get<double>(), t[1].get<double>(), t[2].get<double>()};
    }
    Json element(const std::string& name) {
        const Json state = app_.state();
        for (const Json& each : state.at("elements"))
            if (each.at("name") == name) return each;
        return nullptr;
    }
    bool has_handle(const std::string& name) {
        const Json state = app_.state();
        const Json& all = state.at("handles");
        return std::any_of(all.begin(), all.end(), [&](const Json& each) { return each.at("name") == name; });
    }
    std::size_t steps() { return app_.workspace().history.size(); }

    std::unique_ptr<Window> window_ = open_offscreen({1280, 720});
    App app_{*window_, false};
};

const Names all_of_them{"whole", "turn", "dial", "bone", "below", "place"};

TEST_F(SeveralDragged, AllGoTheSameWayInOneStep) {
    select(all_of_them);
    EXPECT_TRUE(has_handle("place.move_x")) << "it stands on the one selected last";
    EXPECT_FALSE(has_handle("place.scale_x"));
    std::vector<glm::dvec3> before;
    for (const std::string& name : all_of_them) before.push_back(at(name));
    const std::size_t history = steps();
    drag("place.move_x", {{10, 5}, {30, 10}, {50, 15}});
    const glm::dvec3 by = at("place") - before.back();
    EXPECT_GT(by.x, 0.1);
    EXPECT_NEAR(by.y, 0.0, 1e-6);
    for (std::size_t i = 0; i < all_of_them.size(); ++i) {
        const bool stays = all_of_them[i] == "turn" || all_of_them[i] == "dial";
        EXPECT_NEAR(glm::distance(at(all_of_them[i]), before[i] + (stays ? glm::dvec3(0) : by)), 0.0, 1e-5)
            << all_of_them[i];
    }
    EXPECT_EQ(element("dial")["value"], 0.0);
    EXPECT_EQ(steps(), history + 1);
    app_.run({"undo"});
    for (std::size_t i = 0; i < all_of_them.size(); ++i)
        EXPECT_NEAR(glm::distance(at(all_of_them[i]), before[i]), 0.0, 1e-9) << all_of_them[i];
}

/// Undo and removal can happen during a drag.
TEST_F(SeveralDragged, WhatGoesInMidDragIsLeftOut) {
    select({"whole", "place"});
    drag("place.move_x", {{20, 5}}, false);
    const double x = at("whole").x;
    app_.run({"rig.element.remove", Json{{"name", "place"}}});
    for (const char* name : {"dial", "turn", "below", "bone"})
        app_.run({"rig.element.remove", Json{{"name", name}}});
    for (int i = 0; i < 3; ++i) send(MouseMove{{600.0f + 10.0f * static_cast<float>(i), 300.0f}});
    send(MousePress{MouseButton::Left, false});
    EXPECT_EQ(app_.state().at("elements").size(), 1u);
    EXPECT_TRUE(std::isfinite(at("whole").x)) << x;
}

TEST_F(SeveralDragged, WhatStaysIsSaid) {
    select(all_of_them);
    const Lab& lab = *app_.labs().find(rig_lab);
    const Together moved = lab.together(app_.workspace(), Drag::Position);
    EXPECT_EQ(moved.handles.size(), 3u) << "what is below the bone goes with it";
    EXPECT_TRUE(test::says(moved.staying, "turn dial"));
    EXPECT_TRUE(test::says(lab.together(app_.workspace(), Drag::Rotation).staying, "dial"));
    select({"place"});
    EXPECT_TRUE(lab.together(app_.workspace(), Drag::Position).handles.empty());
    select({"place", "dial"});
    EXPECT_EQ(lab.gizmo(app_.workspace())->name, "place") << "the last one that it can drag";
    select({"dial"});
    EXPECT_FALSE(lab.gizmo(app_.workspace()));
}

TEST_F(SeveralDragged, OneThatStopsAtItsLimitIsInItsPlaceWhenAllComeBack) {
    select({"whole", "bone", "place"});
    const glm::dvec3 whole = at("whole"), place = at("place");
    drag("place.move_y", {{0, -30}, {0, -100}}, false);
    EXPECT_NEAR(at("place").y, 0.3, 1e-9);
    EXPECT_GT(at("whole").y, 0.4);
    const glm::dvec3 there = at("whole");
    for (int i = 0; i < 5; ++i) app_.tick(nullptr);
    EXPECT_EQ(at("whole"), there) << "while the hand is still, so are they";
    send(MouseMove{test::handle(app_.state(), "place") + glm::vec2(0, 0)});
    send(KeyTap{*chord_from_name("escape")});
    EXPECT_NEAR(glm::distance(at("whole"), whole), 0.0, 1e-9);
    EXPECT_NEAR(glm::distance(at("place"), place), 0.0, 1e-9);
    const glm::vec2 grip = test::handle(app_.state(), "place.move_y");
    send(MouseMove{grip});
    send(MousePress{MouseButton::Left, true});
    for (const float y : {-40.0f, -140.0f, -30.0f, -1.0f, 0.0f}) send(MouseMove{grip + glm::vec2(0, y)});
    send(MousePress{MouseButton::Left, false});
    EXPECT_NEAR(glm::distance(at("whole"), whole), 0.0, 1e-5);
    EXPECT_NEAR(glm::distance(at("place"), place), 0.0, 1e-5);
}

TEST_F(SeveralDragged, ARingTurnsAllAboutTheOneSelectedLast) {
    select(all_of_them);
    std::vector<glm::dvec3> before;
    for (const std::string& name : all_of_them) before.push_back(at(name));
    const std::size_t history = steps();
    drag("place.rotate_y", {{12, 0}, {30, 2}, {45, 3}});
    EXPECT_EQ(steps(), history + 1);
    const Json q = element("whole")["value"]["rotation"];
    const glm::dquat turn(q[3].get<double>(), q[0].get<double>(), q[1].get<double>(), q[2].get<double>());
    EXPECT_GT(std::abs(turn.y), 0.05);
    const glm::dvec3 pivot = before.back();
    EXPECT_NEAR(glm::distance(at("place"), pivot), 0.0, 1e-6);
    for (const std::size_t i : {std::size_t{0}, std::size_t{3}, std::size_t{4}})
        EXPECT_NEAR(glm::distance(at(all_of_them[i]), pivot + turn * (before[i] - pivot)), 0.0, 1e-4)
            << all_of_them[i];
    EXPECT_NEAR(glm::distance(at("turn"), before[1]), 0.0, 1e-6) << "it has no place of its own";
    const Json turned = element("turn")["value"];
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(turned[i].get<double>(), q[i].get<double>(), 1e-5);
}

}  // namespace
}  // namespace tendril::app
