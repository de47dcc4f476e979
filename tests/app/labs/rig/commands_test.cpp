// The Rig lab's commands: their effects, when the lab solves, and --state.
#include <array>
#include <iterator>
#include "app/labs/rig/values.hpp"

#include "app/shell/command_line.hpp"
#include "rig_support.hpp"
#include "tests/app/labs/rig/rig_support.hpp"

namespace tendril::app {
namespace {

class RigCommands : public RigTest {
  protected:
    /// A bone that a dial turns, and a child.
    void build_arm() {
        element("arm");
        element("hand", "arm", transform(1, 0, 0));
        control("dial", "float", {{"minimum", 0}, {"maximum", 1}});
        unit({{"unit", "offset_transform"},
              {"name", "turn"},
              {"item", "arm"},
              {"offset", {{"rotation", {0, 0, std::sqrt(0.5), std::sqrt(0.5)}}}},
              {"weight", "dial"}});
    }
};

TEST_F(RigCommands, TheControlsOfACurveAreRenamedAndRemovedInItsUnit) {
    element("1");
    element("2", "1", transform(0.5, 0, 0));
    for (const auto& [name, x] : {std::pair("p", 0.0), {"q", 1.0}, {"r", 2.5}})
        control(name, "position", {{"local", transform(x, 1, 0)}});
    unit({{"unit", "spline"}, {"name", "tail"}, {"root", "1"}, {"tip", "2"}, {"points", {"p", "q", "r"}}});
    run("rig.element.rename", {{"name", "q"}, {"to", "hump"}});
    EXPECT_EQ(saved().at("units").at(0).at("points"), (Json{"p", "hump", "r"}));
    expect_refused("rig.element.remove", {{"name", "hump"}}, {"unit \"tail\"", "points"});
    run("rig.unit.set", {{"name", "tail"}, {"points", {"p", "r"}}});
    run("rig.element.remove", {{"name", "hump"}});
}

/// Part of an aim, or a filter, is edited like a unit: omitted members stay the same.
TEST_F(RigCommands, SetsMembersOfAPartAndKeepsTheOthers) {
    build_arm();
    control("look", "position");
    unit(R"({"unit": "aim", "name": "aim", "item": "arm", "primary": {"axis": [0, 0, 1], )"
         R"("target": "look", "weight": 0.5}, "secondary": {"axis": [1, 0, 0], "target": [0, 1, 0], )"
         R"("kind": "direction"}})");
    unit(R"({"unit": "parent_constraint", "name": "follow", "item": "hand", )"
         R"("parents": [{"item": "arm"}], "filter": {"translation": [true, false, true], )"
         R"("rotation": [false, false, false]}})");
    const auto now = [&](std::size_t at) { return saved().at("units").at(at); };
    const auto expect_set = [&](std::size_t at, const char* nested, const char* member, const Json& to) {
        Json wanted = now(at);
        EXPECT_NE(wanted.at(nested).at(member), to);
        wanted[nested][member] = to;
        run("rig.unit.set", {{"name", wanted.at("name")}, {nested, {{member, to}}}});
        EXPECT_EQ(now(at), wanted) << nested;
    };
    expect_set(1, "primary", "weight", 0.25);
    expect_set(1, "primary", "axis", {0.0, 1.0, 0.0});
    expect_set(1, "secondary", "kind", "location");
    expect_set(2, "filter", "scale", {false, true, true});
    run("rig.unit.set", {{"name", "aim"}, {"secondary", nullptr}});
    EXPECT_TRUE(now(1).value("secondary", Json()).is_null());
    run("rig.unit.set", {{"name", "aim"}, {"secondary", {{"target", {0, 1, 0}}}}});
    EXPECT_EQ(now(1).at("secondary").at("target"), (Json{0.0, 1.0, 0.0})) << "one that there was not";
    EXPECT_EQ(now(1).at("primary").at("axis"), (Json{0.0, 1.0, 0.0}));
    expect_refused("rig.unit.set", {{"name", "aim"}, {"primary", {{"taget", "look"}}}}, {"taget"});
    expect_refused("rig.unit.set", {{"name", "bend"}}, {"there is no unit \"bend\""});
}

TEST_F(RigCommands, AnInputThatIsSetCopiesNoState) {
    build_arm();
    unit({{"unit", "alpha_interpolate"}, {"name", "late"}, {"value", "dial"}});
    tick();
    const RigPart before = part();
    run("rig.unit.set", {{"name", "late"}, {"bias", 0.5}});
    EXPECT_EQ(&*part().state, &*before.state);
    EXPECT_EQ(&part().rig.definition().units[0], &before.rig.definition().units[0]);
    EXPECT_FALSE(part() == before);
    set("dial", 1);
    EXPECT_NE(&*part().state, &*before.state);
    EXPECT_FALSE(part().state == before.state) << "and the copy keeps its own";
}

TEST_F(RigCommands, StateHasTheDocumentedKeys) {
    build_arm();
    control("square", "vector2d", {{"space", "hand"}});
    run("rig.curve.add", {{"name", "smile"}, {"value", 0.5}});
    const Json now = state();
    EXPECT_EQ(now.at("lab"), "rig");
    const Json hand = named("elements", "hand");
    EXPECT_EQ(hand.at("kind"), "bone");
    EXPECT_EQ(hand.at("parent"), "arm");
    for (const char* space : {"local", "global"})
        for (const char* each : {"translation", "rotation", "scale"})
            EXPECT_TRUE(hand.at(space).contains(each)) << space << ' ' << each;
    EXPECT_FALSE(named("elements", "arm").contains("parent"));
    EXPECT_EQ(named("elements", "square").at("parent"), "hand");
    EXPECT_EQ(named("elements", "square").at("value"), (Json{0.0, 0.0}));
    EXPECT_EQ(now.at("curves"), (Json{{"smile", 0.5}}));
    const Json turn = named("units", "turn");
    EXPECT_EQ(turn.at("unit"), "offset_transform");
    EXPECT_EQ(turn.at("enabled"), true);
    EXPECT_EQ(turn.at("microseconds"), 0.0) << "not measured where it could not be repeated";
    EXPECT_EQ(turn.at("warning"), "");
    EXPECT_TRUE(turn.at("outputs").contains("result"));
}

TEST_F(RigCommands, AControlIsSetWithinItsLimits) {
    build_arm();
    set("dial", 7);
    EXPECT_EQ(named("elements", "dial").at("value"), 1.0);
    control(
        "square", "vector2d",
        {{"axes", {"z", "y"}}, {"local", transform(0, 1, 0)}, {"minimum", {-1, -2}}, {"maximum", {1, 2}}});
    set("square", {5, -0.5});
    EXPECT_EQ(named("elements", "square").at("value"), (Json{1.0, -0.5}));
    expect_near(translation("square"), {0, 0.5, 1});
    control("free", "transform", {{"local", transform(1, 2, 3)}});
    set("free", {{"rotation", {0, 0, 3, 4}}});
    EXPECT_EQ(named("elements", "free").at("value").at("translation"), (Json{1.0, 2.0, 3.0}))
        << "left out: stays";
    EXPECT_NEAR(rotation("free").z, 0.6, 1e-15) << "of unit length";
}

TEST_F(RigCommands, AMirroredBranchIsAMirrorImageNowAndAtRest) {
    const Json turned{{"translation", {0.2, 1, 0.1}}, {"rotation", {0, 0, 0.6, 0.8}}};
    element("arm.L", "", transform(1, 0.5, 0));
    control("left pull", "vector2d",
            {{"space", "arm.L"}, {"local", turned}, {"minimum", {-1, -2}}, {"maximum", {3, 4}}});
    control("DialLeft", "float", {{"space", "left pull"}, {"minimum", 0}, {"maximum", 1}});
    control("L_grip", "transform", {{"space", "left pull"}, {"local", transform(0.3, 0, 0)}});
    control("bright", "position", {{"space", "L_grip"}, {"minimum", {-1, 0, 0}}, {"maximum", {2, 1, 1}}});
    element("LEFT", "bright", turned);
    element("right", "bright");
    element("left", "bright");
    run("rig.element.set", {{"name", "arm.L"}, {"transform", turned}});
    set("left pull", {0.5, 1});
    set("DialLeft", 0.5);
    set("L_grip", turned);
    set("bright", {1.5, 1, 0});
    run("rig.element.mirror", {{"name", "arm.L"}});
    const std::vector<std::array<const char*, 2>> sides{
        {"arm.L", "arm.R"},        {"left pull", "right pull"},   {"DialLeft", "DialRight"},
        {"L_grip", "R_grip"},      {"bright", "bright mirrored"}, {"LEFT", "RIGHT"},
        {"left", "left mirrored"}, {"right", "right mirrored"}};
    const auto expect_mirrored = [&] {
        solve();
        for (const auto& [from, to] : sides) {
            SCOPED_TRACE(from);
            expect_near(translation(to), translation(from) * glm::dvec3(-1, 1, 1));
            const glm::dquat q = rotation(from);
            EXPECT_NEAR(std::abs(glm::dot(rotation(to), glm::dquat(q.w, q.x, -q.y, -q.z))), 1.0, 1e-12);
        }
    };
    expect_mirrored();
    EXPECT_EQ(named("elements", "right pull").at("value"), (Json{-0.5, 1.0}));
    EXPECT_EQ(named("elements", "DialRight").at("value"), 0.5);
    const auto control_of = [&](const char* name) {
        return *part().rig.definition().elements[*part().rig.element(name)].control;
    };
    expect_near(*control_of("right pull").minimum, {-3, -2, 0});
    expect_near(*control_of("bright mirrored").maximum, {1, 1, 1});
    run("rig.control.reset",
        {{"names", {"left pull", "L_grip", "bright", "right pull", "R_grip", "bright mirrored"}}});
    expect_near(translation("L_grip", "local"), {0.3, 0, 0});
    expect_mirrored();
    run("rig.control.limits", {{"name", "bright"}, {"maximum", nullptr}});
    expect_refused("rig.element.mirror", {{"name", "bright"}}, {"bright", "one side only"});
    run("rig.preset", {{"name", "fk"}});
    run("rig.element.mirror", {{"name", "dial"}});
    run("rig.preset", {{"name", "secondary"}});
    run("rig.element.mirror", {{"name", "head"}});
    EXPECT_EQ(part().selected_element(), "head mirrored");
}

TEST_F(RigCommands, AMirroredBranchMovesAsTheMirrorImage) {
    const auto mirrored = [](const rig::Transform& pose) -> rig::Transform {
        const glm::dquat q = pose.rotation;
        return {pose.translation * glm::dvec3(-1, 1, 1), {q.w, q.x, -q.y, -q.z}, pose.scale};
    };
    const rig::Transform rest{{2, 1, 0.5}, glm::angleAxis(1.2, glm::normalize(glm::dvec3(0.2, 1, 0.1)))};
    const std::vector<std::string> bones{"antenna.L", "tip.L", "antenna.R", "tip.R"};
    const auto play = [&](bool other_way) {
        run("rig.clear");
        element("head", "", transform_json(rest));
        element("antenna.L", "head", transform(0.3, 1, 0));
        element("tip.L", "antenna.L", transform(0, 0.4, 0.1));
        for (const Json& each : read_json_file(test::source_path("tests/app/data/antenna_units.json")))
            unit(each);
        const std::size_t steps = workspace.history.size();
        run("rig.element.mirror", {{"name", "antenna.L"}});
        EXPECT_EQ(workspace.history.size(), steps + 1);
        std::vector<rig::Transform> poses;
        for (int i = 0; i < 180; ++i) {
            const double t = i / 60.0;
            rig::Transform step{{0.3 * std::sin(3 * t), 0.1 * t, 0.2 * std::cos(5 * t)},
                                glm::angleAxis(0.5 * std::sin(4 * t), glm::normalize(glm::dvec3(1, 2, -1)))};
            if (other_way) step = mirrored(step);
            const Json head = transform_json(rig::compose(rest, step));
            run("rig.element.set", {{"name", "head"}, {"transform", head}});
            tick();
            for (const std::string& bone : bones) {
                const rig::ElementId id = part().rig.id(*part().rig.element(bone));
                poses.push_back(
                    rig::relative(rest, rig::Hierarchy(part().state->elements).get(id, rig::Space::Global)));
            }
        }
        return poses;
    };
    const std::vector<rig::Transform> one = play(false), other = play(true);
    std::string names;
    for (const std::string& each : part().rig.unit_names()) names += each + ", ";
    EXPECT_EQ(names,
              "place.L, place.R, trail, trail mirrored, aim.L, aim.R, sway, sway mirrored, "
              "bend, twist, turn, bend mirrored, twist mirrored, turn mirrored, lift, up, "
              "reach, reach mirrored, nod, ");
    constexpr double rounding = 1e-12;  // of doubles near 1; a spring forgets, so it does not add up
    for (std::size_t i = 0; i < one.size(); ++i) {
        SCOPED_TRACE(bones[i % 4] + ", tick " + std::to_string(i / 4));
        const rig::Transform expected = mirrored(one[i]), got = other[i % 4 < 2 ? i + 2 : i - 2];
        expect_near(got.translation, expected.translation, rounding);
        ASSERT_NEAR(std::abs(glm::dot(got.rotation, expected.rotation)), 1.0, rounding);
    }
    EXPECT_GT(glm::distance(one[4].translation, one[400].translation), 0.1) << "it moves";
}

TEST_F(RigCommands, ATickSolvesAfterChangesAndThenRests) {
    build_arm();
    tick(3);
    EXPECT_FALSE(lab().moving(workspace));
    set("dial", 1);
    EXPECT_TRUE(lab().moving(workspace));
    expect_near(translation("hand"), {1, 0, 0});
    tick();
    expect_near(translation("hand"), {0, 1, 0});
    EXPECT_FALSE(lab().moving(workspace)) << "nothing here remembers";
    run("rig.element.set", {{"name", "hand"}, {"transform", transform(2, 0, 0)}});
    EXPECT_TRUE(lab().moving(workspace));
    tick();
    expect_near(translation("hand"), {0, 2, 0});
    run("rig.unit.enable", {{"name", "turn"}, {"on", false}});
    EXPECT_TRUE(lab().moving(workspace));
    tick();
    expect_near(translation("hand"), {2, 0, 0});
    EXPECT_EQ(named("units", "turn").at("enabled"), false);
}

TEST_F(RigCommands, CommandsWithoutEffectLeaveNoUndoStep) {
    build_arm();
    control("place", "position");
    set("dial", 0.5);
    set("place", {1, 2, 3});
    tick(5);
    const std::size_t steps = workspace.history.size();
    const Json before = saved();
    set("dial", 0.5);
    set("place", {1, 2, 3});
    run("rig.element.set", {{"name", "hand"}, {"transform", transform(1, 0, 0)}});
    run("rig.unit.enable", {{"name", "turn"}, {"on", true}});
    solve();
    EXPECT_EQ(workspace.history.size(), steps);
    EXPECT_EQ(saved(), before);
    EXPECT_FALSE(lab().moving(workspace));
}

TEST_F(RigCommands, SolvingTakesNoTimeAndIsIdempotent) {
    control("place", "position");
    unit({{"unit", "spring_interpolate"}, {"name", "trail"}, {"target", "place"}});
    tick();
    set("place", {1, 0, 0});
    solve();
    const Json once = saved();
    solve();
    EXPECT_EQ(saved(), once);
    EXPECT_EQ(output("trail"), (Json{0.0, 0.0, 0.0}));
    tick();
    EXPECT_GT(output("trail")[0], 0.0) << "a spring sees what was changed before the solve";
    EXPECT_TRUE(lab().moving(workspace));
}

TEST_F(RigCommands, WithoutPropagationChildrenStayAfterASolveToo) {
    element("parent");
    element("bone", "parent", transform(1, 0, 0));
    control("place", "position", {{"parent", "parent"}});
    run("rig.element.set", {{"name", "parent"}, {"propagate", false}, {"transform", transform(7, -1, 2)}});
    tick();
    expect_near(translation("parent"), {7, -1, 2});
    expect_near(translation("bone"), {1, 0, 0});
    expect_near(translation("place"), {0, 0, 0});
}

TEST_F(RigCommands, CurvesAreWrittenByUnitsAndRestoredBeforeThem) {
    run("rig.curve.add", {{"name", "smile"}, {"value", 0.25}});
    run("rig.curve.add", {{"name", "frown"}});
    unit({{"unit", "set_curve"}, {"name", "set"}, {"curve", "smile"}, {"value", 1}, {"weight", 0.5}});
    solve();
    EXPECT_EQ(state().at("curves"), (Json{{"smile", 0.625}, {"frown", 0.0}}));
    solve();
    EXPECT_EQ(state().at("curves").at("smile"), 0.625);
    run("rig.curve.set", {{"name", "smile"}, {"value", 0}});
    run("rig.curve.set", {{"name", "frown"}, {"value", 0.1}});
    tick();
    EXPECT_EQ(state().at("curves"), (Json{{"smile", 0.5}, {"frown", 0.1}}));
}

TEST_F(RigCommands, WarningsAreInTheState) {
    element("bone");
    control("weight", "float");
    unit({{"unit", "aim"}, {"name", "look"}, {"item", "bone"}, {"primary", {{"target", "bone"}}}});
    unit({{"unit", "from_two_vectors"}, {"name", "arc"}, {"weight", "weight"}});
    set("weight", 2);
    solve();
    EXPECT_TRUE(test::says(named("units", "look").at("warning"), "target item direction"));
    EXPECT_TRUE(test::says(named("units", "arc").at("warning"), "weight 0 1 clamped"));
    run("rig.unit.enable", {{"name", "look"}, {"on", false}});
    set("weight", 1);
    solve();
    for (const Json& each : list("units")) EXPECT_EQ(each.at("warning"), "");
}

TEST_F(RigCommands, BackwardFindsTheControlsAndReportsTheRemainder) {
    build_arm();
    const double angle = 0.7;
    run("rig.element.set", {{"name", "arm"},
                            {"space", "global"},
                            {"transform", {{"rotation", {0, 0, std::sin(angle / 2), std::cos(angle / 2)}}}}});
    solve("backward");
    // The input pose already has the turn, and the unit adds to it.
    EXPECT_NEAR(named("elements", "dial").at("value").get<double>(), 0.0, 1e-6);
    Json backward = state().at("backward");
    EXPECT_LT(backward.at("worst_mm"), 0.1);
    EXPECT_LT(backward.at("worst_degrees"), 0.01);
    EXPECT_TRUE(backward.at("bone").is_string());
    solve();
    EXPECT_EQ(state().at("backward"), backward) << "until something is changed";
    set("dial", 0.5);
    EXPECT_TRUE(state().at("backward").is_null());
}

TEST_F(RigCommands, TheLastSelectedIsRemoved) {
    expect_refused("rig.remove_selected", Json::object(), {"nothing is selected"});
    run("rig.preset", {{"name", "aim"}});
    const auto units = [&] { return list("units").size(); };
    const auto elements = [&] { return list("elements").size(); };
    const std::size_t all_units = units(), all_elements = elements();
    run("rig.element.add", {{"name", "ear"}, {"parent", "head"}});
    run("rig.select", {{"unit", "aim"}});
    run("rig.select", {{"unit", "aim"}, {"element", "ear"}});
    Workspace other = reopened();
    run("rig.remove_selected");
    EXPECT_EQ(elements(), all_elements);
    EXPECT_EQ(units(), all_units);
    EXPECT_EQ(part().selected.unit, "aim") << "it stays selected, and is next";
    run("rig.remove_selected");
    EXPECT_EQ(units(), all_units - 1);
    expect_refused("rig.remove_selected", Json::object(), {"nothing is selected"});
    run("undo");
    run("undo");
    EXPECT_EQ(units(), all_units);
    EXPECT_EQ(elements(), all_elements + 1);
    run("rig.select", {{"element", "ear"}});
    run("rig.select", {{"element", "ear"}, {"unit", "aim"}});
    other = reopened();
    EXPECT_TRUE(rig_part(other).selected.unit_last) << "a file knows it";
    run("rig.remove_selected");
    EXPECT_EQ(units(), all_units - 1);
    EXPECT_EQ(part().selected_element(), "ear");
    run("rig.select", {{"element", "head"}});
    expect_refused("rig.remove_selected", Json::object(), {"head"});
}

// Renaming elements, units and curves: everything that refers to them follows, and no bit of the pose
// changes.

class RigRename : public RigTest {
  protected:
    /// Every element, unit and curve of the rig.
    struct Thing {
        std::string kind, name;
    };
    std::vector<Thing> things() const {
        const rig::Definition& definition = part().rig.definition();
        std::vector<Thing> all;
        for (const rig::Element& each : definition.elements) all.push_back({"element", each.name});
        for (const std::string& each : part().rig.unit_names()) all.push_back({"unit", each});
        for (const rig::NamedCurve& each : definition.curves) all.push_back({"curve", each.name});
        return all;
    }
    void rename(const Thing& thing, const std::string& to) {
        run(("rig." + thing.kind + ".rename").c_str(), {{"name", thing.name}, {"to", to}});
    }
    /// Moves everything that a number can move, so that units with memory move too.
    static void stir(Workspace& in, const CommandTable& commands) {
        const RigPart& rig = rig_part(in);
        for (const rig::Element& each : rig.rig.definition().elements) {
            if (!each.control || each.control->kind != rig::ControlKind::Float) continue;
            commands.run(in, "rig.control.set", {{"name", each.name}, {"value", 0.7}});
        }
    }
    void ticks_in(Workspace& in, int count) const {
        for (int i = 0; i < count; ++i)
            if (lab().moving(in)) lab().step(in);
    }
    std::vector<std::string> preset_names() const {
        return find_argument(*table.find("rig.preset"), "name")->choices;
    }
};

std::string odd_name(std::size_t i) {
    static const char* const odd[] = {
        "\xC3\xA9t\xC3\xA9 ", "\"quoted\" ", "back\\slash ", "{\"item\": \"each\"} ",
        "  spaces  ",         "?/ */ ",      "each ",        "\xE2\x98\x83\xF0\x9F\xA6\xB4 "};
    return odd[i % std::size(odd)] + std::to_string(i);
}

TEST_F(RigRename, RenamingEverythingInEveryPresetKeepsEveryBit) {
    for (const std::string& preset : preset_names()) {
        run("rig.preset", {{"name", preset}});
        stir(workspace, table);
        tick(20);
        Workspace other = workspace;  // keeps the old names
        const std::vector<Thing> before = things();
        ASSERT_FALSE(before.empty()) << preset;
        for (std::size_t i = 0; i < before.size(); ++i) rename(before[i], odd_name(i));
        const std::vector<Thing> after = things();
        ASSERT_EQ(after.size(), before.size());
        for (std::size_t i = 0; i < after.size(); ++i) EXPECT_EQ(after[i].name, odd_name(i)) << preset;
        EXPECT_TRUE(part().state == rig_part(other).state) << preset << ": the names alone move nothing";
        EXPECT_TRUE(part().take == rig_part(other).take) << preset << ": the take goes on";

        Workspace opened = reopened();
        EXPECT_TRUE(rig_part(opened).rig.definition() == part().rig.definition()) << preset;
        for (Workspace* const each : {&workspace, &other, &opened}) {
            stir(*each, table);
            ticks_in(*each, 40);
        }
        EXPECT_TRUE(part().state == rig_part(other).state) << preset;
        EXPECT_TRUE(rig_part(opened).state == rig_part(other).state) << preset << ": saved and opened";

        const std::string code = lab().code(workspace), old = lab().code(other);
        for (const Thing& each : before) {
            if (each.kind != "element") continue;
            const std::string text = '"' + each.name + '"';
            EXPECT_NE(old.find(text), std::string::npos) << preset << " " << text;
            EXPECT_EQ(code.find(text), std::string::npos) << preset << " " << text;
        }
    }
}

TEST_F(RigRename, SelectionWalkAndClipFollow) {
    control("guide", "position");
    element("arm");
    unit({{"unit", "set_transform"}, {"name", "follow"}, {"item", "arm"}});
    run("rig.motion", {{"name", "guide"}, {"path", "circle"}});
    tick(30);
    run("rig.clip.record");
    ASSERT_TRUE(part().clip);
    run("rig.select", {{"element", "guide"}, {"unit", "follow"}});
    run("rig.element.rename", {{"name", "guide"}, {"to", "leader"}});
    run("rig.element.rename", {{"name", "arm"}, {"to", "limb"}});
    run("rig.unit.rename", {{"name", "follow"}, {"to", "goes after"}});
    EXPECT_EQ(part().selected_element(), "leader");
    EXPECT_EQ(part().selected.unit, "goes after");
    ASSERT_EQ(part().walks.size(), 1u);
    EXPECT_EQ(part().walks[0].control, "leader");
    EXPECT_EQ(part().clip->bones, std::vector<std::string>{"limb"});
    const glm::dvec3 there = translation("leader");
    tick(10);
    EXPECT_NE(translation("leader"), there) << "it walks on";
}

TEST_F(RigRename, GivesNoClipTheSameBoneTwice) {
    element("a");
    element("b");
    tick(3);
    run("rig.clip.record", {{"seconds", 0.05}});
    run("rig.element.remove", {{"name", "a"}});
    EXPECT_TRUE(test::says(refused("rig.element.rename", {{"name", "b"}, {"to", "a"}}),
                           "clip removed bone a record"));
    EXPECT_EQ(part().clip->bones, (std::vector<std::string>{"a", "b"}));
    EXPECT_TRUE(part().rig.element("b"));
    run("rig.clip.record", {{"seconds", 0.05}});
    run("rig.element.rename", {{"name", "b"}, {"to", "a"}});
    EXPECT_EQ(part().clip->bones, std::vector<std::string>{"a"});
}

TEST_F(RigRename, RefusesNamesThatAreEmptyTakenOrUnprintable) {
    element("a");
    element("b", "a");
    run("rig.curve.add", {{"name", "c"}});
    unit({{"unit", "set_transform"}, {"name", "u"}, {"item", "a"}});
    unit({{"unit", "set_transform"}, {"name", "v"}, {"item", "b"}});
    struct Case {
        const char* command;
        Json arguments;
        const char* told;
    };
    const std::vector<Case> cases{
        {"rig.element.rename", {{"name", "a"}, {"to", ""}}, "to empty"},
        {"rig.element.rename", {{"name", "a"}, {"to", "b"}}, "to already element b"},
        {"rig.element.rename", {{"name", "x"}, {"to", "y"}}, "no element x"},
        {"rig.element.rename", {{"name", "a"}, {"to", "a\nb"}}, "unprintable"},
        {"rig.element.rename", {{"name", "a"}, {"to", std::string(101, 'a')}}, "101 100"},
        {"rig.unit.rename", {{"name", "u"}, {"to", "v"}}, "to already unit v"},
        {"rig.unit.rename", {{"name", "u"}, {"to", ""}}, "to empty"},
        {"rig.unit.rename", {{"name", "a"}, {"to", "w"}}, "no unit a"},
        {"rig.curve.rename", {{"name", "c"}, {"to", ""}}, "to empty"},
        {"rig.curve.rename", {{"name", "d"}, {"to", "e"}}, "no curve d"}};
    for (const Case& each : cases) EXPECT_TRUE(test::says(refused(each.command, each.arguments), each.told));
    run("rig.element.rename", {{"name", "a"}, {"to", "u"}});
    EXPECT_EQ(named("elements", "b").at("parent"), "u") << "an element and a unit may share a name";
    run("rig.element.rename", {{"name", "u"}, {"to", "u"}});
    EXPECT_EQ(things().size(), 5u);
}

}  // namespace
}  // namespace tendril::app
