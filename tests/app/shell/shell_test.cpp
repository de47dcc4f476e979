// The shell without a window: shortcuts, layout, input, the command palette's parsing and searching.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "app/document/command.hpp"
#include "app/io/json_complete.hpp"
#include "app/labs/labs.hpp"
#include "app/shell/command_palette.hpp"
#include "app/shell/input.hpp"
#include "app/shell/shell.hpp"
#include "app/shell/shortcuts.hpp"
#include "tests/app/support/full_scenes.hpp"

namespace tendril::app {
namespace {

/// Whether the shortcut's command is accepted in one of its lab's test scenes.
bool accepted_somewhere(const Labs& labs, const CommandTable& table, const Shortcut& shortcut) {
    const Lab& lab = shortcut.lab.empty() ? *labs.all().front() : *labs.find(shortcut.lab);
    for (const test::TestScene& scene : test::test_scenes(lab)) {
        Workspace workspace = make_blank_workspace(labs);
        workspace.names_pictures = true;  // shortcuts belong to a window
        workspace.open_lab(lab.name());
        for (const CommandCall& command : scene.commands)
            table.run(workspace, command.name, to_json(command.arguments));
        try {
            table.run(workspace, shortcut.command, to_json(shortcut.arguments));
            return true;
        } catch (const Refused&) {
        }
    }
    return false;
}

TEST(Shortcuts, EachRunsACommandOfTheTableAndNoTwoShareAKey) {
    const Labs labs;
    const CommandTable table = make_command_table(labs);
    const Shortcuts shortcuts(labs, table);
    std::vector<std::string> seen;
    for (const Shortcut& shortcut : shortcuts.all()) {
        ASSERT_NE(table.find(shortcut.command), nullptr) << shortcut.command;
        const std::string chord = shortcut.lab + " " + chord_name(shortcut.chord);
        EXPECT_EQ(std::count(seen.begin(), seen.end(), chord), 0) << chord;
        seen.push_back(chord);
        for (const auto& lab : labs.all()) {
            const bool here = shortcut.lab.empty() || shortcut.lab == lab->name();
            EXPECT_EQ(shortcuts.find(shortcut.chord, lab->name()) == &shortcut, here) << chord;
        }
        EXPECT_NE(shortcuts.markdown().find(shortcut.title), std::string::npos);
        // Nothing was undone yet, and nothing has moved.
        if (shortcut.command == "redo" || shortcut.command == "view.video_dialog") continue;
        EXPECT_TRUE(accepted_somewhere(labs, table, shortcut)) << shortcut.command;
    }
    EXPECT_EQ(shortcuts.keys_for("undo"), "Ctrl+Z");
    EXPECT_EQ(shortcuts.find(*chord_from_name("ctrl+alt+f12"), labs.all().front()->name()), nullptr);
}

TEST(Shortcuts, OfALabFollowTheOthersOfTheirSection) {
    const Labs labs;
    const Shortcuts shortcuts(labs, make_command_table(labs));
    std::vector<std::string> sections;
    for (const Shortcut& shortcut : shortcuts.all())
        if (sections.empty() || sections.back() != shortcut.section) sections.push_back(shortcut.section);
    std::vector<std::string> once = sections;
    std::sort(once.begin(), once.end());
    EXPECT_EQ(std::unique(once.begin(), once.end()), once.end()) << "a section stands in one piece";
    EXPECT_EQ(sections.front(), "Scene");
    EXPECT_EQ(sections.back(), "Help");
}

TEST(Shortcuts, TheMouseOrbitsAndPansTheView) {
    const auto does = [](MousePreset preset, MouseButton button, HeldKeys held = {}) {
        return mouse_action(preset, button, held);
    };
    constexpr auto left = MouseButton::Left, middle = MouseButton::Middle, right = MouseButton::Right;
    constexpr auto own = MousePreset::Tendril, blender = MousePreset::Blender, maya = MousePreset::Maya;
    EXPECT_EQ(does(own, right), MouseAction::Orbit);
    EXPECT_EQ(does(own, left, {.alt = true}), MouseAction::Orbit);
    EXPECT_EQ(does(own, middle), MouseAction::Pan);
    EXPECT_EQ(does(own, right, {.shift = true}), MouseAction::Pan);
    EXPECT_EQ(does(blender, middle), MouseAction::Orbit);
    EXPECT_EQ(does(blender, middle, {.shift = true}), MouseAction::Pan);
    EXPECT_EQ(does(blender, middle, {.ctrl = true}), MouseAction::Zoom);
    EXPECT_EQ(does(blender, right), std::nullopt);
    EXPECT_EQ(does(maya, left, {.alt = true}), MouseAction::Orbit);
    EXPECT_EQ(does(maya, middle, {.alt = true}), MouseAction::Pan);
    EXPECT_EQ(does(maya, right, {.alt = true}), MouseAction::Zoom);
    for (const MousePreset preset : {own, blender, maya}) {
        EXPECT_EQ(does(preset, left), std::nullopt) << "it is for handles";
        EXPECT_EQ(does(preset, left, {.shift = true}), std::nullopt) << "a drag in the ground plane";
    }
}

TEST(LayoutOfTheWindow, PartsTileItWithoutOverlapAtEverySize) {
    std::mt19937 random(3);
    const auto pick = [&](int low, int high) { return std::uniform_int_distribution(low, high)(random); };
    for (int i = 0; i < 2000; ++i) {
        const glm::vec2 window(pick(1, 5000), pick(1, 3000));
        Settings settings{.left_open = pick(0, 1) == 1,
                          .right_open = pick(0, 1) == 1,
                          .left_width = static_cast<float>(pick(180, 520)),
                          .right_width = static_cast<float>(pick(180, 520))};
        const float scale = static_cast<float>(pick(5, 30)) / 10.0f;
        const float canvas = static_cast<float>(pick(0, 9)) / 10.0f;
        const Layout layout = lay_out(window, scale, settings, static_cast<float>(pick(0, 300)), canvas);
        const float area = window.x * (window.y - layout.top.size().y - layout.status.size().y);
        float covered = 0.0f;
        for (const Rect& rect : {layout.left, layout.right, layout.canvas, layout.view, layout.timeline}) {
            EXPECT_GE(rect.size().x, 0.0f);
            EXPECT_GE(rect.size().y, 0.0f);
            covered += rect.size().x * rect.size().y;
        }
        if (area > 0.0f && layout.status.min.y > layout.top.max.y) {
            EXPECT_NEAR(covered / area, 1.0f, 1e-3f);
        }
        if (window.x >= 200.0f) {
            EXPECT_GE(layout.canvas.size().x + layout.view.size().x, 0.3f * window.x);
        }
        EXPECT_EQ(layout.status.max, window);
    }
}

TEST(InputState, HeldKeysAreModifiersAndATapReleasesThem) {
    Input input;
    const Event down = KeyChange{Key::X, true}, up = KeyChange{Key::X, false};
    input.take(&down);
    EXPECT_TRUE(input.held(Key::X));
    const Event tap = KeyTap{{Key::Z, true, false, false}};
    input.take(&tap);
    EXPECT_EQ(input.pressed(), (Chord{Key::Z, true, false, false}));
    EXPECT_TRUE(input.ctrl());
    input.end_tap();
    EXPECT_FALSE(input.ctrl());
    EXPECT_FALSE(input.held(Key::Z));
    EXPECT_TRUE(input.held(Key::X));
    input.take(&up);
    EXPECT_FALSE(input.held(Key::X));
    input.take(&down);
    EXPECT_FALSE(input.repeated());
    input.take(&down);
    EXPECT_TRUE(input.repeated());
    const Event away = Focus{false};
    input.take(&away);
    EXPECT_FALSE(input.held(Key::X)) << "what is let go elsewhere is never told";
}

}  // namespace
}  // namespace tendril::app
