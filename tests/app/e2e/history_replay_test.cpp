// New, opened and saved scenes among undo and redo: the recording replays identically.
#include "app/document/scene_file.hpp"
#include "app/labs/chain/chain_lab.hpp"
#include "tests/app/e2e/monkey.hpp"
#include "tests/app/support/panel_places.hpp"
#include "tests/app/support/play.hpp"

namespace tendril::test {
namespace {

using app::Json;
using namespace app;

/// The state that a replay must reproduce.
struct Ending {
    Json state;
    Json scene;
    std::string undo, redo, path;
    std::size_t steps = 0;
    bool modified = false;
    bool operator==(const Ending&) const = default;
};

Ending ending_of(App& app) {
    const Workspace& workspace = app.workspace();
    return {.state = app.state(),
            .scene = save_scene(workspace),
            .undo = workspace.history.undo_label(),
            .redo = workspace.history.redo_label(),
            .path = workspace.path.string(),
            .steps = workspace.history.size(),
            .modified = workspace.modified()};
}

std::ostream& operator<<(std::ostream& out, const Ending& ending) {
    return out << "undo \"" << ending.undo << "\", redo \"" << ending.redo << "\", path " << ending.path
               << ", " << ending.steps << " steps, " << (ending.modified ? "modified" : "saved") << "\n"
               << ending.scene.dump().substr(0, 2000);
}

/// Runs a command and returns whether it was refused.
bool refused(App& app, const std::string& name, const Json& arguments = Json::object()) {
    try {
        app.run({name, arguments});
    } catch (const Refused&) {
        return true;
    }
    return false;
}

void tap(App& app, const char* chord) {
    const Event event = KeyTap{*chord_from_name(chord)};
    app.tick(&event);
}

/// Acts in a program that records, removes the files that it wrote, and plays the recording in another one.
template <class Act>
void expect_exact_replay(const TempFolder& folder, const std::string& scene, Act act) {
    const auto window = open_offscreen({1280, 720});
    std::string recording;
    Ending recorded;
    {
        App app(*window);
        if (!scene.empty()) load_scene_file(app.workspace(), scene);
        app.start_recording();
        act(app);
        recorded = ending_of(app);
        recording = app.recording();
    }
    for (const std::string& name : folder.names())
        if ((folder / name).string() != scene) std::filesystem::remove(folder / name);
    window->resize({1280, 720});
    App app(*window);
    Script script = parse_script(recording, app.commands());
    app.start_from(*script.start);
    Player player(std::move(script));
    try {
        while (!player.done()) player.advance(app);
    } catch (const ScriptFailure& failure) {
        ADD_FAILURE() << failure.what() << "\n" << recording.substr(recording.find('\n'));
    }
    EXPECT_EQ(ending_of(app), recorded);
}

TEST(HistoryReplay, ANewSceneAsBlankAsTheOldOneIsNoUndoStep) {
    expect_exact_replay(TempFolder(), "", [](App& app) {
        tap(app, "ctrl+n");
        EXPECT_TRUE(refused(app, "undo"));
    });
}

TEST(HistoryReplay, ASceneThatMentionsOneLabLeavesTheOthersAlone) {
    const TempFolder folder;
    const auto window = open_offscreen({1280, 720});
    {
        App app(*window);
        Json scene = save_scene(app.workspace());
        const std::string lab = scene["lab"].get<std::string>();
        for (const auto& other : app.labs().all())
            if (other->name() != lab) scene["labs"].erase(other->name());
        scene["labs"][lab] = app.workspace().blank.parts().at(lab)->save();
        write(folder / "one.json", scene.dump());
    }
    expect_exact_replay(folder, (folder / "one.json").string(), [&](App& app) {
        for (const auto& lab : app.labs().all()) {
            app.run({"lab.open", Json{{"name", lab->name()}}});
            for (int i = 0; i < 20; ++i) app.tick(nullptr);
            app.run({"scene.open", Json{{"path", (folder / "one.json").string()}}});
            for (int i = 0; i < 20; ++i) app.tick(nullptr);
            refused(app, "undo");
            refused(app, "undo");
            refused(app, "redo");
        }
    });
}

TEST(HistoryReplay, UndoBringsBackTheOldScenesFile) {
    const TempFolder folder;
    const auto window = open_offscreen({1280, 720});
    App app(*window);
    const std::string path = (folder / "blank.json").string();
    app.run({"scene.save", Json{{"path", path}}});
    app.run({"scene.new"});
    EXPECT_EQ(app.workspace().path, "");
    app.run({"undo"});
    EXPECT_EQ(app.workspace().path, path);
    app.run({"redo"});
    EXPECT_EQ(app.workspace().path, "");
}

class HistoryReplaySeeds : public testing::TestWithParam<unsigned> {};

LABEL(slow, "Seeds/HistoryReplaySeeds.*/[1-9]");

/// In any order, in every lab.
TEST_P(HistoryReplaySeeds, NewOpenSaveUndoAndRedoInAnyOrder) {
    const TempFolder folder;
    const WorkingIn working(folder);
    std::mt19937 random(GetParam());
    const auto below = [&](int end) { return static_cast<int>(random() % static_cast<unsigned>(end)); };
    expect_exact_replay(folder, "", [&](App& app) {
        const auto path = [&] { return (folder / (below(2) == 0 ? "a.json" : "b.json")).string(); };
        const auto& labs = app.labs().all();
        const auto tap_or_run = [&](const char* chord, const char* command) {
            below(2) == 0 ? tap(app, chord) : void(refused(app, command));
        };
        for (int i = 0; i < 120; ++i) {
            const int kind = below(10);
            if (kind == 0) tap_or_run("ctrl+n", "scene.new");
            if (kind == 1) refused(app, "scene.open", {{"path", path()}});
            if (kind == 2) refused(app, "scene.save", {{"path", path()}});
            if (kind == 3 || kind == 4) tap_or_run("ctrl+z", "undo");
            if (kind == 5) tap_or_run("ctrl+y", "redo");
            if (kind == 6) {
                const auto lab = static_cast<std::size_t>(below(static_cast<int>(labs.size())));
                app.run({"lab.open", Json{{"name", labs[lab]->name()}}});
            }
            if (kind == 7) app.tick(nullptr);
            if (kind > 7)
                Monkey(app, static_cast<unsigned>(random()), lab_commands(app), {"", "arm", "rope"})
                    .command();
        }
    });
}

/// Undo leads all the way back, and redoing everything loses nothing: neither scene nor the strip's marks and
/// position.
TEST_P(HistoryReplaySeeds, UndoingAndRedoingEverythingLosesNothing) {
    const TempFolder folder;
    const WorkingIn working(folder);
    const auto window = open_offscreen({1280, 720});
    std::mt19937 random(GetParam());
    App app(*window);
    const auto& labs = app.labs().all();
    const auto chain = [&] { return app.workspace().document.get<ChainPart>(chain_lab).save(); };
    const Json start = chain();
    app.run({"lab.open", Json{{"name", labs[random() % labs.size()]->name()}}});
    for (int i = 0; i < 120; ++i)
        Monkey(app, static_cast<unsigned>(random()), lab_commands(app), {"", "arm", "rope"}).act();
    tap(app, "escape");
    if (app.workspace().history.can_redo()) GTEST_SKIP() << "it ended among undone steps";
    for (const char* each : {"rope.let_go", "linkage.let_go"}) refused(app, each);  // undo lets go of drags
    const Json scene = save_scene(app.workspace()), state = app.state();
    const std::string lab = app.workspace().lab;
    const std::size_t steps = app.workspace().history.size();
    for (std::size_t i = 0; i < steps; ++i) EXPECT_FALSE(refused(app, "undo"));
    const Json undone = chain();
    for (const char* member : {"segments", "target", "mode", "iterations", "default_direction"})
        EXPECT_EQ(undone[member], start[member]) << member;
    while (app.workspace().history.can_redo()) EXPECT_FALSE(refused(app, "redo"));
    EXPECT_EQ(app.workspace().history.size(), steps);
    EXPECT_EQ(Json::diff(scene.at("labs"), save_scene(app.workspace()).at("labs")).dump(1), "[]");
    app.run({"lab.open", Json{{"name", lab}}});
    const Json back = app.state();
    EXPECT_EQ(state.value("events", Json()), back.value("events", Json()));
    const auto ticks_back = [](const Json& of) { return of.at("time").value("ticks_back", 0); };
    EXPECT_EQ(ticks_back(state), ticks_back(back));
    tap(app, "ctrl+y");
    EXPECT_EQ(app.workspace().ui.toasts.back().text, "Nothing to redo.");
    EXPECT_EQ(app.workspace().ui.toasts.back().kind, ToastKind::Info) << "no fault";
}

INSTANTIATE_TEST_SUITE_P(Seeds, HistoryReplaySeeds, testing::Range(1u, 9u));

// Playing a recording gives the same state and the same picture, byte for byte.

/// The output of a run: the bytes of its state and picture.
struct Left {
    std::string state, picture, recording;
    bool operator==(const Left&) const = default;
};

class Recording : public testing::Test {
  protected:
    Left run(const std::string& script, const std::string& name, std::vector<std::string> more = {}) {
        const auto path = [&](const char* suffix) { return (folder_ / (name + suffix)).string(); };
        std::vector<std::string> arguments{"--headless", "--script",    script,
                                           "--state",    path(".json"), "--screenshot",
                                           path(".png"), "--record",    path(".jsonl")};
        arguments.insert(arguments.end(), more.begin(), more.end());
        EXPECT_TRUE(succeeded(run_program(arguments)));
        return {read(path(".json")), read(path(".png")), read(path(".jsonl"))};
    }
    /// Records the script, plays the recording twice, and expects the same from all three.
    Left record_and_replay(const ScriptText& script, std::vector<std::string> more = {}) {
        write(folder_ / "script.jsonl", script.text());
        const Left recorded = run((folder_ / "script.jsonl").string(), "recorded", more);
        const Left first = run((folder_ / "recorded.jsonl").string(), "first");
        const Left second = run((folder_ / "first.jsonl").string(), "second");
        EXPECT_EQ(recorded.state, first.state);
        EXPECT_TRUE(recorded.picture == first.picture);
        // A replay records itself, so the second one replays a recording of a recording.
        EXPECT_EQ(first.state, second.state);
        EXPECT_TRUE(first.picture == second.picture);
        EXPECT_EQ(first.recording, second.recording);
        return recorded;
    }
    TempFolder folder_;
};

Json state_of(const Left& left) {
    return app::parse_json(left.state);
}

// Everything in the window that is not the scene: panels, palette, help, keys, wheel over a list, resizing.
TEST_F(Recording, HoldsTheUseOfPanels) {
    const glm::vec2 forward_radio = chain_panel::forward, target = handle(first_state(), "target");
    ScriptText script = ScriptText().click(forward_radio).wait(2);
    script.key("ctrl+k").text("chain.add length=0.75").key("enter").wait(2);
    script.drag({target, {700, 250}, {650, 300}});
    script.key("ctrl+k").text("theme").key("enter").wait(1);
    script.move({130, 500}).wheel(-3).wheel(1);
    script.move({1140, 400}).wheel(-2);
    script.move({640, 500}).line({{"mouse", "wheel"}, {"by", 0.5}, {"sideways", -1.5}});
    script.drag({{640, 600}, {580, 560}, {500, 580}}, "right").drag({{640, 600}, {580, 560}}, "middle");
    script.hold("shift")
        .move({640, 600})
        .release("shift")
        .key("l")
        .key("b")
        .key("?")
        .wait(1)
        .key("escape")
        .key("f9");
    script.line({{"resize", {1000, 700}}}).line({{"focus", false}}).line({{"focus", true}}).wait(5);
    const Json state = state_of(record_and_replay(script));
    EXPECT_EQ(state["mode"], "forward");
    EXPECT_EQ(state["segments"].size(), 9u);
    EXPECT_EQ(state["segments"][8]["length"], 0.75);
}

TEST_F(Recording, HoldsTextTypedIntoAField) {
    // A double click on the target's height opens the field.
    const glm::vec2 field = chain_panel::target_y;
    ScriptText script = ScriptText().command("view.fold", chain_panel::unfolded()).wait(2);
    script.click(field).click(field).wait(1).key("ctrl+a").text("1.25").key("enter").wait(3);
    const Json state = state_of(record_and_replay(script));
    EXPECT_EQ(state["target"], Json::array({7.0, 1.25, 0.0}))
        << "the target's y field has moved in the panel";
}

TEST_F(Recording, HoldsTime) {
    ScriptText script;
    script.command("chain.motion", {{"path", "figure_eight"}, {"radius", 1.7}, {"period", 2.3}}).wait(41);
    script.key("space").wait(10).key(".").key(".").key("space").wait(7);
    const Left left = record_and_replay(script);
    EXPECT_EQ(state_of(left)["motion"], "figure_eight");
    // 41 ticks, one for the key that pauses, two steps, and those after the second space.
    EXPECT_GT(state_of(left)["time"]["tick"], 45);
    EXPECT_LT(state_of(left)["time"]["tick"], 60);
}

TEST_F(Recording, StartsWithItsSceneSizeAndLab) {
    ScriptText first;
    first.command("chain.preset", {{"name", "tentacle"}})
        .command("chain.target", {{"to", {1, 2, 3}}})
        .command("camera.set", {{"yaw_deg", 33}})
        .command("scene.save", {{"path", (folder_ / "tentacle.json").string()}});
    play(first);
    ScriptText script;
    script.command("chain.mode", {{"mode", "forward"}})
        .command("chain.target", {{"to", {0.5, 1, 0}}})
        .wait(2);
    const Left left = record_and_replay(
        script, {"--size", "900x600", "--lab", "chain", (folder_ / "tentacle.json").string()});
    EXPECT_EQ(state_of(left)["segments"].size(), 24u);
    const Json start_line = app::parse_json(left.recording.substr(0, left.recording.find('\n')));
    EXPECT_EQ(start_line["size"], Json::array({900, 600}));
}

TEST_F(Recording, ExpectationsScreenshotsAndStatesWithinAScript) {
    const auto path = [&](const char* name) { return (folder_ / name).string(); };
    ScriptText script;
    script.command("chain.target", {{"to", {3, 2, 0}}})
        .line({{"state", path("after.json")}})
        .line({{"screenshot", path("after.png")}})
        .line({{"expect", "tail"}, {"near", {3, 2, 0}}, {"within", 0.001}})
        .command("chain.target", {{"to", {0, 0, 0}}});
    const Json state = play(script).state;
    EXPECT_EQ(app::parse_json(read(path("after.json")))["target"], Json::array({3.0, 2.0, 0.0}));
    EXPECT_EQ(state["target"], Json::array({0.0, 0.0, 0.0}));
    EXPECT_EQ(app::read_png(path("after.png")).size, glm::ivec2(1280, 720));
}

}  // namespace
}  // namespace tendril::test
