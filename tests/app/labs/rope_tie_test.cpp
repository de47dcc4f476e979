// Ties in the Rope lab: commands, clicks, files, time.
#include <sstream>
#include <utility>

#include "app/labs/rope/numbers.hpp"
#include "app/labs/rope/rope_edit.hpp"
#include "app/labs/rope/rope_time.hpp"
#include "app/widgets/emit.hpp"
#include "tests/app/labs/rope_support.hpp"
#include "tests/app/support/panel_text.hpp"

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
    const auto shown = [&] { return test::PanelReader().inspector(lab(), workspace); };
    EXPECT_TRUE(test::says(shown(), "tears at only by its pins")) << shown();
    run("rope.set", {{"rope", "above"}, {"stretch", 1e-4}});
    EXPECT_TRUE(test::says(shown(), "tears at 100.00 N")) << shown();
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
    EXPECT_TRUE(
        test::says(lab().hint(workspace, no_pick), "above particle 4 click the particle to tie Escape"));
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

// The race of rope solvers: one scene, a world for each solver, changed together.

class RopeRace : public RopeTest {
  protected:
    RopeRace() {
        run("rope.clear");
        const Json slack{{"segments", 64}, {"length", 1.1}, {"pin_start", true}, {"pin_end", true}};
        add_rope("rope", {0, 2, 0}, {1, 2, 0}, slack);
        run("rope.race");
    }
    const NamedWorld& rival(std::size_t i) const { return *part().rivals.at(i).world; }
    std::vector<std::string> solvers() const {
        std::vector<std::string> names;
        const Json race = state().at("race");
        for (const Json& each : race) names.push_back(each.at("solver"));
        return names;
    }
};

TEST_F(RopeRace, EachSolverHasItsPaneAndItsError) {
    wait(180);
    EXPECT_EQ(solvers(), (std::vector<std::string>{"direct", "xpbd", "relaxation"}));
    const Json race = state().at("race");
    EXPECT_LT(race[0].at("length_error"), 0.001);
    EXPECT_GT(race[2].at("length_error"), 0.02) << "plain relaxation lengthens a taut rope";
    const std::vector<PaneTitle> panes = lab().panes(workspace);
    ASSERT_EQ(panes.size(), 3u);
    EXPECT_EQ(panes[2].text, "Relaxation");
    EXPECT_TRUE(test::says(panes[2].detail, "length error % J"));
    run("rope.race", {{"on", false}});
    EXPECT_TRUE(lab().panes(workspace).empty());
    EXPECT_EQ(state().at("race"), nullptr);
    refuses("rope.race", {{"on", false}}, "no race is open");
}

TEST_F(RopeRace, ChangesApplyToAllWorlds) {
    wait(10);
    run("rope.collider.add",
        {{"name", "ball"}, {"kind", "sphere"}, {"centre", {0.5, 1, 0}}, {"radius", 0.1}});
    run("rope.hold", {{"rope", "rope"}, {"particle", 20}, {"at", {0.3, 1.9, 0.2}}});
    wait(5);
    for (std::size_t pane = 0; pane < 3; ++pane) {
        const NamedWorld& world = world_in(part(), pane);
        EXPECT_NE(world.find_collider("ball"), nullptr) << pane;
        EXPECT_LT(glm::distance(world.position(20), {0.3f, 1.9f, 0.2f}), 1e-3f) << pane;
    }
    run("rope.let_go");
    for (std::size_t pane = 0; pane < 3; ++pane) EXPECT_FALSE(world_in(part(), pane).pinned(20)) << pane;
    run("undo");
    run("undo");
    for (std::size_t pane = 0; pane < 3; ++pane)
        EXPECT_EQ(world_in(part(), pane).find_collider("ball"), nullptr) << pane;
    run("undo");
    EXPECT_TRUE(part().rivals.empty());
    run("redo");
    EXPECT_EQ(part().rivals.size(), 2u);
}

TEST_F(RopeRace, APresetIsRacedFromItsStart) {
    wait(10);
    run("rope.preset", {{"name", "flag"}});
    EXPECT_EQ(solvers(), (std::vector<std::string>{"direct", "xpbd", "relaxation"}));
    for (std::size_t pane = 0; pane < 3; ++pane) EXPECT_NE(world_in(part(), pane).find("flag"), nullptr);
}

TEST_F(RopeRace, AChosenSolverSwapsPlacesWithTheOwn) {
    wait(60);
    const double relaxed = rival(1).length_error(), direct = world().length_error();
    run("rope.settings", {{"solver", "relaxation"}, {"iterations", 20}});
    EXPECT_EQ(solvers(), (std::vector<std::string>{"relaxation", "xpbd", "direct"}));
    EXPECT_DOUBLE_EQ(world().length_error(), relaxed);
    EXPECT_DOUBLE_EQ(rival(1).length_error(), direct);
    for (std::size_t pane = 0; pane < 3; ++pane)
        EXPECT_EQ(world_in(part(), pane).settings().iterations, 20) << pane;
}

