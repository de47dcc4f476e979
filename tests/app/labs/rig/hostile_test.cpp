// The lab's refusals and their messages. LabTest::refused checks that nothing changes.
#include <limits>
#include <map>
#include <random>

#include "app/labs/rig/clip.hpp"
#include "app/labs/rig/rig_runtime.hpp"
#include "app/labs/rig/take.hpp"
#include "rig_support.hpp"
#include "tests/app/support/panel_text.hpp"
#include "tests/labels.hpp"

namespace tendril::app {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

class RigHostile : public RigTest {
  protected:
    RigHostile() {
        element("root");
        element("hand", "root", transform(1, 0, 0));
        control("dial", "float");
        run("rig.curve.add", {{"name", "smile"}});
    }
    void expect_unit_refused(const Json& unit, std::vector<std::string> says) {
        expect_refused("rig.unit.add", unit, std::move(says));
    }
};

TEST_F(RigHostile, ElementsThatAreNoTree) {
    expect_refused("rig.element.add", {{"name", ""}}, {"name is empty"});
    expect_refused("rig.element.add", {{"name", std::string(101, 'x')}}, {"101 characters"});
    expect_refused("rig.element.add", {{"name", std::string("a\0b", 3)}}, {"unprintable"});

    expect_scene_refused("/elements/0/parent", "hand", "itself below it");
    expect_scene_refused("/units", std::vector<int>(2001), "2000");
}

TEST_F(RigHostile, InvalidTransforms) {
    // The path begins with the argument's name: "local" or "transform".
    const auto add = [&](const Json& local, const std::string& place, const std::string& says) {
        expect_refused("rig.element.add", {{"name", "new"}, {"local", local}}, {"local" + place, says});
        expect_refused("rig.element.set", {{"name", "hand"}, {"transform", local}},
                       {"transform" + place, says});
    };
    add({{"translation", {nan, 0, 0}}}, ".translation.0", "a number");
    add({{"translation", {0, infinity, 0}}}, ".translation.1", "a number");
    add({{"translation", {1e10, 0, 0}}}, ".translation.0", "1e9");
    add({{"translation", {1, 2}}}, ".translation", "[x, y, z]");
    add({{"rotation", {1, 2, 3}}}, ".rotation", "[x, y, z, w]");
    add({{"size", {1, 1, 1}}}, "", "unknown member \"size\"");
    add("here", "", "\"here\"");
    add(nullptr, "", "null");
    for (const Json& local : {Json{{"rotation", {0, 0, 0, 0}}}, Json{{"scale", {1, 0, 1}}}}) {
        expect_refused("rig.element.add", {{"name", "new"}, {"local", local}},
                       {"\"new\"", local.begin().key()});
        expect_refused("rig.element.set", {{"name", "hand"}, {"transform", local}}, {local.begin().key()});
    }
}

TEST_F(RigHostile, ControlsOutOfOrder) {
    const auto add = [&](const Json& more, std::vector<std::string> says) {
        Json arguments{{"name", "new"}, {"kind", "control"}};
        arguments.update(more);
        expect_refused("rig.element.add", arguments, std::move(says));
    };
    add({{"control", "vector2d"}, {"axes", {"x", "x"}}}, {"axes", "different"});
    add({{"control", "vector2d"}, {"axes", {"x", "w"}}}, {"axes.1", "\"w\""});
    add({{"control", "vector2d"}, {"axes", {"x"}}}, {"axes"});
    add({{"control", "float"}, {"axes", {"x", "y"}}}, {"unknown member \"axes\""});
    add({{"control", "float"}, {"minimum", 1}, {"maximum", 0}}, {"minimum", "at most the maximum", "1"});
    add({{"control", "float"}, {"minimum", {0, 0}}}, {"minimum", "a number"});
    add({{"control", "vector2d"}, {"minimum", 0}}, {"minimum", "2 numbers"});
    add({{"control", "position"}, {"maximum", {1, 2}}}, {"maximum", "3 coordinates"});
    add({{"control", "bool"}, {"maximum", 1}}, {"unknown member \"maximum\""});
    add({{"parent", "hand"}, {"space", "root"}}, {"space", "\"hand\""});
    add({{"space", "nobody"}}, {"\"nobody\""});
    expect_refused("rig.element.add", {{"name", "new"}, {"minimum", 1}}, {"unknown member \"minimum\""});
    expect_refused("rig.element.add", {{"name", "new"}, {"space", "hand"}}, {"unknown member \"space\""});
}

/// It is refused in advance by its estimated cost.
TEST_F(RigHostile, ABackwardSolveThatWouldTakeTooLongIsRefused) {
    Json scene = save_scene(workspace);
    Json& rig = scene["labs"]["rig"];
    rig.erase("state");
    for (int i = 0; i < 1000; ++i) {
        std::string name = "finger ";
        name += std::to_string(i);
        rig["elements"].push_back({{"name", name}, {"kind", "bone"}, {"parent", "root"}});
    }
    for (int i = 0; i < 12; ++i) {
        std::string name = "control ";
        name += std::to_string(i);
        rig["elements"].push_back({{"name", name}, {"kind", "control"}, {"control", "transform"}});
    }
    Json body = Json::array();
    for (int i = 0; i < 40; ++i)
        body.push_back({{"unit", "transform_location"}, {"transform", {{"item", "each"}}}});
    rig["units"] = {{{"unit", "for_each"}, {"name", "all"}, {"roots", {"root"}}, {"body", body}}};
    load_scene(workspace, scene);
    auto& posed = workspace.document.edit<RigPart>(rig_lab);
    ASSERT_TRUE(posed.state.edit().elements.set(posed.rig.id(*posed.rig.element("finger 7")),
                                                rig::Space::Local, {.translation = {1, 0, 0}}));
    expect_refused("rig.solve", {{"direction", "backward"}}, {"so large", "too long"});
}

LABEL(slow, "RigHostile.ABackwardSolveStopsAtItsBudgetAndReportsIt");

/// A chain of controls that each move all the bones after it.
TEST_F(RigHostile, ABackwardSolveStopsAtItsBudgetAndReportsIt) {
    constexpr int count = 120;
    Json scene = save_scene(workspace);
    Json& rig = scene["labs"]["rig"];
    rig.erase("state");
    rig["elements"] = rig["units"] = Json::array();
    const auto named = [](const char* kind, int i) {
        std::string name(kind);
        name += std::to_string(i);
        return name;
    };
    for (int i = 0; i < count; ++i) {
        for (const char* kind : {"control", "bone"}) {
            Json element{{"name", named(kind, i)}, {"kind", kind}, {"local", transform(0, 0.3, 0)}};
            if (i > 0) element["parent"] = named(kind, i - 1);
            rig["elements"].push_back(element);
        }
        rig["units"].push_back({{"unit", "parent_constraint"},
                                {"name", named("follow ", i)},
                                {"item", named("bone", i)},
                                {"parents", {{{"item", named("control", i)}}}}});
    }
    load_scene(workspace, scene);
    auto& posed = workspace.document.edit<RigPart>(rig_lab);
    for (int i = 0; i < count; ++i) {
        const rig::ElementId bone = posed.rig.id(*posed.rig.element(named("bone", i)));
        const double angle = 0.2 * std::sin(2.3 * i);
        ASSERT_TRUE(
            posed.state.edit().elements.set(bone, rig::Space::Local,
                                            {.translation = {0.05 * std::sin(i), 0.3, 0.0},
                                             .rotation = {std::cos(angle), std::sin(angle), 0.0, 0.0}}));
    }
    solve("backward");
    const Json left = state().at("backward");
    EXPECT_EQ(left.at("stopped"), true) << left;
    EXPECT_GT(left.at("worst_mm"), 0.1);
    EXPECT_EQ(rig_part(reopened()).backward, part().backward);
    test::PanelReader reader;
    set_folded(workspace.settings, "rig: Solve", false);
    EXPECT_NE(reader.panel(lab(), workspace).find("Stopped early"), std::string::npos);
}

TEST_F(RigHostile, ValuesThatAControlLacks) {
    control("place", "position");
    control("square", "vector2d");
    expect_refused("rig.control.set", {{"name", "hand"}, {"value", 1}}, {"\"hand\" is not a control"});
    expect_refused("rig.control.set", {{"name", "nobody"}, {"value", 1}}, {"no element \"nobody\""});
    expect_refused("rig.control.set", {{"name", "dial"}, {"value", nan}}, {"value", "a number"});
    expect_refused("rig.control.set", {{"name", "dial"}, {"value", true}}, {"value", "true"});
    expect_refused("rig.control.set", {{"name", "dial"}, {"value", {1, 2, 3}}}, {"value", "a number"});
    expect_refused("rig.control.set", {{"name", "place"}, {"value", 1}}, {"value", "[x, y, z]"});
    expect_refused("rig.control.set", {{"name", "place"}, {"value", {1, nan, 3}}}, {"value"});
    expect_refused("rig.control.set", {{"name", "square"}, {"value", {1, 2, 3}}}, {"value", "[a, b]"});
    expect_refused("rig.control.set", {{"name", "dial"}}, {"needs either value or values"});
}

TEST_F(RigHostile, InvalidUnits) {
    expect_unit_refused({{"unit", "aim"}}, {"\"item\" is missing"});
    expect_unit_refused({{"unit", "aim"}, {"item", "hand"}, {"roots", {"root"}}},
                        {"unknown member \"roots\"", "primary"});
    expect_unit_refused({{"unit", "aim"}, {"item", "hand"}, {"primary", {{"taget", "root"}}}},
                        {"primary: unknown member \"taget\""});
    expect_unit_refused({{"unit", "aim"}, {"item", "hand"}, {"primary", {{"kind", "point"}}}},
                        {"primary.kind", "location, direction", "\"point\""});
    expect_unit_refused({{"unit", "aim"}, {"item", {{"item", "all"}}}}, {"item.item", "\"all\""});
    expect_unit_refused({{"unit", "aim"}, {"item", 7}}, {"item", "7"});
    expect_unit_refused({{"unit", "parent_constraint"}, {"item", "hand"}}, {"\"parents\" is missing"});
    expect_unit_refused({{"unit", "parent_constraint"}, {"item", "hand"}, {"parents", Json::array()}},
                        {"parents", "at least 1"});
    expect_unit_refused({{"unit", "parent_constraint"},
                         {"item", "hand"},
                         {"parents", {{{"item", "root"}}}},
                         {"filter", {{"rotation", {true, 1, true}}}}},
                        {"filter.rotation.1", "true or false"});
    expect_unit_refused({{"unit", "for_each"}, {"roots", {"root"}}, {"body", {{{"unit", "sing"}}}}},
                        {"body.0.unit", "\"sing\""});
    const auto spline = [&](const char* member, const Json& value, std::vector<std::string> says) {
        Json unit{{"unit", "spline"}, {"root", "root"}, {"tip", "hand"}, {"points", {"root", "dial"}}};
        unit[member] = value;
        expect_unit_refused(unit, std::move(says));
    };
    spline("points", {"root", 7}, {"points.1", "7"});
    spline("points", "root", {"points", "\"root\""});
    spline("points", std::vector<std::string>(4097, "root"), {"points", "4097", "4096"});
    spline("roll_end_deg", nan, {"roll_end_deg"});
    expect_unit_refused({{"unit", "from_two_vectors"}, {"at", 5}}, {"at", "0 to 0", "5"});
    unit({{"unit", "from_two_vectors"}, {"name", "arc"}});
    expect_unit_refused({{"unit", "from_two_vectors"}, {"name", "arc"}}, {"\"arc\"", "this name already"});
    expect_refused("rig.unit.enable", {{"name", "nobody"}, {"on", false}}, {"no unit \"nobody\""});
    expect_refused("rig.unit.remove", {{"name", "nobody"}}, {"no unit \"nobody\""});
}

TEST_F(RigHostile, InputsOfTheWrongTypeOrWithoutSource) {
    const auto rotation = [&](const Json& input, std::vector<std::string> says) {
        expect_unit_refused({{"unit", "set_rotation"}, {"item", "hand"}, {"rotation", input}},
                            std::move(says));
    };
    rotation(1.0, {"rotation", "[x, y, z, w]", "1"});
    rotation({0, 0, 0, 0}, {"rotation"});
    rotation({0, nan, 0, 1}, {"rotation.1"});
    rotation("nobody", {"rotation", "no element \"nobody\""});
    rotation({{"element", "hand"}, {"of", "mood"}}, {"rotation.of", "\"mood\""});
    rotation({{"element", "hand"}, {"space", "outer"}}, {"rotation.space", "\"outer\""});
    rotation({{"element", "hand"}, {"offset", 1}}, {"rotation: unknown member \"offset\""});
    rotation({{"each", "weight"}}, {"rotation.each", "\"weight\""});
    expect_unit_refused({{"unit", "set_rotation"}, {"item", "hand"}, {"when", 1}}, {"when", "true or false"});
    expect_unit_refused({{"unit", "from_two_vectors"}, {"weight", nan}}, {"weight", "a number"});
    expect_unit_refused({{"unit", "alpha_interpolate"}, {"in_range", {0, 1, 2}}},
                        {"in_range", "[low, high]"});
    expect_unit_refused({{"unit", "set_rotation"}, {"item", "hand"}, {"when", "dial"}},
                        {"when takes a bool, got a number"});
}

TEST_F(RigHostile, ReferencedElementsCannotBeRemoved) {
    unit({{"unit", "from_two_vectors"}, {"name", "arc"}});
    unit({{"unit", "set_rotation"}, {"name", "turn"}, {"item", "hand"}, {"rotation", {{"unit", "arc"}}}});
    unit({{"unit", "for_each"},
          {"name", "loop"},
          {"roots", {"root"}},
          {"body", {{{"unit", "evaluate_curve"}, {"name", "inner"}, {"value", "dial"}}}}});
    expect_refused("rig.element.remove", {{"name", "root"}}, {"\"root\" is the parent of \"hand\""});
    expect_refused("rig.element.remove", {{"name", "hand"}}, {"unit \"turn\"", "\"hand\"", "item"});
    expect_refused("rig.element.remove", {{"name", "dial"}}, {"unit \"inner\"", "\"dial\"", "value"});
    expect_refused("rig.element.remove", {{"name", "nobody"}}, {"no element \"nobody\""});
    expect_refused("rig.unit.remove", {{"name", "arc"}}, {"unit \"turn\"", "rotation", "\"arc\""});
    run("rig.unit.remove", {{"name", "turn"}});
    run("rig.unit.remove", {{"name", "arc"}});
    run("rig.unit.remove", {{"name", "inner"}});
    run("rig.element.remove", {{"name", "dial"}});
    run("rig.element.remove", {{"name", "hand"}});
    expect_refused("rig.element.remove", {{"name", "root"}}, {"unit \"loop\"", "roots"});
}

/// A single line of a file can request millions of iterations.
TEST_F(RigHostile, ARigThatWouldRunTooLongIsRefused) {
    Json rig = saved(), body = Json::array(), roots = Json::array();
    rig.erase("state");
    for (int i = 0; i < 200; ++i) body.push_back({{"unit", "from_two_vectors"}});
    for (int i = 0; i < 1000; ++i) roots.push_back("root");
    rig["units"] = {{{"unit", "for_each"}, {"roots", roots}, {"body", body}}};
    EXPECT_TRUE(test::says(opened_with("", rig), "units maximum"));
}

TEST_F(RigHostile, InvalidStates) {
    unit({{"unit", "spring_interpolate"}, {"target", "root"}});
    tick();
    const auto expect_place = [&](const std::string& at, const Json& value, const std::string& place) {
        expect_scene_refused("/state" + at, value, "labs.rig.state." + place);
    };
    expect_place("/moving", 1, "moving");
    expect_place("/controls/dial", "x", "controls.dial");
    expect_place("/controls/nobody", 1, "controls: there is no control \"nobody\"");
    expect_place("/curves", "x", "curves");
    expect_place("/curves/smile/now", nan, "curves.smile.now");
    expect_place("/curves/smile/then", 1, "curves.smile: unknown member");
    expect_place("/units/nobody", Json::object(), "units: there is no unit");
    expect_place("/poses/nobody", Json::object(), "poses");
    expect_place("/poses/hand", {{"now", {{"global", {{"rotation", {0, 0, 0, 2}}}}}}},
                 "poses.hand.now.global");
    expect_place("/poses/hand", {{"then", nullptr}}, "poses.hand");
    expect_place("/units/spring_interpolate/warning", "bad", "units.spring_interpolate.warning");
    expect_place("/units/spring_interpolate/outputs", Json::array(), "units.spring_interpolate.outputs");
    expect_place("/units/spring_interpolate/memory/0", {{"spring", {{"value", 1e300}}}},
                 "units.spring_interpolate.memory.0.spring");
    expect_place("/units/spring_interpolate/memory/0", {{"turned", {0, 0, 0, 0}}},
                 "units.spring_interpolate.memory.0.turned");
    expect_place("/units/spring_interpolate/memory/0", {{"ik", {{"rotations", {{1, 0, 0, 1}}}}}},
                 "units.spring_interpolate.memory.0.ik.rotations.0");
}

// Drags while the simulation is paused are part of the take, like those while it runs.

class RigPaused : public RigTest {
  protected:
    void play(int ticks) {
        for (int i = 0; i < ticks; ++i) {
            lab().step(workspace);
            shown_[part().take.now()] = part().state;
        }
    }
    void go(std::uint64_t tick) { run("rig.time", {{"tick", tick}}); }
    /// Emits what a drag emits, repeatedly.
    void drag(const char* name, const Json& value) {
        set(name, value);
        solve();
        see();
    }
    void forget_what_comes() { shown_.erase(shown_.upper_bound(part().take.now()), shown_.end()); }
    void see() {
        forget_what_comes();
        shown_[part().take.now()] = part().state;
    }
    void head_at(double x, double z = 0.0) { drag("head", {{"translation", {x, 1.0, z}}}); }
    void expect_scrubs(int times, unsigned seed, bool forgetful = false) {
        ASSERT_FALSE(shown_.empty());
        std::mt19937 random(seed);
        for (int i = 0; i < times; ++i) {
            auto tick = shown_.begin();
            std::advance(tick, static_cast<int>(random() % shown_.size()));
            if (forgetful) workspace.runtimes.clear();
            go(tick->first);
            ASSERT_EQ(part().state, tick->second) << tick->first;
        }
    }
    /// An arm that reaches for one control, with its elbow towards another, and a bone that trails on a
    /// spring; and a head that, once a switch is on, turns from its direction at that time.
    void arm() {
        element("shoulder");
        element("elbow", "shoulder", transform(0, 1, 0));
        element("wrist", "elbow", transform(0, 1, 0.1));
        element("tip", "wrist", transform(0, 0.5, 0));
        element("tail");
        control("target", "position", {{"local", transform(0.5, 1.5, 0)}});
        control("pole", "position", {{"local", transform(0, 1, 2)}});
        control("dial", "float");
        control("on", "bool");
        unit(R"({"unit": "fabrik", "name": "reach", "root": "shoulder", "tip": "tip", )"
             R"("target": "target", "pole_target": "pole"})");
        unit({{"unit", "spring_interpolate"}, {"name", "trail"}, {"target", "tip"}, {"strength", 1.5}});
        unit(R"({"unit": "aim", "item": "tail", "primary": {"axis": [0, 1, 0], )"
             R"("target": {"unit": "trail"}}, "max_speed": 90})");
        element("head");
        unit(R"({"unit": "aim", "name": "late", "item": "head", "primary": {"target": "target"}, )"
             R"("max_speed": 45, "when": "on"})");
    }

