// Several selected elements: by Shift, by a box and in a file.
#include "app/labs/rig/definition_json.hpp"
#include "app/labs/rig/rig_edit.hpp"
#include "rig_support.hpp"
#include "tests/app/support/panel_text.hpp"

namespace tendril::app {
namespace {

using Names = std::vector<std::string>;

class SeveralElements : public RigTest {
  protected:
    Names selected() const { return state().at("selection").get<Names>(); }
    std::string active() const { return state().at("selected").at("element"); }
    void select(const Names& names, bool add = false) {
        run("rig.select", {{"elements", names}, {"add", add}});
    }
    void add(const std::string& name) { run("rig.select", {{"element", name}, {"add", true}}); }
    void set_all(const Names& names, const Json& value) {
        run("rig.control.set", {{"names", names}, {"value", value}});
    }
    Json value(const std::string& name) const { return named("elements", name).at("value"); }
    Json local(const std::string& name) const {
        return named("elements", name).at("local").at("translation");
    }
    std::size_t steps() const { return workspace.history.size(); }

    /// Two positions, two numbers, and a bone with two descendants in a row.
    void controls_and_bones() {
        control("left", "position", {{"maximum", {1, 1, 1}}, {"minimum", {-1, -1, -1}}});
        control("right", "position");
        control("dial", "float", {{"minimum", 0}, {"maximum", 1}});
        control("knob", "float");
        element("a", "", transform(0, 1, 0));
        element("b", "a", transform(0, 2, 0));
        element("c", "b", transform(0, 3, 0));
    }
};

class SeveralSelected : public SeveralElements {};

TEST_F(SeveralSelected, TheSelectedUnitStaysWhenElementsAreAdded) {
    controls_and_bones();
    select({"b", "a", "left"});
    EXPECT_EQ(selected(), (Names{"left", "a", "b"})) << "in the order of the definition";
    EXPECT_EQ(active(), "left");
    run("rig.select");
    EXPECT_EQ(selected(), Names());
    unit({{"unit", "offset_transform"}, {"name", "lift"}, {"item", "a"}});
    run("rig.select", {{"unit", "lift"}});
    add("b");
    add("c");
    EXPECT_EQ(part().selected.unit, "lift");
    EXPECT_FALSE(part().selected.unit_last);
    run("rig.select", {{"unit", "lift"}, {"add", true}});
    EXPECT_EQ(selected(), (Names{"b", "c"}));
    EXPECT_TRUE(part().selected.unit_last) << "selected again, it is what Delete removes";
    run("rig.select", {{"add", true}});
    EXPECT_TRUE(part().selected.unit_last) << "nothing was added";
    add("b");
    EXPECT_FALSE(part().selected.unit_last);
    run("rig.select", {{"unit", ""}, {"add", true}});
    EXPECT_EQ(part().selected.unit, "");
    EXPECT_EQ(selected(), Names{"c"});
}

TEST_F(SeveralSelected, IsRestoredFromAFileAndAnOlderOneIsRead) {
    controls_and_bones();
    select({"c", "left", "b"});
    Json file = saved();
    EXPECT_EQ(file["state"]["selected"]["element"], "b");
    EXPECT_EQ(file["state"]["selected"]["elements"], (Json{"left", "b", "c"}));
    EXPECT_EQ(rig_part(reopened()).selected, part().selected);
    const auto opened = [&](const Json& selection) {
        Json scene = save_scene(workspace);
        scene["labs"]["rig"]["state"]["selected"] = selection;
        Workspace other = make_blank_workspace(labs);
        load_scene(other, scene);
        return rig_part(other).selected_element() + "/" +
               std::to_string(rig_part(other).selected.elements.all().size());
    };
    EXPECT_EQ(opened({{"element", "b"}, {"unit", ""}}), "b/1");
    EXPECT_EQ(opened({{"element", ""}, {"unit", ""}}), "/0");
    EXPECT_EQ(opened({{"element", "nobody"}, {"unit", ""}}), "/0");
    const auto says = [&](const Json& selection, const std::string& what) {
        expect_scene_refused("/state/selected", selection, what);
    };
    says({{"element", "a"}, {"elements", {"b", "c"}}, {"unit", ""}}, "selected.element");
    says({{"element", "b"}, {"elements", {"b", "nobody"}}, {"unit", ""}}, "there is no element \"nobody\"");
    says({{"element", "b"}, {"elements", {"b", 7}}, {"unit", ""}}, "selected.elements");
    says({{"element", "b"}, {"elements", "b"}, {"unit", ""}}, "selected.elements");
    says({{"element", ""}, {"elements", {"b", "c"}}, {"unit", ""}}, "selected.element");
}

TEST_F(SeveralSelected, ABoxSelectsItsContentsBesideTheUnit) {
    controls_and_bones();
    unit({{"unit", "offset_transform"}, {"name", "lift"}, {"item", "a"}});
    run("rig.select", {{"unit", "lift"}});
    EXPECT_TRUE(lab().selects_by_box());
    const std::vector<Handle> all = lab().selectable(workspace, 0);
    ASSERT_EQ(all.size(), 7u);
    const auto box = [&](const Names& names, bool add) {
        std::vector<PickId> picks;
        for (const Handle& each : all)
            if (std::ranges::find(names, each.name) != names.end()) picks.push_back(each.pick);
        Emit emit;
        lab().select(workspace, picks, add, emit);
        for (const Emitted& each : emit.take()) run(each.name.c_str(), *each.arguments);
    };
    box({"a", "dial"}, false);
    EXPECT_EQ(selected(), (Names{"dial", "a"}));
    EXPECT_EQ(part().selected.unit, "lift");
    box({"b"}, true);
    EXPECT_EQ(selected(), (Names{"dial", "a", "b"}));
    box({}, true);
    EXPECT_EQ(selected().size(), 3u);
    EXPECT_EQ(lab().gizmo(workspace)->name, "b") << "of several, on the last one";
    box({"c"}, false);
    EXPECT_EQ(lab().gizmo(workspace)->name, "c");
    box({}, false);
    EXPECT_EQ(selected(), Names());
    EXPECT_EQ(part().selected.unit, "lift");
}

TEST_F(SeveralSelected, AllAreInViewWhereTheSelectionIsFramed) {
    controls_and_bones();
    set("right", {8, 0, 0});
    solve();
    select({"a", "c", "right"});
    const Bounds around = lab().bounds(workspace, true);
    for (const char* name : {"a", "c", "right"})
        EXPECT_LT(glm::distance(around.centre, glm::vec3(translation(name))), around.radius) << name;
}

TEST_F(SeveralSelected, UnitsAreOfferedForAll) {
    controls_and_bones();
    const auto offered = [&](const std::string& kind) {
        for (std::size_t i = 0; i < std::variant_size_v<rig::Operation::Variant>; ++i)
            if (rig::operation_name(i) == kind) return **offered_unit(part(), i).unit;
        return Json();
    };
    select({"right", "c", "a", "b"});
    EXPECT_EQ(offered("for_each").at("roots"), (Json{"right", "a"})) << "b and c are below a";
    Json parents = Json::array();
    for (const char* name : {"right", "a", "c"}) parents.push_back({{"item", name}});
    EXPECT_EQ(offered("parent_constraint").at("item"), "b");
    EXPECT_EQ(offered("parent_constraint").at("parents"), parents);
    EXPECT_EQ(offered("aim").at("primary").at("target"), "right");
    EXPECT_EQ(offered("spring_interpolate").at("target"), "b");
    EXPECT_EQ(offered("transform_location").at("transform"), (Json{{"element", "b"}, {"of", "transform"}}));
    run("rig.unit.add", offered("transform_location"));
    EXPECT_EQ(offered("spring_interpolate").at("target"), (Json{{"unit", "transform_location"}}));
    run("rig.unit.add", offered("spring_interpolate"));
    EXPECT_EQ(offered("aim").at("item"), "b");
    EXPECT_EQ(offered("aim").at("primary").at("target"), (Json{{"unit", "spring_interpolate"}}));
    run("undo"), run("undo");
    run("rig.unit.add", offered("for_each"));
    EXPECT_EQ(offered("aim").at("item"), (Json{{"item", "each"}})) << "a selected for-each gets the new unit";
    run("rig.unit.add", offered("aim"));
    EXPECT_EQ(saved().at("units").at(0).at("body").size(), 1u);
    refuses("rig.unit.add", {{"unit", "aim_math"}, {"into", "aim"}}, "into");
    for (std::size_t i = 0; i < std::variant_size_v<rig::Operation::Variant>; ++i)
        if (const UnitOffer offer = offered_unit(part(), i); offer.unit) run("rig.unit.add", **offer.unit);
    tick(2);
}

/// Of an aim the axis that points at the target, and up stays up; an arm points with its length, and a head
/// with its face.
TEST_F(SeveralSelected, AnAimKeepsAHeadUpright) {
    control("look", "position");
    element("head", "", transform(0, 1, 0));
    set("look", {1, 0.5, 0});
    select({"look", "head"});
    run("rig.unit.add", **offered_unit(part(), 0).unit);
    tick();
    solve();
    EXPECT_GT(glm::dot(rotation("head") * glm::dvec3(0, 0, 1), glm::normalize(glm::dvec3(1, -0.5, 0))),
              0.999);
    EXPECT_GT((rotation("head") * glm::dvec3(0, 1, 0)).y, 0.8);
    run("undo");
    run("rig.element.rename", {{"name", "head"}, {"to", "neck"}});
    for (const auto& [at, axis, upright] : {std::tuple<Json, Json, bool>{{0, 1.2, 2}, {0, 0, 1}, true},
                                            {{-3, 1, 1}, {-1, 0, 0}, true},
                                            {{1, 3, 0}, {0, 1, 0}, false},
                                            {{0, 1, 0}, {0, 1, 0}, false}}) {
        set("look", at);
        solve();
        select({"look", "neck"});
        const Json aim = **offered_unit(part(), 0).unit;
        ASSERT_EQ(aim.at("unit"), "aim");
        for (int i = 0; i < 3; ++i)
            EXPECT_EQ(aim.at("primary").at("axis")[static_cast<std::size_t>(i)],
                      axis[static_cast<std::size_t>(i)])
                << at;
        EXPECT_EQ(aim.contains("secondary"), upright) << at;
        run("rig.unit.add", aim);
        tick();
        solve();
        EXPECT_GT((rotation("neck") * glm::dvec3(0, 1, 0)).y, upright ? 0.9 : 0.5) << at;
        run("undo");
    }
}

TEST_F(SeveralSelected, LimitsAreSetForAllOfAKindAndRemoved) {
    controls_and_bones();
    set("knob", 3);
    const auto limits = [&](const char* name) {
        const rig::Control& it = *part().rig.definition().elements[*part().rig.element(name)].control;
        return std::pair(it.minimum, it.maximum);
    };
    run("rig.control.limits", {{"names", {"dial", "knob"}}, {"maximum", 2}});
    EXPECT_EQ(limits("dial").first->x, 0.0) << "what is omitted stays";
    EXPECT_EQ(limits("dial").second->x, 2.0);
    EXPECT_FALSE(limits("knob").first);
    EXPECT_EQ(value("knob"), 2) << "within its limit";
    run("rig.control.limits", {{"name", "left"}, {"minimum", nullptr}, {"maximum", {2, 1, 1}}});
    EXPECT_FALSE(limits("left").first);
    EXPECT_EQ(limits("left").second->x, 2.0);
    const Json before = state();
    refuses("rig.control.limits", {{"name", "dial"}, {"minimum", 3}}, "minimum");
    refuses("rig.control.limits", {{"name", "dial"}, {"minimum", {0, 1}}}, "minimum");
    refuses("rig.control.limits", {{"name", "a"}, {"minimum", 1}}, "control");
    EXPECT_EQ(state(), before);
}

TEST_F(SeveralSelected, AControlIsFollowedButDoesNotFollow) {
    controls_and_bones();
    const auto constrained = [&](const Names& names) {
        select(names);
        for (std::size_t i = 0; i < std::variant_size_v<rig::Operation::Variant>; ++i)
            if (rig::operation_name(i) == std::string_view("parent_constraint"))
                return **offered_unit(part(), i).unit;
        return Json();
    };
    for (const Names& names : {Names{"b", "right"}, Names{"right", "b"}}) {
        const Json unit = constrained(names);
        EXPECT_EQ(unit.at("item"), "b");
        EXPECT_EQ(unit.at("parents"), Json::array({{{"item", "right"}}}));
    }
    const Json alone = constrained({"right"});
    EXPECT_EQ(alone.at("item"), "a") << "the first bone";
    EXPECT_EQ(alone.at("parents"), Json::array({{{"item", "right"}}}));
    run("rig.unit.add", alone);
    EXPECT_EQ(part().selected.unit, "parent_constraint") << "a new unit is unfolded";
}

TEST_F(SeveralSelected, TheInspectorShowsTheNumberAndWhatIsSetOnWhich) {
    controls_and_bones();
    solve();
    test::PanelReader reader;
    const auto expect = [&](const Names& names, const Names& said) {
        select(names);
        const std::string text = reader.inspector(lab(), workspace);
        for (const std::string& each : said)
            EXPECT_NE(text.find(each), std::string::npos) << each << " is not in:\n" << text;
    };
    expect({"a", "left", "right"}, {"3 elements, right is shown", "position control",
                                    "apply to 2 of them: those that are position controls"});
    expect({"left", "right"}, {"2 elements, right is shown", "Changes apply to all of them."});
    expect({"left", "a", "dial"}, {"3 elements, dial is shown", "apply to this one only"});
    expect({"left", "a", "c"},
           {"3 elements, c is shown", "bone", "those that are bones or nulls", "Read them"});
    select({"left"});
    const std::string one = reader.inspector(lab(), workspace);
    EXPECT_EQ(one.find("Changes apply"), std::string::npos) << one;
    EXPECT_EQ(one.find("is shown"), std::string::npos) << one;
}

// Editing several elements at once: set, reset, moved along a path, removed; in one step, or not at all.

class SeveralSet : public SeveralElements {
  protected:
    /// A rig of these elements alone, from a file.
    void open(const Json& elements) {
        Json scene = save_scene(workspace);
        scene["labs"]["rig"] = {{"elements", elements}, {"curves", Json::array()}, {"units", Json::array()}};
        load_scene(workspace, scene);
    }
};

TEST_F(SeveralSet, AValueIsSetOnAllAndEachKeepsOmittedOnes) {
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

TEST_F(SeveralSet, OneThatHasTheValueIsNotChanged) {
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

TEST_F(SeveralSet, PosesOfBonesAreSetOnAll) {
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

TEST_F(SeveralSet, AParentListedAfterItsChildIsSetBeforeIt) {
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

TEST_F(SeveralSet, OtherNamesAreRefusedAndChangeNothing) {
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
    expect("rig.control.set", {{"names", {"left", "right"}}, {"value", {1, nullptr, "x"}}}, "value");
    expect("rig.element.set", {{"names", {"a", "b"}}, {"transform", {{"rotation", {0, nullptr, 0, 1}}}}},
           "rotation");
    expect("rig.element.set", {{"names", {"a", "b"}}, {"transform", {{"scale", {0, 1, 1}}}}}, "scale");
    expect("rig.motion", {{"names", {"left", "dial"}}, {"path", "circle"}}, "\"dial\" is a float control");
    EXPECT_EQ(selected(), (Names{"left", "right"}));
}

TEST_F(SeveralSet, SeveralFollowPathsAndASetOneStops) {
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

TEST_F(SeveralSet, ATakesMomentStaysTheSameAfterSettingSeveral) {
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

TEST_F(SeveralSet, ReadingComputesAll) {
    controls_and_bones();
    run("rig.read", {{"names", {"a", "b", "c"}}});
    EXPECT_EQ(workspace.ui.toasts.back().text.find("Reading 3 elements: "), 0u);
}

/// One by one this would take minutes and run out of time.
TEST_F(SeveralSet, ThousandsAreSetAtOnce) {
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

// Several elements dragged by one gizmo: each gets a value of its own, in one undo step.

class SeveralValues : public SeveralElements {};

TEST_F(SeveralValues, EachGetsItsOwnInAnyOrder) {
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

TEST_F(SeveralValues, InvalidValuesAreRefusedAndChangeNothing) {
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
    expect_refused("rig.control.set", controls({"left", "right"}, {"x", "y"}), {"values.0"});
}

/// The mouse on the gizmo.
class SeveralDragged : public RigAppTest {
  protected:
    SeveralDragged() {
        run("rig.clear");
        look_from(6);
        add("whole", "transform", -1.0);
        add("place", "position", 0.0, {{"maximum", {9, 0.3, 9}}, {"minimum", {-9, -9, -9}}});
        add("turn", "rotation", 1.0);
        add("dial", "float", -0.5);
        run("rig.element.add", {{"name", "bone"}, {"local", transform(0.5, 0.5, 0)}});
        run("rig.element.add", {{"name", "below"}, {"parent", "bone"}, {"local", transform(0.2, 0.2, 0)}});
    }
    void add(const char* name, const char* kind, double x, const Json& more = Json::object()) {
        Json arguments{{"name", name}, {"kind", "control"}, {"control", kind}, {"local", transform(x, 0, 0)}};
        arguments.update(more);
        run("rig.element.add", arguments);
    }
    void select(const Names& names) { run("rig.select", {{"elements", names}}); }
    glm::dvec3 place(const std::string& name) {
        const Json t = element(name)["global"]["translation"];
        return {t[0].get<double>(), t[1].get<double>(), t[2].get<double>()};
    }
};

const Names all_of_them{"whole", "turn", "dial", "bone", "below", "place"};

TEST_F(SeveralDragged, AllMoveTheSameWayInOneStep) {
    select(all_of_them);
    EXPECT_TRUE(has_handle("place.move_x")) << "it stands on the one selected last";
    EXPECT_FALSE(has_handle("place.scale_x"));
    std::vector<glm::dvec3> before;
    for (const std::string& name : all_of_them) before.push_back(place(name));
    const std::size_t history = steps();
    drag(at("place.move_x"), {{10, 5}, {30, 10}, {50, 15}});
    const glm::dvec3 by = place("place") - before.back();
    EXPECT_GT(by.x, 0.1);
    EXPECT_NEAR(by.y, 0.0, 1e-6);
    for (std::size_t i = 0; i < all_of_them.size(); ++i) {
        const bool stays = all_of_them[i] == "turn" || all_of_them[i] == "dial";
        EXPECT_NEAR(glm::distance(place(all_of_them[i]), before[i] + (stays ? glm::dvec3(0) : by)), 0.0, 1e-5)
            << all_of_them[i];
    }
    EXPECT_EQ(element("dial")["value"], 0.0);
    EXPECT_EQ(steps(), history + 1);
    run("undo");
    for (std::size_t i = 0; i < all_of_them.size(); ++i)
        EXPECT_NEAR(glm::distance(place(all_of_them[i]), before[i]), 0.0, 1e-9) << all_of_them[i];
}

TEST_F(SeveralDragged, ElementsRemovedDuringADragAreSkipped) {
    select({"whole", "place"});
    drag(at("place.move_x"), {{20, 5}}, false);
    const double x = place("whole").x;
    run("rig.element.remove", {{"name", "place"}});
    for (const char* name : {"dial", "turn", "below", "bone"}) run("rig.element.remove", {{"name", name}});
    for (int i = 0; i < 3; ++i) send(MouseMove{{600.0f + 10.0f * static_cast<float>(i), 300.0f}});
    press(false);
    EXPECT_EQ(app_.state().at("elements").size(), 1u);
    EXPECT_TRUE(std::isfinite(place("whole").x)) << x;
}

TEST_F(SeveralDragged, StationaryElementsAreReported) {
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

TEST_F(SeveralDragged, OneStoppedByItsLimitIsInPlaceWhenAllReturn) {
    select({"whole", "bone", "place"});
    const glm::dvec3 whole = place("whole"), origin = place("place");
    drag(at("place.move_y"), {{0, -30}, {0, -100}}, false);
    EXPECT_NEAR(place("place").y, 0.3, 1e-9);
    EXPECT_GT(place("whole").y, 0.4);
    const glm::dvec3 there = place("whole");
    wait(5);
    EXPECT_EQ(place("whole"), there) << "while the hand is still, so are they";
    send(MouseMove{at("place") + glm::vec2(0, 0)});
    send(KeyTap{*chord_from_name("escape")});
    EXPECT_NEAR(glm::distance(place("whole"), whole), 0.0, 1e-9);
    EXPECT_NEAR(glm::distance(place("place"), origin), 0.0, 1e-9);
    const glm::vec2 grip = at("place.move_y");
    send(MouseMove{grip});
    press(true);
    for (const float y : {-40.0f, -140.0f, -30.0f, -1.0f, 0.0f}) send(MouseMove{grip + glm::vec2(0, y)});
    press(false);
    EXPECT_NEAR(glm::distance(place("whole"), whole), 0.0, 1e-5);
    EXPECT_NEAR(glm::distance(place("place"), origin), 0.0, 1e-5);
}

TEST_F(SeveralDragged, ARingRotatesAllAboutTheLastSelected) {
    select(all_of_them);
    std::vector<glm::dvec3> before;
    for (const std::string& name : all_of_them) before.push_back(place(name));
    const std::size_t history = steps();
    drag(at("place.rotate_y"), {{12, 0}, {30, 2}, {45, 3}});
    EXPECT_EQ(steps(), history + 1);
    const Json q = element("whole")["value"]["rotation"];
    const glm::dquat turn(q[3].get<double>(), q[0].get<double>(), q[1].get<double>(), q[2].get<double>());
    EXPECT_GT(std::abs(turn.y), 0.05);
    const glm::dvec3 pivot = before.back();
    EXPECT_NEAR(glm::distance(place("place"), pivot), 0.0, 1e-6);
    for (const std::size_t i : {std::size_t{0}, std::size_t{3}, std::size_t{4}})
        EXPECT_NEAR(glm::distance(place(all_of_them[i]), pivot + turn * (before[i] - pivot)), 0.0, 1e-4)
            << all_of_them[i];
    EXPECT_NEAR(glm::distance(place("turn"), before[1]), 0.0, 1e-6) << "it has no place of its own";
    const Json turned = element("turn")["value"];
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(turned[i].get<double>(), q[i].get<double>(), 1e-5);
}

}  // namespace
}  // namespace tendril::app
