// The Rig lab in the running program: dragging controls, lists with filters, and the strip below the scene.
#include <optional>

#include "rig_support.hpp"
#include "tests/app/support/frame_record.hpp"

namespace tendril::test {
namespace {

using namespace app;

class RigApp : public RigAppTest {
  protected:
    void drag(const std::string& name, glm::vec2 by) {
        LabAppTest::drag(at(name), {0.25f * by, 0.5f * by, by});
    }
};

TEST_F(RigApp, ADragInItsRectangleFollowsThePointer) {
    const glm::vec2 by(40.0f, 25.0f), from = handle(app_.state(), "look");
    drag("look", by);
    const glm::vec2 to = handle(app_.state(), "look");
    EXPECT_LT(glm::distance(to, from + by), 1.0f) << "it moves in its own plane, under the pointer";
}

/// Real keys in an input's list: Enter chooses the highlighted hit, arrows move it, Escape clears.
TEST_F(RigApp, AFilteredListTakesEnterArrowsAndEscape) {
    const std::string first_source = "look 1 1";  // its translation in the scene
    const auto keys = [&](const std::vector<const char*>& pressed) {
        run("rig.select");
        run("rig.select", {{"element", "head"}, {"unit", "aim"}});
        wait(3);
        click({1190.0f, 413.0f}, 30);
        type(pressed);
        const RigPart& part = rig_part(app_.workspace());
        const auto& aim = std::get<rig::Aim>(part.rig.definition().units[1].operation);
        const auto& from = std::get<rig::FromElement>(aim.primary.target.source);
        const std::string found = std::get<std::string>(from.element.which);
        const std::string whole = found + " " + std::to_string(static_cast<int>(from.of)) + " " +
                                  std::to_string(static_cast<int>(from.space));
        if (whole != first_source) run("undo");
        wait(30);
        return whole;
    };
    EXPECT_EQ(keys({"TILT, tr", "enter"}), "tilt 1 1");
    EXPECT_EQ(keys({"TILT, tr"}), first_source) << "typing alone chooses nothing";
    EXPECT_EQ(keys({"escape", "escape"}), first_source);
    EXPECT_EQ(keys({"nothing has this", "enter", "escape", "TILT, tr", "enter"}), "tilt 1 1")
        << "Escape clears the text and the list stays open";
    const std::string second = keys({"translation", "down", "enter"});
    EXPECT_NE(second, keys({"translation", "enter"}));
    EXPECT_EQ(keys({"translation", "down", "down", "up", "enter"}), second);
    EXPECT_EQ(keys({"TILT, tr", "down", "down", "down", "enter"}), "tilt 1 0") << "past the end it stays";
}

TEST_F(RigApp, TheTreesFilterTakesEnterAndArrows) {
    run("rig.preset", {{"name", "loop"}});
    run("view.fold", {{"section", "rig: Elements"}, {"folded", false}});
    wait(3);
    const auto& elements = rig_part(app_.workspace()).rig.definition().elements;
    ASSERT_GT(elements.size(), 12u) << "the tree has a filter";
    FrameRecorder recorder;
    wait(3);
    std::optional<glm::vec2> at, mirror;
    for (const DrawnText& each : recorder.frame().texts) {
        if (each.text == "Filter by name") at = 0.5f * (each.box.min + each.box.max);
        if (each.text == "Mirror") mirror = 0.5f * (each.box.min + each.box.max);
    }
    ASSERT_TRUE(at && mirror);
    const auto keys = [&](const std::vector<const char*>& pressed) {
        click(*at, 30);
        type(pressed);
        return rig_part(app_.workspace()).selected_element();
    };
    const std::string first = keys({"joint", "enter"});
    EXPECT_TRUE(has(first, "joint"));
    const std::string second = keys({"escape", "down", "down", "enter"});
    EXPECT_NE(second, "");
    EXPECT_NE(second, first) << "the whole tree again, and its second row";
    run("rig.select", {{"element", "arm 2"}});
    click(*mirror, 3);
    const Json from = element("arm 2").at("local"), to = element("arm 2 mirrored").at("local");
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_NEAR(to.at("translation")[i].get<double>(),
                    (i == 0 ? -1.0 : 1.0) * from.at("translation")[i].get<double>(), 1e-9);
    EXPECT_NEAR(to.at("rotation")[1].get<double>(), -from.at("rotation")[1].get<double>(), 1e-9);
    EXPECT_EQ(element("arm 2 joint 6 mirrored").at("parent"), "arm 2 joint 5 mirrored");
    const RigPart& part = rig_part(app_.workspace());
    EXPECT_EQ(part.selected_element(), "arm 2 mirrored");
    const auto& mirrored_curl = std::get<rig::ForEach>(part.rig.definition().units[1].operation);
    EXPECT_EQ(mirrored_curl.roots, (std::vector<std::string>{"arm 2 mirrored"})) << "it curls the other way";
}

TEST_F(RigApp, ReasonsForUnitsThatCannotBeAddedAreWhole) {
    run("rig.clear");
    run("rig.element.add", {{"name", "head"}, {"kind", "bone"}});
    run("rig.unit.add", {{"unit", "for_each"}, {"roots", {"head"}}});
    FrameRecorder recorder;
    wait(3);
    const auto is = [](const char* text) { return [=](const DrawnText& each) { return each.text == text; }; };
    const auto button = std::ranges::find_if(recorder.frame().texts, is("Add a unit"));
    ASSERT_NE(button, recorder.frame().texts.end());
    click(0.5f * (button->box.min + button->box.max), 3);
    int reasons = 0;
    for (const DrawnText& each : recorder.frame().texts) {
        if (each.text.find(": ") == std::string::npos || each.box.min.y < 100.0f) continue;
        ++reasons;
        EXPECT_LE(each.box.max.x, each.clip.max.x) << each.text;
    }
    EXPECT_GE(reasons, 4);
}

TEST_F(RigApp, AUnitIsRenamedInItsPanel) {
    run("rig.select", {{"element", "head"}, {"unit", "aim"}});
    wait(3);
    FrameRecorder recorder;
    const auto rename = [&](const char* text, const char* key = "enter") {
        app_.tick(nullptr);
        float height = 0.0f;
        for (const DrawnText& each : recorder.frame().texts)
            if (each.text == "name") height = 0.5f * (each.box.min.y + each.box.max.y);
        click({1186.0f, height}, 30);
        send(TextInput{text});
        if (key != nullptr) send(KeyTap{*chord_from_name(key)});
        wait(3);
    };
    const auto selected = [&] { return rig_part(app_.workspace()).selected.unit; };
    rename("set head");
    EXPECT_TRUE(says(app_.workspace().ui.toasts.back().text, "already unit set head"));
    EXPECT_EQ(selected(), "aim");
    rename("gaze");
    EXPECT_EQ(selected(), "gaze");
    run("undo");
    EXPECT_EQ(selected(), "aim");
    rename("gaze", "escape");
    EXPECT_EQ(selected(), "aim") << "Escape puts the name back";
    for (const glm::vec2 elsewhere : {glm::vec2(640.0f, 660.0f), glm::vec2(60.0f, 60.0f)}) {
        rename("gaze", nullptr);
        EXPECT_EQ(selected(), "aim") << "not before it is left";
        click(elsewhere, 30);
        const auto names = rig_part(app_.workspace()).rig.unit_names();
        EXPECT_TRUE(std::ranges::find(names, "gaze") != names.end()) << "left by a click elsewhere";
        run("rig.preset", {{"name", "aim"}});
        run("rig.select", {{"element", "head"}, {"unit", "aim"}});
        wait(3);
    }
}

// Time in the Rig lab of the running program: the strip below the scene, and long work in small slices.

constexpr float left = 443.5f, right = 988.5f, y = 677.0f;  ///< of the strip, in a window of 1280 x 720
constexpr glm::vec2 replay{297.0f, 664.0f}, other_strip{338.0f, 664.0f}, back{378.0f, 664.0f},
    on{411.0f, 664.0f};

class RigTimeApp : public LabAppTest {
  protected:
    RigTimeApp() : LabAppTest(rig_lab, false) {}

