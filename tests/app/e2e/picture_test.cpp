// The view as a picture: of the requested size, and without the background.
#include <glm/common.hpp>

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

// The pixel positions in --state must be where the picture shows the objects.

// Objects are found by colour alone, as a viewer would, without knowing where they should be.

struct Blob {
    glm::vec2 centre{0.0f};  ///< of its bounding box, in pixels; a pixel's own centre is at +0.5
    int pixels = 0;
};

/// Connected regions of pixels of about that hue, saturated enough not to be blended. `solid` ignores lines:
/// counts only what remains after removing one pixel all round.
struct Wanted {
    glm::vec3 colour{0.0f};       ///< sRGB, 0 to 1
    float hue_off = 0.25f;        ///< radians
    float least_strength = 0.5f;  ///< relative to the saturation of `colour`
    bool solid = true;
};

/// The colour without its grey: the direction is the hue, the length the saturation.
glm::vec2 hue_of(glm::vec3 rgb) {
    return {rgb.r - 0.5f * (rgb.g + rgb.b), 0.8660254f * (rgb.g - rgb.b)};
}

class Mask {
  public:
    Mask(glm::ivec2 low, glm::ivec2 high) : low_(low), size_(high - low), set_(count()) {}
    bool at(int x, int y) const { return inside(x, y) && set_[index(x, y)] != 0; }
    void set(int x, int y, bool to) { set_[index(x, y)] = to ? 1 : 0; }
    glm::ivec2 low() const { return low_; }
    glm::ivec2 high() const { return low_ + size_; }

    /// Removes one pixel all round.
    Mask eroded() const {
        Mask result(low(), high());
        for (int y = low().y; y < high().y; ++y)
            for (int x = low().x; x < high().x; ++x) {
                bool all = true;
                for (int dy = -1; dy <= 1; ++dy)
                    for (int dx = -1; dx <= 1; ++dx) all = all && at(x + dx, y + dy);
                result.set(x, y, all);
            }
        return result;
    }

  private:
    std::size_t count() const {
        return static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(size_.y);
    }
    bool inside(int x, int y) const { return x >= low_.x && y >= low_.y && x < high().x && y < high().y; }
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y - low_.y) * static_cast<std::size_t>(size_.x) +
               static_cast<std::size_t>(x - low_.x);
    }
    glm::ivec2 low_, size_;
    std::vector<char> set_;
};

Mask mask_of(const app::Image& image, const Wanted& wanted, glm::ivec2 low, glm::ivec2 high) {
    const glm::vec2 hue = hue_of(wanted.colour);
    const float strength = glm::length(hue);
    Mask mask(low, high);
    for (int y = low.y; y < high.y; ++y)
        for (int x = low.x; x < high.x; ++x) {
            const std::size_t i = 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.size.x) +
                                       static_cast<std::size_t>(x));
            const glm::vec2 found =
                hue_of(glm::vec3(image.rgba[i], image.rgba[i + 1], image.rgba[i + 2]) / 255.0f);
            const float length = glm::length(found);
            const bool strong = length >= wanted.least_strength * strength;
            mask.set(x, y, strong && glm::dot(found, hue) >= std::cos(wanted.hue_off) * length * strength);
        }
    return mask;
}

/// Clears the region that contains (x, y) and returns it.
Blob take_region(Mask& mask, int x, int y) {
    std::vector<glm::ivec2> open{{x, y}};
    glm::ivec2 least{x, y}, most{x, y};
    mask.set(x, y, false);
    Blob blob;
    while (!open.empty()) {
        const glm::ivec2 at = open.back();
        open.pop_back();
        ++blob.pixels;
        least = glm::min(least, at);
        most = glm::max(most, at);
        for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx) {
                if (!mask.at(at.x + dx, at.y + dy)) continue;
                mask.set(at.x + dx, at.y + dy, false);
                open.push_back(at + glm::ivec2(dx, dy));
            }
    }
    blob.centre = 0.5f * (glm::vec2(least) + glm::vec2(most + 1));
    return blob;
}

/// The largest region within [low, high); nothing if there is none.
std::optional<Blob> find_blob(const app::Image& image, const Wanted& wanted, glm::ivec2 low,
                              glm::ivec2 high) {
    Mask mask = mask_of(image, wanted, low, high);
    if (wanted.solid) mask = mask.eroded().eroded();
    std::optional<Blob> largest;
    for (int y = low.y; y < high.y; ++y)
        for (int x = low.x; x < high.x; ++x) {
            if (!mask.at(x, y)) continue;
            const Blob blob = take_region(mask, x, y);
            if (!largest || blob.pixels > largest->pixels) largest = blob;
        }
    return largest;
}

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
