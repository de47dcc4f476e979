#include "app/document/scene_file.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <random>

#include "app/document/command.hpp"
#include "app/document/outside_file.hpp"
#include "tests/app/support/program.hpp"
#include "tests/app/support/temp_folder.hpp"
#include "tests/app/support/test_part.hpp"
#include "tests/says.hpp"

namespace tendril::app {
namespace {

using test::has;
using test::make_part;
using test::message_of;
using test::TempFolder;
using test::TestPart;

/// One of everything, all different from the defaults.
Workspace make_busy_workspace() {
    Workspace workspace = test::make_workspace();
    workspace.document.edit<TestPart>("arm").title = "an \"arm\" [{\\ \xC3\xA4";
    workspace.document.edit<TestPart>("arm").values = {0.1f, -0.0f, 1e-40f, 3.0e8f};
    workspace.document.edit<TestPart>("rope").target = {1.0f, 2.5f, -3.25f};
    workspace.lab = "rope";
    workspace.camera = {{1, 2, 3}, 0.3f, -0.7f, 4.2f, 0.9f, true};
    workspace.history.push(workspace.blank, "edit", 0);
    workspace.path = "old.json";
    workspace.clock.tick = 77;
    return workspace;
}

/// Everything that loading may change.
std::string snapshot(const Workspace& w) {
    return save_scene(w).dump() + w.path.string() + std::to_string(w.history.size()) +
           (w.modified() ? " modified" : "") + std::to_string(w.clock.tick);
}

/// Loads a scene that must be refused and returns the reason; the workspace must not change.
std::string refusal(const Json& scene) {
    Workspace workspace = make_busy_workspace();
    const Document document = workspace.document;
    const std::string before = snapshot(workspace);
    const std::string message = message_of([&] { load_scene(workspace, scene); });
    EXPECT_EQ(snapshot(workspace), before);
    EXPECT_TRUE(workspace.document == document);
    return message;
}

TEST(SceneFile, ComesBackAsItWasSaved) {
    const Workspace saved = make_busy_workspace();
    Workspace loaded = make_busy_workspace();
    loaded.document = loaded.blank;
    loaded.lab = "arm";
    load_scene(loaded, parse_json(json_to_text(save_scene(saved))));
    EXPECT_EQ(save_scene(loaded).dump(), save_scene(saved).dump());
    EXPECT_EQ(loaded.lab, "rope");
    EXPECT_TRUE(loaded.camera == saved.camera);
    EXPECT_EQ(loaded.document.get<TestPart>("arm").values, saved.document.get<TestPart>("arm").values);
    EXPECT_EQ(loaded.history.size(), 1u) << "the history is the caller's: opening can be undone";
    EXPECT_EQ(loaded.clock.tick, 0u);
}

TEST(SceneFile, KeepsACameraBitForBit) {
    std::mt19937 random(7);
    const auto in = [&](float low, float high) {
        return std::uniform_real_distribution<float>(low, high)(random);
    };
    for (int i = 0; i < 20'000; ++i) {
        const CameraPose pose{{in(-1e3f, 1e3f), in(-1, 1), in(-1, 1)},
                              in(-10, 10),
                              in(-1.57f, 1.57f),
                              in(0.01f, 1e4f),
                              in(0.1f, 2.0f),
                              random() % 2 == 0};
        ASSERT_TRUE(load_camera(parse_json(save_camera(pose).dump()), "camera") == pose);
    }
    const CameraPose steep{.pitch = static_cast<float>(std::numbers::pi / 2)};
    EXPECT_EQ(save_camera(steep)["pitch_deg"].dump(), "90.0");
    EXPECT_TRUE(load_camera(save_camera(steep), "camera") == steep);
}

TEST(SceneFile, UnmentionedPartsBecomeBlankOrStay) {
    Workspace workspace = make_busy_workspace();
    workspace.first_view.distance = 5.5f;
    load_scene(workspace, parse_json(R"({"tendril_scene": 1, "labs": {}, "unknown": [1, 2]})"));
    EXPECT_TRUE(workspace.document == workspace.blank);
    EXPECT_EQ(workspace.lab, "rope");
    EXPECT_TRUE(workspace.camera == workspace.first_view);
    load_scene(workspace, parse_json(R"({"tendril_scene": 1, "labs": {}, "camera": {"distance": 7}})"));
    EXPECT_EQ(workspace.camera.distance, 7.0f);
    EXPECT_EQ(workspace.camera.pitch, CameraPose{}.pitch);
}

TEST(SceneFile, OtherValuesAreRefusedWithPathAndReason) {
    const std::string arm = R"({"title": "a", "values": [], "target": [0, 0, 0]})";
    const auto scene = [](const std::string& members) { return R"({"tendril_scene": 1, )" + members + "}"; };
    const auto with_arm = [&](const std::string& part) { return scene(R"("labs": {"arm": )" + part + "}"); };
    const auto with_camera = [&](const std::string& camera) {
        return scene(R"("labs": {}, "camera": )" + camera);
    };
    const std::vector<std::pair<std::string, std::string>> bad{
        {"[]", "not a Tendril scene"},
        {R"({"tendril_scene": 3, "labs": {}})",
         "tendril_scene: version 3 is newer than this program, which reads 2"},
        {R"({"tendril_scene": 18446744073709551615, "labs": {}})", "is newer than"},
        {R"({"tendril_scene": 0, "labs": {}})",
         "tendril_scene: expected a whole number from 1 to 2, found 0"},
        {R"({"tendril_scene": 1})", "\"labs\" is missing"},
        {scene(R"("labs": [])"), "labs: expected an object, found []"},
        {scene(R"("labs": {"piano": {}})"), "labs: there is no lab \"piano\""},
        {scene(R"("labs": {}, "lab": "piano")"), "lab: there is no lab \"piano\""},
        {scene(R"("labs": {}, "lab": 3)"), "lab: expected text, found 3"},
        {with_arm("{}"), "labs.arm: \"title\" is missing"},
        {with_arm(R"({"title": 3})"), "labs.arm.title: expected text, found 3"},
        {with_arm(R"({"title": "", "values": [1, "2"]})"),
         "labs.arm.values.1: expected a number, found \"2\""},
        {with_arm(R"({"title": "", "values": [2e9]})"),
         "labs.arm.values.0: expected a number of at most 1e9"},
        {with_camera(R"({"yaw_deg": "0"})"), "camera.yaw_deg: expected a number, found \"0\""},
        {with_camera(R"({"pitch_deg": 91})"), "camera.pitch_deg: expected -90.0 to 90.0 degrees, found 91"},
        {with_camera(R"({"distance": 0})"), "camera.distance: expected a number from "},
        {with_camera(R"({"field_of_view_deg": 180})"), "camera.field_of_view_deg: expected "},
    };
    for (const auto& [text, reason] : bad) EXPECT_TRUE(has(refusal(parse_json(text)), reason)) << text;
    EXPECT_EQ(message_of([&] {
                  Workspace workspace = make_busy_workspace();
                  load_scene(workspace, parse_json(with_arm(arm)));
              }),
              "");
}

TEST(SceneFile, AnyExceptionOfAPartRefusesTheFile) {
    struct Choking : TestPart {
        std::shared_ptr<Part> load(const Json& json, const std::string&) const override {
            if (json == 1) throw std::invalid_argument("length must be positive");
            return json.at("nothing").get<int>() > 0 ? nullptr : clone();
        }
    };
    Workspace workspace = test::make_workspace();
    workspace.blank.set("arm", std::make_shared<Choking>());
    const auto load = [&](int part) {
        load_scene(workspace, Json{{"tendril_scene", 1}, {"labs", {{"arm", part}}}});
    };
    EXPECT_THROW(load(1), std::runtime_error);
    EXPECT_THROW(load(2), std::runtime_error);
    EXPECT_TRUE(test::says(message_of([&] { load(1); }), "labs.arm length"));
}

TEST(SceneFile, OlderVersionsAreUpgradedBeforeAPartReadsThem) {
    struct Renamed : TestPart {
        void upgrade(Json& json, int version) const override {
            if (version == 1 && json.is_object() && json.contains("name")) json["title"] = json["name"];
        }
    };
    Workspace workspace = test::make_workspace();
    workspace.blank.set("arm", std::make_shared<Renamed>());
    const auto load = [&](int version) {
        const Json arm{{"name", "old"}, {"values", Json::array()}, {"target", {0, 0, 0}}};
        load_scene(workspace, Json{{"tendril_scene", version}, {"labs", {{"arm", arm}}}});
    };
    load(1);
    EXPECT_EQ(workspace.document.get<TestPart>("arm").title, "old");
    EXPECT_EQ(message_of([&] { load(2); }), "labs.arm: \"title\" is missing");
}

TEST(SceneFile, OnDiskRemembersItsPathAndThatItIsSaved) {
    const TempFolder folder;
    Workspace workspace = make_busy_workspace();
    ASSERT_TRUE(workspace.modified());
    save_scene_file(workspace, folder / "scene.json");
    EXPECT_EQ(workspace.path, folder / "scene.json");
    EXPECT_FALSE(workspace.modified());
    EXPECT_EQ(workspace.history.size(), 1u) << "saving is no reason to forget";

    Workspace other = test::make_workspace();
    load_scene_file(other, folder / "scene.json");
    EXPECT_EQ(other.path, folder / "scene.json");
    EXPECT_FALSE(other.modified());
    EXPECT_EQ(save_scene(other).dump(), save_scene(workspace).dump());
    save_scene_file(other, folder / "again.json");
    EXPECT_EQ(test::read(folder / "again.json"), test::read(folder / "scene.json"));
}

TEST(SceneFile, ASceneThatWouldNotOpenAgainReplacesNoFile) {
    const TempFolder folder;
    Workspace workspace = make_busy_workspace();
    save_scene_file(workspace, folder / "scene.json");
    const std::string good = test::read(folder / "scene.json");
    workspace.document.edit<TestPart>("arm").values = {1.0f, std::numeric_limits<float>::quiet_NaN()};
    const std::string error = message_of([&] { save_scene_file(workspace, folder / "scene.json"); });
    EXPECT_TRUE(has(error, "scene.json was not overwritten")) << error;
    EXPECT_TRUE(has(error, "labs.arm.values.1")) << error;
    EXPECT_EQ(test::read(folder / "scene.json"), good);
    EXPECT_TRUE(workspace.modified());
    // Under a new name it is saved, with a warning.
    save_scene_file(workspace, folder / "other.json");
    EXPECT_TRUE(std::filesystem::exists(folder / "other.json"));
    ASSERT_FALSE(workspace.ui.toasts.empty());
    EXPECT_TRUE(has(workspace.ui.toasts.back().text, "labs.arm.values.1"));
}

TEST(SceneFile, ErrorsOnDiskNameFileAndLine) {
    const TempFolder folder;
    Workspace workspace = make_busy_workspace();
    const auto message = [&](const std::string& text) {
        test::write(folder / "s.json", text);
        const std::string before = snapshot(workspace);
        const std::string error = message_of([&] { load_scene_file(workspace, folder / "s.json"); });
        EXPECT_EQ(snapshot(workspace), before);
        return error;
    };
    EXPECT_TRUE(has(message("{\n\n\"a\" 1}"), "s.json: line 3: unexpected number"));
    EXPECT_TRUE(has(message("{\"tendril_scene\": 1,\n\"labs\": {\n\"arm\": {\"title\": \"\",\n\"values\": "
                            "[1,\n2,\n\"x\"]}}}"),
                    "s.json: line 6: labs.arm.values.2: expected a number, found \"x\""));
    EXPECT_TRUE(has(message("{\"tendril_scene\": 1,\n\"labs\": {\n\"arm\": {}}}"),
                    "s.json: line 3: labs.arm: \"title\" is missing"));
    EXPECT_TRUE(
        has(message("{\n\"tendril_scene\": 7}"), "s.json: line 2: tendril_scene: version 7 is newer"));
    EXPECT_TRUE(has(message("{}"), "s.json: not a Tendril scene"));
    EXPECT_TRUE(has(message(std::string(100, '[')), "s.json: line 1: nested deeper than 64"));
    EXPECT_TRUE(has(message_of([&] { load_scene_file(workspace, folder / "none"); }), "none: No such file"));
    EXPECT_TRUE(has(message_of([&] { load_scene_file(workspace, folder.path()); }), ": is a folder"));
    EXPECT_TRUE(
        has(message_of([&] { save_scene_file(workspace, folder / "none" / "s.json"); }), "cannot write "));
    EXPECT_EQ(workspace.path, "old.json");
}

TEST(SceneFile, ChangedByAnotherProgramIsNotOverwritten) {
    struct Racing : TestPart {
        std::filesystem::path file;
        std::shared_ptr<Part> load(const Json& json, const std::string& where) const override {
            test::write(file, test::read(file) + "\n");
            return TestPart::load(json, where);
        }
    };
    const TempFolder folder;
    Workspace workspace = make_busy_workspace();
    save_scene_file(workspace, folder / "s.json");
    auto racing = std::make_shared<Racing>();
    racing->file = folder / "s.json";
    workspace.blank.set("arm", racing);
    load_scene_file(workspace, folder / "s.json");
    workspace.blank.set("arm", make_part("blank arm"));
    const std::string there = test::read(folder / "s.json");
    workspace.document.edit<TestPart>("arm").title = "mine";
    EXPECT_TRUE(test::says(message_of([&] { save_scene_file(workspace, folder / "s.json"); }),
                           "s.json was changed by another program"));
    EXPECT_EQ(test::read(folder / "s.json"), there);
}

/// A part that reads a file beside the JSON, like a character.
struct FilePart : Part {
    OutsideFile model;
    std::string text;
    int edits = 0;  ///< at most as many as the file has characters
    std::shared_ptr<Part> clone() const override { return std::make_shared<FilePart>(*this); }
    Json save() const override {
        return {{"models", Json::array({save_outside_file(model)})}, {"edits", edits}};
    }
    std::shared_ptr<Part> load(const Json& json, const std::string& where) const override {
        const JsonPlace place(json, where);
        auto part = std::make_shared<FilePart>();
        part->text = read_outside_file(place["models"].element(0),
                                       [&](const std::string& path, const std::string& file) {
                                           part->model = outside_file(path, file);
                                           return path.empty() ? "blank" : read_text_file(path);
                                       });
        part->edits = place["edits"].integer(0, static_cast<int>(part->text.size()));
        return part;
    }
    std::size_t bytes() const override { return sizeof(FilePart); }
};

class SceneWithAFile : public testing::Test {
  protected:
    SceneWithAFile() {
        std::filesystem::create_directories(folder_ / "project/models");
        std::filesystem::create_directories(folder_ / "project/scenes");
    }
    Workspace workspace() {
        Workspace workspace = make_busy_workspace();
        workspace.blank.set("file", std::make_shared<FilePart>());
        workspace.document.set("file", workspace.blank.parts().at("file"));
        return workspace;
    }
    static CommandTable command_table() {
        CommandTable table;
        add_workspace_commands(table);
        table.add(
            {.name = "file.edit",
             .title = "Edit",
             .arguments = {},
             .help = "Edits",
             .effect = Effect::Edit,
             .apply = [](Workspace& w, const Arguments&) { ++w.document.edit<FilePart>("file").edits; }});
        return table;
    }
    /// Saves a scene that reads the model.
    void save(const std::string& scene, const std::string& model) {
        test::write(folder_ / model, "the model");
        std::filesystem::remove(folder_ / scene);
        Workspace saved = workspace();
        auto& part = saved.document.edit<FilePart>("file");
        part.model = outside_file((folder_ / model).string(), "model.glb");
        part.edits = 7;
        save_scene_file(saved, folder_ / scene);
    }
    const TempFolder folder_;
};

TEST_F(SceneWithAFile, FindsItAfterBothHaveMovedTogether) {
    for (const auto& [scene, model] : {std::pair{"project/s.json", "project/model.glb"},
                                       {"project/s.json", "project/models/model.glb"},
                                       {"project/scenes/s.json", "project/models/model.glb"}}) {
        save(scene, model);
        std::filesystem::rename(folder_ / "project", folder_ / "moved");
        Workspace again = workspace();
        load_scene_file(again, folder_ / ("moved" + std::string(scene).substr(7)));
        EXPECT_TRUE(again.ui.toasts.empty()) << model;
        EXPECT_EQ(again.document.get<FilePart>("file").text, "the model") << model;
        EXPECT_EQ(again.document.get<FilePart>("file").edits, 7);
        std::filesystem::remove(folder_ / "moved" / std::string(model).substr(8));
        std::filesystem::rename(folder_ / "moved", folder_ / "project");
    }
}

TEST_F(SceneWithAFile, OpensWithoutTheFileAndSavesTheLabUnchanged) {
    save("project/s.json", "model.glb");
    std::filesystem::remove(folder_ / "model.glb");
    const Json saved = read_json_file(folder_ / "project/s.json");
    Workspace again = workspace();
    const CommandTable table = command_table();
    table.run(again, "scene.open", {{"path", (folder_ / "project/s.json").string()}});
    ASSERT_FALSE(again.ui.toasts.empty());
    EXPECT_TRUE(test::says(again.ui.toasts.back().text, "model.glb is missing The file lab is blank"));
    EXPECT_EQ(again.document.get<TestPart>("arm").title, saved["labs"]["arm"]["title"].get<std::string>());

    again.document.edit<FilePart>("file").text = "the simulation went on";
    save_scene_file(again, folder_ / "project/s.json");
    EXPECT_EQ(read_json_file(folder_ / "project/s.json")["labs"], saved["labs"]);
    table.run(again, "file.edit", Json::object());
    EXPECT_EQ(save_scene(again)["labs"], saved["labs"]);
    EXPECT_EQ(save_scene(again)["stand_ins"]["file"]["edits"], 1) << "it was edited as it is now";
    table.run(again, "undo", Json::object());
    EXPECT_EQ(save_scene(again)["labs"], saved["labs"]);
}

TEST_F(SceneWithAFile, AsksBeforeASaveDropsALabOfTheFile) {
    save("s.json", "model.glb");
    std::filesystem::remove(folder_ / "model.glb");
    const std::string text = test::read(folder_ / "s.json");
    Workspace again = workspace();
    const auto note = [&] { return stand_in_note("file", *again.document.parts().at("file")); };
    const auto saved = [&](const char* name) {
        return message_of([&] { save_scene_file(again, folder_ / name); });
    };
    const auto open_and_edit = [&] {
        test::write(folder_ / "s.json", text);
        load_scene_file(again, folder_ / "s.json");
        EXPECT_TRUE(test::says(note(), "model.glb is missing keeps until you change it")) << note();
        command_table().run(again, "file.edit", Json::object());
        EXPECT_TRUE(test::says(note(), "model.glb is missing Saving replaces")) << note();
    };
    open_and_edit();
    for (int i = 0; i < 2; ++i) EXPECT_TRUE(test::says(saved("s.json"), "s.json still has file lab --force"));
    EXPECT_EQ(test::read(folder_ / "s.json"), text);
    EXPECT_EQ(saved("other.json"), "") << "which has both";
    open_and_edit();
    again.outputs.in_window = true;
    EXPECT_TRUE(test::says(saved("s.json"), "Do the same again"));
    EXPECT_EQ(saved("s.json"), "");
    EXPECT_EQ(read_json_file(folder_ / "s.json")["labs"]["file"]["edits"], 1);
    open_and_edit();
    EXPECT_TRUE(test::says(saved("s.json"), "Do the same again")) << "each loss by itself";
    again.outputs.force = true;
    EXPECT_EQ(saved("s.json"), "");
}

/// In another file, and in an autosave, which is read from the same JSON.
TEST_F(SceneWithAFile, KeepsWhatCouldNotBeReadBesideItsEdits) {
    save("s.json", "model.glb");
    std::filesystem::remove(folder_ / "model.glb");
    Workspace again = workspace();
    load_scene_file(again, folder_ / "s.json");
    command_table().run(again, "file.edit", Json::object());
    save_scene_file(again, folder_ / "other.json");
    for (int i = 0; i < 2; ++i) {
        again = workspace();
        const std::vector<LabNote> notes = load_scene_file(again, folder_ / "other.json");
        ASSERT_EQ(notes.size(), 1u);
        EXPECT_TRUE(test::says(notes[0].text, "model.glb is missing Saving replaces"));
        EXPECT_FALSE(notes[0].whole);
        EXPECT_EQ(again.document.get<FilePart>("file").edits, 1);
        save_scene_file(again, folder_ / "yet_another.json");
        std::filesystem::rename(folder_ / "yet_another.json", folder_ / "other.json");
    }
    test::write(folder_ / "model.glb", "the model");
    const std::vector<LabNote> notes = load_scene_file(again, folder_ / "other.json");
    ASSERT_EQ(notes.size(), 1u);
    EXPECT_TRUE(test::says(notes[0].text, "its last save Changes are left out"));
    EXPECT_TRUE(notes[0].whole);
    EXPECT_EQ(again.document.get<FilePart>("file").edits, 7);
    EXPECT_FALSE(save_scene(again).contains("stand_ins"));
}

TEST_F(SceneWithAFile, KeepsAStandInWhoseOwnFileIsMissing) {
    save("s.json", "model.glb");
    Json scene = read_json_file(folder_ / "s.json");
    const Json edited = scene["labs"]["file"];
    scene["labs"]["file"]["models"][0]["path"] = (folder_ / "nowhere.glb").string();
    scene["stand_ins"]["file"] = edited;
    std::filesystem::remove(folder_ / "model.glb");
    Workspace again = workspace();
    load_scene(again, scene);
    EXPECT_EQ(save_scene(again)["stand_ins"]["file"], edited);
    EXPECT_EQ(save_scene(again)["labs"]["file"], scene["labs"]["file"]);
    command_table().run(again, "file.edit", Json::object());
    EXPECT_EQ(save_scene(again)["stand_ins"]["file"]["edits"], 1);
}

/// A wrong value is refused, unless the file explains it.
TEST_F(SceneWithAFile, StartsBlankOnlyIfItsFileIsInvalid) {
    save("s.json", "model.glb");
    const Json scene = read_json_file(folder_ / "s.json");
    const auto opened = [&](const Json& edits) {
        Json changed = scene;
        changed["labs"]["file"]["edits"] = edits;
        std::string notes;
        const std::string refused = message_of([&] {
            Workspace again = workspace();
            for (const LabNote& each : load_scene(again, changed))
                notes += (each.whole ? "" : "blank: ") + each.lab + ": " + each.text;
        });
        return notes.empty() ? refused : notes;
    };
    for (const Json& wrong : {Json(10), Json(-1), Json("seven"), Json(nullptr)})
        EXPECT_TRUE(opened(wrong).starts_with("labs.file.edits: expected a whole number")) << wrong;
    for (const Json& wrong : {Json(-1), Json("x"), Json(0.5), Json(1e300), Json(0x1'0000'0000)}) {
        Json changed = scene;
        changed["labs"]["file"]["models"][0]["crc32"] = wrong;
        Workspace again = workspace();
        EXPECT_TRUE(test::says(message_of([&] { load_scene(again, changed); }), "models.0.crc32: expected"));
    }
    test::write(folder_ / "model.glb", "another model");
    EXPECT_EQ(opened(10), "file: model.glb has changed since the scene was saved.");
    test::write(folder_ / "model.glb", "short");
    EXPECT_TRUE(test::says(opened(7), "blank: file: model.glb has changed (labs.file.edits: expected"))
        << opened(7);
    std::filesystem::remove(folder_ / "model.glb");
    EXPECT_TRUE(test::says(opened(7), "blank: file: model.glb is missing"));
    std::filesystem::create_directory(folder_ / "model.glb");
    EXPECT_TRUE(test::says(opened(7), "blank: file: is a folder"));
}

TEST(SceneFile, CutOffAnywhereIsRefused) {
    const TempFolder folder;
    Workspace workspace = make_busy_workspace();
    const std::string text = json_to_text(save_scene(workspace));
    const std::string before = snapshot(workspace);
    // The last byte is the newline after the closing brace.
    for (std::size_t size = 0; size + 1 < text.size(); ++size) {
        test::write(folder / "cut.json", std::string_view(text).substr(0, size));
        const std::string message = message_of([&] { load_scene_file(workspace, folder / "cut.json"); });
        ASSERT_TRUE(has(message, "cut.json: line ")) << size << " of " << text.size() << " bytes";
        ASSERT_EQ(snapshot(workspace), before);
    }
}

TEST(SceneFile, WithAnyByteChangedIsRefusedOrReadWhole) {
    const std::string text = json_to_text(save_scene(make_busy_workspace()));
    std::mt19937 random(8);
    int refused = 0, accepted = 0;
    for (int i = 0; i < test::rounds(30'000); ++i) {
        std::string changed = text;
        for (unsigned flips = 1 + static_cast<unsigned>(random()) % 3; flips > 0; --flips)
            changed[random() % changed.size()] = static_cast<char>(random() % 256);
        Workspace workspace = make_busy_workspace();
        const std::string before = snapshot(workspace);
        try {
            load_scene(workspace, parse_json(changed));
            ++accepted;
            Workspace again = test::make_workspace();
            load_scene(again, parse_json(json_to_text(save_scene(workspace))));
            ASSERT_EQ(save_scene(again).dump(), save_scene(workspace).dump());
        } catch (const std::runtime_error& error) {
            ++refused;
            ASSERT_EQ(snapshot(workspace), before) << error.what();
        }
    }
    EXPECT_GT(refused, test::rounds(700));
    EXPECT_GT(accepted, test::rounds(700));
}

TEST(SceneFile, WithAnyValueOfAnotherKindIsRefusedOrReadWhole) {
    const Json scene = save_scene(make_busy_workspace()).flatten();
    const std::vector<Json> others{
        nullptr, true, -1, 1e8, 3e9, 1e300, "text", Json::array(), Json::object(), Json::array({1, 2, 3})};
    int refused = 0;
    for (const auto& [place, value] : scene.items()) {
        for (const Json& other : others) {
            Json changed = save_scene(make_busy_workspace());
            changed[Json::json_pointer(place)] = other;
            Workspace workspace = make_busy_workspace();
            const std::string before = snapshot(workspace);
            const std::string message = message_of([&] { load_scene(workspace, changed); });
            if (message.empty()) continue;
            ++refused;
            EXPECT_EQ(snapshot(workspace), before) << place << " as " << other;
            EXPECT_FALSE(has(message, "json.exception")) << place << " as " << other;
            std::string where = place.substr(1, place.find('/', 1) - 1);
            EXPECT_TRUE(message.starts_with(where)) << place << " as " << other << ": " << message;
        }
    }
    EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace tendril::app
