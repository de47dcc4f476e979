// Time in the Rig lab: seeking to any tick of a take, in any order, gives bitwise the same as playing.
#include <random>

#include "app/labs/rig/rig_runtime.hpp"
#include "app/labs/rig/take.hpp"
#include "rig_support.hpp"

namespace tendril::app {
namespace {

class RigTime : public RigTest {
  protected:
    void walk(const Json& more = Json::object()) {
        Json arguments{{"name", "head"}, {"path", "figure_eight"}, {"radius", 0.6}, {"period", 1.7}};
        arguments.update(more);
        run("rig.motion", arguments);
    }
    void secondary() {
        run("rig.preset", {{"name", "secondary"}});
        walk();
    }
    void go(std::uint64_t tick) { run("rig.time", {{"tick", tick}}); }
    /// Plays and returns the states, starting with the present one.
    std::vector<rig::State> play(int ticks) {
        std::vector<rig::State> states{part().state};
        for (int i = 0; i < ticks; ++i) {
            lab().step(workspace);
            states.push_back(part().state);
        }
        return states;
    }
    void expect_scrubs(const std::vector<rig::State>& states, int times, unsigned seed,
                       std::uint64_t began = 0) {
        std::mt19937 random(seed);
        for (int i = 0; i < times; ++i) {
            const std::size_t tick = random() % states.size();
            go(began + tick);
            ASSERT_EQ(part().state, states[tick]) << tick;
            ASSERT_EQ(part().take.now(), began + tick);
        }
    }
    glm::dvec3 head() const { return translation("head"); }
    static Json at(double x, double y, double z) { return {{"translation", {x, y, z}}}; }
};

TEST_F(RigTime, AControlFollowsItsPathFromItsPosition) {
    run("rig.preset", {{"name", "secondary"}});
    const glm::dvec3 start = head();
    run("rig.motion", {{"name", "head"}, {"path", "circle"}, {"radius", 0.5}, {"period", 2.0}});
    for (int i = 1; i <= 120; ++i) {
        lab().step(workspace);
        EXPECT_NEAR(glm::distance(head(), start - glm::dvec3(0.5, 0, 0)), 0.5, 1e-6) << i;
        EXPECT_EQ(head().y, start.y);
    }
    EXPECT_NEAR(glm::distance(head(), start), 0.0, 1e-6) << "one round";
    EXPECT_EQ(state().at("motions").at("head").at("path"), "circle");
    run("undo");
    EXPECT_TRUE(part().walks.empty());
}

TEST_F(RigTime, AWalkStopsAtTheLimitsAndTurnsAlongItsPath) {
    control("place", "position", {{"maximum", {0.2, 1, 1}}, {"minimum", {-1, -1, -1}}});
    run("rig.motion", {{"name", "place"}, {"path", "sweep"}, {"radius", 0.5}});
    double most = -1.0;
    for (int i = 0; i < 240; ++i) {
        lab().step(workspace);
        most = std::max(most, translation("place").x);
    }
    EXPECT_EQ(most, 0.2);
    run("rig.preset", {{"name", "secondary"}});
    run("rig.motion", {{"name", "head"}, {"path", "circle"}, {"turn", true}});
    for (int i = 0; i < 50; ++i) {
        const glm::dvec3 before = head();
        lab().step(workspace);
        const glm::dvec3 along = glm::normalize(head() - before);
        const glm::dvec3 looks = rotation("head") * glm::dvec3(0, 0, 1);
        EXPECT_GT(glm::dot(along, looks), 0.999);
    }
}

TEST_F(RigTime, AChangedWalkContinuesFromItsPosition) {
    secondary();
    run("rig.motion", {{"name", "head"}, {"path", "circle"}, {"radius", 0.5}, {"period", 2.0}});
    play(33);
    const glm::dvec3 centre(part().walks.front().motion.centre), before = head();
    const auto change = [&](const char* what, const Json& value) {
        run("rig.motion", {{"name", "head"}, {"path", "circle"}, {what, value}});
        lab().step(workspace);
        const glm::dvec3 now = head();
        run("undo");
        return now;
    };
    lab().step(workspace);
    const glm::dvec3 next = head();
    go(33);
    EXPECT_LT(glm::distance(change("turn", true), next), 1e-6);
    // One tick with three times the period moves a third as far.
    EXPECT_LT(glm::distance(change("period", 6.0), glm::mix(before, next, 1.0 / 3.0)), 1e-3);
    EXPECT_LT(glm::distance(change("radius", 0.25), glm::mix(centre, next, 0.5)), 1e-6);
    EXPECT_LT(glm::distance(change("centre", {1, 1, 2}), next - centre + glm::dvec3(1, 1, 2)), 1e-6);
    run("rig.motion", {{"name", "head"}, {"path", "sweep"}});
    EXPECT_LT(glm::distance(head(), before), 1e-9) << "another path starts where the control is";
    lab().step(workspace);
    EXPECT_LT(glm::distance(head(), before), 0.05);
}

TEST_F(RigTime, AnyTickInAnyOrderEqualsPlaying) {
    secondary();
    const auto states = play(600);
    expect_scrubs(states, 200, 1);
    go(600);
    const auto on = play(30);
    go(620);
    EXPECT_EQ(part().state, on[20]);
}

TEST_F(RigTime, TheSameAfterUndoAndBeforeAnythingWasPlayed) {
    secondary();
    const Document before = workspace.document;
    const auto states = play(200);
    run("rig.unit.enable", {{"name", "trail"}, {"on", false}});
    play(50);
    run("undo");
    EXPECT_EQ(part().state, states[200]);
    expect_scrubs(states, 50, 4);
    run("redo");
    EXPECT_EQ(part().take.began, 200u);
    workspace.document = before;
    workspace.runtimes.clear();
    for (const std::size_t tick : {150u, 3u, 200u, 77u, 0u, 1u}) {
        go(tick);
        EXPECT_EQ(part().state, states[tick]) << tick;
    }
}

TEST_F(RigTime, SettingAPastTickDropsLaterValues) {
    run("rig.preset", {{"name", "secondary"}});
    play(10);
    const rig::State before = part().state;
    set("head", at(0.5, 1, 0));
    play(10);
    go(10);
    EXPECT_EQ(part().state, before);
    EXPECT_TRUE(lab().moving(workspace)) << "the control is still to move";
    set("head", at(-0.5, 1, 0));
    ASSERT_EQ(part().take.keys->size(), 1u);
    const auto states = play(10);
    EXPECT_LT(head().x, 0.0);
    go(15);
    EXPECT_EQ(part().state, states[5]);
}

/// Any other change starts a take, and time continues.
TEST_F(RigTime, AnEditInTheMiddleStartsATake) {
    secondary();
    const auto first = play(100);
    run("rig.unit.enable", {{"name", "trail"}, {"on", false}});
    EXPECT_EQ(part().take.began, 100u);
    EXPECT_DOUBLE_EQ(lab().seconds(workspace), 100.0 / 60.0);
    const auto second = play(50);
    EXPECT_NEAR(glm::distance(glm::dvec3(part().walks.front().motion.centre), head()), 0.6, 0.6);
    expect_scrubs(second, 30, 7, 100);
    expect_refused("rig.time", {{"tick", 99}}, {"begins at tick 100", "99"});
    run("rig.preset", {{"name", "secondary"}});
    EXPECT_EQ(part().take.now(), 0u);
    EXPECT_EQ(lab().seconds(workspace), 0.0);
    go(40);
    EXPECT_EQ(part().take.now(), 40u);
}

/// The path continues from its position, up to rounding, whatever else starts a take.
TEST_F(RigTime, AWalkContinuesOverAnEdit) {
    secondary();
    const auto states = play(80);
    go(33);
    run("rig.unit.enable", {{"name", "trail"}, {"on", false}});
    lab().step(workspace);
    const std::size_t at = *part().rig.element("head");
    EXPECT_EQ(part().state->controls[at], states[34].controls[at]);
}

TEST_F(RigTime, SlowMotionShowsTheSamePoses) {
    secondary();
    const Document before = workspace.document;
    const auto states = play(60);
    workspace.document = before;
    workspace.clock.speed = 0.25f;
    std::size_t distinct = 0;
    for (int i = 0; i < 240; ++i) {
        lab().step(workspace);
        workspace.clock.passed += static_cast<double>(workspace.clock.speed);
        distinct = part().take.tick;
        ASSERT_EQ(part().state, states[distinct]);
    }
    EXPECT_EQ(distinct, 60u);
}

TEST_F(RigTime, ALongTakeContinuesAsANewOne) {
    control("dial", "position");
    run("rig.motion", {{"name", "dial"}, {"path", "circle"}});
    go(max_take_ticks - 1);
    play(3);
    EXPECT_EQ(part().take.began, max_take_ticks);
    EXPECT_EQ(part().take.now(), max_take_ticks + 2);
}

TEST_F(RigTime, PassingTimeNeedsNoSaveAndNoUndo) {
    secondary();
    workspace.saved = workspace.document;
    const std::size_t steps = workspace.history.size();
    go(100);
    play(5);
    EXPECT_FALSE(workspace.modified());
    EXPECT_EQ(workspace.history.size(), steps);
    EXPECT_FALSE(workspace.clock.playing) << "going somewhere pauses";
}

TEST_F(RigTime, Refusals) {
    secondary();
    expect_refused("rig.time", Json::object(), {"either a tick or seconds"});
    expect_refused("rig.time", {{"tick", 1}, {"seconds", 1}}, {"either a tick or seconds"});
    expect_refused("rig.time", {{"tick", 1000000000}}, {"36000 ticks", "1000000000"});
    expect_refused("rig.motion", {{"name", "skull"}, {"path", "circle"}}, {"\"skull\" is not a control"});
    expect_refused("rig.motion",
                   {{"name", "head"}, {"path", "circle"}, {"centre", {1e9, 1, 1}}, {"radius", 1e4}},
                   {"farther than 1e9 m"});
    control("dial", "float");
    expect_refused("rig.motion", {{"name", "dial"}, {"path", "circle"}}, {"\"dial\" is a float control"});
    control("place", "position");
    expect_refused("rig.motion", {{"name", "place"}, {"path", "circle"}, {"turn", true}}, {"transform"});
}

TEST_F(RigTime, ARemovedControlNoLongerWalks) {
    control("place", "position");
    run("rig.motion", {{"name", "place"}, {"path", "circle"}});
    play(10);
    run("rig.element.remove", {{"name", "place"}});
    EXPECT_TRUE(part().walks.empty());
    play(3);
    run("undo");
    EXPECT_EQ(part().walks.size(), 1u);
}

/// The same motion at any frame rate, except for the interaction of springs within a frame.
TEST_F(RigTime, FrameRatesAreComparedAsOneNumber) {
    expect_refused("rig.rates", Json::object(), {"nothing has been played yet"});
    secondary();
    run("rig.rates");
    const Json rates = state().at("rates");
    EXPECT_GT(rates.at("mm"), 0.0);
    EXPECT_GT(rates.at("degrees"), 0.0);
    EXPECT_NE(rates.at("bone"), "");
    EXPECT_EQ(rates.at("between").get<std::string>().find("15 Hz and "), 0u) << rates.at("between");
    EXPECT_EQ(Workspace(reopened()).document.get<RigPart>(rig_lab).rates, part().rates);
    play(5);
    EXPECT_FALSE(state().at("rates").is_null()) << "that time passes changes nothing about them";
    run("rig.unit.enable", {{"name", "trail"}, {"on", false}});
    EXPECT_TRUE(state().at("rates").is_null());
    run("rig.rates");
    EXPECT_LT(state().at("rates").at("mm"), 1e-6) << "nothing remembers";
}

TEST_F(RigTime, FrameRatesDifferByScaleToo) {
    element("bone");
    control("dial", "float");
    unit(R"({"unit": "spring_interpolate", "name": "one", "target": {"element": "dial", "of": "value"}})");
    unit(R"({"unit": "spring_interpolate", "name": "two", "target": {"unit": "one"}, )"
         R"("critical_damping": 1})");
    unit(R"({"unit": "set_transform", "item": "bone", "transform": {"scale": [3, 1, 1]}, )"
         R"("weight": {"unit": "two"}})");
    play(4);
    set("dial", 0.9);
    play(60);
    run("rig.rates");
    const Json rates = state().at("rates");
    EXPECT_EQ(rates.at("mm"), 0.0);
    EXPECT_GT(rates.at("scale"), 0.001);
    EXPECT_EQ(rates.at("bone"), "bone");
    EXPECT_GT(rates.at("seconds"), 0.0);
    EXPECT_EQ(Workspace(reopened()).document.get<RigPart>(rig_lab).rates, part().rates);
}

/// A single spring is exact at any frame rate: the control is set where a frame of each rate begins.
TEST_F(RigTime, ASpringAloneIsTheSameAtAllRates) {
    control("place", "position", {{"local", {{"translation", {0, 0, 1}}}}});
    element("bone");
    element("tip", "bone", transform(0, 0, 1));
    unit(R"({"unit": "spring_interpolate", "name": "spring", "target": {"element": "place", )"
         R"("of": "translation"}, "strength": 2})");
    unit(R"({"unit": "aim", "item": "bone", "primary": {"axis": [0, 0, 1], "target": {"unit": "spring"}}})");
    play(4);
    set("place", {1, 0, 1});
    play(120);
    run("rig.rates");
    EXPECT_GT(glm::distance(translation("tip"), glm::dvec3(0, 0, 1)), 0.3) << "it turns";
    EXPECT_LT(state().at("rates").at("mm"), 1e-3);
    EXPECT_LT(state().at("rates").at("degrees"), 1e-4);
}

// Comparing frame rates tick by tick, as in the window.

class RigRates : public RigTest {
  protected:
    RigRates() {
        run("rig.preset", {{"name", "secondary"}});
        run("rig.motion", {{"name", "head"}, {"path", "figure_eight"}, {"radius", 0.6}, {"period", 1.7}});
    }
};

TEST_F(RigRates, OfAnEarlierTakeAreNoLongerShown) {
    run("rig.rates");
    ASSERT_TRUE(part().rates);
    // As after a backward solve that found other values for the controls.
    begin_take(workspace.document.edit<RigPart>(rig_lab));
    EXPECT_FALSE(part().rates);
}

/// The result is the same however it is divided into ticks, restarted, or loaded from a file half way.
TEST_F(RigRates, FrameRatesAreComparedFromTickToTick) {
    Workspace other = workspace;
    run("rig.rates");
    EXPECT_FALSE(lab().working(workspace)) << "a script's next line finds it done";
    const RateDifference at_once = *part().rates;
    EXPECT_GT(at_once.mm, 1.0);
    workspace = other;
    begin("rig.rates");
    int ticks = 0;
    for (; lab().working(workspace) && ticks < 1000; ++ticks) {
        if (ticks % 2 == 1) workspace.runtimes.clear();
        if (ticks % 3 == 2) {
            Workspace again = reopened();
            ASSERT_EQ(rig_part(again).rates, part().rates) << ticks;
            workspace.document = again.document;
        }
        if (ticks == 3) tick(2);
        lab().work(workspace);
    }
    EXPECT_GT(ticks, 5);
    EXPECT_EQ(*part().rates, at_once);
}

TEST_F(RigRates, AComparisonOfFrameRatesIsCancelledAndEndsWithItsTake) {
    expect_refused("rig.rates.cancel", Json::object(), {"no frame rates are being compared"});
    begin("rig.rates");
    lab().work(workspace);
    ASSERT_TRUE(lab().working(workspace));
    const std::size_t done = part().rates->done;
    run("rig.rates.cancel");
    EXPECT_FALSE(part().rates);
    run("undo");
    EXPECT_EQ(part().rates->done, done);
    run("rig.motion", {{"name", "head"}, {"path", "figure_eight"}});
    EXPECT_FALSE(lab().working(workspace)) << "it was of the take so far";
    run("undo");
    set("head", {{"translation", {0.3, 1, 0}}});
    EXPECT_FALSE(lab().working(workspace));
}

}  // namespace
}  // namespace tendril::app
