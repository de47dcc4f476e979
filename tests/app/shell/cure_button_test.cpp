// The button beside an explanation that names a cure runs it, as one step to undo.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "app/app.hpp"
#include "app/document/json_complete.hpp"
#include "tests/app/support/frame_record.hpp"

namespace tendril::test {
namespace {

using namespace app;

class CureButton : public testing::Test {
  protected:
    void run(const std::string& command, Json arguments = Json::object()) {
        app_.run({command, std::move(arguments)});
    }
    void wait(int ticks) {
        for (int i = 0; i < ticks; ++i) app_.tick(nullptr);
    }
    /// The middle of a text that is on the screen, not scrolled out of view.
    std::optional<glm::vec2> seen(const std::string& text) {
        wait(4);
        for (const DrawnText& each : recorder_.frame().texts) {
            const glm::vec2 middle = 0.5f * (each.box.min + each.box.max);
            if (each.text == text && each.clip.contains(middle)) return middle;
        }
        return std::nullopt;
    }
    void click(const std::string& text) {
        const auto at = seen(text);
        ASSERT_TRUE(at) << text;
        const Event events[] = {MouseMove{*at}, MousePress{MouseButton::Left, true},
                                MousePress{MouseButton::Left, false}};
        for (const Event& event : events) app_.tick(&event);
        wait(3);
    }
    std::string verdict() { return app_.state().at("verdict"); }

    std::unique_ptr<Window> window_ = open_offscreen({1280, 720});
    App app_{*window_};
    FrameRecorder recorder_;
};

TEST_F(CureButton, BendsAStraightChain) {
    run("chain.preset", {{"name", "straight"}});
    EXPECT_EQ(verdict(), "Stalled: 0.75 m short");
    click("Add a pole target");
    EXPECT_EQ(verdict(), "Reached");
    EXPECT_FALSE(seen("Add a pole target"));
    run("undo");
    EXPECT_EQ(verdict(), "Stalled: 0.75 m short");
    // Two commands, one step.
    run("chain.target", {{"to", {2.5, 1.5, 0}}});
    run("chain.solver", {{"name", "jacobian_transpose"}, {"iterations", 1}});
    run("chain.target", {{"to", {0.5, 2.5, 1}}});
    const std::string before = verdict();
    EXPECT_EQ(before.find("Not there yet"), 0u) << before;
    click("More iterations");
    EXPECT_NE(verdict(), before);
    run("undo");
    EXPECT_EQ(verdict(), before);
}

TEST_F(CureButton, HalvesTheSubstepOfARopeThatIsNotHeld) {
    run("lab.open", {{"name", "rope"}});
    run("rope.preset", {{"name", "bridge"}});
    const auto still = seen("Selection");
    ASSERT_TRUE(still);
    run("rope.settings", {{"solver", "relaxation"}, {"iterations", 1}});
    run("time.play");
    wait(90);
    run("time.pause");
    const auto heading = seen("Selection");
    ASSERT_TRUE(heading);
    EXPECT_EQ(heading->y, still->y) << "the rows below keep still";
    const auto substep = [&] { return app_.state().at("settings").at("substep").get<double>(); };
    const double before = substep();
    click("Halve the substep");
    EXPECT_NEAR(substep(), 0.5 * before, 1e-12);
}

/// Also with a joint selected, whose rows would push it out of a small window.
TEST_F(CureButton, OfAFlipIsInViewOnceItsMarkIsClicked) {
    run("chain.preset", {{"name", "reaching_arm"}});
    run("chain.select", {{"index", 1}});
    for (int i = 0; i <= 60; ++i) {
        const double x = 1.6 - 2.6 * i / 60.0;
        run("chain.target", {{"to", {x, 2.95 - 0.3 * std::abs(x - 0.3), -0.605}}});
        wait(1);
    }
    wait(60);
    const Json events = app_.state().at("events");
    std::size_t flip = 0;
    while (flip < events.size() && events[flip].at("kind") != "flip") ++flip;
    ASSERT_LT(flip, events.size());
    EXPECT_FALSE(seen("Move the pole"));
    run("time.incident", {{"number", flip}});
    EXPECT_TRUE(seen("Move the pole"));
    click("Move the pole");
    EXPECT_NE(app_.state().at("solve").at("pole").at(2).get<double>(), -0.5);
    run("undo");
    EXPECT_GT(app_.workspace().later_ticks(), 20u) << "what came after is back";
}

}  // namespace
}  // namespace tendril::test
