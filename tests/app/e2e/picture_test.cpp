// The view as a picture: of the requested size, and without the background.
#include <cstdlib>

#include "tests/app/support/play.hpp"

namespace tendril::test {
namespace {

app::Image picture(const app::Json& arguments, const char* lab = "chain") {
    const TempFolder folder;
    app::Json given = arguments;
    given["path"] = (folder / "view.png").string();
    ScriptText script;
    script.command("lab.open", {{"name", lab}}).command("time.pause").command("view.picture", given);
    play(script);
    return app::read_png(folder / "view.png");
}

int alpha(const app::Image& image, int x, int y) {
    return image.rgba[4 * static_cast<std::size_t>(y * image.size.x + x) + 3];
}

TEST(Picture, HasTheRequestedSize) {
    const app::Image image = picture({{"width", 640}, {"height", 360}});
    EXPECT_EQ(image.size, glm::ivec2(640, 360));
    EXPECT_EQ(alpha(image, 0, 0), 255);
    EXPECT_EQ(picture({{"width", 3000}, {"height", 200}}).size, glm::ivec2(3000, 200));
    const app::Image as_seen = picture({});
    EXPECT_LT(as_seen.size.x, 1280) << "without the panels";
    EXPECT_GT(as_seen.size.x, 500);
}

/// Opaque pixels have the colour of the picture with background.
TEST(Picture, IsTransparentWhereNothingIsDrawn) {
    for (const char* lab : {"chain", "rope", "humanoid"}) {
        const app::Json size{{"width", 600}, {"height", 400}};
        app::Json clear = size;
        clear["transparent"] = true;
        const app::Image with = picture(size, lab), without = picture(clear, lab);
        ASSERT_EQ(without.size, with.size);
        EXPECT_EQ(alpha(without, 0, 0), 0);
        EXPECT_EQ(alpha(without, 599, 399), 0);
        int solid = 0, between = 0, empty = 0, off = 0;
        for (std::size_t i = 0; i < with.rgba.size(); i += 4) {
            const int opacity = without.rgba[i + 3];
            (opacity == 255 ? solid : opacity == 0 ? empty : between) += 1;
            for (std::size_t c = 0; c < 3 && opacity == 255; ++c)
                off += std::abs(with.rgba[i + c] - without.rgba[i + c]) > 2;
        }
        EXPECT_GT(solid, 500) << lab;
        EXPECT_GT(between, 100) << lab << ": edges and shadows";
        EXPECT_GT(empty, 100'000) << lab;
        EXPECT_LT(off, 10) << lab;
    }
}

/// Each lab with something selected that is marked in the view.
TEST(Picture, LeavesOutHandlesAndTheSelectionUnlessWanted) {
    const std::pair<const char*, app::Json> selections[]{{"chain", {{"index", 2}}},
                                                         {"rope", {{"rope", "rope"}, {"particle", 3}}},
                                                         {"rig", {{"element", "head"}}},
                                                         {"humanoid", {{"node", "Head"}}}};
    for (const auto& [lab, selection] : selections) {
        const TempFolder folder;
        ScriptText script;
        script.command("lab.open", {{"name", lab}}).command("time.pause");
        const auto shot = [&](const std::string& name, bool handles) {
            script.command(
                "view.picture",
                {{"path", (folder / (name + ".png")).string()}, {"labels", true}, {"handles", handles}});
        };
        shot("a", false), shot("a_handles", true);
        script.command(lab + std::string(".select"), selection);
        shot("b", false), shot("b_handles", true);
        play(script);
        EXPECT_EQ(read(folder / "a.png"), read(folder / "b.png")) << lab;
        EXPECT_NE(read(folder / "a.png"), read(folder / "b_handles.png")) << lab;
        EXPECT_NE(read(folder / "a_handles.png"), read(folder / "b_handles.png")) << lab;
    }
}

TEST(Picture, IsDarkOnWhiteForPaper) {
    const app::Json size{{"width", 600}, {"height", 400}, {"paper", true}, {"labels", true}};
    const app::Image white = picture(size, "rope");
    app::Json clear = size;
    clear["transparent"] = true;
    const app::Image over = picture(clear, "rope");
    std::size_t plain = 0;
    for (std::size_t i = 0; i < white.rgba.size(); i += 4) {
        plain += white.rgba[i] == 255 && white.rgba[i + 1] == 255 && white.rgba[i + 2] == 255;
        for (std::size_t c = 0; c < 3; ++c) {  // the same colours, laid over white
            const int laid = 255 + (over.rgba[i + c] - 255) * over.rgba[i + 3] / 255;
            ASSERT_NEAR(white.rgba[i + c], laid, 2);
        }
    }
    EXPECT_GT(plain, 100'000u);
}

TEST(Picture, KeepsTheProportionsOfTheView) {
    const glm::ivec2 view = picture({}).size, wide = picture({{"width", 300}}).size;
    EXPECT_EQ(wide, glm::ivec2(300, std::lround(300.0 * view.y / view.x)));
    EXPECT_EQ(picture({{"height", 300}}).size, glm::ivec2(std::lround(300.0 * view.x / view.y), 300));
}

TEST(Picture, ChangesNothingElse) {
    const TempFolder folder;
    ScriptText plain, pictured;
    plain.wait(5);
    pictured.command("view.picture", {{"path", (folder / "a.png").string()}, {"width", 100}}).wait(400);
    const Played before = play(plain, {.picture = true}), after = play(pictured, {.picture = true});
    EXPECT_EQ(before.state.at("segments"), after.state.at("segments"));
    EXPECT_EQ(before.state.at("camera"), after.state.at("camera"));
    EXPECT_EQ(before.picture.rgba, after.picture.rgba);
}

TEST(Picture, IsRefusedInWords) {
    const TempFolder folder;
    const auto refusal = [](const app::Json& arguments) {
        return run_script(ScriptText().command("view.picture", arguments)).err;
    };
    EXPECT_TRUE(has(refusal({{"path", "a.jpg"}}), "path must end in .png, got a.jpg"));
    EXPECT_TRUE(has(refusal({{"path", "/nowhere/a.png"}}), "/nowhere/a.png"));
    EXPECT_TRUE(has(refusal(app::Json::object()), "path is missing")) << "without a window nothing is named";
    ScriptText plots = ScriptText().command("lab.open", {{"name", "signal"}});
    plots.command("view.picture", {{"path", (folder / "a.png").string()}});
    EXPECT_TRUE(has(run_script(plots).err, "more than a view of a scene"));
}

}  // namespace
}  // namespace tendril::test
