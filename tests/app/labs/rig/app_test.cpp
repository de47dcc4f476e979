// The Rig lab in the running program: dragging controls, and seeking in time.
#include <algorithm>
#include <glm/geometric.hpp>
#include <optional>
#include <string>
#include <vector>

#include "rig_support.hpp"
#include "tests/app/support/frame_record.hpp"
#include "tests/says.hpp"

namespace tendril::test {
namespace {

using namespace app;

class RigApp : public RigAppTest {
  protected:
    void drag(const std::string& name, glm::vec2 by) {
        RigAppTest::drag(at(name), {0.25f * by, 0.5f * by, by});
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
        app_.run({"rig.select", Json{{"element", "head"}, {"unit", "aim"}}});
        const auto wait = [&] {
            for (int i = 0; i < 3; ++i) app_.tick(nullptr);
        };
        wait();
        send(MouseMove{{1190.0f, 413.0f}});
        send(MousePress{MouseButton::Left, true});
        send(MousePress{MouseButton::Left, false});
        wait();
        for (const char* const each : pressed) {
            if (const auto chord = chord_from_name(each))
                send(KeyTap{*chord});
            else
                send(TextInput{each});
            wait();
        }
        const RigPart& part = rig_part(app_.workspace());
        const auto& aim = std::get<rig::Aim>(part.rig.definition().units[1].operation);
        const auto& from = std::get<rig::FromElement>(aim.primary.target.source);
        const std::string found = std::get<std::string>(from.element.which);
        const std::string whole = found + " " + std::to_string(static_cast<int>(from.of)) + " " +
                                  std::to_string(static_cast<int>(from.space));
        if (whole != first_source) app_.run({"undo"});
        for (int i = 0; i < 30; ++i) app_.tick(nullptr);
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

/// The tree of elements has the same filter line.
TEST_F(RigApp, TheTreesFilterTakesEnterAndArrows) {
    app_.run({"rig.preset", Json{{"name", "loop"}}});
    app_.run({"view.fold", Json{{"section", "rig: Elements"}, {"folded", false}}});
    const auto wait = [&] {
        for (int i = 0; i < 3; ++i) app_.tick(nullptr);
    };
    wait();
    const auto& elements = rig_part(app_.workspace()).rig.definition().elements;
    ASSERT_GT(elements.size(), 12u) << "the tree has a filter";
    FrameRecorder recorder;
    wait();
    std::optional<glm::vec2> at;
    for (const DrawnText& each : recorder.frame().texts)
        if (each.text == "Filter by name") at = 0.5f * (each.box.min + each.box.max);
    ASSERT_TRUE(at);
    const auto selected = [&] { return rig_part(app_.workspace()).selected_element(); };
    const auto keys = [&](const std::vector<const char*>& pressed) {
        send(MouseMove{*at});
        send(MousePress{MouseButton::Left, true});
        send(MousePress{MouseButton::Left, false});
        for (int i = 0; i < 30; ++i) app_.tick(nullptr);
        for (const char* const each : pressed) {
            if (const auto chord = chord_from_name(each))
                send(KeyTap{*chord});
            else
                send(TextInput{each});
            wait();
        }
        return selected();
    };
    const std::string first = keys({"joint", "enter"});
    EXPECT_TRUE(has(first, "joint"));
    const std::string second = keys({"escape", "down", "down", "enter"});
    EXPECT_NE(second, "");
    EXPECT_NE(second, first) << "the whole tree again, and its second row";
}

TEST_F(RigApp, AUnitIsRenamedInItsPanel) {
    app_.run({"rig.select", Json{{"element", "head"}, {"unit", "aim"}}});
    for (int i = 0; i < 3; ++i) app_.tick(nullptr);
    const auto click = [&](glm::vec2 at) {
        send(MouseMove{at});
        send(MousePress{MouseButton::Left, true});
        send(MousePress{MouseButton::Left, false});
        for (int i = 0; i < 30; ++i) app_.tick(nullptr);
    };
    FrameRecorder recorder;
    const auto type = [&](const char* text, const char* key = "enter") {
        app_.tick(nullptr);
        float height = 0.0f;
        for (const DrawnText& each : recorder.frame().texts)
            if (each.text == "name") height = 0.5f * (each.box.min.y + each.box.max.y);
        click({1186.0f, height});
        send(TextInput{text});
        if (key != nullptr) send(KeyTap{*chord_from_name(key)});
        for (int i = 0; i < 3; ++i) app_.tick(nullptr);
    };
    const auto selected = [&] { return rig_part(app_.workspace()).selected.unit; };
    type("set head");
    EXPECT_TRUE(says(app_.workspace().ui.toasts.back().text, "already unit set head"));
    EXPECT_EQ(selected(), "aim");
    type("gaze");
    EXPECT_EQ(selected(), "gaze");
    app_.run({"undo"});
    EXPECT_EQ(selected(), "aim");
    type("gaze", "escape");
    EXPECT_EQ(selected(), "aim") << "Escape puts the name back";
    for (const glm::vec2 elsewhere : {glm::vec2(640.0f, 660.0f), glm::vec2(60.0f, 60.0f)}) {
        type("gaze", nullptr);
        EXPECT_EQ(selected(), "aim") << "not before it is left";
        click(elsewhere);
        const auto names = rig_part(app_.workspace()).rig.unit_names();
        EXPECT_TRUE(std::ranges::find(names, "gaze") != names.end()) << "left by a click elsewhere";
        app_.run({"rig.preset", Json{{"name", "aim"}}});
        app_.run({"rig.select", Json{{"element", "head"}, {"unit", "aim"}}});
        for (int i = 0; i < 3; ++i) app_.tick(nullptr);
    }
}

}  // namespace
}  // namespace tendril::test
