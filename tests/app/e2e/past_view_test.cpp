// The plot and the past poses of the last ten seconds in the running program, in every lab that has joints.
#include <array>

#include "app/labs/humanoid/humanoid_runtime.hpp"
#include "app/live_loop.hpp"
#include "tests/app/support/play.hpp"
#include "tests/places.hpp"

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

TEST(PastViews, StayWhatTheyAreWhenOneGoesBack) {
    for (const PlottedLab& lab : plotted_labs()) {
        const Json end = state_after(shown(lab).wait(70))["past"]["plot"]["values"];
        const Json back =
            state_after(shown(lab).wait(70).command("time.seek", {{"ticks_back", 30}}).wait(3))["past"];
        for (std::size_t i = 0; i < 60; ++i) EXPECT_EQ(back["plot"]["values"][i], end[i]) << lab.lab << i;
    }
}

TEST(PastViews, AreSettingsAndNothingToUndoOrToSave) {
    for (const PlottedLab& lab : plotted_labs()) {
        const ScriptText script = ScriptText(lab.scene).command("time.pause").wait(1);
        const Json plain = state_after(script);
        const Json with = state_after(ScriptText(script)
                                          .command(view(lab, "_plot"), {{"of", lab.of}})
                                          .command(view(lab, "_ghosts"), {{"of", "past"}}));
        EXPECT_EQ(with.value("modified", false), plain.value("modified", false)) << lab.lab;
        EXPECT_TRUE(plain["past"]["plot"].is_null());
        EXPECT_EQ(with["past"]["plot"]["of"], lab.of);
        // Each without an argument selects the next choice, in the end the first one.
        const Json off = state_after(
            ScriptText(script).command(view(lab, "_ghosts"), {{"of", "past"}}).command(view(lab, "_ghosts")));
        EXPECT_EQ(off["past"], plain["past"]) << lab.lab;
    }
}

TEST(PastViews, ChangeNothingOfWhatIsShownBesides) {
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

TEST(PastViews, UndoUnderAHandThatKeepsStillIsNotDraggedBack) {
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

TEST(PastViews, GhostsAreOfWhatHasTheJointsThatThereAreNow) {
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
    for (std::size_t lab = 0; lab < labs.size(); ++lab) {
        for (const Change& change : changes[lab]) {
            const ScriptText script =
                shown(labs[lab]).wait(100).command("time.pause").wait(1).lines(change.to).wait(2);
            const Json ghosts = state_after(script)["past"]["ghosts"];
            EXPECT_EQ(ghosts.empty(), change.other_joints) << labs[lab].lab << "\n" << change.to.text();
            const Json back = state_after(ScriptText(script).command("undo").wait(1))["past"]["ghosts"];
            EXPECT_GE(back.size(), 3u) << labs[lab].lab << " as it was before\n" << change.to.text();
        }
    }
}

/// Each lab with its strip of the last ten seconds above the plot, paused.
ScriptText below_the_strip(const PlottedLab& lab) {
    ScriptText script = shown(lab).wait(420).command("time.pause");
    if (std::string(lab.lab) == "rig") script.command("view.rig_strip", {{"of", "past"}});
    return script.wait(2);
}

TEST(PastViews, AClickInThePlotGoesToTheMomentThatTheStripHasAtThatPlace) {
    constexpr float strip = 546.0f, plot = 615.0f;
    constexpr std::array places{600.0f, 607.0f, 633.0f, 641.0f};
    for (const PlottedLab& lab : plotted_labs()) {
        const TempFolder folder;
        ScriptText script = below_the_strip(lab);
        if (std::string(lab.lab) == "humanoid") script.click({405.0f, 534.0f});  // Past
        int count = 0;
        for (const float y : {strip, plot})
            for (const float x : places)
                press_at(script, {x, y})
                    .up()
                    .wait(1)
                    .line({{"state", (folder / std::to_string(count++)).string()}});
        play(script);
        std::vector<std::uint64_t> moments;
        for (int i = 0; i < count; ++i)
            moments.push_back(
                app::parse_json(read(folder / std::to_string(i)))["time"]["moment"].get<std::uint64_t>());
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

    /// With the present one.
    std::size_t moments() { return app_.workspace().rewind.size() + 1; }

    std::unique_ptr<app::Window> window_ = app::open_offscreen({1000, 700});
    app::App app_{*window_};
    std::atomic<bool> ending_{false};
    app::LiveLoop loop_{app_, *window_, {.config = false, .ending = ending_}};
    app::Player player_{app::Script{}};
};

TEST_F(LivePlot, ComesInSharesWhileThePausedWindowGoesOnDrawing) {
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

TEST_F(LivePlot, IsWholeInAPictureAndInTheState) {
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

}  // namespace
}  // namespace tendril::test
