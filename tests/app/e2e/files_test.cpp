// A file of any kind opens in the lab that reads it, whichever lab is open and however it is opened.
#include <sys/stat.h>

#include "tests/app/support/frame_record.hpp"
#include "tests/app/support/play.hpp"

namespace tendril::test {
namespace {

struct OpenedFile {
    std::string path, lab;
    std::string member;  ///< of the state of its lab
    app::Json value;
};

class Files : public testing::Test {
  protected:
    Files() {
        play(ScriptText()
                 .command("chain.preset", {{"name", "arm"}})
                 .command("scene.save", {{"path", path("arm.json")}}));
        play(ScriptText()
                 .command("lab.open", {{"name", "humanoid"}})
                 .command("humanoid.map.save", {{"path", path("map.json")}}));
        write(folder_ / "rows.CSV", "dt,input\n0.5,7\n0.5,-7\n");
        write(folder_ / "notes.txt", "Remember the milk");
        write(folder_ / "arm.scene", read(folder_ / "arm.json"));
    }
    std::string path(const std::string& name) const { return (folder_ / name).string(); }
    std::vector<OpenedFile> files() const {
        const std::string golden = source_path("tests/app/golden/");
        return {{path("arm.json"), "chain", "segments", 7},
                {path("arm.scene"), "chain", "segments", 7},
                {path("rows.CSV"), "signal", "input.kind", "csv"},
                {golden + "body.glb", "humanoid", "character.file", golden + "body.glb"},
                {golden + "a_pose.bvh", "humanoid", "character.file", golden + "a_pose.bvh"},
                {path("map.json"), "humanoid", "lab", "humanoid"}};
    }
    static std::vector<std::string> labs() {
        std::vector<std::string> names;
        const app::Labs all;
        for (const auto& lab : all.all()) names.push_back(lab->name());
        return names;
    }
    static ScriptText in(const std::string& lab) {
        ScriptText script;
        return script.command("lab.open", {{"name", lab}}).command("time.pause");
    }
    static void expect_opened(const app::Json& state, const OpenedFile& file) {
        EXPECT_EQ(state.at("lab"), file.lab);
        const app::Json* found = app::find_in_state(state, file.member);
        ASSERT_NE(found, nullptr) << file.member;
        EXPECT_EQ(found->is_array() ? app::Json(found->size()) : *found, file.value);
    }
    TempFolder folder_;
};

LABEL(slow, "Files.*");

TEST_F(Files, DroppedOrOpenedGoToTheirLabAndComeBackByUndo) {
    for (const std::string& lab : labs()) {
        const app::Json before = state_after(in(lab));
        for (const OpenedFile& file : files()) {
            SCOPED_TRACE(file.path + " in " + lab);
            ScriptText dropped = in(lab).line({{"drop", app::Json::array({file.path})}}).wait(2);
            expect_opened(state_after(dropped), file);
            if (lab == labs().front())
                expect_opened(state_after(in(lab).command("file.open", {{"path", file.path}})), file);
            if (file.member == "lab") continue;  // the stick figure's own map changes nothing
            const app::Json undone = state_after(dropped.command("undo").wait(2));
            EXPECT_EQ(undone.at("lab"), lab);
            EXPECT_EQ(undone.at("camera"), before.at("camera"));
            if (file.lab == lab) {
                EXPECT_EQ(*app::find_in_state(undone, file.member), *app::find_in_state(before, file.member));
            }
        }
    }
}

TEST_F(Files, TypedIntoTheDialogGoToTheirLab) {
    for (const OpenedFile& file : files()) {
        ScriptText script = in("rope").key("ctrl+o").wait(2).text(file.path.c_str()).key("enter").wait(2);
        SCOPED_TRACE(file.path);
        expect_opened(state_after(script), file);
    }
}

TEST_F(Files, AreListedByKindInTheDialog) {
    const WorkingIn here(folder_);
    ScriptText script =
        in("rope").key("ctrl+o").wait(2).click({757, 485}).wait(2).text("csv").key("enter").wait(2);
    script.click({400, 235}).click({400, 235}).wait(2);  // the first of the list, of four files in all
    expect_opened(state_after(script), {"rows.CSV", "signal", "input.kind", "csv"});
}

TEST_F(Files, OfTheCommandLineStartTheSession) {
    for (const OpenedFile& file : files()) {
        SCOPED_TRACE(file.path);
        const Played played =
            play(ScriptText().command("undo", {}, true), {.more = {file.path}});  // nothing to undo
        expect_opened(played.state, file);
    }
}

TEST_F(Files, OfAPipeAreScenes) {
    const std::string pipe = path("pipe");
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    std::thread writer([&] { std::ofstream(pipe) << read(folder_ / "arm.json"); });
    const app::Json state = state_after(in("rope").command("file.open", {{"path", pipe}}));
    writer.join();
    expect_opened(state, {pipe, "chain", "segments", 7});
}

TEST_F(Files, ThatNoLabReadsAreRefusedAndChangeNothing) {
    write(folder_ / "broken.bvh", "HIERARCHY of nothing");
    write(folder_ / "list.json", "[1, 2, 3]");
    const std::string kinds = "json csv gltf glb vrm fbx bvh";
    const std::vector<std::pair<std::string, std::string>> junk{{path("notes.txt"), "notes.txt " + kinds},
                                                                {path("none.txt"), "none.txt no such file"},
                                                                {path("none.bvh"), "none.bvh"},
                                                                {path("broken.bvh"), "broken.bvh"},
                                                                {path("list.json"), "list.json scene"},
                                                                {folder_.path().string(), "folder"}};
    for (const std::string& lab : labs()) {
        const app::Json before = state_after(in(lab).wait(4));
        for (const auto& [file, told] : junk) {
            if (lab != labs().front() && file != junk.front().first) continue;
            SCOPED_TRACE(file + " in " + lab);
            write(folder_ / "drop.jsonl", in(lab).line({{"drop", app::Json::array({file})}}).wait(3).text());
            const Outcome dropped =
                run_here({"--headless", "--script", path("drop.jsonl"), "--state", path("state.json")});
            EXPECT_EQ(dropped.exit_code, 0);
            EXPECT_TRUE(says(dropped.err, told));
            EXPECT_EQ(app::parse_json(read(folder_ / "state.json")), before);
            const Played refused =
                play(in(lab).command("file.open", {{"path", file}}, true).command("undo", {}, true).wait(4));
            EXPECT_EQ(refused.state, before);
        }
    }
}

TEST(SavedScene, IsReportedWithItsFolder) {
    const auto window = app::open_offscreen({1280, 720});
    app::App program(*window);
    const TempFolder folder;
    const auto told = [&] { return program.workspace().ui.toasts.back().text; };
    program.run({"scene.save", app::Json{{"path", (folder / "arm.json").string()}}});
    EXPECT_EQ(told(), "Saved: " + app::shown_path(folder / "arm.json"));
    program.run({"scene.save_dialog", app::Json::object()});
    EXPECT_EQ(told(), "Saved: " + app::shown_path(folder / "arm.json"));
}

/// A scene whose character has gone, in scripts and in the window.
class MissingCharacter : public testing::Test {
  protected:
    MissingCharacter() {
        std::filesystem::copy_file(source_path("tests/app/golden/a_pose.bvh"), folder_ / "hero.bvh");
        play(ScriptText()
                 .command("lab.open", {{"name", "humanoid"}})
                 .command("humanoid.load", {{"path", (folder_ / "hero.bvh").string()}})
                 .command("scene.save", {{"path", scene_}}));
        std::filesystem::remove(folder_ / "hero.bvh");
        text_ = read(scene_);
    }
    Outcome run(const ScriptText& script, std::vector<std::string> more = {}) {
        write(folder_ / "script.jsonl", script.text());
        more.insert(more.end(), {"--headless", scene_, "--script", (folder_ / "script.jsonl").string(),
                                 "--state", (folder_ / "state.json").string()});
        return run_here(more);
    }
    const TempFolder folder_;
    const std::string scene_ = (folder_ / "s.json").string();
    std::string text_;
};

TEST_F(MissingCharacter, IsReportedToScriptsAndNotOverwrittenWithoutForce) {
    const Outcome opened = run(ScriptText().wait(1));
    EXPECT_EQ(opened.exit_code, 2);
    EXPECT_TRUE(says(opened.err, "hero.bvh is missing The humanoid lab is blank"));
    const std::string said = app::parse_json(read(folder_ / "state.json")).at("unread").get<std::string>();
    EXPECT_TRUE(says(opened.err, said));
    const auto save = ScriptText().command("humanoid.foot_ik", {{"on", true}}).command("scene.save");
    const Outcome refused = run(save);
    EXPECT_EQ(refused.exit_code, 1);
    EXPECT_TRUE(says(refused.err, "s.json still has humanoid lab hero.bvh --force"));
    EXPECT_EQ(read(scene_), text_);
    run(save, {"--force"});
    EXPECT_NE(read(scene_), text_);
}

TEST_F(MissingCharacter, IsReportedInThePanelAndConfirmedBeforeItIsOverwritten) {
    const auto window = app::open_offscreen({1280, 720});
    app::App program(*window);
    FrameRecorder recorder;
    const auto settled_text = [&](int ticks) {
        for (int i = 0; i < ticks; ++i) program.tick(nullptr);
        std::string all;
        for (const DrawnText& each : recorder.frame().texts) all += each.text + ' ';
        return all;
    };
    const auto save = [&] {
        const app::Event event = app::KeyTap{*app::chord_from_name("ctrl+s")};
        program.tick(&event);
        return settled_text(4);
    };
    program.workspace().outputs.in_window = true;
    program.run({"scene.open", app::Json{{"path", scene_}}});
    EXPECT_TRUE(says(settled_text(600), "hero.bvh is missing keeps old contents"));
    save();
    EXPECT_EQ(app::parse_json(read(scene_)).at("labs"), app::parse_json(text_).at("labs"));
    const std::string before = read(scene_);
    glm::vec2 at(0.0f);
    for (const DrawnText& each : recorder.frame().texts)
        if (each.text == "Foot IK") at = each.box.centre();
    for (const app::Event& event :
         {app::Event(app::MouseMove{at}), app::Event(app::MousePress{app::MouseButton::Left, true}),
          app::Event(app::MousePress{app::MouseButton::Left, false})})
        program.tick(&event);
    EXPECT_TRUE(says(settled_text(600), "hero.bvh is missing Saving replaces"));
    EXPECT_TRUE(says(save(), "s.json still has Do the same again"));
    EXPECT_EQ(read(scene_), before);
    EXPECT_TRUE(says(save(), "Saved"));
    EXPECT_NE(read(scene_), before);
    EXPECT_FALSE(says(settled_text(600), "hero.bvh"));
}

}  // namespace
}  // namespace tendril::test
