// Files on which readers once failed, and the correct result for each: a row for every file of that folder.
// Small cases of each kind, independent of that folder, are in the tests of the formats.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <glm/trigonometric.hpp>
#include <tendril/humanoid/lint.hpp>

#include "app/io/character/character.hpp"
#include "app/io/character/export.hpp"
#include "tests/app/io/posed.hpp"
#include "tests/app/support/temp_folder.hpp"
#include "tests/places.hpp"
#include "tests/says.hpp"

namespace tendril::app {
namespace {

namespace fs = std::filesystem;
using test_posed::at;

struct FoundFile {
    const char* name;
    std::function<void(const Character&)> is_right{};  ///< check for a file that is read
    const char* refused = nullptr;                     ///< words of the message for a file that is refused
};

/// Within 0.1 mm on a figure of 1.8 m.
void expect_near(const glm::dvec3& position, const glm::dvec3& right, double height = 1.8) {
    EXPECT_LT(glm::distance(position, right), 1e-4 * height / 1.8 + 5e-5)
        << position.x << ' ' << position.y << ' ' << position.z;
}

std::size_t keys_of(const Character& character) {
    std::size_t most = 0;
    for (const humanoid::Channel& channel : character.clips.at(0).channels)
        most = std::max({most, channel.translation.times.size(), channel.rotation.times.size()});
    return most;
}

/// Expects three frames, as declared, and a note on the spelling after the guesses.
void expect_three_frames_and_a_note(const Character& character) {
    EXPECT_EQ(keys_of(character), 3u);
    EXPECT_EQ(character.sentences().size(), 2u) << test_posed::lines(character.sentences());
}

auto noted(std::size_t nodes, const char* words) {
    return [nodes, words](const Character& character) {
        EXPECT_EQ(character.skeleton.size(), nodes);
        if (*words == '\0')
            EXPECT_EQ(character.notes, std::vector<std::string>());
        else
            EXPECT_TRUE(test::says(test_posed::lines(character.notes), words));
    };
}

/// Expects that the bones are matched, and these to nodes of those names.
auto usable(std::map<humanoid::Bone, std::string> names) {
    return [names = std::move(names)](const Character& character) {
        const humanoid::BoneMap map = bone_map(character);
        EXPECT_TRUE(map.is_usable());
        for (const auto& [bone, name] : names) {
            ASSERT_GE(map[bone].node, 0) << name;
            EXPECT_EQ(character.skeleton[static_cast<std::size_t>(map[bone].node)].name, name);
        }
    };
}

const std::vector<FoundFile>& found_files() {
    static const std::vector<FoundFile> files{
        {"fbx_mesh_only.fbx", {}, "no skeleton"},
        {"fbx_inherit_scale_human.fbx",
         [](const Character& character) {
             expect_near(at(character, "Character1_LeftUpLeg", -1), {0.0891, 0.9373, 0.0});
             EXPECT_NEAR(at(character, "Character1_LeftFoot", -1).y, 0.0815, 1.5e-4);
             EXPECT_TRUE(bone_map(character).is_usable());
         }},
        {"fbx_inherit_scale_small.fbx",
         [](const Character& character) {
             EXPECT_NEAR(glm::distance(at(character, "joint4", -1), at(character, "joint1", -1)), 0.16, 1e-4);
         }},
        {"fbx_cubic_keys.fbx",
         [](const Character& character) {
             const glm::dvec3 tip = at(character, "joint6", 0, 0.3);
             EXPECT_LT(glm::distance(tip, {0.137, 0.150, -0.109}), 1e-3)
                 << tip.x << ' ' << tip.y << ' ' << tip.z;
         }},
        {"fbx_stepped_keys.fbx",
         [](const Character& character) {
             for (const humanoid::Channel& channel : character.clips.at(0).channels)
                 EXPECT_TRUE(channel.rotation.times.size() < 2 ||
                             channel.rotation.interpolation == humanoid::Interpolation::Step);
         }},
        {"fbx_motionbuilder_jog.fbx",
         [](const Character& character) {
             const humanoid::Clip& clip = character.clips.at(0);
             EXPECT_EQ(humanoid::frame_rate(clip), 30.0);
             const humanoid::LintReport report = lint(character.skeleton, bone_map(character), clip);
             EXPECT_TRUE(report.findings.empty()) << report.findings.at(0).text;
         }},
        {"fbx_limit_only.fbx",
         [](const Character& character) {
             expect_near(at(character, "ankle", -1), {0.0, 0.0302, -0.1710});
             EXPECT_TRUE(character.notes.empty());
         }},
        {"fbx_auto_tangent_ends.fbx",
         [](const Character& character) {
             const double bent = glm::radians(16.406);  // the knee at 0.125 s
             EXPECT_LT(glm::distance(at(character, "ankle", 0, 0.125) - at(character, "knee", 0, 0.125),
                                     0.5 * glm::dvec3(0.0, -std::cos(bent), -std::sin(bent))),
                       1e-4);
         }},
        {"fbx_key_next_line.fbx",
         [](const Character& character) {
             expect_near(at(character, "C", 0, 0.5), {0.0, 1.7071, 0.7071});
         }},
        {"fbx_with_sound.fbx",
         [](const Character& character) {
             EXPECT_TRUE(test::says(test_posed::lines(character.notes), "unknown kind left out Z"));
         }},
        {"bvh_root_offset.bvh",
         [](const Character& character) {
             EXPECT_EQ(character.scale, 0.01);
             EXPECT_NEAR(at(character, "Hips", 0).y, 0.9195, 1e-4);
             EXPECT_NEAR(at(character, "LeftToe", 0).y, -0.0003, 1e-4);
             EXPECT_EQ(character.space.positions, RootPositions::Replace);
             EXPECT_TRUE(bone_map(character).is_usable());
         }},
        {"bvh_rounded_frame_time.bvh",
         [](const Character& character) {
             EXPECT_EQ(keys_of(character), 3u);
             const test::TempFolder folder;
             const humanoid::Clip& clip = character.clips.at(0);
             EXPECT_EQ(export_clip({character, {}, clip, clip, 30.0}, folder / "out.bvh").frames, 3u);
         }},
        {"bvh_extra_frame.bvh", expect_three_frames_and_a_note},
        {"bvh_space_colon.bvh", expect_three_frames_and_a_note},
        {"bvh_nospace_frames.bvh", expect_three_frames_and_a_note},
        {"bvh_nospace_time.bvh", expect_three_frames_and_a_note},
        {"bvh_ctrlz.bvh", expect_three_frames_and_a_note},
        {"bvh_nul.bvh", expect_three_frames_and_a_note},
        {"bvh_comma.bvh", {}, "line 23 decimal point"},
        {"bvh_nan.bvh", {}, "line 25 nan"},
        {"bvh_nine.bvh", {}, "line 9 channels 9"},
        {"bvh_time0.bvh", {}, "line 23 frame time"},
        {"bvh_utf16.bvh", {}, "line 1 UTF-16"},
        {"bvh_z_up.bvh",
         [](const Character& character) {
             EXPECT_EQ(character.space.up, UpAxis::Z);
             EXPECT_TRUE(test::says(character.guesses.up, "Z"));
             EXPECT_TRUE(bone_map(character).is_usable());
             Character lying = character;
             read_as(lying, lying.scale, {.up = UpAxis::Y, .positions = lying.space.positions});
             EXPECT_TRUE(lying.guesses.up.empty());
         }},
        {"bvh_walk_folded.bvh", usable({})},
        {"bvh_walk_folded_yaw.bvh", usable({})},
        {"bvh_walk_60hz_300.bvh", [](const Character& character) { EXPECT_EQ(keys_of(character), 300u); }},
        {"bvh_walk_30hz_61.bvh", [](const Character& character) { EXPECT_EQ(keys_of(character), 61u); }},
        {"bvh_acclaim_names.bvh",
         usable({{humanoid::Bone::LeftLowerArm, "lradius"}, {humanoid::Bone::RightLowerArm, "rradius"}})},
        {"bvh_left_right_differ.bvh",
         usable({{humanoid::Bone::LeftUpperArm, "LUArm"}, {humanoid::Bone::RightUpperArm, "RUArm"}})},
        {"gltf_animation_pointer.gltf",
         [](const Character& character) {
             EXPECT_NEAR(character.clips.at(0).duration, 0.2, 1e-6);
             EXPECT_TRUE(character.notes.empty());
             expect_near(at(character, "j2", 0, 0.2), {-std::sqrt(0.75), 1.5, 0.0});
         }},
        {"glb_empty_bin.vrm", noted(54, "")},
        {"glb_draco.vrm", noted(19, "KHR_draco_mesh_compression left out")},
        {"glb_meshopt.glb", {}, "EXT_meshopt_compression"},
        {"glb_no_skin.glb", noted(54, "")},
        {"gltf_neg_times.gltf", noted(4, "1 before 0 s")},
        {"gltf_dup_times.gltf", noted(4, "1 same time")},
        {"gltf_zero_quat.gltf", noted(4, "1 rotation length 0")},
        {"gltf_zero_rest.gltf", noted(4, "scale of 0 j2")},
        {"gltf_singular_matrix.gltf", noted(5, "scale of 0 flat")},
        {"gltf_missing_picture.gltf", noted(6, "Gray skin.png missing")},
        {"gltf_ktx.gltf", noted(6, "Gray skin.ktx2 KTX2")},
        {"glb_texture_transform.glb",
         [](const Character& character) {
             noted(42, "")(character);
             for (const glm::vec2& uv : character.skin.mesh->uvs) EXPECT_LT(std::max(uv.x, uv.y), 2.0f);
         }},
        {"hostile/oob8.gltf", {}, "accessors[20].byteOffset"},
        {"hostile/x1.gltf", {}, "accessors[20].count"},
        {"hostile/leak.gltf", {}, "buffers[1].uri no/such/file outside"}};
    return files;
}

TEST(FoundFiles, EachIsReadCorrectlyOrRefusedHelpfully) {
    const fs::path folder = test::found_path("");
    if (!fs::is_directory(folder)) GTEST_SKIP() << folder << " is not there";
    for (const FoundFile& each : found_files()) {
        SCOPED_TRACE(each.name);
        if (each.refused) {
            EXPECT_TRUE(
                test::says(test::message_of([&] { read_character(folder / each.name); }), each.refused));
            continue;
        }
        Character character;
        ASSERT_NO_THROW(character = read_character(folder / each.name));
        each.is_right(character);
        for (const humanoid::Clip& clip : character.clips) EXPECT_TRUE(check(clip, character.skeleton));
    }
}

TEST(FoundFiles, EveryFileOfTheFolderHasARow) {
    const fs::path folder = test::found_path("");
    if (!fs::is_directory(folder)) GTEST_SKIP() << folder << " is not there";
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (!ends_as_character(entry.path())) continue;
        const std::string name = fs::relative(entry.path(), folder).generic_string();
        EXPECT_TRUE(std::ranges::any_of(found_files(), [&](const FoundFile& each) {
            return each.name == name;
        })) << name;
    }
}

}  // namespace
}  // namespace tendril::app
