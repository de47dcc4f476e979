// The pixel positions in --state must be where the picture shows the objects.
#include "app/view/palette.hpp"
#include "tests/app/support/blobs.hpp"
#include "tests/app/support/play.hpp"

namespace tendril::test {
namespace {

struct Pose {
    const char* name;
    const char* camera;  ///< arguments of camera.set
};

class Handles : public testing::TestWithParam<Pose> {};

/// A chain pulled by segment 5, so that neither end is behind the target, away from the axes.
ScriptText scene(const Pose& pose) {
    ScriptText script;
    app::Json camera = app::parse_json(pose.camera);
    camera["target"] = {4, 1.5, 0};
    script.command("chain.mode", {{"mode", "with_index"}, {"index", 5}})
        .command("chain.target", {{"to", {4, 3, 1.5}}})
        .command("chain.target", {{"to", {5, 2.5, -1}}})
        .command("chain.select", {{"index", 2}})
        .command("camera.set", camera);
    return script;
}

TEST_P(Handles, AreWhereThePictureShowsThem) {
    const Played played = play(scene(GetParam()), {.picture = true});
    const glm::ivec2 low(300, 110), high(980, 680);  // the view without its panels and hint
    const app::Palette& colours = app::palette(app::Theme::Dark);
    const std::vector<std::pair<std::string, Wanted>> things{
        {"target", {.colour = colours.target}},
        {"segment.0", {.colour = colours.head}},
        {"segment.7", {.colour = colours.tail}},
        {"segment.2", {.colour = colours.selection, .hue_off = 0.2f, .solid = false}}};
    for (const auto& [name, wanted] : things) {
        const auto blob = find_blob(played.picture, wanted, low, high);
        ASSERT_TRUE(blob) << name;
        EXPECT_GT(blob->pixels, 20) << name;
        const glm::vec2 pixel = handle(played.state, name);
        EXPECT_LE(glm::distance(blob->centre, pixel), 1.0f)
            << name << ": the state has it at " << pixel.x << ", " << pixel.y << ", the picture at "
            << blob->centre.x << ", " << blob->centre.y;
    }
}

INSTANTIATE_TEST_SUITE_P(
    Poses, Handles,
    testing::Values(
        Pose{"first", R"({"yaw_deg": -20, "pitch_deg": 20, "distance": 14})"},
        Pose{"close", R"({"yaw_deg": 35, "pitch_deg": 40, "distance": 9})"},
        Pose{"far", R"({"yaw_deg": 10, "pitch_deg": 5, "distance": 25})"},
        Pose{"below", R"({"yaw_deg": 20, "pitch_deg": -30, "distance": 12})"},
        Pose{"above", R"({"yaw_deg": 15, "pitch_deg": 75, "distance": 13})"},
        Pose{"wide", R"({"yaw_deg": -30, "pitch_deg": 25, "distance": 6, "field_of_view_deg": 80})"},
        Pose{"orthographic", R"({"yaw_deg": -25, "pitch_deg": 30, "distance": 14, "orthographic": true})"},
        Pose{"front", R"({"yaw_deg": 0, "pitch_deg": 0, "distance": 14, "orthographic": true})"}),
    [](const auto& pose) { return pose.param.name; });

/// A lab opened from the command line is laid out before anything is drawn.
TEST(HandlesAtTheStart, AreWhereTheFirstFrameShowsThem) {
    for (const char* lab : {"chain", "rig"}) {
        const app::Json none = play(ScriptText(), {.more = {"--lab", lab}}).state["handles"];
        EXPECT_EQ(none, play(ScriptText(), {.more = {"--lab", lab, "--frames", "1"}}).state["handles"])
            << lab;
    }
}

TEST(HandlesOutOfView, HaveAPixelOutsideOrNone) {
    ScriptText script = ScriptText().command(
        "camera.set", {{"target", {0, 0, -30}}, {"yaw_deg", 0}, {"pitch_deg", 0}, {"distance", 10}});
    const app::Json state = state_after(script);
    ASSERT_EQ(state.at("handles").size(), 9u);
    for (const auto& each : state.at("handles")) EXPECT_TRUE(each.at("pixel").is_null()) << each.dump();
}

// The largest usual screen. No golden picture: it would be larger than all others together.
TEST(HandlesOfALargeWindow, AreDrawnAt3840x2160) {
    const Played played = play(ScriptText().command("view.text_scale", {{"scale", 2}}),
                               {.picture = true, .more = {"--size", "3840x2160"}});
    ASSERT_EQ(played.picture.size, glm::ivec2(3840, 2160));
    const auto blob = find_blob(played.picture, {.colour = app::palette(app::Theme::Dark).target}, {700, 220},
                                {3100, 2000});
    ASSERT_TRUE(blob);
    EXPECT_LE(glm::distance(blob->centre, handle(played.state, "target")), 1.0f);
}

}  // namespace
}  // namespace tendril::test