    std::map<std::uint64_t, rig::State> shown_;  ///< by tick
};

/// The intermediate values of a drag must not reach anything with memory.
TEST_F(RigPaused, ADragEndsAsIfAllHadBeenSetAtOnce) {
    arm();
    play(30);
    const Workspace before = workspace;
    drag("dial", 0.5);
    drag("on", true);
    for (int i = 0; i < 30; ++i) drag("target", {std::cos(0.3 * i), std::sin(0.5 * i), 0.2 * i});
    drag("pole", {1.0, 1.0, -1.0});
    drag("target", {1.0, 0.5, 0.3});
    const RigPart dragged = part();
    workspace = before;
    workspace.runtimes.clear();
    set("dial", 0.5);
    set("on", true);
    set("target", {1.0, 0.5, 0.3});
    set("pole", {1.0, 1.0, -1.0});
    solve();
    EXPECT_EQ(part().state, dragged.state);
    EXPECT_EQ(part().take.keys->size(), dragged.take.keys->size());
    EXPECT_EQ(part().moving, dragged.moving);
}

TEST_F(RigPaused, AnyTickIsAsItWasShown) {
    for (const unsigned seed : {1u, 2u, 3u, 4u, 5u, 6u}) {
        SCOPED_TRACE(seed);
        run("rig.clear");
        arm();
        shown_.clear();
        play(5);
        std::mt19937 random(seed);
        const auto any = [&] { return 4.0 * static_cast<double>(random() >> 8) / (1u << 24) - 2.0; };
        const std::uint64_t began = part().take.began;
        for (int i = 0; i < 120; ++i) {
            const auto what = random() % 9;
            const char* const name = random() % 3 == 0 ? "pole" : "target";
            const double x = any(), y = any(), z = any();
            if (what < 3) play(1 + static_cast<int>(random() % 7));
            if (what == 3 || what == 4) drag(name, {x, y, z});
            if (what == 5) set(name, {x, y, z}), forget_what_comes();  // units see it one tick later
            if (what == 6) solve(), see();
            if (what == 8) drag("on", random() % 2 == 0);
            if (what == 7) {
                go(began + random() % (part().take.tick + 1));
                if (part().take.tick == 0) go(began + 1);
            }
        }
        ASSERT_EQ(part().take.began, began);
        shown_.erase(shown_.begin(), shown_.lower_bound(began));
        expect_scrubs(60, seed);
        expect_scrubs(20, seed, true);
        workspace = reopened();
        expect_scrubs(30, seed);
    }
}

TEST_F(RigPaused, PausedPosesAreBakedAsTheyPlay) {
    arm();
    play(10);
    for (int i = 0; i < 6; ++i) {
        drag("target", {0.3 * i, 1.0, 0.5 - 0.2 * i});
        play(4);
    }
    run("rig.clip.record");
    const RigClip clip = *part().clip;
    const auto shoulder =
        static_cast<std::size_t>(std::ranges::find(clip.bones, "shoulder") - clip.bones.begin());
    for (std::size_t frame = 0; frame < clip.frames(); ++frame) {
        go(clip.began + frame);
        const glm::quat turned(rotation("shoulder"));
        EXPECT_EQ(clip.poses[frame * clip.bones.size() + shoulder].rotation, turned) << frame;
    }
}

/// An edit of the rig starts a take, and so does a backward solve.
TEST_F(RigPaused, AnEditStartsATake) {
    arm();
    play(30);
    run("rig.unit.set", {{"name", "trail"}, {"strength", 3}});
    solve();
    EXPECT_EQ(part().take.last, 0u);
    play(10);
    const std::uint64_t now = part().take.now();
    drag("target", {1.0, 0.5, 0.3});
    EXPECT_NE(part().take.began, now);
    solve("backward");
    EXPECT_EQ(part().take.began, now);
}

TEST_F(RigPaused, InvalidKeysInAFile) {
    arm();
    play(10);
    drag("target", {1.0, 0.5, 0.3});
    Json scene = save_scene(workspace);
    Json& keys = scene["labs"]["rig"]["state"]["take"]["keys"];
    EXPECT_EQ(keys.back(), (Json{10}));
    for (const Json& key : {Json::array(), Json{-1}, Json{"solve"}, Json{10, "target"}, Json(10)}) {
        keys.back() = key;
        EXPECT_THROW(load_scene(workspace, scene), std::runtime_error) << key;
    }
}

}  // namespace
}  // namespace tendril::app
