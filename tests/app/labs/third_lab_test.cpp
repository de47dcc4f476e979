// A lab is one folder and one line in the table: palette, help and shortcuts find a lab that is not in the
// program, although only the table knows it. EveryScene drags, undoes, saves and records it.
#include <gtest/gtest.h>

#include "app/document/command.hpp"
#include "app/document/scene_file.hpp"
#include "app/shell/command_palette.hpp"
#include "tests/app/labs/app_support.hpp"
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

class ThirdLab : public LabAppTest {
  protected:
    ThirdLab() : LabAppTest("spring", true, {1280, 720}, labs_with_a_spring()) {}
    Json ball() { return app_.state().at("ball"); }
};

TEST_F(ThirdLab, ItsPictureShowsItsHandlesWhereTheyAre) {
    const Image picture = app_.screenshot();
    const glm::ivec2 pixel_at(at("ball"));
    const std::size_t pixel =
        4 * (static_cast<std::size_t>(pixel_at.y) * static_cast<std::size_t>(picture.size.x) +
             static_cast<std::size_t>(pixel_at.x));
    EXPECT_GT(picture.rgba[pixel], picture.rgba[pixel + 2]) << "the ball is orange, the ground is not";
    const Lab& lab = *app_.labs().find("spring");
    const Bounds around = lab.bounds(app_.workspace(), false);  // which the view frames
    for (const app::Handle& each : lab.handles(app_.workspace()))
        EXPECT_LE(glm::distance(each.frame.position, around.centre), 1.001f * around.radius) << each.name;
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

    drag(at("ball"), {{22.5f, 0.0f}, {45.0f, 0.0f}, {90.0f, 0.0f}});
    send(KeyTap{*chord_from_name("r")});
    EXPECT_EQ(ball(), point({0.5f, 1.0f, 0.0f}));
}

TEST(Labs, WithTheSameNameAreRefused) {
    Labs labs = labs_with_a_spring();
    EXPECT_THROW(labs.add(std::make_unique<SpringLab>()), std::logic_error);
}

}  // namespace
}  // namespace tendril::test
