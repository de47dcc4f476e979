// Skins: vertices bound to nodes, the strongest weights, morphs and their clips, colours; and refusals.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "app/io/character/gltf.hpp"
#include "app/io/character/read.hpp"
#include "tests/app/support/temp_folder.hpp"
#include "tests/places.hpp"

namespace tendril::app {
namespace {

template <class T>
std::string raw(std::initializer_list<T> values) {
    std::string bytes;
    for (const T& value : values) bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    return bytes;
}

/// A triangle at x = 1, skinned to nodes 0 and 1, the second 1 m above the first; with a morph that lifts it
/// by 1 m, animated from 0 to 1 in a second. Each list of numbers has a buffer view of its own.
class OwnGltf {
  public:
    std::string primitive = R"("POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2)";
    std::string indices = raw<std::uint16_t>({0, 1, 2, 0});
    std::string joints = raw<std::uint8_t>({0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0});
    std::string weights = raw<float>({0.25f, 0.75f, 0, 0, 1, 0, 0, 0, 0, 3, 0, 0});
    std::string positions = raw<float>({1, 0, 0, 1, 1, 0, 1, 0, 1});
    std::string node = R"("mesh":0,"skin":0)";
    std::string more, after_primitive;

    Character read() const {
        const std::string numbers = positions + joints + weights + indices +
                                    raw<float>({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0,  0, 1,  //
                                                1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1,  //
                                                0, 1, 0, 0, 1, 0, 0, 1, 0,                        // the morph
                                                0, 1,                                             // its times
                                                0, 1});  // and weights
        return parse_gltf(json(), "own.gltf", folder_with(numbers));
    }

  private:
    std::string json() const {
        std::string views,
            text = R"({"asset":{"version":"2.0"},"buffers":[{"uri":"numbers.bin","byteLength":)";
        std::size_t at = 0;
        for (const std::size_t size : {positions.size(), joints.size(), weights.size(), indices.size(),
                                       std::size_t{128}, std::size_t{36}, std::size_t{8}, std::size_t{8}}) {
            views += (views.empty() ? "" : ",") + std::string(R"({"buffer":0,"byteOffset":)") +
                     std::to_string(at) + R"(,"byteLength":)" + std::to_string(size) + "}";
            at += size;
        }
        text += std::to_string(at) + R"(}],"bufferViews":[)" + views +
                R"(],"accessors":[)"
                R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},)"
                R"({"bufferView":1,"componentType":5121,"count":3,"type":"VEC4"},)"
                R"({"bufferView":2,"componentType":5126,"count":3,"type":"VEC4"},)"
                R"({"bufferView":3,"componentType":5123,"count":3,"type":"SCALAR"},)"
                R"({"bufferView":4,"componentType":5126,"count":2,"type":"MAT4"},)"
                R"({"bufferView":5,"componentType":5126,"count":3,"type":"VEC3"},)"
                R"({"bufferView":6,"componentType":5126,"count":2,"type":"SCALAR"},)"
                R"({"bufferView":7,"componentType":5126,"count":2,"type":"SCALAR"}],)"
                R"("skins":[{"joints":[0,1],"inverseBindMatrices":4}],)"
                R"("materials":[{"pbrMetallicRoughness":{"baseColorFactor":[1,0,0,1]}}],)"
                R"("meshes":[{"weights":[0.5],"primitives":[{"indices":3,"material":0,"attributes":{)" +
                primitive + R"(},"targets":[{"POSITION":5}])" + after_primitive +
                R"(}]}],)"
                R"("animations":[{"name":"up","samplers":[{"input":6,"output":7}],)"
                R"("channels":[{"sampler":0,"target":{"node":2,"path":"weights"}}]}],)"
                R"("nodes":[{"children":[1]},{"translation":[0,1,0]},{)" +
                node + "}]" + more + "}";
        return text;
    }
    std::filesystem::path folder_with(const std::string& numbers) const {
        test::write(folder_ / "numbers.bin", numbers);
        return folder_.path();
    }

    test::TempFolder folder_;
};

