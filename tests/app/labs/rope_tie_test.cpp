// Ties in the Rope lab: commands, clicks, files, time.
#include "app/labs/rope/code.hpp"
#include "app/labs/rope/numbers.hpp"
#include "tests/app/labs/rope_support.hpp"
#include "tests/app/support/panel_text.hpp"
#include "tests/labels.hpp"
#include "tests/says.hpp"

namespace tendril::app {
namespace {

class RopeTieTest : public RopeTest {
  protected:
    /// Two hanging ropes, the lower one's start 0.2 m below the upper one's end.
    void two_ropes() {
        run("rope.clear");
        add_rope("above", {0, 2, 0}, {0, 1.5, 0}, {{"segments", 4}, {"pin_start", true}});
        add_rope("below", {0, 1.3, 0}, {0, 0.8, 0}, {{"segments", 4}});
    }
    void tie_them(Json more = Json::object()) {
        Json arguments{{"a", "above"}, {"a_particle", 4}, {"b", "below"}, {"b_particle", 0}};
        arguments.update(more);
        run("rope.tie", arguments);
    }
    void click(const char* body, std::size_t index) {
        click(particle_pick(world().find(body)->first + index));
    }
    void click(PickId pick) {
        emit([&](Emit& to) { lab().click(workspace, pick, to); });
    }
};

LABEL(slow, "RopeTieTest.Refusals");

/// While a tie draws its ends together, the solver's force moves them and is not a load.
TEST_F(RopeTieTest, HasATensionOnceItIsClosed) {
    two_ropes();
    tie_them();
    run("rope.select", {{"tie", "tie"}});
    wait(3);
    EXPECT_EQ(state()["ties"][0]["tension"], nullptr);
    EXPECT_TRUE(test::says(test::PanelReader().inspector(lab(), workspace), "tension closing to go"));
    wait(120);
    EXPECT_NEAR(state()["ties"][0]["tension"].get<double>(), 0.6 * 9.81, 1.0);
    EXPECT_TRUE(test::says(test::PanelReader().inspector(lab(), workspace), "tension N"));
    // Between pins that are too far apart for it, no number is correct.
    run("rope.pin", {{"rope", "below"}, {"particle", 4}, {"at", {0, 0.5, 0}}});
    wait(120);
    EXPECT_EQ(state()["ties"][0]["tension"], nullptr);
    EXPECT_TRUE(test::says(test::PanelReader().inspector(lab(), workspace), "tension without limit"));
    run("rope.select", {{"rope", "above"}, {"particle", 2}});
    EXPECT_TRUE(test::says(test::PanelReader().inspector(lab(), workspace), "tension without limit"));
}

TEST_F(RopeTieTest, AColliderIsRefusedAndAWeightHangsInstead) {
    two_ropes();
    run("rope.collider.add", {{"name", "lamp"}, {"kind", "sphere"}, {"centre", {0, 1, 0}}, {"radius", 0.1}});
    run("rope.tool", {{"name", "tie"}});
    click("above", 4);
    Emit emit;
    lab().click(workspace, collider_pick(0), emit);
    const std::vector<Emitted> tie = emit.take();
    ASSERT_EQ(tie.size(), 1u);
    refuses(tie[0].name.c_str(), *tie[0].arguments, "lamp collider mass");
    const double rest = world().state().mass[3];
    run("rope.weight", {{"rope", "above"}, {"particle", 4}, {"mass", 2}});
    EXPECT_EQ(world().state().mass[4], 2.0);
    EXPECT_EQ(world().state().mass[3], rest);
    wait(120);
    EXPECT_NEAR(world().state().links[3].tension, 2.0 * 9.81, 0.5) << "what carries it";
    run("rope.select", {{"rope", "above"}, {"particle", 3}});
    run("rope.set", {{"rope", "above"}, {"tear", 0.01}});
    const auto shown = [&] { return tension_text(world(), *rope_part(workspace).selection); };
    EXPECT_TRUE(shown().ends_with(" N, too stiff to tear")) << shown();
    run("rope.set", {{"rope", "above"}, {"stretch", 1e-4}});
    EXPECT_TRUE(shown().ends_with(" N, tears at 100.00 N")) << shown();
    refuses("rope.weight", {{"rope", "above"}, {"particle", 4}, {"mass", 0}}, "mass");
    refuses("rope.weight", {{"rope", "above"}, {"particle", 5}, {"mass", 1}}, "particle");
}

TEST_F(RopeTieTest, TwoClicksTieAndSelectTheTie) {
    two_ropes();
    run("rope.tool", {{"name", "tie"}});
    click("above", 4);
    EXPECT_TRUE(world().state().ties.empty());
    EXPECT_TRUE(test::says(lab().hint(workspace, particle_pick(6)), "below particle 1 ties selected"));
    click("below", 0);
    ASSERT_EQ(world().state().ties.size(), 1u);
    EXPECT_EQ(state()["selected"], Json({{"tie", "tie"}}));
    // The next two clicks make another tie.
    click("above", 2);
    click("below", 2);
    EXPECT_EQ(world().state().ties.size(), 2u);
    EXPECT_EQ(state()["selected"], Json({{"tie", "tie 2"}}));
    run("rope.remove_selected");
    EXPECT_EQ(world().state().ties.size(), 1u);
    EXPECT_EQ(state()["selected"], nullptr);
}

/// Arrows over the next particle to click would take the click.
TEST_F(RopeTieTest, AClickThatMissesKeepsTheFirstEndAndShowsNoGizmo) {
    two_ropes();
    click("above", 4);
    run("rope.pin", {{"rope", "above"}, {"particle", 4}});
    ASSERT_TRUE(lab().gizmo(workspace));
    run("rope.tool", {{"name", "tie"}});
    EXPECT_EQ(state()["selected"], nullptr) << "what was selected before is no end of a tie";
    click("above", 4);
    EXPECT_FALSE(lab().gizmo(workspace));
    run("view.close");
    EXPECT_EQ(state()["selected"], nullptr) << "Escape forgets the first end";
    click("above", 4);
    click(no_pick);
    EXPECT_TRUE(test::says(lab().hint(workspace, no_pick), "above particle 4 click what to tie Escape"));
    click("below", 0);
    EXPECT_EQ(world().state().ties.size(), 1u);
}

TEST_F(RopeTieTest, TearsAndDisappears) {
    two_ropes();
    tie_them({{"length", 0.2}, {"name", "thread"}});
    wait(120);
    run("rope.select", {{"tie", "thread"}});
    run("rope.tie.set", {{"name", "thread"}, {"strength", 1}});
    wait(1);
    EXPECT_TRUE(world().state().ties.empty());
    EXPECT_EQ(state()["selected"], nullptr);
    wait(30);
    EXPECT_LT(world().position(world().find("below")->first).y, 1.0f);
}

TEST_F(RopeTieTest, IsRemovedWithItsBody) {
    two_ropes();
    tie_them();
    tie_them({{"a_particle", 1}, {"b_particle", 3}, {"name", "second"}});
    run("rope.cut", {{"rope", "above"}, {"segment", 2}});
    EXPECT_EQ(state()["ties"][0]["a"], "above 2");
    EXPECT_EQ(state()["ties"][0]["a_particle"], 1);
    EXPECT_EQ(state()["ties"][1]["a"], "above");
    EXPECT_EQ(state()["ties"][1]["b"], "below");
    EXPECT_EQ(state()["ties"][1]["b_particle"], 3);
    run("rope.remove", {{"name", "above 2"}});
    ASSERT_EQ(state()["ties"].size(), 1u);
    EXPECT_EQ(state()["ties"][0]["name"], "second");
    run("rope.untie", {{"name", "second"}});
    EXPECT_EQ(state()["ties"], Json::array());
}

TEST_F(RopeTieTest, IsInTheCode) {
    run("rope.preset", {{"name", "line"}});
    wait(40);
    EXPECT_TRUE(
        test::says(rope_code(part()), "\"tie\" state.ties.push_back .length 0.04f rope::number_slots"));
}

TEST_F(RopeTieTest, Refusals) {
    two_ropes();
    tie_them();
    expect_refused("rope.tie", {{"a", "above"}, {"a_particle", 1}, {"b", "above"}, {"b_particle", 1}},
                   {"itself"});
    expect_refused("rope.tie", {{"a", "above"}, {"a_particle", 9}, {"b", "below"}, {"b_particle", 1}},
                   {"9", "above", "5"});
    expect_refused("rope.tie", {{"a", "none"}, {"a_particle", 0}, {"b", "below"}, {"b_particle", 1}},
                   {"none"});
    expect_refused("rope.tie",
                   {{"a", "above"}, {"a_particle", 0}, {"b", "below"}, {"b_particle", 1}, {"name", "tie"}},
                   {"tie"});
    add_cloth("sail", {0, 1, 0}, {1, 0, 0}, {0, -1, 0}, 90, 90);
    // Few ties of a cloth cost little; from two per side on they cost as much as its elimination.
    const auto sewn = [](int at) {
        return Json{{"a", "above"}, {"a_particle", 0}, {"b", "sail"}, {"b_particle", at}};
    };
    for (int at = 0; at < 180; ++at) run("rope.tie", sewn(at));
    expect_refused("rope.tie", sewn(180), {"steps", "maximum"});
    expect_refused("rope.untie", {{"name", "knot"}}, {"knot"});
    expect_refused("rope.select", {{"tie", "tie"}, {"rope", "above"}, {"particle", 0}}, {"both"});
}

}  // namespace
}  // namespace tendril::app
