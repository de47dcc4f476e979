// Windows without a screen: both kinds open, draw, resize, and refuse impossible sizes.
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "app/io/image.hpp"
#include "app/window/gl.hpp"
#include "app/window/window.hpp"
#include "tests/app/support/backends.hpp"

namespace tendril::app {
namespace {

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

TEST_P(Offscreen, RefusesSizesThatCannotBe) {
    for (const glm::ivec2 bad :
         {glm::ivec2(0, 10), glm::ivec2(10, -1), glm::ivec2(16385, 10), glm::ivec2(10, 1 << 30)}) {
        EXPECT_THROW(open_window(GetParam(), bad), std::runtime_error);
    }
    const auto window = open_window(GetParam(), {64, 48});
    EXPECT_THROW(window->resize({0, 0}), std::runtime_error);
    EXPECT_EQ(window->size(), glm::ivec2(64, 48));
    expect_clears(*window, {64, 48});
}

TEST_P(Offscreen, NothingEverHappensToIt) {
    const auto window = open_window(GetParam(), {64, 48});
    std::vector<Event> events;
    window->poll(events, 10.0);
    EXPECT_TRUE(events.empty());
    window->set_clipboard("one\ntwo");
    EXPECT_EQ(window->clipboard(), "one\ntwo");
}

TEST_P(Offscreen, CanBeOpenedAgain) {
    for (int i = 0; i < 3; ++i) expect_clears(*open_window(GetParam(), {32, 32}), {32, 32});
}

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
