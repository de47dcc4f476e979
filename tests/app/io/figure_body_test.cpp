// The built-in figure's body: its surface at rest, its bending, and its export and import.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <numeric>
#include <random>
#include <string>

#include "app/io/character/character.hpp"
#include "app/io/character/export.hpp"
#include "app/io/character/skin.hpp"
#include "app/io/character/stick_figure.hpp"
#include "tests/app/io/posed.hpp"
#include "tests/app/support/temp_folder.hpp"
#include "tests/core/humanoid_figure.hpp"
#include "tests/places.hpp"

namespace tendril::app {
namespace {

using humanoid::Placement;

class FigureBodyTest : public ::testing::Test {
  protected:
    const Character figure_ = stick_figure();
    const SkinnedMesh& mesh() const { return *figure_.skin.mesh; }

    /// The vertices with some nodes rotated about a world axis, degrees.
    struct Turned {
        const char* node;
        glm::dvec3 about;
        double degrees;
    };
    static std::vector<glm::dvec3> posed(const Character& figure, const std::vector<Turned>& turns) {
        std::vector<rig::Transform> pose = rest_pose(figure.skeleton);
        for (const Turned& each : turns)
            pose[*figure.skeleton.find(each.node)].rotation =
                glm::angleAxis(glm::radians(each.degrees), each.about);
        const std::vector<Placement> at = test_posed::placed_as(figure.skeleton, pose);
        const TwistSpread spread(figure.skin, figure.skeleton, bone_map(figure));
        const SkinDraw draw{.mesh = figure.skin.mesh,
                            .matrices = spread.matrices(figure.skin, at),
                            .weights = spread.weights()};
        std::vector<glm::dvec3> points;
        for (std::size_t i = 0; i < figure.skin.mesh->positions.size(); ++i)
            points.emplace_back(skinned(draw, i));
        return points;
    }
    double volume(const std::vector<glm::dvec3>& at) const {
        double sum = 0.0;
        for (std::size_t i = 0; i < mesh().indices.size(); i += 3)
            sum += glm::dot(at[mesh().indices[i]],
                            glm::cross(at[mesh().indices[i + 1]], at[mesh().indices[i + 2]])) /
                   6.0;
        return sum;
    }
    /// The number of triangles whose normal is opposite to their vertices' normals at rest.
    std::size_t inverted(const std::vector<glm::dvec3>& at) const {
        std::size_t count = 0;
        for (std::size_t i = 0; i < mesh().indices.size(); i += 3) {
            const auto [a, b, c] =
                std::tuple(mesh().indices[i], mesh().indices[i + 1], mesh().indices[i + 2]);
            const glm::dvec3 face = glm::cross(at[b] - at[a], at[c] - at[a]);
            const glm::dvec3 normal(mesh().normals[a] + mesh().normals[b] + mesh().normals[c]);
            count += glm::dot(face, normal) <= 0.0 ? 1u : 0u;
        }
        return count;
    }
};

TEST_F(FigureBodyTest, IsAClosedSurfaceOfAFewThousandVertices) {
    ASSERT_TRUE(figure_.skin.mesh);
    EXPECT_GT(mesh().positions.size(), 3000u);
    EXPECT_LT(mesh().positions.size(), 9000u);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (std::size_t i = 0; i < mesh().indices.size(); ++i)
        ++edges[{mesh().indices[i], mesh().indices[i % 3 == 2 ? i - 2 : i + 1]}];
    for (const auto& [edge, times] : edges) {
        EXPECT_EQ(times, 1) << "at " << mesh().positions[edge.first].x << " "
                            << mesh().positions[edge.first].y << " " << mesh().positions[edge.first].z;
        EXPECT_EQ(edges.count({edge.second, edge.first}), 1u) << "a hole beside " << edge.first;
    }
    std::vector<glm::dvec3> bound(mesh().positions.begin(), mesh().positions.end());
    EXPECT_EQ(inverted(bound), 0u);
    double smallest = 1.0;
    for (std::size_t i = 0; i < mesh().indices.size(); i += 3)
        smallest = std::min(smallest,
                            glm::length(glm::cross(bound[mesh().indices[i + 1]] - bound[mesh().indices[i]],
                                                   bound[mesh().indices[i + 2]] - bound[mesh().indices[i]])));
    EXPECT_GT(smallest, 1e-7) << "no triangle is degenerate";
}

TEST_F(FigureBodyTest, StandsOnTheGroundAtItsHeight) {
    const auto at = posed(figure_, {});
    double low = 1.0, high = 0.0;
    std::size_t on_ground = 0;
    for (const glm::dvec3& each : at) {
        low = std::min(low, each.y), high = std::max(high, each.y);
        on_ground += each.y < 0.003 ? 1u : 0u;
    }
    EXPECT_NEAR(low, 0.0, 0.004);
    EXPECT_NEAR(high, 1.8, 0.015);
    EXPECT_GT(on_ground, 60u) << "flat soles";
    EXPECT_NEAR(volume(at), 0.067, 0.02) << "cubic metres, of an adult";
}

TEST_F(FigureBodyTest, FollowsNearbyBones) {
    const std::vector<Placement> rest = test_posed::placed(figure_, -1);
    const auto at = posed(figure_, {});
    for (std::size_t i = 0; i < at.size(); ++i) {
        const JointWeights& by = mesh().weights[i];
        EXPECT_NEAR(std::accumulate(by.weights.begin(), by.weights.end(), 0.0f), 1.0f, 1e-5f);
        for (std::size_t k = 0; k < 4; ++k) {
            if (by.weights[k] < 0.02f) continue;
            const std::size_t node = figure_.skin.joints[by.joints[k]].node;
            double away = glm::distance(at[i], rest[node].position);
            for (const std::int32_t child : figure_.skeleton.children(node)) {
                const glm::dvec3 from = rest[node].position,
                                 way = rest[static_cast<std::size_t>(child)].position - from;
                const double u = std::clamp(glm::dot(at[i] - from, way) / glm::dot(way, way), 0.0, 1.0);
                away = std::min(away, glm::distance(at[i], from + u * way));
            }
            EXPECT_LT(away, 0.24) << figure_.skeleton[node].name << " " << by.weights[k] << " at " << at[i].x
                                  << " " << at[i].y << " " << at[i].z;
        }
    }
}

TEST_F(FigureBodyTest, KeepsItsVolumeWhenItBends) {
    const double rest = volume(posed(figure_, {}));
    const glm::dvec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
    const std::vector<std::pair<const char*, std::vector<Turned>>> bends{
        {"elbows", {{"LeftLowerArm", y, -90}, {"RightLowerArm", y, 90}}},
        {"knees", {{"LeftLowerLeg", x, 90}, {"RightLowerLeg", x, 90}}},
        {"hips", {{"LeftUpperLeg", x, -90}, {"RightUpperLeg", x, -90}}},
        {"arms beside the body", {{"LeftUpperArm", z, -80}, {"RightUpperArm", z, 80}}},
        {"arms forward", {{"LeftUpperArm", y, -80}, {"RightUpperArm", y, 80}}}};
    for (const auto& [what, turns] : bends)
        EXPECT_NEAR(volume(posed(figure_, turns)), rest, 0.03 * rest) << what;
}

TEST_F(FigureBodyTest, SuitsOtherProportionsAndNeedsEveryBone) {
    for (const double legs : {0.6, 1.5}) {
        std::vector<humanoid::Node> nodes = figure_.skeleton.nodes();
        for (humanoid::Node& each : nodes) {
            if (each.name.find("LowerLeg") != std::string::npos || each.name.ends_with("Foot"))
                each.rest.translation *= legs;
            if (each.name == "Hips") each.rest.translation.y += 0.85 * (legs - 1.0);
        }
        Character other;
        other.skeleton = skeleton_of(nodes);
        other.skin = figure_body(other.skeleton, bone_map(other));
        ASSERT_TRUE(other.skin.mesh) << legs;
        double high = 0.0, low = 1.0;
        for (const glm::dvec3& each : posed(other, {}))
            high = std::max(high, each.y), low = std::min(low, each.y);
        EXPECT_NEAR(high, 1.8 + 0.85 * (legs - 1.0), 0.08);
        EXPECT_NEAR(low, 0.0, 0.03);
    }
    humanoid::BoneMap map = bone_map(figure_);
    map.bones[static_cast<std::size_t>(humanoid::Bone::LeftToes)].node = -1;
    EXPECT_FALSE(figure_body(figure_.skeleton, map).mesh);
}

TEST_F(FigureBodyTest, IsExportedAndReadBack) {
    const tendril::test::TempFolder folder;
    for (const char* name : {"figure.glb", "figure.gltf"}) {
        export_clip({figure_, {}, figure_.clips[0], figure_.clips[0], 30.0}, folder / name);
        const Character read = read_character(folder / name);
        ASSERT_TRUE(read.skin.mesh) << name;
        EXPECT_EQ(read.skin.mesh->indices, mesh().indices);
        const auto before = posed(figure_, {{"LeftLowerArm", {0, 1, 0}, -90}}),
                   after = posed(read, {{"LeftLowerArm", {0, 1, 0}, -90}});
        ASSERT_EQ(before.size(), after.size());
        double off = 0.0;
        for (std::size_t i = 0; i < before.size(); ++i)
            off = std::max(off, glm::distance(before[i], after[i]));
        EXPECT_LT(off, 1e-4);
        for (int i = 0; i < 3; ++i)
            EXPECT_NEAR(read.skin.mesh->parts[0].colour[i], mesh().parts[0].colour[i], 1e-3f);
    }
}

// Skins of twisted arms, linearly blended and with the twist spread: thinness and motion.

using humanoid::Bone;
constexpr double degree = 3.14159265358979323846 / 180.0;
constexpr float radius = 0.04f;
const glm::dvec3 along{1.0, 0.0, 0.0};

/// A tube along the figure's left arm, from chest to fingers, with a ring every 5 mm. Bones share the rings
/// within 3 cm of their joints.
class TwistedTube : public testing::Test {
  protected:
    static constexpr int sides = 16;

