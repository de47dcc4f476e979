// A lab is one folder and one line in the table: palette, help and shortcuts find a lab that is not in the
// program, although only the table knows it. EveryScene drags, undoes, saves and records it.
#include <gtest/gtest.h>

#include "app/document/command.hpp"
#include "app/document/scene_file.hpp"
#include "app/shell/command_palette.hpp"
#include "tests/app/e2e/monkey.hpp"
#include "tests/app/labs/spring/spring_lab.hpp"
#include "tests/says.hpp"

namespace tendril::test {
namespace {

using namespace app;

Labs labs_with_a_spring() {
    Labs labs;
    labs.add(std::make_unique<SpringLab>());
    return labs;
}

class ThirdLab : public testing::Test {
  protected:
    ThirdLab() {
        app_.run({"lab.open", Json{{"name", "spring"}}});
        app_.run({"time.pause"});
    }
    void send(const Event& event) { app_.tick(&event); }
    void drag(const std::string& name, glm::vec2 by) {
        const glm::vec2 from = handle(app_.state(), name);
        send(MouseMove{from});
        send(MousePress{MouseButton::Left, true});
        for (const float share : {0.25f, 0.5f, 1.0f}) send(MouseMove{from + share * by});
        send(MousePress{MouseButton::Left, false});
    }
    Json ball() { return app_.state().at("ball"); }

    std::unique_ptr<Window> window_ = open_offscreen({1280, 720});
    App app_{*window_, false, labs_with_a_spring()};
};

TEST_F(ThirdLab, ItsPictureShowsItsHandlesWhereTheyAre) {
    const Image picture = app_.screenshot();
    const glm::ivec2 at(handle(app_.state(), "ball"));
    const std::size_t pixel = 4 * (static_cast<std::size_t>(at.y) * static_cast<std::size_t>(picture.size.x) +
                                   static_cast<std::size_t>(at.x));
    EXPECT_GT(picture.rgba[pixel], picture.rgba[pixel + 2]) << "the ball is orange, the ground is not";
}

TEST_F(ThirdLab, IsInThePaletteTheHelpAndTheShortcuts) {
    EXPECT_EQ(search_commands(app_.commands(), "spring.anchor").front()->name, "spring.anchor");
    const Shortcuts shortcuts(app_.labs(), app_.commands());
    const Shortcut* row = shortcuts.find(*chord_from_name("r"), "spring");
    ASSERT_NE(row, nullptr);
    EXPECT_EQ(row->command, "spring.ball");
    EXPECT_EQ(shortcuts.find(*chord_from_name("r"), app_.labs().all().front()->name()), nullptr);
    EXPECT_TRUE(has(shortcuts.markdown(), "| R | Pull the ball aside |"));
    EXPECT_TRUE(has(shortcuts.markdown(), "| Left drag on the ball | holds it there |"));
    EXPECT_TRUE(test::says(shortcuts.mouse_help("spring").back().gesture, "Left drag ball"));

    drag("ball", {90.0f, 0.0f});
    send(KeyTap{*chord_from_name("r")});
    EXPECT_EQ(ball(), point({0.5f, 1.0f, 0.0f}));
}

TEST(Labs, WithTheSameNameAreRefused) {
    Labs labs = labs_with_a_spring();
    EXPECT_THROW(labs.add(std::make_unique<SpringLab>()), std::logic_error);
}

}  // namespace
}  // namespace tendril::test