TEST_F(RopeRace, APastMomentIsRacedToo) {
    std::vector<std::pair<glm::vec3, glm::vec3>> all;  // of the own world and of a rival
    const auto now = [&] { return std::pair(world().position(30), rival(1).position(30)); };
    for (int i = 0; i < 40; ++i) {
        wait(1);
        remember();
        all.push_back(now());
    }
    run("time.seek", {{"ticks_back", 20}});
    EXPECT_NE(now(), all.back());
    EXPECT_NE(std::ranges::find(all, now()), all.end());
}

TEST_F(RopeRace, WithTheSameSolverTwiceIsRefused) {
    expect_scene_refused("/rivals/1", saved()["rivals"][0], "rivals");
}

TEST_F(RopeRace, APaneIsPickedInItsOwnWorld) {
    wait(120);
    const PickId there = pick_in(2, particle_pick(32));
    const std::optional<Handle> handle = lab().handle(workspace, there);
    ASSERT_TRUE(handle);
    EXPECT_EQ(handle->pick, there);
    EXPECT_EQ(handle->frame.position, rival(1).position(32));
    EXPECT_NE(handle->frame.position, world().position(32));
    EXPECT_FALSE(lab().handle(workspace, pick_in(5, tie_pick(3))));
}

TEST_F(RopeRace, ResetRestartsIt) {
    run("rope.reset");
    EXPECT_EQ(solvers().size(), 3u);
}

/// After a cut in one world only, as when a rope tears only there, a drag lets go in all worlds.
TEST_F(RopeRace, ADragIsReleasedInEveryWorldByItsOwnNames) {
    run("rope.hold", {{"rope", "rope"}, {"particle", 40}, {"at", {0.6, 1.9, 0.2}}});
    RopePart& changed = workspace.document.edit<RopePart>(rope_lab);
    RopePart same = part_of_rival(changed, changed.rivals[0]);
    auto torn = std::make_shared<NamedWorld>(*same.world);
    const Became became = torn->cut("rope", 20);
    follow_particles(same, *torn, "rope", became);
    changed.rivals[0] = {torn, {}, same.hold};
    ASSERT_EQ(rival(0).state().pins.size(), 3u);
    ASSERT_EQ(part().rivals[0].hold->body, "rope 2");
    EXPECT_EQ(part().save()["rivals"][0]["pins"].size(), part().save()["world"]["pins"].size());
    run("rope.let_go");
    for (std::size_t pane = 0; pane < 3; ++pane)
        EXPECT_EQ(world_in(part(), pane).state().pins.size(), 2u) << pane;
}

/// Particles selected in one world may not exist in another.
TEST_F(RopeRace, AClickInAPaneUsesOnlyItsOwnParticles) {
    run("rope.select", {{"rope", "rope"}, {"particle", 60}});
    run("rope.tool", {{"name", "tie"}});
    RopePart& changed = workspace.document.edit<RopePart>(rope_lab);
    auto torn = std::make_shared<NamedWorld>(*changed.rivals[0].world);
    torn->cut("rope", 20);
    changed.rivals[0].world = torn;
    Emit emit;
    lab().click(workspace, picks_in_pane + particle_pick(5), emit);
    for (const Emitted& each : emit.take()) EXPECT_EQ(each.name, "rope.select");
}

/// Undo is bounded by the size that a part reports.
TEST_F(RopeRace, ItsSizeCountsTheCurvesOfAll) {
    const std::size_t before = part().bytes();
    wait(100);
    EXPECT_GE(part().bytes(), before + 3 * 99 * sizeof(RopeSample));
}

TEST_F(RopeRace, ItsNumbersAreWrittenAsCsv) {
    wait(12);
    run("rope.race.copy");
    run("rope.race.save", {{"path", path("race.csv")}});
    EXPECT_EQ(test::read(path("race.csv")), workspace.ui.copied.value());
    std::istringstream lines(*workspace.ui.copied);
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(line, "solver,seconds,length_error,as_solved,energy,microseconds");
    int rows = 0;
    while (std::getline(lines, line)) {
        const bool costs = std::stod(line.substr(line.rfind(',') + 1)) > 0.0;
        EXPECT_TRUE(costs) << line;
        ++rows;
    }
    EXPECT_EQ(rows, 36);
    run("rope.race", {{"on", false}});
    refuses("rope.race.copy", Json::object(), "no race is open");
}

}  // namespace
}  // namespace tendril::app
