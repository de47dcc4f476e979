// Time in the Rig lab of the running program: the strip below the scene, and long work in small slices.
#include "app/labs/rig/rig_lab.hpp"
#include "tests/app/e2e/monkey.hpp"
#include "tests/says.hpp"

namespace tendril::test {
namespace {

using namespace app;

void walking_head(App& app) {
    app.run({"lab.open", Json{{"name", rig_lab}}});
    app.run({"rig.preset", Json{{"name", "secondary"}}});
    app.run({"rig.motion", Json{{"name", "head"}, {"path", "circle"}, {"period", 1.5}}});
}
void send(App& app, const Event& event) {
    app.tick(&event);
}
constexpr float left = 443.5f, right = 988.5f, y = 677.0f;  ///< of the strip, in a window of 1280 x 720
/// Presses on the strip at the first of these seconds, and drags the playhead to each of the others.
void scrub(App& app, const std::vector<float>& seconds) {
    const auto at = [&](float s) { return MouseMove{{left + (right - left) * s / 10.0f, y}}; };
    send(app, at(seconds.front()));
    send(app, MousePress{MouseButton::Left, true});
    for (const float each : seconds) send(app, at(each));
    send(app, MousePress{MouseButton::Left, false});
}
const RigPart& part_of(App& app) {
    return rig_part(app.workspace());
}

class RigTimeApp : public testing::Test {
  protected:
    std::unique_ptr<Window> window_ = open_offscreen({1280, 720});
    App app_{*window_, false};
};

TEST_F(RigTimeApp, TheStripIsDraggedToAnyTickOfTheTake) {
    walking_head(app_);
    std::vector<rig::State> states{part_of(app_).state};
    for (int i = 0; i < 240; ++i) {
        app_.tick(nullptr);
        states.push_back(part_of(app_).state);
    }
    for (const float seconds : {3.0f, 0.5f, 2.25f, 0.0f, 3.9f}) {
        scrub(app_, {1.0f, seconds});
        const std::uint64_t tick = part_of(app_).take.now();
        EXPECT_NEAR(static_cast<double>(tick), 60.0 * static_cast<double>(seconds), 1.0);
        EXPECT_EQ(part_of(app_).state, states[tick]) << tick;
        EXPECT_FALSE(app_.workspace().clock.playing);
    }
    EXPECT_DOUBLE_EQ(app_.state().at("time").at("seconds").get<double>(),
                     static_cast<double>(part_of(app_).take.now()) * tick_seconds);
    EXPECT_EQ(app_.workspace().history.size(), 2u) << "the preset and the walk";
}

/// A click in a tick of its own.
void click(App& app, glm::vec2 at) {
    send(app, MouseMove{at});
    send(app, MousePress{MouseButton::Left, true});
    send(app, MousePress{MouseButton::Left, false});
    app.tick(nullptr);
}
constexpr glm::vec2 replay{297.0f, 664.0f}, other_strip{338.0f, 664.0f}, back{378.0f, 664.0f},
    on{411.0f, 664.0f};

TEST_F(RigTimeApp, ReplayRepeatsItAndTheStripStaysInPlace) {
    walking_head(app_);
    for (int i = 0; i < 120; ++i) app_.tick(nullptr);
    const std::uint64_t end = part_of(app_).take.now();
    click(app_, replay);
    EXPECT_TRUE(app_.workspace().clock.replaying);
    EXPECT_LT(part_of(app_).take.now(), 20u);
    click(app_, replay);
    EXPECT_FALSE(app_.workspace().clock.replaying) << "paused";
    const std::uint64_t paused = part_of(app_).take.now();
    for (int i = 0; i < 10; ++i) app_.tick(nullptr);
    EXPECT_EQ(part_of(app_).take.now(), paused);
    click(app_, on);
    EXPECT_EQ(part_of(app_).take.now(), paused + 1);
    click(app_, back);
    click(app_, back);
    EXPECT_EQ(part_of(app_).take.now(), paused - 1);
    click(app_, replay);
    for (int i = 0; i < 200; ++i) app_.tick(nullptr);
    EXPECT_FALSE(app_.workspace().clock.replaying);
    EXPECT_GE(part_of(app_).take.now(), end);
}

TEST_F(RigTimeApp, TheOtherStripIsOneClickAway) {
    walking_head(app_);
    for (int i = 0; i < 60; ++i) app_.tick(nullptr);
    click(app_, other_strip);
    EXPECT_EQ(app_.workspace().settings.choices.at("rig_strip"), "past");
    click(app_, other_strip);
    EXPECT_EQ(app_.workspace().settings.choices.at("rig_strip"), "take");
}

TEST_F(RigTimeApp, AMarkIsClicked) {
    app_.run({"lab.open", Json{{"name", rig_lab}}});
    app_.run({"rig.preset", Json{{"name", "fk"}}});
    const auto dial = [&](double to, int ticks) {
        for (int i = 1; i <= ticks; ++i) {
            app_.run({"rig.control.set", Json{{"name", "dial"}, {"value", to * i / ticks}}});
            app_.tick(nullptr);
        }
    };
    dial(1.0, 120);
    const auto incidents = app_.workspace().rewind.incidents();
    ASSERT_EQ(incidents.size(), 2u) << "it leaves its minimum, and comes to its maximum";
    click(app_, {left + (right - left) * 0.02f / 10.0f, y - 4.0f});
    ASSERT_TRUE(app_.workspace().ui.incident);
    EXPECT_TRUE(test::says(app_.workspace().ui.incident->cause, "dial left minimum 0.00"));
    EXPECT_NEAR(std::get<double>(part_of(app_).state->controls[0]), 0.0, 0.03);
    scrub(app_, {1.0f, 0.5f});
    EXPECT_FALSE(app_.workspace().ui.incident) << "one looks elsewhere";
}

TEST_F(RigTimeApp, AClipIsSolvedInAPauseAndStaysResponsive) {
    walking_head(app_);
    app_.run({"time.pause"});
    app_.run({"rig.clip.record", Json{{"seconds", 1.0}}});
    app_.run({"rig.clip.solve"});
    EXPECT_TRUE(app_.needs_ticks());
    int ticks = 0;
    for (; app_.needs_ticks() && ticks < 600; ++ticks) app_.tick(nullptr);
    EXPECT_FALSE(part_of(app_).clip_left->running);
    EXPECT_GT(ticks, 5);
    EXPECT_EQ(part_of(app_).take.now(), 0u);
    app_.run({"undo"});
    EXPECT_EQ(part_of(app_).clip_left, nullptr);
}

}  // namespace
}  // namespace tendril::test
