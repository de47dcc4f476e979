// Differences that the comparison of pictures must detect, and others that it must accept.
#include <random>

#include "app/labs/chain/chain_lab.hpp"
#include "app/view/picture.hpp"
#include "tests/app/golden/golden.hpp"
#include "tests/app/support/play.hpp"
#include "tests/labels.hpp"

namespace tendril::test {
namespace {

using app::Image;

/// The Chain lab's scene without panels, to be modified before it is drawn.
class Studio {
  public:
    Studio() : window_(app::open_offscreen({900, 520})), workspace_(app::make_blank_workspace(labs_)) {
        const auto table = app::make_command_table(labs_);
        table.run(workspace_, "chain.target", {{"to", {4.0, 3.0, -1.0}}});
        camera_.emplace(workspace_.camera, app::Rect{{0, 0}, {900, 520}});
        lab().draw({workspace_, *camera_, app::palette(app::Theme::Dark)}, list);
    }
    Image draw() {
        renderer_.draw(
            list, *camera_, app::palette(app::Theme::Dark),
            {.framebuffer = window_->framebuffer(), .framebuffer_size = window_->framebuffer_size()});
        return app::read_framebuffer(window_->framebuffer(), window_->framebuffer_size());
    }
    app::DrawList list;

  private:
    const app::Lab& lab() const { return *labs_.find("chain"); }
    std::unique_ptr<app::Window> window_;
    app::Labs labs_;
    app::Workspace workspace_;
    app::Renderer renderer_;
    std::optional<app::Camera> camera_;
};

bool is_ball(const app::Stroke& stroke) {
    return stroke.a == stroke.b;
}

std::uint8_t level(double value) {
    return static_cast<std::uint8_t>(std::clamp(std::lround(value), 0L, 255L));
}

/// Every level off by up to `most`, at random.
Image noisy(Image image, int most, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_int_distribution<int> off(-most, most);
    for (std::size_t i = 0; i < image.rgba.size(); ++i) {
        if (i % 4 != 3) image.rgba[i] = level(image.rgba[i] + off(random));
    }
    return image;
}

Image brighter(Image image, int by) {
    for (std::size_t i = 0; i < image.rgba.size(); ++i) {
        if (i % 4 != 3) image.rgba[i] = level(image.rgba[i] + by);
    }
    return image;
}

/// The whole picture moved right by a fraction of a pixel, as if every edge were smoothed differently.
Image nudged(const Image& image, double pixels) {
    Image result = image;
    const auto row = 4 * static_cast<std::size_t>(image.size.x);
    for (std::size_t i = 0; i < image.rgba.size(); ++i) {
        if (i % row < 4) continue;
        result.rgba[i] = level((1.0 - pixels) * image.rgba[i] + pixels * image.rgba[i - 4]);
    }
    return result;
}

/// Cuts out what `with` has and `without` lacks, and draws it into `without`, moved by `by`.
Image moved(const Image& with, const Image& without, glm::ivec2 by) {
    Image result = without;
    const auto at = [&](int x, int y) {
        return 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(with.size.x) +
                    static_cast<std::size_t>(x));
    };
    for (int y = 8; y < with.size.y - 8; ++y)
        for (int x = 8; x < with.size.x - 8; ++x) {
            const std::size_t from = at(x, y), to = at(x + by.x, y + by.y);
            if (std::equal(&with.rgba[from], &with.rgba[from] + 4, &without.rgba[from])) continue;
            std::copy_n(&with.rgba[from], 4, &result.rgba[to]);
        }
    return result;
}

/// Pictures of the whole program, with and without a label beside a segment.
struct Labelled {
    Image with, without;
};
Labelled labelled() {
    ScriptText script;
    script
        .command("camera.set", {{"target", {2, 1, 0}}, {"yaw_deg", -20}, {"pitch_deg", 20}, {"distance", 9}})
        .command("chain.target", {{"to", {1, 3, 0}}});
    const Image without = play(script, {.picture = true}).picture;
    // Labels always shown, but just one: a chain of one segment.
    script.command("view.labels", {{"show", "always"}});
    return {play(script, {.picture = true}).picture, without};
}

TEST(Compare, NoisePasses) {
    const Image picture = Studio().draw();
    const Image panels = app::read_png(golden_folder() / "light.png");
    for (unsigned seed = 1; seed <= (is_thorough() ? 3u : 1u); ++seed)
        for (int most : {1, 2}) {
            const Difference scene = compare(picture, noisy(picture, most, seed));
            EXPECT_TRUE(scene.same) << most << ": " << scene.text();
            const Difference whole = compare(panels, noisy(panels, most, seed));
            EXPECT_TRUE(whole.same) << most << ": " << whole.text();
        }
    for (int by : {-2, 2}) EXPECT_TRUE(compare(picture, brighter(picture, by)).same) << by;
}

TEST(Compare, EdgesSmoothedDifferentlyPass) {
    const Image picture = Studio().draw();
    const Image panels = app::read_png(golden_folder() / "help.png");
    for (double pixels : {0.05, 0.1, 0.15}) {
        EXPECT_TRUE(compare(picture, nudged(picture, pixels)).same)
            << compare(picture, nudged(picture, pixels)).text();
        EXPECT_TRUE(compare(panels, nudged(panels, pixels)).same)
            << compare(panels, nudged(panels, pixels)).text();
    }
}

TEST(Compare, ASingleFlippedPixelPasses) {
    Image picture = Studio().draw();
    const Image before = picture;
    std::fill_n(&picture.rgba[4 * (200 * 900 + 450)], 3, std::uint8_t{255});
    EXPECT_TRUE(compare(before, picture).same);
    std::fill_n(&picture.rgba[4 * (200 * 900 + 450)], 12, std::uint8_t{255});
    EXPECT_FALSE(compare(before, picture).same);
}

TEST(Compare, AnotherColourOfOneJointFails) {
    for (int channel = 0; channel < 3; ++channel)
        for (float by : {-10.0f, 10.0f}) {
            Studio studio;
            const Image before = studio.draw();
            for (auto& stroke : studio.list.strokes) {
                if (is_ball(stroke) && stroke.pick == app::segment_pick(3))
                    stroke.colour[channel] += by / 255.0f;
            }
            const Difference difference = compare(before, studio.draw());
            EXPECT_FALSE(difference.same)
                << "channel " << channel << " by " << by << ": " << difference.text();
        }
}

TEST(Compare, AMissingSegmentFails) {
    for (std::size_t segment = 0; segment < 8; ++segment) {
        for (bool ball : {false, true}) {
            Studio studio;
            const Image before = studio.draw();
            const auto gone = std::erase_if(studio.list.strokes, [&](const app::Stroke& stroke) {
                return stroke.pick == app::segment_pick(segment) && is_ball(stroke) == ball;
            });
            if (segment == 0 && !ball) continue;  // nothing leads to the head
            if (segment == 7 && ball) continue;   // behind the target
            ASSERT_EQ(gone, 1u);
            const Difference difference = compare(before, studio.draw());
            EXPECT_FALSE(difference.same)
                << (ball ? "joint " : "link ") << segment << ": " << difference.text();
        }
    }
}

TEST(Compare, AMissingSegmentOfAFineCoilFails) {
    const auto picture = [](bool gap) {
        ScriptText script;
        script.command("chain.preset", {{"name", "coil"}, {"count", 120}})
            .command("camera.frame", {{"what", "all"}});
        if (gap) script.command("chain.remove", {{"index", 60}});
        return play(script, {.picture = true}).picture;
    };
    EXPECT_FALSE(compare(picture(false), picture(true)).same);
}

TEST(Compare, ALabelMovedByThreePixelsFails) {
    const Labelled pictures = labelled();
    ASSERT_FALSE(compare(pictures.without, pictures.with).same);
    ASSERT_TRUE(compare(pictures.with, moved(pictures.with, pictures.without, {0, 0})).same);
    for (const glm::ivec2 by : {glm::ivec2(3, 0), glm::ivec2(-3, 0), glm::ivec2(0, 3), glm::ivec2(0, -3)}) {
        const Difference difference = compare(pictures.with, moved(pictures.with, pictures.without, by));
        EXPECT_FALSE(difference.same) << by.x << ", " << by.y << ": " << difference.text();
    }
}

TEST(Compare, AnotherSizeFails) {
    const Image picture = Studio().draw();
    Image shorter = picture;
    shorter.size.y -= 1;
    shorter.rgba.resize(shorter.rgba.size() - 4 * 900);
    EXPECT_FALSE(compare(picture, shorter).same);
    EXPECT_FALSE(compare(picture, Image{}).same);
}

TEST(GoldenCheck, IsNotBlindAndLeavesThePictures) {
    const TempFolder folder;
    const char* const before = std::getenv("TENDRIL_TEST_OUTPUT");
    const std::string kept = before != nullptr ? before : "";
    ::setenv("TENDRIL_TEST_OUTPUT", (folder / "out").c_str(), 1);
    const Image wrong = app::read_png(golden_folder() / "empty_chain.png");
    EXPECT_FALSE(looks_like(wrong, golden_folder() / "mode_fixed.png", "wrong"));
    EXPECT_FALSE(looks_like(wrong, golden_folder() / "there is none.png", "missing"));
    EXPECT_TRUE(looks_like(wrong, golden_folder() / "empty_chain.png", "right"));
    before != nullptr ? ::setenv("TENDRIL_TEST_OUTPUT", kept.c_str(), 1) : ::unsetenv("TENDRIL_TEST_OUTPUT");

    EXPECT_EQ(app::read_png(folder / "out/wrong.actual.png").rgba, wrong.rgba);
    EXPECT_EQ(app::read_png(folder / "out/wrong.difference.png").size, wrong.size);
    EXPECT_FALSE(std::filesystem::exists(folder / "out/right.actual.png"));
}

}  // namespace
}  // namespace tendril::test
