// The plot and the past poses of the last ten seconds in the running program, in every lab that has joints.
#include <glm/trigonometric.hpp>

#include "app/labs/humanoid/humanoid_runtime.hpp"
#include "app/live_loop.hpp"
#include "tests/app/support/panel_places.hpp"
#include "tests/app/support/play.hpp"

namespace tendril::test {
namespace {

using app::Json;

struct PlottedLab {
    const char* lab;
    const char* of;
    ScriptText scene;  ///< a scene that moves by itself
};

std::vector<PlottedLab> plotted_labs() {
    return {{"chain", "swing",
             ScriptText()
                 .command("chain.mode", {{"mode", "reach"}})
                 .command("chain.motion", {{"path", "circle"}, {"period", 2}})},
            {"rig", "angle",
             ScriptText()
                 .command("lab.open", {{"name", "rig"}})
                 .command("rig.preset", {{"name", "secondary"}})
                 .command("rig.motion", {{"name", "head"}, {"path", "figure_eight"}, {"period", 1.5}})
                 .command("rig.select", {{"element", "left 3"}})},
            {"humanoid", "swing",
             ScriptText()
                 .command("lab.open", {{"name", "humanoid"}})
                 .command("humanoid.clip", {{"name", "walk"}, {"play", true}})}};
}

std::string view(const PlottedLab& lab, const char* what) {
    return "view." + std::string(lab.lab) + what;
}

ScriptText shown(const PlottedLab& lab) {
    return ScriptText(lab.scene)
        .command(view(lab, "_plot"), {{"of", lab.of}})
        .command(view(lab, "_ghosts"), {{"of", "past"}});
}

TEST(PastViews, PlotAValueForEveryTickAndAGhostForEveryHalfSecond) {
    for (const PlottedLab& lab : plotted_labs()) {
        const Json past = state_after(shown(lab).wait(130))["past"];
        const Json values = past["plot"]["values"];
        ASSERT_GE(values.size(), 128u) << lab.lab;
        double low = 1e9, high = -1e9;
        for (std::size_t i = 1; i < values.size(); ++i) {
            EXPECT_EQ(values[i][0].get<int>(), values[i - 1][0].get<int>() + 1) << lab.lab;
            low = std::min(low, values[i][1].get<double>());
            high = std::max(high, values[i][1].get<double>());
        }
        EXPECT_GT(high - low, 1.0) << lab.lab << ": it moves";
        EXPECT_GE(past["ghosts"].size(), 4u) << lab.lab;
    }
}

TEST(PastViews, StayTheSameWhenSeeking) {
    for (const PlottedLab& lab : plotted_labs()) {
        const Json end = state_after(shown(lab).wait(70))["past"]["plot"]["values"];
        const Json back =
            state_after(shown(lab).wait(70).command("time.seek", {{"ticks_back", 30}}).wait(3))["past"];
        for (std::size_t i = 0; i < 60; ++i) EXPECT_EQ(back["plot"]["values"][i], end[i]) << lab.lab << i;
    }
}

TEST(PastViews, AreSettingsWithoutUndoStepOrUnsavedChange) {
    for (const PlottedLab& lab : plotted_labs()) {
        const ScriptText script = ScriptText(lab.scene).command("time.pause").wait(1);
        const Json plain = state_after(script);
        const Json with = state_after(ScriptText(script)
                                          .command(view(lab, "_plot"), {{"of", lab.of}})
                                          .command(view(lab, "_ghosts"), {{"of", "past"}}));
        EXPECT_EQ(with.value("modified", false), plain.value("modified", false)) << lab.lab;
        EXPECT_TRUE(plain["past"]["plot"].is_null());
        EXPECT_EQ(with["past"]["plot"]["of"], lab.of);
        // Without an argument, each selects its next choice, and after the last one the first.
        const Json off = state_after(
            ScriptText(script).command(view(lab, "_ghosts"), {{"of", "past"}}).command(view(lab, "_ghosts")));
        EXPECT_EQ(off["past"], plain["past"]) << lab.lab;
    }
}

TEST(PastViews, ChangeNothingElseInTheView) {
    for (const PlottedLab& lab : plotted_labs()) {
        Json with = state_after(shown(lab).wait(90).command("time.pause"));
        Json without = state_after(ScriptText(lab.scene).wait(90).command("time.pause"));
        for (Json* each : {&with, &without})
            for (const char* const seen : {"past", "handles", "view", "layout"}) each->erase(seen);
        EXPECT_EQ(with, without) << lab.lab;
    }
}

ScriptText& press_at(ScriptText& script, glm::vec2 at) {
    return script.move(at).wait(1).down().wait(2);
}

TEST(PastViews, UndoUnderAStillHandIsNotDraggedBack) {
    for (const float y : {546.0f, 615.0f}) {
        ScriptText script = plotted_labs()[0].scene;
        script.command("view.chain_plot", {{"of", "swing"}}).wait(400).command("time.pause").wait(2);
        for (int i = 0; i < 3; ++i) script.command("chain.add", {{"length", 0.5}}).wait(1);
        const Json before = state_after(script);
        press_at(script, {500.0f, y}).move({480.0f, y}).wait(2);
        EXPECT_GT(state_after(script)["time"]["ticks_back"], 50);
        EXPECT_EQ(state_after(script)["segments"].size(), before["segments"].size() - 3);
        EXPECT_EQ(state_after(script.command("undo").wait(2))["segments"], before["segments"]) << y;
        EXPECT_GT(state_after(script.move({400.0f, y}).wait(2))["time"]["ticks_back"], 100)
            << "a drag goes on";
    }
}

TEST(PastViews, GhostsShowOnlyMomentsWithTheSameJoints) {
    struct Change {
        ScriptText to;
        bool other_joints;
    };
    const std::vector<Change> changes[] = {
        {{ScriptText().command("chain.preset", {{"name", "arm"}}), true},
         {ScriptText().command("chain.set_length", {{"index", 2}, {"length", 1.5}}), true},
         {ScriptText().command("chain.add", {{"length", 1.0}}), true},
         {ScriptText().command("chain.mode", {{"mode", "forward"}}), false},
         {ScriptText().command("chain.target", {{"to", {2, 3, 1}}}), false}},
        {{ScriptText().command("rig.preset", {{"name", "fk"}}), true},
         {ScriptText().command("rig.element.add", {{"name", "more"}, {"kind", "bone"}}), true},
         {ScriptText().command("rig.select", {{"element", "right 3"}}), false}},
        {{ScriptText().command("humanoid.load", {{"path", source_path("tests/app/golden/antennae.bvh")}}),
          true},
         {ScriptText().command("humanoid.clip", {{"name", "punch"}, {"play", true}}), false}}};
    const auto labs = plotted_labs();
    for (std::size_t lab = 0; lab < labs.size(); ++lab)
        for (const Change& change : changes[lab]) {
            const ScriptText script =
                shown(labs[lab]).wait(100).command("time.pause").wait(1).lines(change.to).wait(2);
            const Json ghosts = state_after(script)["past"]["ghosts"];
            EXPECT_EQ(ghosts.empty(), change.other_joints) << labs[lab].lab << "\n" << change.to.text();
            const Json back = state_after(ScriptText(script).command("undo").wait(1))["past"]["ghosts"];
            EXPECT_GE(back.size(), 3u) << labs[lab].lab << " as it was before\n" << change.to.text();
        }
}

/// Each lab with its strip of the last ten seconds above the plot, paused.
ScriptText below_the_strip(const PlottedLab& lab) {
    ScriptText script = shown(lab).wait(420).command("time.pause");
    if (std::string(lab.lab) == "rig") script.command("view.rig_strip", {{"of", "past"}});
    return script.wait(2);
}

TEST(PastViews, AClickInThePlotSeeksToTheStripsMomentThere) {
    constexpr float strip = 546.0f, plot = 615.0f;
    constexpr std::array places{600.0f, 607.0f, 633.0f, 641.0f};
    for (const PlottedLab& lab : plotted_labs()) {
        const TempFolder folder;
        ScriptText script = below_the_strip(lab);
        std::optional<glm::vec2> hips;
        if (std::string(lab.lab) == "humanoid")
            hips = handle(state_after(script.click({405.0f, 534.0f})), "hips");  // Past
        int count = 0;
        for (const float y : {strip, plot})
            for (const float x : places)
                press_at(script, {x, y})
                    .up()
                    .wait(1)
                    .line({{"state", (folder / std::to_string(count++)).string()}});
        play(script);
        std::vector<std::uint64_t> moments;
        for (int i = 0; i < count; ++i) {
            const Json there = app::parse_json(read(folder / std::to_string(i)));
            moments.push_back(there["time"]["moment"].get<std::uint64_t>());
            EXPECT_TRUE(!hips || glm::distance(handle(there, "hips"), *hips) < 30.0f) << "the camera follows";
        }
        for (std::size_t i = 0; i < places.size(); ++i) {
            EXPECT_EQ(moments[places.size() + i], moments[i]) << lab.lab << " at " << places[i];
            EXPECT_TRUE(i == 0 || moments[i] > moments[i - 1]) << lab.lab << " at " << places[i];
        }
    }
}

TEST(PastViews, ADragInThePlotIsOneStepAsOnTheStrip) {
    for (const PlottedLab& lab : plotted_labs()) {
        ScriptText script = below_the_strip(lab);
        press_at(script, {480.0f, 615.0f}).move({560.0f, 600.0f}).move({1000.0f, 640.0f}).wait(2);
        const Json end = state_after(script)["time"];
        EXPECT_EQ(end["ticks_back"], 0) << lab.lab << ": to the right of the present there is nothing";
        script.move({400.0f, 640.0f}).up().wait(2);
        const Json back = state_after(script)["time"];
        EXPECT_GT(back["ticks_back"].get<int>(), 50) << lab.lab;
        EXPECT_FALSE(back["playing"].get<bool>());
        script.move({800.0f, 640.0f}).wait(2);
        EXPECT_EQ(state_after(script)["time"], back) << lab.lab << ": nothing is held any more";
    }
}

class LivePlot : public testing::Test {
  protected:
    LivePlot() {
        app_.workspace().clock.measured = true;
        app_.run({"lab.open", Json{{"name", "humanoid"}}});
        app_.run({"humanoid.clip", Json{{"name", "walk"}, {"play", true}}});
        for (int i = 0; i < 300; ++i) app_.tick(nullptr);
        app_.run({"time.pause", Json::object()});
        turns(30);
    }
    void turns(int count) {
        for (int i = 0; i < count; ++i) loop_.turn({}, app::tick_seconds, player_);
    }
    std::size_t poses() { return app::humanoid_runtime(app_.workspace()).past.size(); }

