// Everything is drawn where the camera says, more strokes need no more draw calls, and output is repeatable.
#include <cstdlib>

#include "app/view/picking.hpp"
#include "app/window/gl.hpp"
#include "tests/app/support/backends.hpp"

namespace tendril::app::renderer_test {
namespace {

constexpr glm::ivec2 size{320, 240};
const Rect viewport{{40.0f, 20.0f}, {320.0f, 220.0f}};
const glm::vec4 red{1.0f, 0.0f, 0.0f, 1.0f};

/// A plain background, so that the colour of a pixel is a stroke's coverage.
Palette black() {
    Palette result = palette(Theme::Dark);
    result.background_top = result.background_bottom = glm::vec3(0.0f);
    return result;
}

class Drawing : public testing::TestWithParam<Backend> {
  protected:
    Image draw(const DrawList& list, const CameraPose& pose, const Palette& colours, bool grid = false) {
        renderer_.draw(list, Camera(pose, viewport), colours, {window_->framebuffer(), size, 1.0f, grid});
        EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
        return read_framebuffer(window_->framebuffer(), size);
    }
    Image draw_plain(const DrawList& list, const CameraPose& pose) { return draw(list, pose, black()); }

    std::unique_ptr<Window> window_ = open_window(GetParam(), size);
    Renderer renderer_;
};

float red_at(const Image& image, int x, int y) {
    return static_cast<float>(image.rgba[static_cast<std::size_t>(4 * (y * image.size.x + x))]) / 255.0f;
}

DrawList many(int count) {
    DrawList list;
    for (int i = 0; i < count; ++i) {
        const float t = static_cast<float>(i) / static_cast<float>(count);
        const glm::vec3 at(std::cos(40.0f * t) * 3.0f, 0.1f + t, std::sin(40.0f * t) * 3.0f);
        list.sphere(at, 3.0f, Unit::Pixels, red).shadow = true;
        list.line(at, at + glm::vec3(0.1f), 1.5f, red);
        list.bone(at, at + glm::vec3(0.0f, 0.2f, 0.0f), 0.05f, 0.02f, red).layer = Layer::Overlay;
    }
    return list;
}

/// Whether the pixels in a rectangle of window coordinates are the same in both pictures.
bool same_within(const Image& a, const Image& b, const Rect& rect) {
    for (int y = static_cast<int>(rect.min.y); y < static_cast<int>(rect.max.y); ++y)
        for (int x = static_cast<int>(rect.min.x); x < static_cast<int>(rect.max.x); ++x) {
            const auto i = static_cast<std::size_t>(4 * (y * a.size.x + x));
            if (!std::equal(&a.rgba[i], &a.rgba[i] + 4, &b.rgba[i])) return false;
        }
    return true;
}

TEST_P(Drawing, APaneLooksAsItWouldAlone) {
    const CameraPose pose{.yaw = 0.3f, .pitch = 0.5f, .distance = 6.0f};
    const Palette colours = palette(Theme::Dark);
    std::vector<Pane> panes;
    for (const Rect& rect : tiled({{20.0f, 10.0f}, {320.0f, 230.0f}}, 3, 2.0f)) panes.push_back({rect});
    panes[0].drawn = many(40);
    panes[2].drawn = many(90);
    const Frame frame{window_->framebuffer(), size, 1.0f, true};
    for (int again = 0; again < 3; ++again) {  // the second time the background is copied
        renderer_.draw(panes, pose, colours, frame);
        const Image together = read_framebuffer(window_->framebuffer(), size);
        Renderer other;
        for (const Pane& pane : panes) {
            other.draw(pane.drawn, pane.camera(pose), colours, frame);
            EXPECT_TRUE(same_within(together, read_framebuffer(window_->framebuffer(), size), pane.rect))
                << again;
        }
    }
}

TEST_P(Drawing, CallsDoNotGrowWithStrokes) {
    const CameraPose pose{.pitch = 0.5f};
    draw(many(4), pose, palette(Theme::Dark), true);
    const int few = renderer_.draw_calls();
    draw(many(10000), pose, palette(Theme::Dark), true);
    EXPECT_EQ(renderer_.draw_calls(), few);
    EXPECT_LE(few, 6);
}

TEST_P(Drawing, ABallIsDrawnWhereTheCameraProjectsIt) {
    for (const bool orthographic : {false, true})
        for (const glm::vec3 at :
             {glm::vec3(0.0f), glm::vec3(1.3f, 0.7f, -0.5f), glm::vec3(-1.5f, -0.8f, 1.0f)}) {
            DrawList list;
            list.sphere(at, 0.3f, Unit::Metres, red).shade = Shade::Flat;
            const CameraPose pose{.yaw = 0.3f, .pitch = 0.2f, .distance = 6.0f, .orthographic = orthographic};
            const Image image = draw_plain(list, pose);
            glm::vec2 sum(0.0f);
            float weight = 0.0f;
            for (int y = 0; y < size.y; ++y)
                for (int x = 0; x < size.x; ++x) {
                    const float covered = red_at(image, x, y);
                    sum += covered * (glm::vec2(x, y) + 0.5f);
                    weight += covered;
                }
            ASSERT_GT(weight, 50.0f);
            const Camera camera(pose, viewport);
            EXPECT_LT(glm::distance(sum / weight, *camera.project(at)), 0.1f);
            const float radius = 0.3f / camera.metres_per_pixel(at);
            EXPECT_NEAR(weight, 3.14159f * radius * radius, 0.03f * weight) << "and as large";
        }
}

TEST_P(Drawing, NothingIsDrawnOutsideTheViewport) {
    DrawList list;
    list.line({-100, 0, 0}, {100, 0, 0}, 8.0f, red);
    const Image image = draw_plain(list, {});
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < 40; ++x) EXPECT_LT(red_at(image, x, y), 0.02f);
    EXPECT_GT(red_at(image, 41, 120), 0.9f);
}

TEST_P(Drawing, NearerSolidsHideFartherOnesWhateverTheOrder) {
    for (const bool swapped : {false, true}) {
        DrawList list;
        const Stroke nearer = list.sphere({0, 0, 1}, 0.5f, Unit::Metres, {0, 1, 0, 1});
        const Stroke farther = list.sphere({0, 0, -1}, 0.5f, Unit::Metres, red);
        list.strokes = swapped ? std::vector{farther, nearer} : std::vector{nearer, farther};
        const Image image = draw_plain(list, {});
        EXPECT_LT(red_at(image, 180, 120), 0.2f);
        list.strokes[swapped ? 0 : 1].layer = Layer::Overlay;
        EXPECT_GT(red_at(draw_plain(list, {}), 180, 120), 0.5f) << "but the overlay is over everything";
    }
}

TEST_P(Drawing, LinesKeepTheirWidthInPixels) {
    for (const float wanted : {3.0f, 0.25f}) {  // thinner than a pixel, they fade
        for (const float distance : {2.0f, CameraPose{}.distance, 50.0f}) {
            DrawList list;
            list.line({-100, 0, 0}, {100, 0, 0}, wanted, red);
            const Image image = draw_plain(list, {.distance = distance});
            float width = 0.0f;
            for (int y = 0; y < size.y; ++y) width += red_at(image, 180, y);
            EXPECT_NEAR(width, wanted, wanted > 1.0f ? 0.1f : 0.05f) << distance;
        }
    }
}

TEST_P(Drawing, PickingAgreesWithTheDrawnPixels) {
    DrawList all;
    all.bone({-1.2f, 0.4f, 0.8f}, {1.1f, -0.3f, -1.0f}, 0.35f, 0.1f, red);
    all.bone({0.0f, -0.6f, 3.0f}, {0.1f, -0.5f, -2.0f}, 0.1f, 0.3f, red);  // nearly end-on
    all.bone({0.0f, 0.0f, 0.0f}, {0.1f, 0.1f, 0.1f}, 0.1f, 0.5f, red);     // one ball inside the other
    all.line({-1.0f, -0.8f, 0.0f}, {0.9f, 0.9f, 0.3f}, 6.0f, red);
    all.line({-1.0f, -0.8f, 0.0f}, {0.9f, 0.9f, 30.0f}, 6.0f, red);  // through the eye
    all.ring({0.8f, 0.7f, 0.0f}, 18.0f, 4.0f, red);
    for (Stroke stroke : all.strokes) {
        stroke.pick = 1;
        if (stroke.shade == Shade::Lit) stroke.shade = Shade::Flat;  // then red is coverage
        const DrawList list{{stroke}, {}};
        for (const bool orthographic : {false, true}) {
            const CameraPose pose{.yaw = 0.2f, .pitch = 0.3f, .distance = 5.0f, .orthographic = orthographic};
            const Camera camera(pose, viewport);
            const Image image = draw_plain(list, pose);
            int drawn = 0, wrong = 0;
            for (int y = 20; y < 220; ++y)
                for (int x = 40; x < 320; ++x) {
                    const bool picked = pick(list, camera, glm::vec2(x, y) + 0.5f, 0.0f) == 1;
                    const float covered = red_at(image, x, y);
                    drawn += covered > 0.5f;
                    wrong += (picked && covered < 0.47f) || (!picked && covered > 0.53f);
                }
            EXPECT_GT(drawn, 300);
            EXPECT_EQ(wrong, 0);
        }
    }
}

TEST_P(Drawing, TheBackdropIsTheSameInEveryFrame) {
    const DrawList list = many(5);
    const CameraPose pose{.yaw = 0.4f, .pitch = 0.5f};
    const Image drawn = draw(list, pose, palette(Theme::Dark), true);
    const int calls = renderer_.draw_calls();
    EXPECT_EQ(draw(list, pose, palette(Theme::Dark), true).rgba, drawn.rgba);
    EXPECT_EQ(draw(list, pose, palette(Theme::Dark), true).rgba, drawn.rgba) << "copied";
    EXPECT_EQ(renderer_.draw_calls(), calls);
    const Image light = draw(list, pose, palette(Theme::Light), true);
    EXPECT_NE(light.rgba, drawn.rgba) << "another theme is another backdrop";
    draw(list, pose, palette(Theme::Light), true);
    EXPECT_NE(draw(list, pose, palette(Theme::Light), false).rgba, light.rgba);
    EXPECT_EQ(draw(list, pose, palette(Theme::Dark), true).rgba, drawn.rgba);
}

TEST_P(Drawing, BrokenStrokesAndPosesAreHarmless) {
    const float nan = std::nanf(""), infinite = INFINITY;
    DrawList list;
    for (const float bad : {nan, infinite, -infinite, 1e30f, -1e30f}) {
        list.sphere({bad, 0, 0}, 1.0f, Unit::Metres, red).shadow = true;
        list.sphere({0, 0, 0}, bad, Unit::Metres, red).shadow = true;
        list.bone({0, 0, 0}, {0, bad, 0}, 0.1f, bad, {bad, bad, bad, bad}).shadow = true;
        list.ring({bad, 0, 0}, bad, bad, red);
    }
    list.bone({0, 0, -1}, {0, 0, 100}, 0.1f, 0.2f, red).shadow = true;  // through the eye
    list.sphere({0, 0, 0}, 0.0f, Unit::Metres, red);
    draw(list, {.pitch = 0.5f}, palette(Theme::Dark), true);
    draw(list, {.target = {nan, 0, 0}, .distance = infinite}, palette(Theme::Dark), true);
    renderer_.draw(list, Camera({}, Rect{}), palette(Theme::Dark),
                   {window_->framebuffer(), size, 1.0f, true});
    renderer_.draw(list, Camera({}, {{-5000, -5000}, {9000, 9000}}), palette(Theme::Dark),
                   {window_->framebuffer(), size, 2.0f, true});
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

LABEL(nightly, "Backends/Drawing.*/Egl");
INSTANTIATE_TEST_SUITE_P(Backends, Drawing, testing::ValuesIn(test::backends_here()),
                         [](const auto& test) { return test.param == Backend::Egl ? "Egl" : "OsMesa"; });

TEST(Drawings, OsMesaAndEglDifferByOneInAFewPixels) {
    Image images[2];
    for (const Backend backend : {Backend::OsMesa, Backend::Egl}) {
        if (const std::string why = test::why_missing(backend); !why.empty()) GTEST_SKIP() << why;
        const auto window = open_window(backend, size);
        Renderer renderer;
        renderer.draw(many(300), Camera({.yaw = 0.4f, .pitch = 0.5f}, viewport), palette(Theme::Dark),
                      {window->framebuffer(), size, 1.0f, true});
        images[backend == Backend::Egl] = read_framebuffer(window->framebuffer(), size);
    }
    int differing = 0, most = 0;
    for (std::size_t i = 0; i < images[0].rgba.size(); ++i) {
        const int difference = std::abs(images[0].rgba[i] - images[1].rgba[i]);
        differing += difference != 0;
        most = std::max(most, difference);
    }
    EXPECT_LE(most, 1);
    EXPECT_LE(differing, 400);
}

}  // namespace
}  // namespace tendril::app::renderer_test