    TwistedTube() {
        SkinBuilder builder;
        const auto rest = test_posed::placed_as(skeleton, pose);
        constexpr Bone bones[]{Bone::LeftShoulder, Bone::LeftUpperArm, Bone::LeftLowerArm, Bone::LeftHand};
        for (const Bone bone : bones)
            builder.add_joint(node(bone), {glm::dmat3(1.0), -rest[node(bone)].position});
        SkinBuilder::Corners corners;
        std::vector<std::uint32_t> indices;
        for (double x = 0.08; x < 0.881; x += 0.005) {
            std::vector<std::pair<std::size_t, double>> by{{0, 1.0}};
            for (std::size_t i = 1; i < 4; ++i) {
                const double over = (x - rest[node(bones[i])].position.x) / 0.06 + 0.5;
                if (over > 0.0) by = {{i - 1, 1.0 - std::min(over, 1.0)}, {i, std::min(over, 1.0)}};
            }
            for (int side = 0; side < sides; ++side) {
                const float angle = 6.2831853f * static_cast<float>(side) / sides;
                corners.positions.emplace_back(static_cast<float>(x), 1.45f + radius * std::cos(angle),
                                               radius * std::sin(angle));
                corners.influences.push_back(by);
            }
        }
        for (std::uint32_t i = 0; i + sides + 1 < corners.positions.size(); ++i)
            indices.insert(indices.end(), {i, i + 1, i + sides});
        builder.add_part("tube", std::move(corners), std::move(indices), {});
        skin = builder.finish();
        spread = TwistSpread(skin, skeleton, map);
    }

