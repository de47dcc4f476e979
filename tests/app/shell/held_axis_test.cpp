// A drag along an axis tells how far it has gone, above all along the view, where the picture does not.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "app/app.hpp"
#include "app/document/json_complete.hpp"
#include "tests/app/support/frame_record.hpp"
#include "tests/app/support/play.hpp"
#include "tests/says.hpp"

namespace tendril::test {
namespace {

using namespace app;

class HeldAxis : public testing::Test {
  protected:
    void send(const Event& event) { app_.tick(&event); }
    void catch_handle(const char* name) {
        for (int i = 0; i < 3; ++i) app_.tick(nullptr);
        at_ = handle(app_.state(), name);
        send(MouseMove{at_});
        send(MousePress{MouseButton::Left, true});
    }
    void move(glm::vec2 by) { send(MouseMove{at_ += by}); }
    std::vector<std::string> texts_with(const std::string& what) {
        app_.tick(nullptr);
        std::vector<std::string> found;
        for (const DrawnText& each : recorder_.frame().texts)
            if (each.text.find(what) != std::string::npos) found.push_back(each.text);
        return found;
    }

    std::unique_ptr<Window> window_ = open_offscreen({1280, 800});
    App app_{*window_};
    FrameRecorder recorder_;
    glm::vec2 at_{0.0f};
};

TEST_F(HeldAxis, SaysHowFarAndHowMuchNearer) {
    app_.run({"chain.preset", Json{{"name", "reaching_arm"}}});
    app_.run({"camera.set",
              Json{{"target", {0.85, 1.05, 0.2}}, {"yaw_deg", -8}, {"pitch_deg", 15}, {"distance", 7}}});
    app_.run({"time.pause", Json::object()});
    const auto z = [&] { return app_.state().at("solve").at("pole").at(2).get<double>(); };
    const double before = z();
    catch_handle("pole");
    send(KeyChange{.key = Key::Z, .down = true});
    move({-6, 16});
    move({-6, 16});
    const double by = z() - before;
    ASSERT_GT(std::abs(by), 0.2);
    char said[32];
    std::snprintf(said, sizeof said, "%.2f m along Z", std::abs(by));
    const auto texts = texts_with(said);
    ASSERT_EQ(texts.size(), 2u) << "at the ball and in the status line: " << said;
    for (const std::string& text : texts) EXPECT_TRUE(says(text, by > 0 ? "m nearer" : "m farther")) << text;
    // Released, the drag goes on in the plane of the view.
    send(KeyChange{.key = Key::Z, .down = false});
    EXPECT_TRUE(texts_with("along Z").empty());
}

TEST_F(HeldAxis, AcrossTheViewSaysOnlyHowFar) {
    app_.run({"chain.preset", Json{{"name", "start"}}});
    app_.run({"camera.set", Json{{"yaw_deg", 0}, {"pitch_deg", 10}}});
    catch_handle("target");
    send(KeyChange{.key = Key::X, .down = true});
    move({-40, 0});
    move({-40, 0});
    const auto texts = texts_with("m along X");
    ASSERT_EQ(texts.size(), 2u);
    for (const std::string& text : texts) EXPECT_EQ(text.find("nearer"), text.npos) << text;
}

}  // namespace
}  // namespace tendril::test
