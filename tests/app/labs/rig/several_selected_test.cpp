// Several selected elements: by Shift, by a box, in a file, and as elements are added and removed.
#include <algorithm>
#include <random>
#include <set>

#include "app/labs/rig/rig_edit.hpp"
#include "several_support.hpp"
#include "tests/app/support/panel_text.hpp"

namespace tendril::app {
namespace {

class SeveralSelected : public SeveralElements {};

TEST_F(SeveralSelected, ShiftAddsAndTakesOutAndTheLastOneIsActive) {
    controls_and_bones();
    run("rig.select", {{"element", "b"}});
    add("left");
    EXPECT_EQ(selected(), (Names{"left", "b"})) << "in the order of the definition";
    EXPECT_EQ(active(), "left");
    add("left");
    EXPECT_EQ(selected(), Names{"b"});
    EXPECT_EQ(active(), "b");
    select({"c", "a"}, true);
    EXPECT_EQ(selected(), (Names{"a", "b", "c"}));
    EXPECT_EQ(active(), "a");
    add("c");
    EXPECT_EQ(active(), "a") << "another that goes leaves it";
    select({"dial"});
    EXPECT_EQ(selected(), Names{"dial"});
    run("rig.select");
    EXPECT_EQ(selected(), Names());
    select({"a", "b"});
    select({});
    EXPECT_EQ(selected(), Names());
}

TEST_F(SeveralSelected, TheUnitStaysWhereElementsAreAdded) {
    controls_and_bones();
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

/// Compared with a list of names, as elements and the selection change.
TEST_F(SeveralSelected, TheSelectionFollowsWhatComesAndGoes) {
    std::mt19937 random(7);
    std::vector<std::string> there;
    std::set<std::string> wanted;
    std::string last;
    int next = 0;
    for (int step = 0; step < 400; ++step) {
        const std::size_t at = there.empty() ? 0 : random() % there.size();
        switch (there.empty() ? 0 : random() % 4) {
            case 0:
                there.push_back("e" + std::to_string(next++));
                element(there.back().c_str());
                break;
            case 1:
                run("rig.element.remove", {{"name", there[at]}});
                wanted.erase(there[at]);
                if (last == there[at]) last = wanted.empty() ? "" : "?";
                there.erase(there.begin() + static_cast<std::ptrdiff_t>(at));
                break;
            case 2:
                add(there[at]);
                if (wanted.insert(there[at]).second)
                    last = there[at];
                else if (wanted.erase(there[at]); last == there[at])
                    last = wanted.empty() ? "" : "?";
                break;
            default:
                run("undo");
                run("redo");
        }
        if (last == "?") last = active();
        const Names names = selected();
        ASSERT_EQ(std::set(names.begin(), names.end()), wanted) << step;
        ASSERT_EQ(active(), last) << step;
        if (!names.empty()) {
            ASSERT_TRUE(wanted.contains(active())) << step;
        }
        if (step % 10 == 0) {
            ASSERT_EQ(rig_part(reopened()).selected, part().selected) << step;
        }
    }
}

TEST_F(SeveralSelected, ComesBackFromAFileAndAnOlderOneIsRead) {
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
        try {
            opened(selection);
            ADD_FAILURE() << selection << " was accepted";
        } catch (const std::runtime_error& error) {
            EXPECT_NE(std::string(error.what()).find(what), std::string::npos) << error.what();
        }
    };
    says({{"element", "a"}, {"elements", {"b", "c"}}, {"unit", ""}}, "selected.element");
    says({{"element", "b"}, {"elements", {"b", "nobody"}}, {"unit", ""}}, "there is no element \"nobody\"");
    says({{"element", "b"}, {"elements", {"b", 7}}, {"unit", ""}}, "selected.elements");
    says({{"element", "b"}, {"elements", "b"}, {"unit", ""}}, "selected.elements");
    says({{"element", ""}, {"elements", {"b", "c"}}, {"unit", ""}}, "selected.element");
}

TEST_F(SeveralSelected, ABoxSelectsWhatIsInItBesideTheUnit) {
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
    for (std::size_t i = 0; i < std::variant_size_v<rig::Operation::Variant>; ++i)
        if (const UnitOffer offer = offered_unit(part(), i); offer.unit) run("rig.unit.add", **offer.unit);
    tick(2);
}

TEST_F(SeveralSelected, AControlIsFollowedAndDoesNotFollow) {
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

TEST_F(SeveralSelected, TheInspectorSaysHowManyAndWhatIsSetOnWhich) {
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

}  // namespace
}  // namespace tendril::app