std::vector<humanoid::Placement> placed(const Character& character, std::vector<rig::Transform> pose) {
    std::vector<humanoid::Placement> placements(pose.size());
    humanoid::place(character.skeleton, pose, placements);
    return placements;
}
glm::vec3 corner(const Character& character, const std::vector<rig::Transform>& pose, std::size_t i) {
    return skinned({character.skin.mesh, skin_matrices(character.skin, placed(character, pose))}, i);
}

TEST(CharacterSkin, VerticesRestInPlaceAndFollowTheirJointsByWeight) {
    const Character character = OwnGltf().read();
    ASSERT_TRUE(character.skin.mesh);
    const SkinnedMesh& mesh = *character.skin.mesh;
    ASSERT_EQ(mesh.positions.size(), 3u);
    EXPECT_EQ(mesh.indices, (std::vector<std::uint32_t>{0, 1, 2}));
    ASSERT_EQ(mesh.parts.size(), 1u);
    EXPECT_LT(glm::distance(mesh.parts[0].colour, glm::vec4(1.0f, 0.0f, 0.0f, 1.0f)), 1e-5f);
    EXPECT_LT(glm::distance(mesh.normals[0], glm::vec3(1.0f, 0.0f, 0.0f)), 1e-6f) << "made from the triangle";
    EXPECT_EQ(mesh.weights[2].weights[0], 1.0f) << "made 1 together";
    std::vector<rig::Transform> pose = rest_pose(character.skeleton);
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_LT(glm::distance(corner(character, pose, i), mesh.positions[i]), 1e-6f);
    pose[1].translation.z += 2.0;
    EXPECT_NEAR(corner(character, pose, 0).z, 1.5f, 1e-6f);
    EXPECT_NEAR(corner(character, pose, 1).z, 0.0f, 1e-6f);
    EXPECT_NEAR(corner(character, pose, 2).z, 3.0f, 1e-6f);
}

TEST(CharacterSkin, AMeshWithoutSkinFollowsItsNodeOrIsOmitted) {
    OwnGltf own;
    own.node = R"("name":"prop","mesh":0)";
    EXPECT_FALSE(own.read().skin.mesh) << "it hangs on no joint";
    own.node = R"("mesh":0},{"translation":[0,0,5],"children":[2])";
    own.more = R"(,"scene":0)";
    EXPECT_FALSE(own.read().skin.mesh);
    own.node = R"("mesh":0},{"translation":[0,0,5],"children":[2,0])";
    const Character character = own.read();
    ASSERT_TRUE(character.skin.mesh) << "its parent holds the joints";
    EXPECT_NEAR(corner(character, rest_pose(character.skeleton), 0).z, 5.0f, 1e-6f);
}

TEST(CharacterSkin, ThePlainCopyOfACompressedMeshIsRead) {
    OwnGltf own;
    own.after_primitive = R"(,"extensions":{"KHR_draco_mesh_compression":{"bufferView":0,"attributes":{}}})";
    const Character character = own.read();
    EXPECT_TRUE(character.skin.mesh);
    EXPECT_TRUE(character.notes.empty());
}

TEST(CharacterSkin, MorphsHaveTheirOwnWeightOrTheClips) {
    const Character character = OwnGltf().read();
    ASSERT_EQ(character.skin.mesh->morphs.size(), 1u);
    ASSERT_EQ(character.clips.size(), 1u);
    EXPECT_EQ(morph_weights(character.skin, 5, 0.0), std::vector<float>{0.5f});
    for (const double time : {0.0, 0.25, 1.0, 3.0})
        EXPECT_NEAR(morph_weights(character.skin, 0, time).at(0), std::min(time, 1.0), 1e-6);
    std::vector<glm::vec3> positions, normals;
    apply_morphs(*character.skin.mesh, morph_weights(character.skin, 0, 0.25), positions, normals);
    EXPECT_NEAR(positions[1].y, 1.25f, 1e-6f);
}

