// A file of any kind opens in the lab that reads it, whichever lab is open and however it is opened.
#include <sys/stat.h>

#include <fstream>
#include <thread>

#include "tests/app/support/play.hpp"
#include "tests/places.hpp"
#include "tests/says.hpp"

#include "app/app.hpp"
#include "app/document/atomic_file.hpp"
#include "app/document/expectation.hpp"
#include "app/labs/labs.hpp"

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
                {path("rows.CSV"), "signal", "input_kind", "csv"},
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
    expect_opened(state_after(script), {"rows.CSV", "signal", "input_kind", "csv"});
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

TEST(SavedScene, IsToldWithItsFolder) {
    const auto window = app::open_offscreen({1280, 720});
    app::App program(*window);
    const TempFolder folder;
    const auto told = [&] { return program.workspace().ui.toasts.back().text; };
    program.run({"scene.save", app::Json{{"path", (folder / "arm.json").string()}}});
    EXPECT_EQ(told(), "Saved: " + app::shown_path(folder / "arm.json"));
    program.run({"scene.save_dialog", app::Json::object()});
    EXPECT_EQ(told(), "Saved: " + app::shown_path(folder / "arm.json"));
}

}  // namespace
}  // namespace tendril::test
