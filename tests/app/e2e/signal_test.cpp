// The Signal lab in the running program: the ball dragged by the mouse, a response drawn, small windows.
#include <cmath>

#include "tests/app/support/play.hpp"

namespace tendril::test {
namespace {

using app::Json;

ScriptText signal_lab() {
    return ScriptText()
        .command("lab.open", {{"name", "signal"}})
        .command("signal.input", {{"kind", "hand"}})
        .wait(10);
}

ScriptText dragged_ball(const ScriptText& before, float pixels) {
    const glm::vec2 at = handle(state_after(before), "hand");
    ScriptText script = before;
    script.move(at).down();
    for (int i = 1; i <= 10; ++i) script.move(at - glm::vec2(0.0f, 0.1f * static_cast<float>(i) * pixels));
    return script;
}

TEST(SignalInTheWindow, TheBallThatIsDraggedIsTheInput) {
    const ScriptText before = signal_lab();
    ScriptText script = dragged_ball(before, 60.0f).up().wait(120);
    const Json state = state_after(script);
    EXPECT_EQ(state.at("input_kind"), "hand");
    const double input = state.at("input").get<double>();
    EXPECT_GT(input, 0.3);
    EXPECT_NEAR(state.at("output").get<double>(), input, 0.1 * input) << "the spring follows";
    const float moved = handle(state_after(before), "hand").y - handle(state, "hand").y;
    EXPECT_NEAR(moved, 60.0f, 1.5f);
    const Json back = state_after(script.command("undo").wait(1));
    EXPECT_NEAR(back.at("input").get<double>(), 0.0, 1e-6) << "the whole drag is one step";
}

TEST(SignalInTheWindow, DraggingTakesAWaveOver) {
    const ScriptText before =
        ScriptText().command("lab.open", {{"name", "signal"}}).wait(30).command("time.pause");
    ScriptText script = dragged_ball(before, -30.0f).up();
    EXPECT_EQ(state_after(script).at("input_kind"), "hand");
}

TEST(SignalInTheWindow, AResponseIsDrawnWithTheMouse) {
    ScriptText script = ScriptText()
                            .command("lab.open", {{"name", "signal"}})
                            .command("time.pause")
                            .command("signal.plot", {{"name", "fit"}})
                            .wait(2);
    script.drag({{450, 560}, {470, 560}, {500, 540}, {560, 500}, {600, 500}});
    script.command("signal.fit");
    const Json state = state_after(script);
    EXPECT_EQ(state.at("plot"), "fit");
    EXPECT_FALSE(state.at("fits").empty());
    const Json undone = state_after(script.command("undo").command("undo"));
    EXPECT_TRUE(undone.at("fits").empty());
    script.command("signal.fit", Json::object(), true);
    EXPECT_TRUE(state_after(script).at("fits").empty()) << "what was drawn is undone in one step";
}

TEST(SignalInTheWindow, AHandAtRestLetsTheWindowIdle) {
    ScriptText script = signal_lab().wait(650);
    const Json rested = state_after(script), later = state_after(script.wait(100));
    EXPECT_EQ(rested.at("seconds"), later.at("seconds"));
    EXPECT_LT(rested.at("seconds").get<double>(), 10.5);
}

}  // namespace
}  // namespace tendril::test
