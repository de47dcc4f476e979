// The Linkage lab in the running program: a four-bar drawn with the mouse, and run.

#include "tests/app/support/play.hpp"

namespace tendril::test {
namespace {

using app::Json;

TEST(LinkageInTheWindow, AFourBarIsDrawnByMouseAndRun) {
    ScriptText script =
        ScriptText().command("lab.open", {{"name", "linkage"}}).command("linkage.clear").wait(2);
    const glm::vec2 a{500, 420}, b{500, 340}, c{640, 300}, d{700, 420};
    script.drag({a, {510, 400}, b}).drag({b, {560, 320}, c}).drag({c, {680, 360}, d}).wait(2);
    Json state = state_after(script);
    ASSERT_EQ(state.at("points").size(), 4u) << "strokes that begin at a joint go on from it";
    EXPECT_EQ(state.at("verdict"), "Nothing holds it");
    script.command("linkage.tool", {{"name", "pin"}}).click(a).wait(30).click(d).wait(30);
    script.command("linkage.tool", {{"name", "motor"}}).click(a).wait(2);
    state = state_after(script);
    EXPECT_EQ(state.at("freedom"), 1);
    ASSERT_EQ(state.at("drivers").size(), 1u);
    EXPECT_EQ(state.at("tool"), "move") << "a motor is placed once";
    const double before = state.at("drivers").at("motor 1").get<double>();
    script.command("linkage.motor", {{"joint", "motor 1"}}).wait(20);
    state = state_after(script);
    EXPECT_NEAR(state.at("drivers").at("motor 1").get<double>(), before + 30.0, 1e-6);
    EXPECT_LT(state.at("closed_to").get<double>(), 1e-6);
}

TEST(LinkageInTheWindow, AClickAddsAJointInEmptySpaceOrOnABar) {
    ScriptText script =
        ScriptText().command("lab.open", {{"name", "linkage"}}).command("linkage.clear").wait(2);
    script.drag({{500, 420}, {560, 420}, {700, 420}})
        .wait(30)
        .click({600, 422})
        .wait(30)
        .click({600, 300})
        .wait(2);
    const Json state = state_after(script);
    EXPECT_EQ(state.at("points").size(), 4u);
    script.command("linkage.pin", {{"point", "A"}});
    script.command("linkage.drag", {{"point", "B"}, {"to", {state["points"]["A"][0].get<double>(), 9, 0}}});
    const Json turned = state_after(script);
    EXPECT_GT(turned["points"]["C"][1].get<double>() - state["points"]["C"][1].get<double>(), 0.5)
        << "the joint on the bar turns with it";
    EXPECT_EQ(turned["points"]["D"], state["points"]["D"]);
}

TEST(LinkageInTheWindow, APresetRestartsTheLastTenSeconds) {
    ScriptText script = ScriptText()
                            .command("lab.open", {{"name", "linkage"}})
                            .command("view.linkage_plot", {{"of", "motor"}})
                            .command("linkage.preset", {{"name", "four_bar"}})
                            .command("linkage.motor", {{"joint", "crank"}})
                            .wait(60);
    const Json first = state_after(script);
    EXPECT_GE(first["time"]["remembered"].get<int>(), 59);
    EXPECT_GE(first["past"]["plot"]["values"].size(), 59u);
    script.command("linkage.preset", {{"name", "slider_crank"}});
    const Json opened = state_after(script);
    EXPECT_EQ(opened["past"]["plot"]["values"].size(), 1u) << "the new linkage as it is";
    const Json undone = state_after(ScriptText(script).command("undo"));
    EXPECT_EQ(undone["points"], first["points"]);
    EXPECT_EQ(undone["past"]["plot"]["values"].size(), first["past"]["plot"]["values"].size())
        << "undo brings its past back";
    script.command("linkage.motor", {{"joint", "crank"}}).wait(20);
    const Json runs = state_after(script);
    EXPECT_LE(runs["past"]["plot"]["values"].size(), 22u);
    EXPECT_GE(runs["past"]["plot"]["values"].size(), 20u);
    script.command("linkage.clear");
    EXPECT_EQ(state_after(script)["events"], Json::array());
}

}  // namespace
}  // namespace tendril::test
