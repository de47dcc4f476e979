// The built-in figure's body: its surface at rest, its bending, and its export and import.
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <numeric>
#include <string>

#include "app/io/character/export.hpp"
#include "app/io/character/figure_body.hpp"
#include "app/io/character/read.hpp"
#include "app/io/character/stick_figure.hpp"
#include "app/io/character/twist_spread.hpp"
#include "tests/app/io/posed.hpp"
#include "tests/app/support/temp_folder.hpp"

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

}  // namespace
}  // namespace tendril::app