    void walking_head() {
        run("rig.preset", {{"name", "secondary"}});
        run("rig.motion", {{"name", "head"}, {"path", "circle"}, {"period", 1.5}});
    }
    /// Presses on the strip at the first of these seconds, and drags the playhead to each of the others.
    void scrub(const std::vector<float>& seconds) {
        const auto at = [&](float s) { return MouseMove{{left + (right - left) * s / 10.0f, y}}; };
        send(at(seconds.front()));
        press(true);
        for (const float each : seconds) send(at(each));
        press(false);
    }
    const RigPart& part() { return rig_part(app_.workspace()); }
    std::uint64_t now() { return part().take.now(); }
};

TEST_F(RigTimeApp, TheStripIsDraggedToAnyTickOfTheTake) {
    walking_head();
    std::vector<rig::State> states{part().state};
    for (int i = 0; i < 240; ++i) {
        app_.tick(nullptr);
        states.push_back(part().state);
    }
    for (const float seconds : {3.0f, 0.5f, 2.25f, 0.0f, 3.9f}) {
        scrub({1.0f, seconds});
        const std::uint64_t tick = now();
        EXPECT_NEAR(static_cast<double>(tick), 60.0 * static_cast<double>(seconds), 1.0);
        EXPECT_EQ(part().state, states[tick]) << tick;
        EXPECT_FALSE(app_.workspace().clock.playing);
    }
    EXPECT_DOUBLE_EQ(app_.state().at("time").at("seconds").get<double>(),
                     static_cast<double>(now()) * tick_seconds);
    EXPECT_EQ(app_.workspace().history.size(), 2u) << "the preset and the walk";
}

TEST_F(RigTimeApp, ReplayRepeatsItAndTheStripStaysInPlace) {
    walking_head();
    wait(120);
    const std::uint64_t end = now();
    click(replay, 1);
    EXPECT_TRUE(app_.workspace().clock.replaying);
    EXPECT_LT(now(), 20u);
    click(replay, 1);
    EXPECT_FALSE(app_.workspace().clock.replaying) << "paused";
    const std::uint64_t paused = now();
    wait(10);
    EXPECT_EQ(now(), paused);
    click(on, 1);
    EXPECT_EQ(now(), paused + 1);
    click(back, 1);
    click(back, 1);
    EXPECT_EQ(now(), paused - 1);
    click(replay, 1);
    wait(200);
    EXPECT_FALSE(app_.workspace().clock.replaying);
    EXPECT_GE(now(), end);
}

TEST_F(RigTimeApp, TheOtherStripIsOneClickAway) {
    walking_head();
    wait(60);
    click(other_strip, 1);
    EXPECT_EQ(app_.workspace().settings.choices.at("rig_strip"), "past");
    click(other_strip, 1);
    EXPECT_EQ(app_.workspace().settings.choices.at("rig_strip"), "take");
}

TEST_F(RigTimeApp, AMarkIsClicked) {
    run("rig.preset", {{"name", "fk"}});
    const auto dial = [&](double to, int ticks) {
        for (int i = 1; i <= ticks; ++i) {
            run("rig.control.set", {{"name", "dial"}, {"value", to * i / ticks}});
            app_.tick(nullptr);
        }
    };
    dial(1.0, 120);
    const auto incidents = app_.workspace().rewind.incidents();
    ASSERT_EQ(incidents.size(), 2u) << "it leaves its minimum, and comes to its maximum";
    click({left + (right - left) * 0.02f / 10.0f, y - 4.0f}, 1);
    ASSERT_TRUE(app_.workspace().ui.incident);
    EXPECT_TRUE(test::says(app_.workspace().ui.incident->cause, "dial left minimum 0.00"));
    EXPECT_NEAR(std::get<double>(part().state->controls[0]), 0.0, 0.03);
    scrub({1.0f, 0.5f});
    EXPECT_FALSE(app_.workspace().ui.incident) << "one looks elsewhere";
}

TEST_F(RigTimeApp, AClipIsSolvedInAPauseAndStaysResponsive) {
    walking_head();
    run("time.pause");
    run("rig.clip.record", {{"seconds", 1.0}});
    run("rig.clip.solve");
    EXPECT_TRUE(app_.needs_ticks());
    int ticks = 0;
    for (; app_.needs_ticks() && ticks < 600; ++ticks) app_.tick(nullptr);
    EXPECT_FALSE(part().clip_left->running);
    EXPECT_GT(ticks, 5);
    EXPECT_EQ(now(), 0u);
    run("undo");
    EXPECT_EQ(part().clip_left, nullptr);
}

}  // namespace
}  // namespace tendril::test