TEST(CharacterSkin, TheFourStrongestInfluencesAreKept) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> any(0.01, 1.0);
    for (int run = 0; run < 200; ++run) {
        SkinBuilder builder;
        for (std::size_t i = 0; i < 9; ++i) builder.add_joint(0, {});
        SkinBuilder::Corners corners;
        corners.positions.assign(3, glm::vec3(0.0f));
        corners.influences.resize(3);
        std::vector<std::pair<double, std::size_t>> sorted;
        for (std::size_t i = 0; i < 9; ++i) {
            const double weight = any(random);
            corners.influences[1].push_back({i, weight});
            sorted.push_back({weight, i});
        }
        builder.add_part("it", std::move(corners), {0, 1, 2}, {});
        const Skin skin = builder.finish();
        const JointWeights& kept = skin.mesh->weights[1];
        std::ranges::sort(sorted, std::greater<>());
        float sum = 0.0f;
        for (std::size_t i = 0; i < 4; ++i) {
            EXPECT_EQ(kept.joints[i], sorted[i].second);
            sum += kept.weights[i];
        }
        EXPECT_NEAR(sum, 1.0f, 1e-6f);
        EXPECT_NEAR(kept.weights[0] / kept.weights[3], sorted[0].first / sorted[3].first, 1e-4);
    }
}

TEST(CharacterSkin, WrongNumbersAreRefusedWithTheirPath) {
    const auto says = [](auto change, const std::string& words) {
        OwnGltf own;
        change(own);
        const std::string said = test::message_of([&] { own.read(); });
        EXPECT_NE(said.find(words), said.npos) << "says \"" << said << "\", expected \"" << words << '"';
        EXPECT_EQ(said.find("own.gltf"), 0u) << said;
    };
    says(
        [](OwnGltf& own) {
            own.indices = raw<std::uint16_t>({0, 1, 3, 0});
        },
        "meshes[0].primitives[0].indices");
    says(
        [](OwnGltf& own) {
            own.joints = raw<std::uint8_t>({0, 9, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0});
        },
        "no joint 9");
    says([](OwnGltf& own) { own.positions = raw<float>({1, 0, 0, 1, NAN, 0, 1, 0, 1}); }, "vertex 1");
    says([](OwnGltf& own) { own.primitive = R"("POSITION":0,"JOINTS_0":1)"; }, "without WEIGHTS");
    says([](OwnGltf& own) { own.primitive = R"("POSITION":99)"; }, "POSITION: there is no 99");
    says([](OwnGltf& own) { own.primitive = R"("POSITION":0,"NORMAL":6)"; }, "NORMAL");
    says([](OwnGltf& own) { own.node = R"("mesh":7,"skin":0)"; }, "nodes[2]: there is no mesh 7");
    says([](OwnGltf& own) { own.node = R"("mesh":0,"skin":4)"; }, "no skin 4");
    says([](OwnGltf& own) { own.node = R"("mesh":0,"children":[3]},{"children":[2])"; },
         "nodes[2] is below itself");
}

TEST(CharacterSkin, ThirdPartySkinsStayAroundTheirBones) {
    namespace fs = std::filesystem;
    if (!fs::is_directory(tendril::test::characters_folder()))
        GTEST_SKIP() << tendril::test::characters_folder() << " is not there";
    int worn = 0;
    for (const auto& entry : fs::directory_iterator(tendril::test::characters_folder())) {
        if (!ends_as_character(entry.path())) continue;
        SCOPED_TRACE(entry.path().filename().string());
        const Character character = read_character(entry.path());
        if (!character.skin.mesh) continue;
        ++worn;
        const auto placements = placed(character, rest_pose(character.skeleton));
        glm::vec3 low(1e9f), high(-1e9f);
        for (const humanoid::Placement& each : placements) {
            low = glm::min(low, glm::vec3(each.position));
            high = glm::max(high, glm::vec3(each.position));
        }
        const glm::vec3 margin(0.5f * glm::distance(low, high));
        const SkinDraw draw{character.skin.mesh, skin_matrices(character.skin, placements)};
        for (std::size_t i = 0; i < draw.mesh->positions.size(); ++i) {
            const glm::vec3 at = skinned(draw, i);
            ASSERT_TRUE(glm::all(glm::greaterThan(at, low - margin)) &&
                        glm::all(glm::lessThan(at, high + margin)))
                << "corner " << i << " at " << at.x << ' ' << at.y << ' ' << at.z;
        }
    }
    EXPECT_GE(worn, 7);
}

}  // namespace
}  // namespace tendril::app
