// Characters written to glTF, GLB and BVH, and read back.
#include <algorithm>
#include <filesystem>

#include "app/io/character/bake.hpp"
#include "app/io/character/bvh.hpp"
#include "app/io/character/character.hpp"
#include "app/io/character/export.hpp"
#include "app/io/character/gltf_bytes.hpp"
#include "app/io/character/gltf_write.hpp"
#include "app/io/character/stick_figure.hpp"
#include "app/io/json.hpp"
#include "tests/app/io/gltf_structure.hpp"
#include "tests/app/io/posed.hpp"
#include "tests/app/support/temp_folder.hpp"
#include "tests/labels.hpp"
#include "tests/places.hpp"

namespace tendril::app {
namespace {

namespace fs = std::filesystem;
using humanoid::Clip;
using humanoid::Interpolation;
using tendril::test::TempFolder;

constexpr double tenth_of_a_millimetre = 1e-4;

/// 0.1 mm for a figure of 1.8 m, proportionally more for larger ones: files store floats.
double allowed_error(const humanoid::Skeleton& skeleton) {
    double largest = 1.8;
    for (const humanoid::Placement& each : test_posed::placed_as(skeleton, rest_pose(skeleton)))
        for (int axis = 0; axis < 3; ++axis) largest = std::max(largest, std::abs(each.position[axis]));
    return tenth_of_a_millimetre * largest / 1.8;
}

class Exports : public ::testing::Test {
  protected:
    ExportReport write(const Character& character, const Clip& clip, const std::string& name,
                       const std::string& from = {}, double rate = 60.0) const {
        return export_clip({character, from, clip, clip, rate}, folder_ / name);
    }
    std::string text(const char* name) const { return read_text_file((folder_ / name).string()); }
    TempFolder folder_;
    const Character figure_ = stick_figure();
};

LABEL(slow, "Exports.FilesOfOthersKeepWhatTheyHaveAndMoveAsTheyDid");

TEST_F(Exports, TheFigureIsReadBackUnchanged) {
    for (const Clip& clip : figure_.clips) {
        for (const char* name : {"figure.glb", "figure.gltf", "figure.bvh"}) {
            SCOPED_TRACE(clip.name + " as " + name);
            const ExportReport report = write(figure_, clip, name);
            EXPECT_LT(report.worst, 0.2 * tenth_of_a_millimetre) << report.text();
            EXPECT_FALSE(report.worst_joint.empty());
            EXPECT_TRUE(report.has_feet);
            EXPECT_EQ(report.skating_before, report.skating_after);
            const Character read = read_character(folder_ / name);
            EXPECT_EQ(read.scale, 1.0);
            for (const humanoid::Node& node : figure_.skeleton.nodes())
                EXPECT_TRUE(read.skeleton.find(node.name)) << node.name;
            ASSERT_EQ(read.clips.size(), 1u);
            EXPECT_NEAR(read.clips[0].duration, clip.duration, 1e-6);
            EXPECT_TRUE(humanoid::match_bones(read.skeleton).is_usable());
        }
        EXPECT_EQ(GltfStructure(text("figure.glb")).json["animations"][0]["name"], clip.name);
        EXPECT_EQ(GltfStructure(text("figure.gltf")).json["nodes"].size(), figure_.skeleton.size() + 1)
            << "and the body";
    }
}

TEST_F(Exports, StepsCubicsAndFlippedKeysAreReadBack) {
    Clip clip{.name = "kinds", .duration = 1.0, .channels = {{.node = 0}, {.node = 3}, {.node = 5}}};
    clip.channels[0].translation = {
        Interpolation::Cubic,
        {0.1, 0.7},
        {glm::dvec3(0), {0, 1, 0}, {1, 2, 0}, {0, -3, 0}, {1, 1, 0}, glm::dvec3(0)}};
    clip.channels[1].rotation = {Interpolation::Step, {0.0, 0.55}, {{1, 0, 0, 0}, {0, 1, 0, 0}}};
    // Away, back with the opposite sign, and away again.
    const auto about_x = [](double half) { return glm::dquat(std::cos(half), std::sin(half), 0, 0); };
    clip.channels[2].rotation = {Interpolation::Linear,
                                 {0.0, 0.123, 0.5, 1.0},
                                 {about_x(0), -about_x(0.8), about_x(0.1), -about_x(0.4)}};
    clip.channels[2].scale = {Interpolation::Linear, {0.25}, {glm::dvec3(1.2)}};
    ASSERT_TRUE(humanoid::check(clip, figure_.skeleton));
    for (const char* name : {"kinds.glb", "kinds.gltf"}) {
        EXPECT_LT(write(figure_, clip, name, {}, 30.0).worst, 1e-6);
        const GltfStructure structure(text(name));
        const Clip read = read_character(folder_ / name).clips.at(0);
        EXPECT_EQ(read.channels[0].translation.interpolation, Interpolation::Cubic);
        EXPECT_EQ(read.channels[1].rotation.interpolation, Interpolation::Step);
        EXPECT_GT(read.channels[2].rotation.times.size(), 31u);
    }
}

TEST_F(Exports, EveryFrameHasAKeyAndTheClipsOwnKeysStay) {
    for (const double rate : {24.0, 30.0, 60.0}) {
        write(figure_, figure_.clips[0], "walk.glb", {}, rate);
        const Clip read = read_character(folder_ / "walk.glb").clips.at(0);
        const auto& times = read.channels[0].rotation.times;
        for (int frame = 0; frame / rate <= 1.1; ++frame)
            EXPECT_TRUE(std::ranges::any_of(times, [&](double time) {
                return std::abs(time - frame / rate) < 1e-4;
            })) << frame;
        EXPECT_GE(times.size(), figure_.clips[0].channels[0].rotation.times.size());
    }
}

TEST_F(Exports, ACorrectedUpAxisDoesNotChangeAGltfsNodes) {
    write(figure_, figure_.clips[0], "own.glb");
    Character turned = read_character(folder_ / "own.glb");
    const humanoid::Skeleton own = turned.skeleton;
    read_as(turned, 0.5, {.up = UpAxis::MinusX, .positions = RootPositions::Replace});
    const std::string from = (folder_ / "own.glb").string();
    EXPECT_LT(write(turned, turned.clips[0], "again.glb", from).worst, tenth_of_a_millimetre);
    const Character again = read_character(folder_ / "again.glb");
    ASSERT_EQ(again.skeleton.size(), own.size());
    for (std::size_t i = 0; i < own.size(); ++i)
        EXPECT_LT(glm::distance(again.skeleton[i].rest.translation, own[i].rest.translation), 1e-6);
    EXPECT_LT(glm::distance(again.clips[0].channels[0].translation.values[0],
                            read_character(folder_ / "own.glb").clips[0].channels[0].translation.values[0]),
              1e-6);
}

TEST_F(Exports, ABvhHasItsRateNamesAndARecognisableUnit) {
    write(figure_, figure_.clips[0], "walk.bvh", {}, 30.0);
    const std::string bvh = text("walk.bvh");
    for (const char* const line :
         {"Frames: 34\n", "Frame Time: 0.03333333333333333\n", "JOINT HeadTop_End\n"})
        EXPECT_TRUE(tendril::test::has(bvh, line));
    // Giants and dwarfs keep their sizes, although a BVH has no unit.
    for (const double size : {0.01, 0.3, 2.0, 4.0, 90.0}) {
        std::vector<humanoid::Node> nodes = figure_.skeleton.nodes();
        std::vector<Clip> clips = figure_.clips;
        normalise(nodes, clips, size);
        nodes[3].name = "a{b}\nc";
        const Character other{.skeleton = *humanoid::Skeleton::make(nodes), .clips = clips, .notes = {}};
        const ExportReport report = write(other, clips[0], "other.bvh");
        EXPECT_LT(report.worst, 1e-5 * std::max(size, 1.0)) << size << ": " << report.text();
    }
    // End sites that were read are written as end sites.
    const Character once = read_character(folder_ / "walk.bvh");
    write(once, once.clips[0], "again.bvh");
    EXPECT_EQ(read_character(folder_ / "again.bvh").skeleton.size(), once.skeleton.size());
}

TEST_F(Exports, EachRootHasASkin) {
    std::vector<humanoid::Node> nodes{{"a", -1, {}}, {"b", 0, {.translation = {0, 1, 0}}}, {"c", -1, {}}};
    const Character two{.skeleton = *humanoid::Skeleton::make(nodes), .clips = {}, .notes = {}};
    for (const char* name : {"two.glb", "two.bvh"})
        EXPECT_LT(write(two, Clip{.name = "none"}, name).worst, 1e-6);
    EXPECT_EQ(GltfStructure(text("two.glb")).json["skins"].size(), 2u);
}

TEST_F(Exports, UnwritableFilesAreRefusedAndTheOldFileStays) {
    write(figure_, figure_.clips[0], "walk.glb");
    const std::string before = text("walk.glb");
    EXPECT_THROW(write(figure_, figure_.clips[0], "walk.fbx"), std::runtime_error);
    EXPECT_THROW(write(figure_, figure_.clips[0], "nowhere/walk.glb"), std::runtime_error);
    EXPECT_THROW(write(figure_, figure_.clips[0], "walk.glb", {}, 0.0), std::runtime_error);
    EXPECT_THROW(write(figure_, figure_.clips[0], "walk.glb", {}, std::nan("")), std::runtime_error);
    EXPECT_THROW(write(figure_, figure_.clips[0], "walk.glb", (folder_ / "gone.glb").string()),
                 std::runtime_error);
    Clip age = figure_.clips[0];
    age.duration = 1e9;
    EXPECT_THROW(write(figure_, age, "walk.glb"), std::runtime_error);
    // The file's nodes differ from the character's that claims to come from it.
    const Character other{.skeleton = *humanoid::Skeleton::make({{"a", -1, {}}}), .clips = {}, .notes = {}};
    EXPECT_THROW(write(other, Clip{}, "walk.glb", (folder_ / "walk.glb").string()), std::runtime_error);
    EXPECT_EQ(text("walk.glb"), before);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator()), 1);
}

