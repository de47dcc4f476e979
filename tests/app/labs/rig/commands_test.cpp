// The Rig lab's commands: their effects, when the lab solves, and --state.
#include "rig_support.hpp"
#include "tests/says.hpp"

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
    unit({{"unit", "aim"},
          {"name", "aim"},
          {"item", "arm"},
          {"primary", {{"axis", {0, 0, 1}}, {"target", "look"}, {"weight", 0.5}}},
          {"secondary", {{"axis", {1, 0, 0}}, {"target", {0, 1, 0}}, {"kind", "direction"}}}});
    unit({{"unit", "parent_constraint"},
          {"name", "follow"},
          {"item", "hand"},
          {"parents", {{{"item", "arm"}}}},
          {"filter", {{"translation", {true, false, true}}, {"rotation", {false, false, false}}}}});
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

}  // namespace
}  // namespace tendril::app