namespace tendril::app {
namespace {

// Windows without a screen: both kinds open, draw, resize, and refuse impossible sizes.

class Offscreen : public testing::TestWithParam<Backend> {};

/// Clears to a colour and expects it in every pixel.
void expect_clears(Window& window, glm::ivec2 size) {
    EXPECT_EQ(window.framebuffer_size(), size);
    glBindFramebuffer(GL_FRAMEBUFFER, window.framebuffer());
    glViewport(0, 0, size.x, size.y);
    glClearColor(0.2f, 0.4f, 0.6f, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT);
    window.present();
    const Image image = read_framebuffer(window.framebuffer(), size);
    ASSERT_EQ(image.rgba.size(), static_cast<std::size_t>(4 * size.x * size.y));
    for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
        ASSERT_EQ(image.rgba[i], 51);
        ASSERT_EQ(image.rgba[i + 1], 102);
        ASSERT_EQ(image.rgba[i + 2], 153);
        ASSERT_EQ(image.rgba[i + 3], 255);
    }
}

TEST_P(Offscreen, OpensWithCoreGlAndDraws) {
    const auto window = open_window(GetParam(), {64, 48});
    GLint major = 0, minor = 0, profile = 0;
    glGetIntegerv(GL_MAJOR_VERSION, &major);
    glGetIntegerv(GL_MINOR_VERSION, &minor);
    glGetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
    EXPECT_GE(10 * major + minor, 33);
    EXPECT_NE(profile & GL_CONTEXT_CORE_PROFILE_BIT, 0);
    expect_clears(*window, {64, 48});
}

TEST_P(Offscreen, ChangesItsSize) {
    const auto window = open_window(GetParam(), {64, 48});
    for (const glm::ivec2 size : {glm::ivec2(200, 10), glm::ivec2(1, 1), glm::ivec2(300, 300)}) {
        window->resize(size);
        EXPECT_EQ(window->size(), size);
        expect_clears(*window, size);
    }
}

TEST_P(Offscreen, RefusesImpossibleSizes) {
    for (const glm::ivec2 bad :
         {glm::ivec2(0, 10), glm::ivec2(10, -1), glm::ivec2(16385, 10), glm::ivec2(10, 1 << 30)})
        EXPECT_THROW(open_window(GetParam(), bad), std::runtime_error);
    const auto window = open_window(GetParam(), {64, 48});
    EXPECT_THROW(window->resize({0, 0}), std::runtime_error);
    EXPECT_EQ(window->size(), glm::ivec2(64, 48));
    expect_clears(*window, {64, 48});
}

LABEL(nightly, "Backends/Offscreen.*/Egl");
INSTANTIATE_TEST_SUITE_P(Backends, Offscreen, testing::ValuesIn(test::backends_here()),
                         [](const auto& test) { return test.param == Backend::Egl ? "Egl" : "OsMesa"; });

TEST(OpenWindow, AMissingDisplayIsOneClearLine) {
    const char* const before = std::getenv("DISPLAY");
    const std::string display = before == nullptr ? "" : before;
    ASSERT_EQ(setenv("DISPLAY", ":4711", 1), 0);
    try {
        open_window(Backend::Glfw, {64, 48});
        ADD_FAILURE() << "there is no such display";
    } catch (const std::runtime_error& error) {
        const std::string text = error.what();
        EXPECT_EQ(text.rfind("no display: ", 0), 0u) << text;
        EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    }
    before == nullptr ? unsetenv("DISPLAY") : setenv("DISPLAY", display.c_str(), 1);
}

}  // namespace
}  // namespace tendril::app
