// The dialog that asks for a file: its messages about folders and long names.
#include "tests/app/support/apng.hpp"
#include "tests/app/support/driven_app.hpp"

namespace tendril::test {
namespace {

using namespace app;

class FileDialogTest : public testing::Test, protected DrivenApp {
  protected:
    FileDialogTest() : DrivenApp({1024, 640}) {}
    /// Opens the dialog in the folder of the scene.
    void open() {
        run("scene.open_dialog");
        wait(4);
    }
    std::string text() {
        app_.tick(nullptr);
        std::string all;
        for (const DrawnText& each : recorder_.frame().texts) all += each.text + '\n';
        return all;
    }

    TempFolder folder_;
};

/// Ctrl+P, a width, a white background, Save: the picture lies beside the scene.
TEST_F(FileDialogTest, APictureHasTheSizeAndBackgroundThatAreChosen) {
    run("scene.save", {{"path", (folder_ / "arm.json").string()}});
    const glm::ivec2 view = app_.workspace().ui.picture_size;
    for (const char* const name : {"a.png", "b.png", "c.png"}) write(folder_ / name, "");
    key("ctrl+p");
    EXPECT_TRUE(says(text(), "a.png b.png c.png")) << "more than a row";
    click({700.0f, at("width, pixels").y});
    key("ctrl+a");
    type("7");
    key("escape");
    EXPECT_TRUE(app_.workspace().ui.covered()) << "only the number is given up";
    click({700.0f, at("width, pixels").y});
    key("ctrl+a");
    type("300");
    key("enter");
    click({700.0f, at("background").y});
    click(at("white"));
    click(at("Save"));
    EXPECT_FALSE(app_.workspace().ui.covered());
    const Image image = read_png(folder_ / "arm-1.png");
    EXPECT_EQ(image.size, glm::ivec2(300, std::lround(300.0 * view.y / view.x)));
    EXPECT_EQ(image.rgba[0], 255);
    key("ctrl+shift+p");
    click({700.0f, at("shows").y});
    click(at("a full turn of the camera"));
    click({700.0f, at("turn, frames").y});
    key("ctrl+a");
    type("3");
    key("enter");
    click(at("Record"));
    wait(8);
    const Apng turn = read_apng(read(folder_ / "arm-2.png"));
    EXPECT_EQ(turn.frames.size(), 3u);
    EXPECT_EQ(turn.size, image.size) << "as chosen before";
}

TEST_F(FileDialogTest, AVideoOfARunningMotorIsOneTurnWithoutAFrameTwice) {
    run("scene.save", {{"path", (folder_ / "leg.json").string()}});
    run("lab.open", {{"name", "linkage"}});
    run("linkage.preset", {{"name", "four_bar"}});
    run("linkage.drive", {{"joint", "crank"}, {"angle_deg", 33}});
    run("time.pause");
    for (const auto& [rate, round] :
         {std::pair(-90, "4.00 s to 0.03 s"), {77, "4.70 s to"}, {360, "1.00 s to"}}) {
        run("linkage.motor", {{"joint", "crank"}, {"deg_per_s", rate}});
        workspace().clock.steps_due = 300;
        wait(2);
        key("ctrl+shift+p");
        EXPECT_TRUE(says(text(), round)) << rate;
        if (rate != 360) key("escape");
    }
    click({700.0f, at("frames").y});
    click(at("60 a second"));
    EXPECT_TRUE(says(text(), "1.00 s to 0.02 s"));
    click(at("Record"));
    wait(80);
    run("view.picture", {{"path", (folder_ / "now.png").string()}});
    wait(4);
    const Apng turn = read_apng(read(folder_ / "leg-1.png"));
    ASSERT_EQ(turn.frames.size(), 60u);
    const Image now = read_png(folder_ / "now.png");
    const auto differing = [&](const Image& frame) {
        int count = 0;
        for (std::size_t i = 0; i < now.rgba.size(); ++i) count += frame.rgba.at(i) != now.rgba[i] ? 1 : 0;
        return count;
    };
    const int first = differing(turn.frames[0].image);  // the frame after the last
    EXPECT_LT(4 * first, differing(turn.frames[1].image));
    EXPECT_LT(4 * first, differing(turn.frames.back().image));
}

TEST_F(FileDialogTest, AFolderWithoutSuchFilesSaysWhatCanBeOpened) {
    run("scene.save", {{"path", (folder_ / "arm.json").string()}});
    open();
    EXPECT_EQ(text().find("No files that can be opened here"), std::string::npos);
    std::filesystem::remove(folder_ / "arm.json");
    std::filesystem::create_directory(folder_ / "poses");
    write(folder_ / "notes.txt", "Remember the milk");
    key("escape");
    open();
    EXPECT_TRUE(
        says(text(), "poses/ No files that can be opened here scenes json characters gltf motions bvh"));
}

TEST_F(FileDialogTest, AsksBeforeItReplacesAScene) {
    app_.workspace().outputs.in_window = true;
    const std::string old = R"({"tendril_scene": 2, "labs": {}})";
    run("scene.save", {{"path", (folder_ / "arm.json").string()}});
    write(folder_ / "old.json", old);
    write(folder_ / "walk.json", "{\"asset\": {}}");
    const auto save_as = [&](const char* name) {
        run("scene.save_dialog", {{"ask", true}});
        wait(4);
        key("ctrl+a");
        type(name);
        key("enter");
        app_.tick(nullptr);
    };
    save_as("walk.json");
    EXPECT_TRUE(says(text(), "walk.json is not replaced: it is not a scene"));
    key("escape");
    save_as("old.json");
    EXPECT_TRUE(says(text(), "old.json already exists"));
    EXPECT_EQ(read(folder_ / "old.json"), old);
    key("enter");
    app_.tick(nullptr);
    EXPECT_NE(read(folder_ / "old.json"), old);
    EXPECT_EQ(app_.workspace().ui.file_dialog, UiState::FileDialog::None);
    EXPECT_EQ(read(folder_ / "walk.json"), "{\"asset\": {}}");
}

TEST_F(FileDialogTest, StartsFreshEachTime) {
    run("scene.save", {{"path", (folder_ / "arm.json").string()}});
    open();
    type("helper");
    EXPECT_NE(text().find("helper"), std::string::npos);
    key("escape");
    EXPECT_EQ(text().find("helper"), std::string::npos);
    open();
    EXPECT_EQ(text().find("helper"), std::string::npos);
    EXPECT_NE(text().find("file name"), std::string::npos) << "the hint of an empty field";
}

TEST_F(FileDialogTest, ShowsTheEndOfALongNameUntilItIsTypedInto) {
    const std::string name = "a_character_with_a_name_" + std::string(80, 'x') + "_that_goes_on_take_12.json";
    run("scene.save", {{"path", (folder_ / name).string()}});
    open();
    click(at(name));  // its row
    const std::string shown = text();
    const auto cut = shown.find("take_12.json");
    ASSERT_NE(cut, std::string::npos);
    EXPECT_NE(shown.find("a_character"), std::string::npos);
    std::string in_field;
    for (const DrawnText& each : recorder_.frame().texts)
        if (each.text.starts_with("a_character") && each.text.find("...") < each.text.find("_take_12.json"))
            in_field = each.text;
    ASSERT_FALSE(in_field.empty());
    click(at(in_field));
    type("_b.json");
    const std::string typed = text();
    EXPECT_NE(typed.find("_b.json"), std::string::npos) << typed;
}

/// A BVH dropped on a character: the choice is made by a click, and Escape opens nothing.
TEST_F(FileDialogTest, AsksHowToOpenAMotionOnACharacter) {
    const std::string motion = source_path("tests/app/golden/faulty_walk.bvh");
    run("file.open", {{"path", source_path("tests/app/golden/body.glb")}});
    const auto character = [&] { return app_.state().at("character").at("file").get<std::string>(); };
    const std::string before = character();
    const auto drop = [&] {
        take(Drop{{motion}});
        wait(4);
    };
    drop();
    EXPECT_TRUE(says(text(), "Open a file faulty_walk.bvh Play it on the figure Open it on its own Cancel"));
    key("escape");
    EXPECT_EQ(text().find("Play it on the figure"), std::string::npos);
    EXPECT_TRUE(app_.state().at("clip").is_null() || app_.state().at("clip").at("name") != "motion");
    drop();
    click(at("Play it on the figure"));
    EXPECT_EQ(app_.state().at("clip").at("name"), "motion");
    EXPECT_EQ(character(), before);
    drop();
    click(at("Open it on its own"));
    EXPECT_EQ(character(), motion);
    EXPECT_EQ(text().find("Play it on the figure"), std::string::npos);
}

TEST_F(FileDialogTest, BrowsesForTheFileOfARow) {
    run("lab.open", {{"name", "humanoid"}});
    std::filesystem::copy(source_path("tests/app/golden/body.glb"), folder_ / "body.glb");
    run("scene.save", {{"path", (folder_ / "arm.json").string()}});
    write(folder_ / "walk.jsonl", "");
    click(at("Browse"));
    EXPECT_EQ(text().find("walk.jsonl"), std::string::npos) << "not for this row";
    click(at("body.glb"));
    click(at("Open"));
    EXPECT_EQ(app_.state().at("character").at("file"), (folder_ / "body.glb").string());
    open();
    type(source_path("tests/app/golden/body.glb"));
    key("enter");
    run("scene.open_dialog", {{"by", "humanoid.map.load"}});
    wait(4);
    EXPECT_EQ(text().find("a_pose.bvh"), std::string::npos) << "it has no bone map";
    key("escape");
    click(at("Load"));
    EXPECT_NE(text().find("a_pose.bvh"), std::string::npos) << "where the last file was";
    type("body.glb");
    key("enter");
    app_.tick(nullptr);
    EXPECT_EQ(app_.state().at("clip").at("name"), "wave_2") << "played, not asked about";
    run("lab.open", {{"name", "rope"}});
    click(at("Add"));
    click(at("Browse"));
    type("body.glb");
    key("enter");
    EXPECT_EQ(workspace().lab, "rope");
    EXPECT_FALSE(app_.state().at("character").is_null()) << app_.state();
}

}  // namespace
}  // namespace tendril::test
