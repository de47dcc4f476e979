// The bones that a VRM file names are its bone map, whatever its nodes are called and wherever they are.
#include <gtest/gtest.h>

#include "app/io/character/gltf.hpp"
#include "tests/app/support/temp_folder.hpp"

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

TEST(VrmCharacter, bones_are_those_that_the_file_names) {
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

TEST(VrmCharacter, names_that_lead_nowhere_are_refused_and_said) {
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

}  // namespace
}  // namespace tendril::app