TEST_F(Exports, GroundedFeetAreBaked) {
    const Clip& walk = figure_.clips[0];
    const humanoid::BoneMap map = humanoid::match_bones(figure_.skeleton);
    for (const auto& ground : {humanoid::Ground::flat(), humanoid::Ground::stairs(0.15, 0.3)}) {
        const Clip clip = with_feet_on(*ground, figure_.skeleton, map, walk, 60.0);
        EXPECT_TRUE(humanoid::check(clip, figure_.skeleton));
        EXPECT_EQ(clip.duration, walk.duration);
        const ExportReport report = export_clip({figure_, {}, walk, clip, 60.0}, folder_ / "on_ground.glb");
        EXPECT_LT(report.worst, tenth_of_a_millimetre) << report.text();
        GltfStructure{text("on_ground.glb")};
    }
    // Without a ground nothing changes.
    EXPECT_EQ(with_feet_on({}, figure_.skeleton, map, walk, 60.0), walk);
}

/// All members of `before` except animations and their data are also in `after`.
void expect_kept(const nlohmann::json& before, const nlohmann::json& after) {
    for (const char* member : {"scenes", "scene", "skins", "meshes", "materials", "textures", "samplers",
                               "cameras", "extensions", "extensionsUsed"})
        EXPECT_EQ(before.value(member, nlohmann::json()), after.value(member, nlohmann::json())) << member;
    ASSERT_EQ(before["nodes"].size(), after["nodes"].size());
    for (std::size_t i = 0; i < before["nodes"].size(); ++i) {
        nlohmann::json from = before["nodes"][i], to = after["nodes"][i];
        if (from.contains("matrix"))
            for (const char* part : {"matrix", "translation", "rotation", "scale"})
                from.erase(part), to.erase(part);
        EXPECT_EQ(from, to) << "node " << i;
    }
    for (std::size_t i = 0; i < before.value("images", nlohmann::json::array()).size(); ++i)
        EXPECT_EQ(before["images"][i].value("name", std::string()),
                  after["images"][i].value("name", std::string()));
}

