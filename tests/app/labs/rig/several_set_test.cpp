// Editing several elements at once: set, reset, moved along a path, removed; in one step, or not at all.
#include "app/labs/rig/definition_json.hpp"
#include "several_support.hpp"
#include "tests/says.hpp"

namespace tendril::app {
namespace {

class SeveralSet : public SeveralElements {
  protected:
    /// A rig of these elements alone, from a file.
    void open(const Json& elements) {
        Json scene = save_scene(workspace);
        scene["labs"]["rig"] = {{"elements", elements}, {"curves", Json::array()}, {"units", Json::array()}};
        load_scene(workspace, scene);
    }
};

TEST_F(SeveralSet, AValueGoesOnAllAndEachKeepsWhatIsNotTold) {
    controls_and_bones();
    set("left", {0.1, 0.2, 0.3});
    set("right", {5, 6, 7});
    const std::size_t before = steps();
    set_all({"right", "left"}, {nullptr, 2.5, nullptr});
    EXPECT_EQ(value("right"), (Json{5.0, 2.5, 7.0}));
    EXPECT_EQ(value("left"), (Json{0.1, 1.0, 0.3})) << "within its limits";
    EXPECT_EQ(steps(), before + 1);
    set_all({"dial", "knob"}, 0.75);
    EXPECT_EQ(value("dial"), 0.75);
    EXPECT_EQ(value("knob"), 0.75);
    run("undo");
    EXPECT_EQ(value("dial"), 0.0);
    EXPECT_EQ(value("knob"), 0.0);
    run("redo");
    run("rig.control.reset", {{"names", {"left", "knob", "dial", "right"}}});
    EXPECT_EQ(value("right"), (Json{0.0, 0.0, 0.0}));
    EXPECT_EQ(value("knob"), 0.0);
    run("undo");
    EXPECT_EQ(value("knob"), 0.75) << "one step for all";
    EXPECT_EQ(value("left"), (Json{0.1, 1.0, 0.3}));
}

TEST_F(SeveralSet, OneThatHasTheValueIsLeftAlone) {
    controls_and_bones();
    set_all({"dial", "knob"}, 0.5);
    const std::size_t before = steps();
    set_all({"dial", "knob"}, 0.5);
    EXPECT_EQ(steps(), before) << "nothing changes";
    set("right", {5, 6, 7});
    unit({{"unit", "offset_transform"}, {"item", "left"}, {"offset", transform(0, 0.5, 0)}});
    solve();
    const Json moved = local("left");
    EXPECT_NE(moved, (Json{0.0, 0.0, 0.0}));
    set_all({"left", "right"}, {0, 0, 0});
    EXPECT_EQ(local("left"), moved) << "a unit has moved it since";
    EXPECT_EQ(local("right"), (Json{0.0, 0.0, 0.0}));
}

TEST_F(SeveralSet, PosesOfBonesGoOnAll) {
    controls_and_bones();
    run("rig.element.set",
        {{"names", {"c", "a"}}, {"transform", {{"translation", {0.5, nullptr, nullptr}}}}});
    solve();
    EXPECT_EQ(local("a"), (Json{0.5, 1.0, 0.0}));
    EXPECT_EQ(local("b"), (Json{0.0, 2.0, 0.0}));
    EXPECT_EQ(local("c"), (Json{0.5, 3.0, 0.0}));
    // In global space the order does not matter: an element that moves with its parent is set after it.
    for (const Names& names : {Names{"a", "b", "c"}, {"c", "b", "a"}}) {
        run("rig.element.set",
            {{"names", names},
             {"space", "global"},
             {"transform", {{"translation", {names.front() == "a" ? 1 : 2, nullptr, 4}}}}});
        const double x = names.front() == "a" ? 1.0 : 2.0;
        for (const char* name : {"a", "b", "c"}) {
            EXPECT_NEAR(translation(name).x, x, 1e-9) << name;
            EXPECT_NEAR(translation(name).z, 4.0, 1e-9) << name;
        }
    }
    run("undo");
    EXPECT_NEAR(translation("b").x, 1.0, 1e-9);
}

TEST_F(SeveralSet, AParentThatStandsAfterItsChildIsSetBeforeIt) {
    open({{{"name", "b"}, {"kind", "bone"}, {"parent", "a"}, {"local", transform(0, 2, 0)}},
          {{"name", "a"}, {"kind", "bone"}, {"local", transform(0, 1, 0)}}});
    run("rig.element.set",
        {{"names", {"a", "b"}}, {"space", "global"}, {"transform", {{"translation", {1, nullptr, 4}}}}});
    for (const char* name : {"a", "b"}) {
        EXPECT_NEAR(translation(name).x, 1.0, 1e-9) << name;
        EXPECT_NEAR(translation(name).z, 4.0, 1e-9) << name;
    }
}

TEST_F(SeveralSet, ParentsAreRemovedTogetherWithTheirChildren) {
    controls_and_bones();
    select({"a", "b"});
    EXPECT_TRUE(test::says(refused("rig.remove_selected"), "b parent c"));
    select({"c", "a", "left", "b"});
    const std::size_t before = steps();
    run("rig.remove_selected");
    EXPECT_EQ(steps(), before + 1);
    EXPECT_EQ(list("elements").size(), 3u);
    EXPECT_EQ(selected(), Names());
    EXPECT_NE(refused("rig.remove_selected").find("nothing is selected"), std::string::npos);
    run("undo");
    EXPECT_EQ(list("elements").size(), 7u);
    EXPECT_EQ(selected(), (Names{"left", "a", "b", "c"})) << "as it was";
    unit({{"unit", "offset_transform"}, {"name", "lift"}, {"item", "c"}});
    select({"right", "c", "knob"});
    EXPECT_TRUE(test::says(refused("rig.remove_selected"), "unit lift c item"));
    run("rig.element.remove", {{"names", {"right", "knob"}}});
    EXPECT_EQ(selected(), Names{"c"});
}

TEST_F(SeveralSet, WhatIsNoElementIsRefusedAndChangesNothing) {
    controls_and_bones();
    select({"left", "right"});
    const Json none = Json::array({{"a", "nobody"}, {1}, {nullptr}, {{"a"}}, {""}, {true}, {Json::object()}});
    for (const Json& names : none) {
        EXPECT_FALSE(refused("rig.select", {{"elements", names}}).empty()) << names;
        for (const char* command : {"rig.element.set", "rig.element.remove", "rig.control.set",
                                    "rig.control.reset", "rig.motion", "rig.read"}) {
            Json arguments{{"names", names}};
            if (std::string(command) == "rig.element.set") arguments["transform"] = Json::object();
            if (std::string(command) == "rig.control.set") arguments["value"] = 1;
            if (std::string(command) == "rig.motion") arguments["path"] = "circle";
            EXPECT_NE(refused(command, arguments).find("names: "), std::string::npos) << command << names;
        }
    }
    const auto expect = [&](const char* command, const Json& arguments, const char* what) {
        const std::string why = refused(command, arguments);
        EXPECT_NE(why.find(what), std::string::npos) << why;
    };
    expect("rig.select", {{"element", "a"}, {"elements", {"b"}}}, "either element or elements");
    expect("rig.element.remove", {{"names", Json::array()}}, "names: []");
    expect("rig.element.remove", Json::object(), "either name or names");
    expect("rig.control.reset", {{"name", "left"}, {"names", {"right"}}}, "either name or names");
    expect("rig.control.reset", {{"names", {"left", "a"}}}, "\"a\" is not a control");
    expect("rig.control.set", {{"names", {"dial", "left"}}, {"value", 1}},
           "\"left\" is a position control, \"dial\" a float control");
    expect("rig.control.set", {{"names", {"left", "right"}}, {"value", {1, 2}}}, "value");
    expect("rig.control.set", {{"names", {"left", "right"}}, {"value", {1, nullptr, "x"}}}, "value");
    expect("rig.control.set", {{"names", {"dial", "knob"}}, {"value", nullptr}}, "value");
    expect("rig.element.set", {{"names", {"a", "b"}}, {"transform", {{"rotation", {0, nullptr, 0, 1}}}}},
           "rotation");
    expect("rig.element.set", {{"names", {"a", "b"}}, {"transform", {{"scale", {0, 1, 1}}}}}, "scale");
    expect("rig.motion", {{"names", {"left", "dial"}}, {"path", "circle"}}, "\"dial\" is a float control");
    EXPECT_EQ(selected(), (Names{"left", "right"}));
}

TEST_F(SeveralSet, SeveralWalkAndOneThatIsSetWalksNoMore) {
    controls_and_bones();
    set("right", {3, 1, 0});
    run("rig.motion", {{"names", {"left", "right"}}, {"path", "circle"}, {"radius", 0.25}});
    EXPECT_EQ(part().walks.size(), 2u);
    tick(30);
    EXPECT_NEAR(translation("left").x - translation("right").x, -3.0, 1e-6) << "each around its own centre";
    EXPECT_GT(glm::distance(translation("right"), glm::dvec3(3, 1, 0)), 0.01);
    run("rig.motion", {{"names", {"left", "right"}}, {"path", "circle"}, {"radius", 0.5}});
    EXPECT_EQ(part().walks.size(), 2u);
    for (const RigWalk& each : part().walks) EXPECT_FLOAT_EQ(each.motion.radius, 0.5f);
    set_all({"right", "left"}, {nullptr, 0.5, nullptr});
    EXPECT_TRUE(part().walks.empty());
}

TEST_F(SeveralSet, AMomentOfTheTakeIsTheSameAfterSeveralWereSetInIt) {
    for (const int count : {5, 100}) {  // beyond some dozens a new take begins
        run("rig.clear");
        control("round", "position");
        Names names;
        for (int i = 0; i < count; ++i) control(names.emplace_back("c" + std::to_string(i)).c_str(), "float");
        run("rig.motion", {{"name", "round"}, {"path", "circle"}});
        tick(5);
        set_all(names, 0.75);
        EXPECT_EQ(part().take.began, count == 5 ? 0u : 5u);
        tick(5);
        const Json then = list("elements");
        const std::uint64_t end = part().take.now();
        EXPECT_EQ(end, 10u);
        run("rig.time", {{"tick", part().take.began + 2}});
        EXPECT_EQ(value("c0"), count == 5 ? 0.0 : 0.75);
        run("rig.time", {{"tick", end}});
        EXPECT_EQ(list("elements"), then) << count;
    }
}

TEST_F(SeveralSet, ReadingWorksAllOut) {
    controls_and_bones();
    run("rig.read", {{"names", {"a", "b", "c"}}});
    EXPECT_EQ(workspace.ui.toasts.back().text.find("Reading 3 elements: "), 0u);
}

/// One by one this would take minutes and run out of time.
TEST_F(SeveralSet, ThousandsAreDoneAtOnce) {
    Json elements = Json::array();
    for (std::size_t i = 0; i < max_lab_elements; ++i) {
        Json each{{"name", "e" + std::to_string(i)}, {"kind", i % 2 == 0 ? "control" : "bone"}};
        if (i % 2 == 0) each["control"] = "position";
        if (i > 2 && i % 2 != 0) each["parent"] = "e" + std::to_string(i - 2);  // a chain of all bones
        elements.push_back(std::move(each));
    }
    open(elements);
    std::vector<PickId> picks;
    for (const Handle& each : lab().selectable(workspace, 0)) picks.push_back(each.pick);
    ASSERT_EQ(picks.size(), max_lab_elements);
    Emit emit;
    lab().select(workspace, picks, false, emit);
    for (const Emitted& each : emit.take()) run(each.name.c_str(), *each.arguments);
    Names controls, bones;
    for (std::size_t i = 0; i < max_lab_elements; ++i)
        (i % 2 == 0 ? controls : bones).push_back("e" + std::to_string(i));
    for (int drag = 1; drag <= 10; ++drag) {
        set_all(controls, {0.1 * drag, nullptr, nullptr});
        tick();
    }
    EXPECT_EQ(value("e4998")[0], 1.0);
    run("rig.element.set", {{"names", bones}, {"transform", {{"translation", {nullptr, 0.01, nullptr}}}}});
    run("rig.element.set",
        {{"names", bones}, {"space", "global"}, {"transform", {{"translation", {nullptr, nullptr, 1}}}}});
    solve();
    EXPECT_NEAR(translation("e4999").z, 1.0, 1e-6);
    EXPECT_NEAR(translation("e4999").y, 25.0, 1e-3);
    run("rig.motion", {{"names", controls}, {"path", "circle"}});
    run("rig.motion", {{"names", controls}, {"path", "circle"}, {"radius", 0.25}});
    tick(3);
    run("rig.control.reset", {{"names", controls}});
    EXPECT_TRUE(part().walks.empty());
    run("rig.remove_selected");
    EXPECT_TRUE(part().rig.definition().elements.empty());
    run("undo");
    EXPECT_EQ(part().selected.elements.all().size(), max_lab_elements);
}

}  // namespace
}  // namespace tendril::app