    std::size_t node(Bone bone) const { return static_cast<std::size_t>(map[bone].node); }
    glm::dquat& turn(Bone bone) { return pose[node(bone)].rotation; }
    std::vector<glm::vec3> corners(bool spreads) const {
        const auto placements = test_posed::placed_as(skeleton, pose);
        SkinDraw draw{skin.mesh, skin_matrices(skin, placements)};
        if (spreads) draw.weights = spread.weights(), draw.matrices = spread.matrices(skin, placements);
        std::vector<glm::vec3> result;
        for (std::size_t i = 0; i < skin.mesh->positions.size(); ++i) result.push_back(skinned(draw, i));
        return result;
    }
    /// For a straight arm: the radius of the thinnest ring relative to the tube's.
    double thinnest(bool spreads) const {
        float least = 1.0f;
        for (const glm::vec3& each : corners(spreads))
            least = std::min(least, std::hypot(each.y - 1.45f, each.z) / radius);
        return static_cast<double>(least);
    }
    static double farthest(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b) {
        float most = 0.0f;
        for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, glm::distance(a[i], b[i]));
        return static_cast<double>(most);
    }

    humanoid::Skeleton skeleton = tendril::test::make_figure({});
    humanoid::BoneMap map = humanoid::match_bones(skeleton);
    std::vector<rig::Transform> pose = humanoid::rest_pose(skeleton);
    Skin skin;
    TwistSpread spread;
};

TEST_F(TwistedTube, KeepsItsGirthAt170DegreesOfWristWhereLinearBlendingCollapses) {
    turn(Bone::LeftHand) = glm::angleAxis(170.0 * degree, along);
    EXPECT_LT(thinnest(false), 0.15);
    EXPECT_GT(thinnest(true), 0.98);
    // Evenly from the elbow to the wrist.
    const std::vector<glm::vec3> now = corners(true);
    for (const double part : {0.25, 0.5, 0.75}) {
        const auto ring = static_cast<std::size_t>(std::lround((0.46 + 0.26 * part - 0.08) / 0.005));
        const glm::vec3 at = now[ring * sides];
        const double where = (static_cast<double>(skin.mesh->positions[ring * sides].x) - 0.46) / 0.26;
        EXPECT_NEAR(static_cast<double>(std::atan2(at.z, at.y - 1.45f)), 170.0 * degree * where, 0.02);
    }
}

TEST_F(TwistedTube, KeepsItsGirthAtTheShoulderAndWithATwistedLowerArm) {
    turn(Bone::LeftUpperArm) = glm::angleAxis(-170.0 * degree, along);
    EXPECT_LT(thinnest(false), 0.15);
    EXPECT_GT(thinnest(true), 0.98);
    turn(Bone::LeftUpperArm) = glm::dquat(1.0, 0.0, 0.0, 0.0);
    turn(Bone::LeftLowerArm) = turn(Bone::LeftHand) = glm::angleAxis(85.0 * degree, along);
    EXPECT_LT(thinnest(false), 0.8);
    EXPECT_GT(thinnest(true), 0.98);
    turn(Bone::LeftUpperArm) = glm::angleAxis(170.0 * degree, along);
    turn(Bone::LeftLowerArm) = glm::angleAxis(-170.0 * degree, along);
    turn(Bone::LeftHand) = glm::angleAxis(-170.0 * degree, along);
    EXPECT_GT(thinnest(true), 0.9);
}

TEST_F(TwistedTube, EqualsLinearBlendingWithoutTwist) {
    EXPECT_EQ(farthest(corners(true), corners(false)), 0.0);
    std::mt19937 engine(7);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    for (int i = 0; i < 300; ++i) {
        for (rig::Transform& each : pose) {
            const double y = any(engine), z = any(engine), angle = any(engine);
            each.rotation = glm::angleAxis(2.5 * angle, glm::normalize(glm::dvec3(0.0, y, z)));
        }
        EXPECT_LT(farthest(corners(true), corners(false)), 1e-6);
    }
}

TEST_F(TwistedTube, MovesAsEvenlyAsTheHandTurnsExceptNearHalfATurn) {
    std::mt19937 engine(8);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    for (int i = 0; i < 3; ++i) {
        const double y = any(engine), z = any(engine), angle = any(engine);
        const glm::dquat swing = glm::angleAxis(1.2 * angle, glm::normalize(glm::dvec3(0.0, y, z)));
        std::vector<glm::vec3> before;
        for (double twist = -179.5; twist < 180.0; twist += 0.5) {
            turn(Bone::LeftHand) = swing * glm::angleAxis(twist * degree, along);
            const std::vector<glm::vec3> now = corners(true);
            if (!before.empty()) {
                // A vertex of the hand is at most 20 cm off its axis, and the arm makes half a turn.
                ASSERT_LT(farthest(before, now), 0.25 * 0.5 * degree) << twist;
            }
            before = now;
            if (std::fmod(twist, 10.0) != 0.0) continue;
            turn(Bone::LeftHand) = -turn(Bone::LeftHand);
            ASSERT_LT(farthest(corners(true), now), 1e-6) << "the same rotation";
        }
    }
}

TEST_F(TwistedTube, TwistsTheSameWayOnAMirroredCharacter) {
    pose[0].scale = {-1.0, 1.0, 1.0};
    turn(Bone::LeftHand) = glm::angleAxis(170.0 * degree, along);
    turn(Bone::LeftUpperArm) = glm::angleAxis(60.0 * degree, along);
    EXPECT_GT(thinnest(true), 0.98);
}

TEST_F(TwistedTube, IsFiniteInAnyPose) {
    std::mt19937 engine(9);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    const glm::dquat down = glm::angleAxis(180.0 * degree, glm::dvec3(0.0, 0.0, 1.0));
    for (int i = 0; i < 1000; ++i) {
        for (rig::Transform& each : pose) {
            const double x = any(engine), y = any(engine), z = any(engine), w = any(engine);
            each.rotation = i % 10 == 0 ? down : glm::normalize(glm::dquat(w, x, y, z));
            if (i % 7 == 0) each.scale = glm::dvec3(w > 0.5 ? 0.0 : x, y, z);
        }
        for (const glm::vec3& each : corners(true))
            ASSERT_TRUE(std::isfinite(each.x) && std::isfinite(each.y) && std::isfinite(each.z));
    }
}

TEST_F(TwistedTube, SkipsBonesWhoseTwistNodesAreUsed) {
    std::vector<humanoid::Node> nodes = skeleton.nodes();
    nodes.push_back({"lowerarm_twist_01_l", map[Bone::LeftLowerArm].node, {}});
    nodes.back().rest.translation = {0.13, 0.0, 0.0};
    skeleton = *humanoid::Skeleton::make(nodes);
    pose = humanoid::rest_pose(skeleton);
    turn(Bone::LeftHand) = glm::angleAxis(170.0 * degree, along);
    spread = TwistSpread(skin, skeleton, map);
    EXPECT_GT(thinnest(true), 0.98) << "no corner hangs on it";
    for (SkinJoint& joint : skin.joints)
        if (joint.node == node(Bone::LeftLowerArm)) joint.node = nodes.size() - 1;
    spread = TwistSpread(skin, skeleton, map);
    EXPECT_EQ(farthest(corners(true), corners(false)), 0.0);
}

TEST(TwistedCharacters, EqualLinearBlendingInTheirBindPose) {
    const std::filesystem::path folder = tendril::test::characters_folder();
    if (!std::filesystem::exists(folder)) GTEST_SKIP();
    int worn = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (!entry.is_regular_file() || entry.path().extension() == ".md") continue;
        const Character character = read_character(entry.path().string());
        const Skin& skin = character.skin;
        if (!skin.mesh) continue;
        const TwistSpread spread(skin, character.skeleton, bone_map(character));
        const auto placements = test_posed::placed(character, -1);
        const SkinDraw linear{skin.mesh, skin_matrices(skin, placements)};
        SkinDraw even{skin.mesh, spread.matrices(skin, placements)};
        even.weights = spread.weights();
        worn += even.weights != nullptr;
        float most = 0.0f;
        for (std::size_t i = 0; i < skin.mesh->positions.size(); ++i)
            most = std::max(most, glm::distance(skinned(linear, i), skinned(even, i)));
        EXPECT_LT(most, 1e-5f) << entry.path();
    }
    EXPECT_GE(worn, 4);
}

}  // namespace
}  // namespace tendril::app