TEST_F(Exports, FilesOfOthersKeepWhatTheyHaveAndMoveAsTheyDid) {
    const fs::path folder = tendril::test::characters_folder();
    if (!fs::is_directory(folder)) GTEST_SKIP() << folder << " is not there";
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (!ends_as_character(entry.path())) continue;
        const std::string file = entry.path().string();
        SCOPED_TRACE(entry.path().filename().string());
        const Character character = read_character(file);
        const std::size_t clips = std::min<std::size_t>(character.clips.size(), test::is_thorough() ? 3 : 1);
        for (std::size_t i = 0; i < clips; ++i) {
            const Clip clip = test_posed::first_seconds(character.clips[i], test::is_thorough() ? 4.0 : 1.5);
            for (const char* name : {"other.glb", "other.gltf", "other.bvh"}) {
                const ExportReport report = write(character, clip, name, file);
                EXPECT_LT(report.worst, allowed_error(character.skeleton)) << name << ": " << report.text();
            }
            const GltfStructure binary(text("other.glb")), written(text("other.gltf"));
            EXPECT_EQ(binary.json["nodes"], written.json["nodes"]);
            if (entry.path().extension() != ".glb" && entry.path().extension() != ".gltf") continue;
            expect_kept(nlohmann::json::parse(gltf_json(tendril::test::read(entry.path()))), binary.json);
            EXPECT_EQ(read_character(folder_ / "other.glb").skeleton.size(), character.skeleton.size());
        }
    }
}

}  // namespace
}  // namespace tendril::app
