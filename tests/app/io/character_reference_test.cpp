// Joint positions of characters, at rest and in clips, compared with independent readers of the formats: the
// Python scripts in reference/.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <glm/gtc/quaternion.hpp>
#include <random>
#include <tendril/humanoid/clip.hpp>

#include "app/document/json_complete.hpp"
#include "app/io/character/read.hpp"
#include "tests/app/support/temp_folder.hpp"
#include "tests/places.hpp"

namespace tendril::app {
namespace {

namespace fs = std::filesystem;

const fs::path scripts = tendril::test::source_path("tests/app/io/reference");

std::string quoted(const fs::path& path) {
    return '\'' + path.string() + '\'';
}
int python(const std::string& script, const std::string& arguments) {
    return std::system(("python3 -B " + quoted(scripts / script) + ' ' + arguments).c_str());
}

bool has_python() {
    return std::system("python3 -c '' > /dev/null 2>&1") == 0;
}

/// Random sample times, or key times if the other reader does not interpolate.
std::vector<double> times_in(const humanoid::Clip& clip, bool at_keys, std::mt19937& random) {
    std::vector<double> times;
    if (!at_keys) {
        std::uniform_real_distribution<double> any(-0.1, clip.duration + 0.1);
        for (int i = 0; i < 6; ++i) times.push_back(any(random));
        return times;
    }
    for (const humanoid::Channel& channel : clip.channels)
        for (const auto* keys : {&channel.translation.times, &channel.rotation.times})
            times.insert(times.end(), keys->begin(), keys->end());
    std::shuffle(times.begin(), times.end(), random);
    if (times.size() > 8) times.resize(8);
    return times;
}

void add_pose(const Character& character, const Json& clip, double time, Json& poses) {
    std::vector<rig::Transform> pose = rest_pose(character.skeleton);
    if (!clip.is_null())
        sample(character.clips[clip.get<std::size_t>()], character.skeleton, std::max(time, 0.0), pose);
    std::vector<humanoid::Placement> placements(pose.size());
    place(character.skeleton, pose, placements);
    Json at = Json::array();
    for (const humanoid::Placement& each : placements)
        at.push_back({each.position.x, each.position.y, each.position.z});
    poses.push_back({{"clip", clip}, {"time", std::max(time, 0.0)}, {"at", at}});
    if (!character.skin.mesh) return;
    const SkinDraw draw{character.skin.mesh, skin_matrices(character.skin, placements)};
    Json corners = Json::array();
    const std::size_t count = draw.mesh->positions.size();
    for (std::size_t i = 0; i < count; i += count / 50 + 1) {
        const glm::vec3 corner = skinned(draw, i);
        corners.push_back({i, {corner.x, corner.y, corner.z}});
    }
    poses.back()["corners"] = corners;
}

/// Whether the rest pose is the zero pose, neither rotated nor taken from the motion.
bool rests_as_in_file(const Character& character) {
    return std::ranges::none_of(
        character.notes, [](const std::string& each) { return each.find("rest pose is") != each.npos; });
}

/// The rows of the rotation that puts the file upright.
Json upright(const Character& character) {
    const glm::dmat3 axes = glm::mat3_cast(turn_of(character.space.up));
    Json rows = Json::array();
    for (int i = 0; i < 3; ++i) rows.push_back({axes[0][i], axes[1][i], axes[2][i]});
    return rows;
}

fs::path dump(const fs::path& file, const test::TempFolder& folder) {
    const Character character = read_character(file);
    std::mt19937 random(7);
    Json names = Json::array(), clips = Json::array(), poses = Json::array();
    for (const humanoid::Node& node : character.skeleton.nodes()) names.push_back(node.name);
    if (rests_as_in_file(character)) add_pose(character, nullptr, 0.0, poses);
    const bool at_keys = file.extension() == ".bvh";
    for (std::size_t i = 0; i < character.clips.size(); ++i) {
        clips.push_back(character.clips[i].name);
        for (const double time : times_in(character.clips[i], at_keys, random))
            add_pose(character, i, time, poses);
    }
    const fs::path to = folder / (file.filename().string() + ".json");
    std::ofstream(to) << Json{{"file", file.string()},
                              {"scale", character.scale},
                              {"upright", upright(character)},
                              {"adds", character.space.positions == RootPositions::Add},
                              {"names", names},
                              {"clips", clips},
                              {"poses", poses}};
    return to;
}

/// Checks every character file in a folder; none may be off by more than the tolerance, in metres. The script
/// knows only linear FBX curves.
void check_all(const fs::path& of, double tolerance, bool with_fbx) {
    const test::TempFolder folder;
    std::string dumps;
    int count = 0;
    for (const auto& entry : fs::directory_iterator(of)) {
        if (!ends_as_character(entry.path())) continue;
        if (!with_fbx && entry.path().extension() == ".fbx") continue;
        SCOPED_TRACE(entry.path().string());
        ASSERT_NO_THROW(dumps += ' ' + quoted(dump(entry.path(), folder)));
        ++count;
    }
    EXPECT_GE(count, 10);
    EXPECT_EQ(python("check.py", std::to_string(tolerance) + dumps), 0)
        << "see the lines that begin with FAR";
}

TEST(CharacterReference, JointsOfRandomFilesAreWhereAnotherReaderPutsThem) {
    if (!has_python()) GTEST_SKIP() << "python3 is not there";
    for (const int seed : {1, 2, 3}) {
        const test::TempFolder folder;
        ASSERT_EQ(python("make.py", quoted(folder.path()) + ' ' + std::to_string(seed)), 0);
        check_all(folder.path(), 1e-4, true);
    }
}

TEST(CharacterReference, JointsOfThirdPartyFilesAreWithin2Mm) {
    if (!fs::is_directory(tendril::test::characters_folder()))
        GTEST_SKIP() << tendril::test::characters_folder() << " is not there";
    if (!has_python()) GTEST_SKIP() << "python3 is not there";
    check_all(tendril::test::characters_folder(), 0.002, false);
}

}  // namespace
}  // namespace tendril::app
