// The openings: each lab moves by itself in a new window until the user takes over.
#include "app/app.hpp"
#include "app/document/scene_file.hpp"
#include "app/labs/chain/chain_lab.hpp"
#include "app/session.hpp"
#include "app/view/assets.hpp"
#include "tests/app/e2e/monkey.hpp"
#include "tests/app/support/driven_app.hpp"

namespace tendril::test {
namespace {

using namespace app;

class Openings : public testing::TestWithParam<std::string>, protected DrivenApp {
  protected:
    Openings() : DrivenApp({1280, 720}) {
        open_alive(app_);
        app_.run({"lab.open", Json{{"name", GetParam()}}});
        app_.settle();
    }
    Json part() { return workspace().document.parts().at(GetParam())->save(); }
    bool opens() { return workspace().openings.contains(GetParam()); }
    /// A change in the lab that moves nothing.
    RunCommand change() const {
        const std::map<std::string, RunCommand> all{
            {"chain", {"chain.pole", Json{{"to", {0.3, 2.6, -0.4}}}}},
            {"rope", {"rope.settings", Json{{"friction", 0.41}}}},
            {"signal", {"signal.filter.add", Json{{"kind", "moving_average"}, {"window", 0.2}}}},
            {"rig", {"rig.control.set", Json{{"name", "look"}, {"value", {0.1, 0.2}}}}},
            {"humanoid", {"humanoid.attach", Json{{"bone", "Hips"}, {"kind", "rope"}, {"name", "tail"}}}},
            {"linkage", {"linkage.joint", Json{{"at", {0, -2, 0}}}}}};
        return all.at(GetParam());
    }
};

TEST_P(Openings, MoveForTenSecondsAndLeaveNothingToSaveOrUndo) {
    const std::vector<bool> before = {workspace().modified(), workspace().history.can_undo()};
    EXPECT_EQ(before, std::vector<bool>(2, false));
    for (int second = 0; second < 10; ++second) {
        const Json then = part();
        wait(60);
        EXPECT_NE(part(), then) << "it stands still in second " << second;
        EXPECT_TRUE(app_.needs_ticks());
    }
    const Json state = app_.state();
    expect_finite(state, "state");
    EXPECT_FALSE(workspace().modified());
    EXPECT_FALSE(workspace().history.can_undo());
    EXPECT_TRUE(opens());
    for (const Toast& toast : workspace().ui.toasts) EXPECT_NE(toast.kind, ToastKind::Refusal) << toast.text;
}

TEST_P(Openings, OfAnotherLabEndsWhenSomethingChangesThere) {
    const std::string elsewhere = GetParam() == "chain" ? "rope" : "chain";
    app_.run({"lab.open", Json{{"name", elsewhere}}});
    app_.run(change());
    EXPECT_FALSE(opens());
    EXPECT_TRUE(workspace().modified());
    app_.run({"lab.open", Json{{"name", GetParam()}}});
    wait(60);
    EXPECT_TRUE(workspace().modified());
    app_.run({"lab.open", Json{{"name", elsewhere}}});
    EXPECT_TRUE(save_scene(workspace())["labs"].contains(GetParam()));
}

TEST_P(Openings, ContinueWhenTheViewTurns) {
    const Json state = app_.state();
    for (const Json& handle : state.at("handles")) {
        if (!handle.at("pixel").is_array()) continue;
        const glm::vec2 at{handle["pixel"][0].get<float>(), handle["pixel"][1].get<float>()};
        for (const Event& event : {Event(MouseMove{at}), Event(MousePress{MouseButton::Right, true}),
                                   Event(MousePress{MouseButton::Right, false})})
            app_.tick(&event);
    }
    app_.run({"camera.set", Json{{"yaw_deg", 10}}});
    EXPECT_TRUE(opens());
    const Json then = part();
    wait(30);
    EXPECT_NE(part(), then);
    EXPECT_FALSE(workspace().modified());
}

TEST_P(Openings, EndAtTheFirstChangeWhichAloneCanBeUndone) {
    wait(90);
    app_.run(change());
    EXPECT_FALSE(opens());
    EXPECT_TRUE(workspace().modified());
    ASSERT_EQ(workspace().history.size(), 1u);
    app_.run({"undo"});
    EXPECT_FALSE(workspace().history.can_undo());
    EXPECT_FALSE(opens()) << "it does not come back";
    const Json state = app_.state();
    if (GetParam() == "chain") {
        EXPECT_EQ(state["motion"], "still");
    }
    if (GetParam() == "rope" || GetParam() == "rig") {
        EXPECT_TRUE(part().value(GetParam() == "rope" ? "swings" : "walks", Json::object()).empty());
    }
    if (GetParam() == "humanoid") {
        EXPECT_TRUE(state["clip"]["playing"].get<bool>()) << "the walk is in nobody's way";
    }
}

TEST_P(Openings, ReturnWithTheirRuleWhenANewSceneIsUndone) {
    const auto opened = workspace().openings;
    const TempFolder folder;
    const std::string file = (folder / "scene.json").string();
    write(file, save_scene(make_blank_workspace(app_.labs())).dump());
    for (const RunCommand& away : {RunCommand{"scene.new"}, RunCommand{"scene.open", Json{{"path", file}}}}) {
        wait(30);
        const Json then = part();
        app_.run(away);
        EXPECT_TRUE(workspace().openings.empty());
        app_.run({"undo"});
        EXPECT_EQ(workspace().openings, opened) << away.name;
        EXPECT_EQ(part(), then);
        EXPECT_FALSE(workspace().modified()) << away.name << ": there is nothing to save";
        wait(30);
        EXPECT_NE(part(), then) << "it goes on";
        EXPECT_FALSE(workspace().modified());
        EXPECT_EQ(save_scene(workspace())["labs"].size(), 1u);
        app_.run({"redo"});
        EXPECT_TRUE(workspace().openings.empty());
        EXPECT_FALSE(workspace().modified()) << away.name;
        app_.run({"undo"});
        EXPECT_TRUE(opens());
    }
    app_.run(change());
    EXPECT_FALSE(opens()) << "the first change ends it as ever";
    EXPECT_TRUE(workspace().modified());
    app_.run({"undo"});
    EXPECT_FALSE(opens());
}

TEST_P(Openings, ContinueWhenACommandIsRefused) {
    wait(45);
    const Json then = part();
    const std::map<std::string, RunCommand> wrong{
        {"chain", {"chain.insert", Json{{"index", 99}, {"length", 1}}}},
        {"rope", {"rope.remove", Json{{"name", "nothing"}}}},
        {"signal", {"signal.filter.remove", Json{{"at", 99}}}},
        {"rig", {"rig.control.set", Json{{"name", "nobody"}, {"value", 1}}}},
        {"humanoid", {"humanoid.attach", Json{{"bone", "Nowhere"}, {"kind", "rope"}}}},
        {"linkage", {"linkage.drive", Json{{"joint", "nobody"}, {"angle_deg", 1}}}}};
    EXPECT_THROW(app_.run(wrong.at(GetParam())), Refused);
    EXPECT_TRUE(opens());
    EXPECT_EQ(part(), then);
    EXPECT_FALSE(workspace().modified());
    EXPECT_FALSE(workspace().history.can_undo());
    wait(30);
    EXPECT_NE(part(), then);
    EXPECT_FALSE(workspace().modified());
}

/// Starts from the opening, not only from the card's own scene.
TEST_P(Openings, EveryStepOfTheCardPlays) {
    app_.run({"view.card", Json{{"open", true}}});
    wait(100);
    const Card card = read_cards(cards_source(GetParam())).front();
    const auto done = [&] { return app_.state().at("card").at("done").get<std::vector<bool>>(); };
    EXPECT_EQ(done(), std::vector<bool>(card.steps.size(), false)) << "time alone ticks nothing";
    for (std::size_t i = 0; i < card.steps.size(); ++i) {
        std::string text;
        for (const SharedJson& line : card.steps[i].script) text += line->dump() + "\n";
        Player player(parse_script(text, app_.commands()));
        while (!player.done()) player.advance(app_);
        wait(60);
        EXPECT_TRUE(done()[i]) << card.steps[i].text;
    }
}

INSTANTIATE_TEST_SUITE_P(Labs, Openings,
                         testing::Values("chain", "rope", "signal", "rig", "humanoid", "linkage"),
                         [](const auto& lab) { return lab.param; });

class RigOpening : public Openings {};
INSTANTIATE_TEST_SUITE_P(Labs, RigOpening, testing::Values("rig"));

/// The face blinks and speaks by curves that the rig's units set.
TEST_P(RigOpening, MovesTheLidsAndTheMouth) {
    const auto curve = [&](const char* name) { return app_.state().at("curves").at(name).get<double>(); };
    int blinks = 0, syllables = 0, closed = 0;
    bool shut = false, open = false;
    constexpr int ticks = 600;
    for (int i = 0; i < ticks; ++i) {
        wait(1);
        const double lids = curve("blink"), mouth = curve("mouth");
        closed += lids > 0.5 ? 1 : 0;
        blinks += lids > 0.5 && !shut ? 1 : 0;
        syllables += mouth > 0.5 && !open ? 1 : 0;
        shut = lids > 0.5, open = mouth > 0.5;
    }
    EXPECT_GE(blinks, 3);
    EXPECT_LE(blinks, 8) << "in ten seconds";
    EXPECT_LT(closed, ticks / 5) << "the eyes are open most of the time";
    EXPECT_GE(syllables, 12);
    EXPECT_LE(syllables, 40);
    app_.run(change());
    wait(2);
    EXPECT_EQ(curve("blink"), 0.0) << "it looks at whoever takes over";
    EXPECT_EQ(curve("mouth"), 0.0);
}

/// Each picture differs where the lids or the mouth are.
TEST_P(RigOpening, DrawsTheStateOfTheCurves) {
    const auto strokes = [&](double blink, double mouth) {
        app_.run({"rig.preset", Json{{"name", "aim"}}});
        for (const auto& [name, value] : {std::pair{"blink", blink}, std::pair{"mouth", mouth}})
            app_.run({"rig.curve.add", Json{{"name", name}, {"value", value}}});
        const Camera camera(workspace().camera, {{0.0f, 0.0f}, {800.0f, 600.0f}});
        DrawList list;
        app_.labs().find("rig")->draw({workspace(), camera, palette(Theme::Dark)}, list);
        std::vector<glm::vec3> places;
        for (const Stroke& each : list.strokes) places.push_back(each.a);
        return places;
    };
    const auto calm = strokes(0.0, 0.0);
    EXPECT_EQ(calm, strokes(0.0, 0.0));
    EXPECT_EQ(strokes(1.0, 0.0).size(), calm.size() + 2) << "two lids";
    EXPECT_GT(strokes(0.0, 1.0).size(), calm.size()) << "an open mouth";
    EXPECT_NE(strokes(0.5, 0.0), strokes(1.0, 0.0)) << "lids come down";
    EXPECT_NE(strokes(0.0, 0.5), strokes(0.0, 1.0));
}

class ChainOpening : public Openings {};
INSTANTIATE_TEST_SUITE_P(Labs, ChainOpening, testing::Values("chain"));

/// The target stops under the mouse, not where the drag began to move it.
TEST_P(ChainOpening, APressOnTheTargetStopsIt) {
    wait(45);
    app_.settle();
    const glm::vec2 target = handle(app_.state(), "target");
    const Event move(MouseMove{target});
    app_.tick(&move);
    const Event press(MousePress{MouseButton::Left, true});
    app_.tick(&press);
    const Json there = app_.state()["target"];
    wait(30);
    EXPECT_EQ(app_.state()["target"], there);
    EXPECT_FALSE(workspace().modified());
    EXPECT_FALSE(workspace().history.can_undo());
}

// The scene that a window opens with by default.

TEST(Opening, IsOnlyForAWindowWithoutOtherInstructions) {
    const auto opens = [](auto ask) {
        SessionOptions options;
        ask(options);
        return opens_alive(options);
    };
    EXPECT_TRUE(opens([](SessionOptions&) {}));
    EXPECT_TRUE(opens([](SessionOptions& o) { o.config = false, o.record = "r.jsonl", o.frames = 5; }));
    EXPECT_FALSE(opens([](SessionOptions& o) { o.scene = "arm.json"; }));
    EXPECT_FALSE(opens([](SessionOptions& o) { o.lab = "chain"; }));
    EXPECT_FALSE(opens([](SessionOptions& o) { o.headless = true; }));
    EXPECT_FALSE(opens([](SessionOptions& o) { o.script = "s.jsonl"; }));
}

class OpenScene : public testing::Test, protected DrivenApp {
  protected:
    OpenScene() : DrivenApp({1280, 720}) {}
};

TEST_F(OpenScene, IsAnArmWithItsHandOnTheTarget) {
    open_alive(app_);
    app_.settle();
    const Json state = app_.state();
    EXPECT_EQ(state["mode"], "reach");
    EXPECT_EQ(state["solve"]["report"]["status"], "Converged");
    EXPECT_LT(glm::distance(point_of(state["tail"]), point_of(state["target"])), 0.005f);
    EXPECT_EQ(state["solve"]["limits"][1]["kind"], "hinge");
    EXPECT_TRUE(state["solve"]["pole"].is_array());
    for (const char* name : {"target", "pole", "segment.0", "segment.1", "segment.2"}) handle(state, name);
}

TEST_F(OpenScene, KeepsSettingsThatTheUserChose) {
    workspace().settings.choices["segments"] = "spheres";
    open_alive(app_);
    EXPECT_EQ(workspace().settings.choices["segments"], "spheres");
    EXPECT_EQ(workspace().settings.choices["reach sphere"], "on") << "that was not chosen yet";
}

TEST_F(OpenScene, CardsAreOfferedOnce) {
    offer_cards(app_);
    EXPECT_TRUE(card_shown(workspace().settings, chain_lab));
    app_.run({"view.card", Json{{"open", false}}});
    offer_cards(app_);
    EXPECT_FALSE(card_shown(workspace().settings, chain_lab));
}

/// The circle appears on request, in mode Reach only.
TEST_F(OpenScene, ItsReachSphereIsASetting) {
    const auto strokes = [&] {
        const Camera camera(workspace().camera, {{0.0f, 0.0f}, {800.0f, 600.0f}});
        DrawList list;
        app_.labs().find(chain_lab)->draw({workspace(), camera, palette(Theme::Dark)}, list);
        return list.strokes.size();
    };
    open_alive(app_);
    const std::size_t with = strokes();
    app_.run({"view.reach_sphere", Json{{"show", "off"}}});
    EXPECT_LT(strokes() + 100, with);
    app_.run({"chain.mode", Json{{"mode", "backward"}}});
    const std::size_t trailing = strokes();
    app_.run({"view.reach_sphere", Json{{"show", "on"}}});
    EXPECT_EQ(strokes(), trailing);
}

}  // namespace
}  // namespace tendril::test
