// New, opened and saved scenes among undo and redo: the recording replays identically.
#include "app/document/scene_file.hpp"
#include "tests/app/e2e/monkey.hpp"

namespace tendril::test {
namespace {

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

/// Undoing and redoing everything loses nothing: neither scene nor the strip's marks and position.
TEST_P(HistoryReplaySeeds, UndoingAndRedoingEverythingLosesNothing) {
    const TempFolder folder;
    const WorkingIn working(folder);
    const auto window = open_offscreen({1280, 720});
    std::mt19937 random(GetParam());
    App app(*window);
    const auto& labs = app.labs().all();
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

}  // namespace
}  // namespace tendril::test
