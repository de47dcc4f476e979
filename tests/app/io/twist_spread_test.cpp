// Skins of twisted arms, linearly blended and with the twist spread: thinness and motion.
#include "app/io/character/twist_spread.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <random>

#include "app/io/character/read.hpp"
#include "tests/app/io/posed.hpp"
#include "tests/core/humanoid_figure.hpp"
#include "tests/places.hpp"

namespace tendril::app {
namespace {

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
