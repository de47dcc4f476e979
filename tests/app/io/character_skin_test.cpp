// Skins: vertices bound to nodes, the strongest weights, morphs and their clips, colours; and refusals.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "app/io/character/character.hpp"
#include "app/io/character/gltf.hpp"
#include "tests/app/io/gltf_text.hpp"
#include "tests/app/io/posed.hpp"
#include "tests/app/support/temp_folder.hpp"
#include "tests/labels.hpp"
#include "tests/places.hpp"

namespace tendril::app {
namespace {

/// A triangle at x = 1, skinned to nodes 0 and 1, the second 1 m above the first; with a morph that lifts it
/// by 1 m, animated from 0 to 1 in a second.
struct OwnGltf {
    std::string primitive = R"("POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2)";
    std::vector<unsigned short> indices{0, 1, 2};
    std::vector<unsigned char> joints{0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0};
    std::vector<float> weights{0.25f, 0.75f, 0, 0, 1, 0, 0, 0, 0, 3, 0, 0},
        positions{1, 0, 0, 1, 1, 0, 1, 0, 1};
    std::string node = R"("mesh":0,"skin":0)";
    std::string more{}, after_primitive{};

    Character read() const {
        test_gltf::GltfText file;
        file.vectors(positions);
        file.add("VEC4", 4, joints);
        file.quaternions(weights);
        file.add("SCALAR", 1, indices);
        file.add<float>("MAT4", 16, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0,  0, 1,  //
                                     1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1});
        const std::string morph = file.vectors({0, 1, 0, 0, 1, 0, 0, 1, 0}), times = file.scalars({0, 1}),
                          amounts = file.scalars({0, 1});
        file.members =
            R"("skins":[{"joints":[0,1],"inverseBindMatrices":4}],)"
            R"("materials":[{"pbrMetallicRoughness":{"baseColorFactor":[1,0,0,1]}}],)"
            R"("meshes":[{"weights":[0.5],"primitives":[{"indices":3,"material":0,"attributes":{)" +
            primitive + R"(},"targets":[{"POSITION":)" + morph + "}]" + after_primitive +
            R"(}]}],"animations":[{"name":"up","samplers":[{"input":)" + times + R"(,"output":)" + amounts +
            R"(}],"channels":[{"sampler":0,"target":{"node":2,"path":"weights"}}]}],)"
            R"("nodes":[{"children":[1]},{"translation":[0,1,0]},{)" +
            node + "}]" + more;
        return parse_gltf(file.gltf(), "own.gltf", {});
    }
};

glm::vec3 corner(const Character& character, const std::vector<rig::Transform>& pose, std::size_t i) {
    return skinned(
        {character.skin.mesh, skin_matrices(character.skin, test_posed::placed_as(character.skeleton, pose))},
        i);
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
        EXPECT_TRUE(test::has(said, words));
        EXPECT_TRUE(said.starts_with("own.gltf")) << said;
    };
    says([](OwnGltf& own) { own.indices[2] = 3; }, "meshes[0].primitives[0].indices");
    says([](OwnGltf& own) { own.joints[1] = 9; }, "no joint 9");
    says([](OwnGltf& own) { own.positions[4] = NAN; }, "vertex 1");
    says([](OwnGltf& own) { own.primitive = R"("POSITION":0,"JOINTS_0":1)"; }, "without WEIGHTS");
    says([](OwnGltf& own) { own.primitive = R"("POSITION":99)"; }, "POSITION: there is no 99");
    says([](OwnGltf& own) { own.primitive = R"("POSITION":0,"NORMAL":6)"; }, "NORMAL");
    says([](OwnGltf& own) { own.node = R"("mesh":7,"skin":0)"; }, "nodes[2]: there is no mesh 7");
    says([](OwnGltf& own) { own.node = R"("mesh":0,"skin":4)"; }, "no skin 4");
    says([](OwnGltf& own) { own.node = R"("mesh":0,"children":[3]},{"children":[2])"; },
         "nodes[2] is below itself");
}

LABEL(slow, "CharacterSkin.ThirdPartySkinsStayAroundTheirBones");
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
        const auto placements = test_posed::placed(character, -1);
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