    /// The number of moments, including the present one.
    std::size_t moments() { return app_.workspace().rewind.size() + 1; }

    std::unique_ptr<app::Window> window_ = app::open_offscreen({1000, 700});
    app::App app_{*window_};
    std::atomic<bool> ending_{false};
    app::LiveLoop loop_{app_, *window_, {.config = false, .ending = ending_}};
    app::Player player_{app::Script{}};
};

TEST_F(LivePlot, IsComputedInPartsWhileThePausedWindowContinues) {
    EXPECT_FALSE(app_.needs_ticks());
    app_.run({"view.humanoid_plot", Json{{"of", "swing"}}});
    std::size_t before = poses();
    EXPECT_LE(before, 32u);
    for (int i = 0; i < 100 && app_.needs_ticks(); ++i) {
        turns(1);
        EXPECT_LE(poses(), before + 32) << "a turn has two ticks at most";
        before = poses();
    }
    EXPECT_EQ(poses(), moments());
    EXPECT_FALSE(app_.needs_ticks());
    app_.run({"view.humanoid_plot", Json{{"of", "nothing"}}});
    EXPECT_EQ(poses(), 0u);
}

TEST_F(LivePlot, IsCompleteInAPictureAndInTheState) {
    app_.run({"view.humanoid_plot", Json{{"of", "swing"}}});
    ASSERT_LT(poses(), 100u);
    const auto at_once = app_.screenshot();
    EXPECT_EQ(poses(), moments());
    app_.run({"view.humanoid_plot", Json{{"of", "nothing"}}});
    app_.run({"view.humanoid_plot", Json{{"of", "swing"}}});
    EXPECT_EQ(app_.state()["past"]["plot"]["values"].size(), moments());
    turns(100);
    EXPECT_EQ(app_.screenshot().rgba, at_once.rgba);
}

// The Chain lab's last ten seconds in the running program: drags, flips, and returning to them.

/// Two bones in mode Reach whose target then passes through the root, a hundredth of the reach per tick.
ScriptText through_the_root() {
    ScriptText script;
    script.command("chain.preset", {{"name", "start"}, {"count", 3}})
        .command("chain.mode", {{"mode", "reach"}})
        .command("chain.target", {{"to", {0.4, 0.004, 0}}})
        .wait(1);
    for (int i = 0; i < 40; ++i)
        script.command("chain.target", {{"to", {0.4 - 0.02 * (i + 1), 0.004, 0}}}).wait(1);
    return script;
}

constexpr const char* straight = "the chain was straight (collinear)";

/// All flips except the first, in which the straight chain bends.
std::vector<Json> flips_of(const Json& state) {
    std::vector<Json> flips;
    for (const Json& event : state.at("events"))
        if (event.at("kind") == "flip" && event.at("cause") != straight) flips.push_back(event);
    return flips;
}

std::size_t number_of(const Json& state, const Json& event) {
    std::size_t number = 0;
    while (state.at("events").at(number) != event) ++number;
    return number;
}

/// The index of the last moment.
int newest_of(ScriptText script) {
    const Json time = state_after(script.command("time.seek", {{"ticks_back", 1}}))["time"];
    return time["moment"].get<int>() + 1;
}

TEST(ChainsPast, AFlipIsMarkedAtItsTickWithItsCause) {
    const Json state = state_after(through_the_root());
    const std::vector<Json> flips = flips_of(state);
    ASSERT_GE(flips.size(), 1u) << state["events"].dump(2);
    for (const Json& flip : flips) EXPECT_TRUE(says(flip["cause"], "target root"));
    EXPECT_EQ(state["events"][0]["cause"], straight);
    EXPECT_GT(flips[0]["degrees"].get<double>(), 30.0);
    // The poses before and after it differ that much.
    const auto tick = flips[0]["tick"].get<int>(), now = newest_of(through_the_root());
    const auto pose_at = [&](int at) {
        return state_after(through_the_root().command("time.seek", {{"ticks_back", now - at}}));
    };
    EXPECT_EQ(flips[0]["joint"], 1) << "the elbow";
    const auto bone = [&](const Json& at, std::size_t to) {
        return glm::normalize(point_of(at["segments"][to]["position"]) -
                              point_of(at["segments"][to - 1]["position"]));
    };
    const Json before = pose_at(tick), after = pose_at(tick + 1);
    float turned = 0.0f;
    for (const std::size_t to : {1u, 2u})
        turned = std::max(turned, glm::degrees(std::acos(glm::dot(bone(before, to), bone(after, to)))));
    EXPECT_NEAR(turned, flips[0]["degrees"].get<float>(), 0.1f);
}

TEST(ChainsPast, ADragIsRememberedTickByTickAndTakenBackBySeeking) {
    const ScriptText reach = ScriptText().command("chain.mode", {{"mode", "reach"}});
    const glm::vec2 at = handle(state_after(reach), "target");
    ScriptText script = reach;
    script.move(at).down();
    for (int i = 1; i <= 20; ++i) script.move(at - glm::vec2(6.0f * static_cast<float>(i), 0.0f));
    ScriptText half = script;
    script.up();
    const Json end = state_after(script);
    EXPECT_EQ(newest_of(script), 21) << "one for the mode, and one for each move of the mouse";
    script.command("time.seek", {{"ticks_back", 20}});
    const Json begin = state_after(script);
    EXPECT_EQ(begin["segments"], state_after(reach)["segments"]);
    EXPECT_EQ(begin["target"], state_after(reach)["target"]);
    // Undo works, and a replay shows it again up to its end, at any speed.
    EXPECT_EQ(state_after(ScriptText(script).command("undo"))["segments"], end["segments"]);
    ScriptText again = script;
    again.command("time.speed", {{"factor", 0.5}}).command("time.replay").wait(20);
    EXPECT_EQ(state_after(again)["time"]["ticks_back"], 10);
    const Json whole = state_after(again.wait(20));
    EXPECT_FALSE(whole["time"].contains("ticks_back")) << "it has come to its end";
    EXPECT_EQ(whole["segments"], end["segments"]);
    EXPECT_EQ(whole["target"], end["target"]);
}

TEST(ChainsPast, AnIncidentIsReachedByItsNumber) {
    const Json state = state_after(through_the_root());
    const std::size_t number = number_of(state, flips_of(state).front());
    const ScriptText script = through_the_root().command("time.incident", {{"number", number}});
    const Json there = state_after(script);
    const int newest = newest_of(through_the_root());
    EXPECT_EQ(there["time"]["ticks_back"], newest - state["events"][number]["tick"].get<int>() - 1);
    EXPECT_EQ(there["events"], state["events"]) << "looking back forgets nothing";
    // A change there replaces what came after it.
    const Json other = state_after(ScriptText(script).command("chain.target", {{"to", {1, 1, 0}}}).wait(1));
    EXPECT_EQ(flips_of(other).size(), 1u) << "those that came after it are forgotten";
    ASSERT_GT(flips_of(state).size(), 1u);
    const ScriptText before = through_the_root().command("time.seek", {{"ticks_back", 30}});
    EXPECT_EQ(
        flips_of(state_after(ScriptText(before).command("chain.target", {{"to", {1, 1, 0}}}).wait(1))).size(),
        0u)
        << "it never came to the flip";
    EXPECT_EQ(play(ScriptText().command("time.incident", {{"number", 0}}, true)).outcome.exit_code, 0);
}

TEST(ChainsPast, ARefusedNumberIsAMarkAndNoFlip) {
    // Typed into the panel; a refused script command leaves no event.
    const ScriptText reach = ScriptText()
                                 .command("chain.mode", {{"mode", "reach"}})
                                 .command("view.fold", chain_panel::unfolded())
                                 .wait(3);
    const Json typed =
        play_refused(ScriptText(reach).click(chain_panel::iterations).wait(2).text("0").key("enter").wait(2))
            .state;
    ASSERT_EQ(typed["events"].size(), 1u);
    EXPECT_EQ(typed["events"][0]["kind"], "status");
    EXPECT_TRUE(says(typed["events"][0]["cause"].get<std::string>(), "iterations 1"));
    const Json told =
        state_after(ScriptText(reach).command("chain.target", {{"to", {1e30, 0, 0}}}, true).wait(1));
    EXPECT_TRUE(told["events"].empty());
}

TEST(ChainsPast, AnAnalysisBeginsWhereTheLastDragBegan) {
    const ScriptText reach = ScriptText().command("chain.mode", {{"mode", "reach"}});
    const Json start = state_after(reach);
    const glm::vec2 at = handle(start, "target");
    ScriptText script = reach;
    script.move(at).down();
    for (int i = 1; i <= 12; ++i) script.move(at + glm::vec2(-25.0f * static_cast<float>(i), -8.0f));
    script.up().command("microscope.open").command("microscope.seek", {{"step", 0}});
    const Json positions = state_after(script)["microscope"]["positions"];
    ASSERT_EQ(positions.size(), start["segments"].size());
    for (std::size_t i = 0; i < positions.size(); ++i)
        EXPECT_EQ(positions[i], start["segments"][i]["position"]) << i;
}

TEST(ChainsPast, AReplayEndsWithThePastItShows) {
    // Another lab, another scene, or undo ends it while it runs.
    for (const char* other : {"lab.open", "scene.new", "undo"}) {
        ScriptText script = through_the_root().command("time.replay").wait(2);
        const Json arguments = std::string(other) == "lab.open" ? Json{{"name", "rope"}} : Json::object();
        EXPECT_EQ(play(script.command(other, arguments).wait(30)).outcome.exit_code, 0) << other;
    }
}

TEST(ChainsPast, AReplayContinuesWithOnlySomeMomentsKept) {
    // A chain this large keeps every fourth moment.
    ScriptText script = ScriptText().command("chain.preset", {{"name", "start"}, {"count", 100000}});
    for (int i = 1; i <= 90; ++i) script.command("chain.target", {{"to", {100, i, 0}}});
    const Json shown = state_after(script.command("time.replay").wait(100));
    EXPECT_FALSE(shown["time"].contains("ticks_back")) << shown["time"];
    EXPECT_EQ(shown["target"], Json::array({100.0, 90.0, 0.0}));
}

TEST(ChainsPast, UndoneMomentsAreStillRemembered) {
    const ScriptText script = ScriptText()
                                  .command("chain.target", {{"to", {5, 1, 0}}})
                                  .command("chain.target", {{"to", {4, 2, 0}}})
                                  .command("undo")
                                  .command("time.seek", {{"ticks_back", 1}});
    EXPECT_EQ(state_after(script)["target"], Json::array({4.0, 2.0, 0.0}));
}

TEST(ChainsPast, SeekingIsNotAnUndoStep) {
    ScriptText script = ScriptText();
    for (int i = 1; i <= 5; ++i) script.command("chain.target", {{"to", {7 - i, i, 0}}}).wait(1);
    const Json end = state_after(script);
    const Json back = state_after(ScriptText(script).command("time.replay").wait(30).command("undo"));
    EXPECT_EQ(back["target"], Json::array({3.0, 4.0, 0.0})) << "the last change, and not the way back";
    EXPECT_EQ(end["target"], Json::array({2.0, 5.0, 0.0}));
}

// The Rig lab's last ten seconds in the running program: flips of bones, and returning to them.

/// The head looks up; then the control for its up direction crosses its line of sight.
ScriptText tilt_past_the_look(int steps = 40) {
    ScriptText script;
    script.command("lab.open", {{"name", "rig"}})
        .command("rig.preset", {{"name", "aim"}})
        .command("rig.control.set", {{"name", "look"}, {"value", {0, 1}}})
        .wait(2)
        .command("rig.control.set", {{"name", "tilt"}, {"value", {0.303, 0.3145, 0.5}}})
        .wait(3);
    for (int i = 1; i <= steps; ++i)
        script.command("rig.control.set", {{"name", "tilt"}, {"value", {0.303 - 0.015 * i, 0.3145, 0.5}}})
            .wait(1);
    return script;
}

const Json& element(const Json& state, const std::string& name) {
    for (const Json& each : state.at("elements"))
        if (each.at("name") == name) return each;
    throw std::runtime_error("there is no element " + name);
}

TEST(RigsPast, AFlipIsMarkedAtItsTickWithBoneUnitAndCause) {
    const Json state = state_after(tilt_past_the_look());
    const std::vector<Json> flips = flips_of(state);
    ASSERT_GE(flips.size(), 1u) << state["events"].dump(2);
    double turned = 0.0;
    for (const Json& flip : flips) {
        EXPECT_EQ(flip["name"], "head");
        EXPECT_EQ(state["elements"].at(flip["joint"].get<std::size_t>())["name"], "head");
        EXPECT_TRUE(says(flip["cause"].get<std::string>(), "unit aim second target"));
        turned += flip["degrees"].get<double>();
    }
    EXPECT_GT(turned, 60.0);
    // The poses before and after it differ by as much as it says.
    const std::size_t number = number_of(state, flips[0]);
    const ScriptText there = tilt_past_the_look().command("time.incident", {{"number", number}});
    const Json after = state_after(there);
    const int back = after["time"]["ticks_back"].get<int>();
    EXPECT_EQ(after["time"]["moment"].get<int>(), flips[0]["tick"].get<int>() + 1);
    const Json before = state_after(ScriptText(there).command("time.seek", {{"ticks_back", back + 1}}));
    const Json &a = element(before, "head")["global"]["rotation"],
               &b = element(after, "head")["global"]["rotation"];
    double dot = 0.0;
    for (std::size_t i = 0; i < 4; ++i) dot += a[i].get<double>() * b[i].get<double>();
    EXPECT_NEAR(2.0 * std::acos(std::min(1.0, std::abs(dot))) * 180.0 / 3.14159265,
                flips[0]["degrees"].get<double>(), 0.1);
    EXPECT_EQ(after["events"], state["events"]) << "looking back forgets nothing";
}

TEST(RigsPast, APausedDragIsRememberedAndMarkedToo) {
    ScriptText script;
    script.command("lab.open", {{"name", "rig"}}).command("rig.preset", {{"name", "aim"}});
    script.command("rig.control.set", {{"name", "look"}, {"value", {0, 1}}}).wait(3).command("time.pause");
    for (int i = 0; i <= 40; ++i)
        script.command("rig.control.set", {{"name", "tilt"}, {"value", {0.303 - 0.015 * i, 0.3145, 0.5}}})
            .command("rig.solve")
            .wait(1);
    const std::vector<Json> flips = flips_of(state_after(script));
    ASSERT_GE(flips.size(), 1u);
    EXPECT_EQ(flips[0]["name"], "head");
}

TEST(RigsPast, TheSelectionDoesNotGoBackInTime) {
    const ScriptText script = tilt_past_the_look(10)
                                  .command("rig.select", {{"element", "nose"}})
                                  .command("time.seek", {{"ticks_back", 8}});
    EXPECT_EQ(state_after(script)["selected"]["element"], "nose");
}

}  // namespace
}  // namespace tendril::test
