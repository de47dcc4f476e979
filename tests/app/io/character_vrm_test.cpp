// The bones that a VRM file names are its bone map, whatever its nodes are called and wherever they are; the
// character gets its springs.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <glm/geometric.hpp>

#include "app/io/character/gltf.hpp"
#include "app/io/character/gltf_vrm.hpp"
#include "tests/app/support/temp_folder.hpp"
#include "tests/says.hpp"

namespace tendril::app {
namespace {

using humanoid::Bone;

constexpr const char* needed[]{"hips",          "spine",         "head",          "leftUpperArm",
                               "leftLowerArm",  "leftHand",      "rightUpperArm", "rightLowerArm",
                               "rightHand",     "leftUpperLeg",  "leftLowerLeg",  "leftFoot",
                               "rightUpperLeg", "rightLowerLeg", "rightFoot"};

/// A chain of unnamed nodes that goes up, with this extension and these bones.
Character read(const std::string& extension, const std::string& bones) {
    std::string nodes;
    for (int i = 0; i < 19; ++i)
        nodes += R"({"translation":[0,0.1,0],"children":[)" + std::to_string(i + 1) + "]},";
    return parse_gltf(R"({"asset":{"version":"2.0"},"extensionsUsed":[")" + extension + R"("],"nodes":[)" +
                          nodes + R"({}],"extensions":{")" + extension + R"(":{"humanoid":{"humanBones":)" +
                          bones + "}}}}",
                      "own.vrm", {});
}
std::string version_1(int shift = 0) {
    std::string bones = R"({"leftThumbDistal":{"node":3},"jaw":{"node":99})";
    for (int i = 0; i < 15; ++i)
        bones += std::string(",\"") + needed[i] + R"(":{"node":)" + std::to_string(18 - i + shift) + "}";
    return bones + "}";
}
std::string version_0() {
    std::string bones = R"([{"bone":"leftEye","node":3})";
    for (int i = 0; i < 15; ++i)
        bones += std::string(R"(,{"useDefaultValues":true,"bone":")") + needed[i] + R"(","node":)" +
                 std::to_string(18 - i) + "}";
    return bones + "]";
}

TEST(VrmCharacter, BonesAreTheOnesThatTheFileNames) {
    for (const bool is_new : {true, false}) {
        const Character character = is_new ? read("VRMC_vrm", version_1()) : read("VRM", version_0());
        ASSERT_TRUE(character.bones);
        EXPECT_EQ(character.bones->source, is_new ? "VRMC_vrm" : "VRM");
        const humanoid::BoneMap map = bone_map(character);
        EXPECT_TRUE(map.missing.empty());
        EXPECT_EQ(character.skeleton[static_cast<std::size_t>(map[Bone::Hips].node)].name, "node_18");
        EXPECT_EQ(character.skeleton[static_cast<std::size_t>(map[Bone::RightFoot].node)].name, "node_4");
        EXPECT_EQ(map[Bone::Hips].confidence, 1.0);
        EXPECT_NE(map[Bone::Hips].reasons.find("VRM"), std::string::npos);
        EXPECT_EQ(map[Bone::Neck].node, -1) << "not named, so it has none";
    }
}

TEST(VrmCharacter, InvalidNamesAreRefusedWithAMessage) {
    const auto says = [](const std::string& bones, const std::string& words) {
        const std::string said = test::message_of([&] { read("VRMC_vrm", bones); });
        EXPECT_TRUE(test::has(said, words));
        EXPECT_EQ(said.find("own.vrm"), 0u);
    };
    says(version_1(5), "head: there is no node 21");
    says(R"({"hips":{"node":1},"head":{"node":1}})", "already another bone");
    says(R"({"hips":{"node":"x"}})", "expected a node number");
    says(R"({"hips":7})", "expected a node number");
    says("[7]", "no skeleton");
    says("7", "no skeleton");
}

// --------------------------------------------------------------------------------------------------- springs

/// VRM's own step of one bone's tip, from `angle` beside its rest; returns y / length for some steps.
std::vector<double> vrm_swing(const VrmSpring& spring, double length, double angle, int steps) {
    const glm::dvec2 rest(0.0, -length);
    glm::dvec2 tip = length * glm::dvec2(std::sin(angle), -std::cos(angle)), before = tip;
    std::vector<double> swing;
    for (int i = 0; i < steps; ++i) {
        const glm::dvec2 moved = tip + (tip - before) * (1.0 - spring.drag) +
                                 rest / length * spring.stiffness / 60.0 + glm::dvec2(spring.gravity) / 60.0;
        before = tip;
        tip = glm::normalize(moved) * length;
        swing.push_back(tip.x / length);
    }
    return swing;
}

TEST(VrmCharacter, SpringsSwingAndDecayAsInVrm) {
    for (const double stiffness : {0.2, 1.0, 4.0}) {
        for (const double drag : {0.05, 0.45, 0.8}) {
            for (const double length : {0.05, 0.2}) {
                for (const double gravity : {0.0, 0.5}) {
                    const VrmSpring spring{0, stiffness, drag, {0.0, -gravity, 0.0}};
                    const SpringRate rate = spring_rate(spring, length, {0.0, -1.0, 0.0});
                    const double start = 0.02;
                    const std::vector<double> steps = vrm_swing(spring, length, start, 60);
                    // The closed form of a damped spring through the first two values.
                    const double w = 6.283185307179586 * rate.strength, z = rate.critical_damping;
                    const std::complex<double> root = std::sqrt(std::complex<double>(z * z - 1.0, 0.0));
                    const std::complex<double> a = std::exp(-w * (z - root) / 60.0),
                                               b = std::exp(-w * (z + root) / 60.0);
                    ASSERT_GT(std::abs(a - b), 1e-9);
                    const std::complex<double> u = (steps[1] - b * steps[0]) / (a - b), v = steps[0] - u;
                    for (int i = 0; i < 60; ++i)
                        EXPECT_NEAR((u * std::pow(a, i) + v * std::pow(b, i)).real(),
                                    steps[static_cast<std::size_t>(i)], 0.01 * start)
                            << stiffness << ' ' << drag << ' ' << length << ' ' << gravity << " step " << i;
                }
            }
        }
    }
    // Extreme values are clamped to a spring's ranges.
    for (const VrmSpring& each :
         {VrmSpring{0, 0.0, 0.0, {}}, VrmSpring{0, 1e3, 1.0, {}}, VrmSpring{0, 0.0, 1.0, {0.0, 1e3, 0.0}}}) {
        const SpringRate rate = spring_rate(each, 0.0, {0.0, -1.0, 0.0});
        EXPECT_TRUE(rate.strength >= 0.01 && rate.strength <= 100.0);
        EXPECT_TRUE(rate.critical_damping >= 0.0 && rate.critical_damping <= 10.0);
    }
}

/// A head with two strands of hair below it, and a VRM's springs.
Character with_hair(const std::string& extensions) {
    return parse_gltf(
        R"({"asset":{"version":"2.0"},"nodes":[{"name":"hips","children":[1]},)"
        R"({"name":"head","translation":[0,1,0],"children":[2,4]},)"
        R"({"name":"hair_l","translation":[0.1,0,0],"children":[3]},{"name":"tip_l","translation":[0,-0.2,0]},)"
        R"({"name":"hair_r","translation":[-0.1,0,0],"children":[5]},{"name":"tip_r","translation":[0,-0.2,0]}],)"
        R"("skins":[{"joints":[0,1]}],"extensions":{)" +
            extensions + "}}",
        "hair.vrm", {});
}
const std::string hips_and_head_0 =
    R"("humanoid":{"humanBones":[{"bone":"hips","node":0},{"bone":"head","node":1}]})";

TEST(VrmCharacter, SpringsOfBothVersionsBecomeTheCharacters) {
    const Character old = with_hair(
        R"("VRM":{)" + hips_and_head_0 +
        R"(,"secondaryAnimation":{"boneGroups":[{"stiffiness":2,"dragForce":0.3,"gravityPower":0,"bones":[2,4]},)"
        R"({"bones":[1,3,99,"x"]},{"bones":7},7]}})");
    const Character fresh = with_hair(
        R"("VRMC_springBone":{"springs":[{"joints":[{"node":2,"stiffness":2,"dragForce":0.3},{"node":3}]},)"
        R"({"joints":[{"node":4,"stiffness":2,"dragForce":0.3},{"node":5}]},{"joints":[]},{"joints":[{"node":-4}]}]})");
    for (const Character* each : {&old, &fresh}) {
        ASSERT_EQ(each->springs.size(), 2u);
        EXPECT_EQ(each->skeleton[each->springs[0].node].name, "hair_l");
        EXPECT_EQ(each->skeleton[each->springs[1].node].name, "hair_r");
        EXPECT_TRUE(test::says(each->notes.at(0), "Gravity strength springs"));
        const SpringRate rate = spring_rate({2, 2.0, 0.3, {}}, 0.2, {0.0, -1.0, 0.0});
        EXPECT_NEAR(each->springs[0].critical_damping, rate.critical_damping, 1e-9);
        EXPECT_LT(each->springs[0].strength, rate.strength);
        EXPECT_GT(each->springs[0].strength, 0.2 * rate.strength);
    }
    EXPECT_TRUE(test::says(old.notes.at(1), "2 springs left out body")) << "on the head, and below the first";
    EXPECT_TRUE(with_hair(R"("VRM":{)" + hips_and_head_0 + "}").springs.empty());
}

TEST(VrmCharacter, CollidersOfBothVersionsBecomeTheSprings) {
    // Radius and hit radius; a sphere on the head, for VRM 0.x with Unity's z; and all that may be wrong.
    const Character old = with_hair(
        R"("VRM":{)" + hips_and_head_0 +
        R"(,"secondaryAnimation":{"colliderGroups":[{"node":99,"colliders":[{"radius":1}]},)"
        R"({"node":1,"colliders":[{"offset":{"x":0.1,"y":-0.1,"z":0.2},"radius":0.3},{"radius":-7},7]},{"node":0}],)"
        R"("boneGroups":[{"hitRadius":0.02,"bones":[2],"colliderGroups":[1,0,2,-1,99,"x"]},{"bones":[4]}]}})");
    const Character fresh = with_hair(
        R"("VRMC_springBone":{"colliders":[{"node":1,"shape":{"sphere":{"offset":[0.1,-0.1,-0.2],"radius":0.3}}},)"
        R"({"node":0,"shape":{"capsule":{"offset":[0,0.1,0],"radius":0.2,"tail":[0,0.4,"x"]}}},)"
        R"({"node":99,"shape":{"sphere":{}}},{"node":0},{"node":0,"shape":{"plane":{}}},7],)"
        R"("colliderGroups":[{"colliders":[]},{"colliders":[0,5,2,1,3,4,99]}],"springs":[)"
        R"({"joints":[{"node":2,"hitRadius":0.02},{"node":3}],"colliderGroups":[0,1,7,"x"]},)"
        R"({"joints":[{"node":4},{"node":5}]}]})");
    for (const Character* each : {&old, &fresh}) {
        ASSERT_EQ(each->springs.size(), 2u);
        EXPECT_EQ(each->springs[0].hit_radius, 0.02);
        EXPECT_TRUE(each->springs[1].colliders.empty());
        ASSERT_EQ(each->springs[0].colliders.size(), 2u);
        const SpringCollider sphere = each->springs[0].colliders[0];
        EXPECT_EQ(each->skeleton[sphere.node].name, "head");
        EXPECT_EQ(sphere.from, glm::dvec3(0.1, -0.1, -0.2));
        EXPECT_EQ(sphere.to, sphere.from);
        EXPECT_EQ(sphere.radius, 0.3);
    }
    EXPECT_EQ(old.springs[0].colliders[1].radius, 0.0);
    const SpringCollider capsule = fresh.springs[0].colliders[1];
    EXPECT_EQ(fresh.skeleton[capsule.node].name, "hips");
    EXPECT_EQ(capsule.from, glm::dvec3(0.0, 0.1, 0.0));
    EXPECT_EQ(capsule.to, glm::dvec3(0.0, 0.4, 0.0));
    Character large = fresh;
    read_as(large, 2.0, large.space);
    EXPECT_EQ(large.springs[0].hit_radius, 0.04);
    EXPECT_EQ(large.springs[0].colliders[1].to, glm::dvec3(0.0, 0.8, 0.0));
}

TEST(VrmCharacter, UnsupportedCollidersAndConstraintsAreReported) {
    const auto hair = [](const std::string& extended) {
        return with_hair(
            R"("VRMC_springBone":{"colliders":[{"node":1,"shape":{"sphere":{"radius":0.5}},"extensions":{)"
            R"("VRMC_springBone_extended_collider":{"specVersion":"1.0","shape":{)" +
            extended +
            R"(}}}}],"colliderGroups":[{"colliders":[0]}],"springs":[{"joints":[{"node":2},{"node":3}],)"
            R"("colliderGroups":[0]}]})");
    };
    for (const char* beyond :
         {R"("plane":{"offset":[0,0,0],"normal":[0,1,0]})", R"("sphere":{"radius":2,"inside":true})",
          R"("capsule":{"radius":2,"tail":[0,1,0],"inside":true})"}) {
        const Character character = hair(beyond);
        EXPECT_EQ(character.springs.at(0).colliders.at(0).radius, 0.5) << "the stand-in";
        EXPECT_TRUE(test::says(character.notes.at(1), "1 collider plane inside not followed")) << beyond;
    }
    for (const char* within : {R"("sphere":{"radius":2,"inside":false})", R"("capsule":{"radius":2})"}) {
        const Character character = hair(within);
        EXPECT_EQ(character.springs.at(0).colliders.at(0).radius, 2.0);
        EXPECT_EQ(character.notes.size(), 1u) << within;
    }
    const auto constrained = [](const std::string& first, const std::string& second) {
        const auto node = [](const std::string& constraint) {
            return R"("extensions":{"VRMC_node_constraint":{"specVersion":"1.0","constraint":)" + constraint +
                   "}}";
        };
        return parse_gltf(R"({"asset":{"version":"2.0"},"nodes":[{"children":[1],)" + node(first) + "},{" +
                              node(second) + R"(}],"skins":[{"joints":[0,1]}]})",
                          "own.vrm", {})
            .notes;
    };
    const auto notes =
        constrained(R"({"roll":{"source":1,"rollAxis":"X","weight":1}})", R"({"aim":{"source":0}})");
    ASSERT_EQ(notes.size(), 1u);
    EXPECT_TRUE(test::says(notes[0], "constraints not followed 1 roll, 1 aim"));
    EXPECT_TRUE(
        test::says(constrained(R"({"rotation":{"source":1}})", R"({"rotation":{"source":9},"aim":7})").at(0),
                   "1 aim, 2 rotation"));
    EXPECT_TRUE(constrained("7", R"({"other":{}})").empty());
}

TEST(VrmCharacter, OfEndlesslyRepeatedCollidersTheFirst256AreUsed) {
    const auto times = [](int count, const std::string& each) {
        std::string all = each;
        for (int i = 1; i < count; ++i) all += "," + each;
        return all;
    };
    // 2000 times the same group of 2000 colliders, all invalid except the last, in each of 60 springs: 240
    // million.
    const std::string groups = times(2000, "0"), old_shapes = times(1999, "7") + R"(,{"radius":1})",
                      shapes = times(1999, "7") + ",0";
    const Character old = with_hair(R"("VRM":{)" + hips_and_head_0 +
                                    R"(,"secondaryAnimation":{"colliderGroups":[{"node":0,"colliders":[)" +
                                    old_shapes + R"(]}],"boneGroups":[)" +
                                    times(60, R"({"bones":[2],"colliderGroups":[)" + groups + "]}") + "]}}");
    const Character fresh = with_hair(
        R"("VRMC_springBone":{"colliders":[{"node":0,"shape":{"sphere":{"radius":1}}}],"colliderGroups":[)"
        R"({"colliders":[)" +
        shapes + R"(]}],"springs":[)" +
        times(60, R"({"joints":[{"node":2}],"colliderGroups":[)" + groups + "]}") + "]}");
    for (const Character* each : {&old, &fresh}) {
        ASSERT_EQ(each->springs.size(), 1u);
        EXPECT_TRUE(each->springs[0].colliders.empty());
    }
}

}  // namespace
}  // namespace tendril::app
