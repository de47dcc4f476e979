// Matching nodes to bones: by common names, by shape alone, and incomplete where bones are missing.
#include <gtest/gtest.h>

#include <random>

#include "humanoid_figure.hpp"

namespace tendril::test {
namespace {

using Naming = std::map<std::string, std::string>;

/// Node names for both sides and the middle: `pattern` with $ replaced by the word for the side.
Naming naming(const std::string& left, const std::string& right, const Naming& pattern) {
    Naming names;
    for (const auto& [key, value] : pattern) {
        const auto with = [&, text = value](const std::string& side) {
            std::string result = text;
            if (const auto at = result.find('$'); at != result.npos) result.replace(at, 1, side);
            return result;
        };
        if (key.starts_with("Left")) {
            names[key] = with(left);
            names["Right" + key.substr(4)] = with(right);
        } else {
            names[key] = value;
        }
    }
    return names;
}

struct Habit {
    const char* name;
    Naming names;
};
std::vector<Habit> habits() {
    return {{"mixamo", naming("Left", "Right",
                              {{"Hips", "mixamorig:Hips"},
                               {"Spine", "mixamorig:Spine"},
                               {"Chest", "mixamorig:Spine1"},
                               {"UpperChest", "mixamorig:Spine2"},
                               {"Neck", "mixamorig:Neck"},
                               {"Head", "mixamorig:Head"},
                               {"Head end", "mixamorig:HeadTop_End"},
                               {"LeftShoulder", "mixamorig:$Shoulder"},
                               {"LeftUpperArm", "mixamorig:$Arm"},
                               {"LeftLowerArm", "mixamorig:$ForeArm"},
                               {"LeftHand", "mixamorig:$Hand"},
                               {"LeftHand end", "mixamorig:$HandMiddle1"},
                               {"LeftUpperLeg", "mixamorig:$UpLeg"},
                               {"LeftLowerLeg", "mixamorig:$Leg"},
                               {"LeftFoot", "mixamorig:$Foot"},
                               {"LeftToes", "mixamorig:$ToeBase"},
                               {"LeftToes end", "mixamorig:$Toe_End"}})},
            {"unreal", naming("l", "r",
                              {{"Hips", "pelvis"},
                               {"Spine", "spine_01"},
                               {"Chest", "spine_02"},
                               {"UpperChest", "spine_03"},
                               {"Neck", "neck_01"},
                               {"Head", "head"},
                               {"Head end", "head_leaf"},
                               {"LeftShoulder", "clavicle_$"},
                               {"LeftUpperArm", "upperarm_$"},
                               {"LeftLowerArm", "lowerarm_$"},
                               {"LeftHand", "hand_$"},
                               {"LeftHand end", "middle_01_$"},
                               {"LeftUpperLeg", "thigh_$"},
                               {"LeftLowerLeg", "calf_$"},
                               {"LeftFoot", "foot_$"},
                               {"LeftToes", "ball_$"},
                               {"LeftToes end", "ball_leaf_$"}})},
            {"vrm", naming("L", "R",
                           {{"Hips", "J_Bip_C_Hips"},
                            {"Spine", "J_Bip_C_Spine"},
                            {"Chest", "J_Bip_C_Chest"},
                            {"UpperChest", "J_Bip_C_UpperChest"},
                            {"Neck", "J_Bip_C_Neck"},
                            {"Head", "J_Bip_C_Head"},
                            {"Head end", "J_Sec_Hair1"},
                            {"LeftShoulder", "J_Bip_$_Shoulder"},
                            {"LeftUpperArm", "J_Bip_$_UpperArm"},
                            {"LeftLowerArm", "J_Bip_$_LowerArm"},
                            {"LeftHand", "J_Bip_$_Hand"},
                            {"LeftHand end", "J_Bip_$_Middle1"},
                            {"LeftUpperLeg", "J_Bip_$_UpperLeg"},
                            {"LeftLowerLeg", "J_Bip_$_LowerLeg"},
                            {"LeftFoot", "J_Bip_$_Foot"},
                            {"LeftToes", "J_Bip_$_ToeBase"},
                            {"LeftToes end", "J_Bip_$_ToeBase_end"}})},
            {"rigify", naming("L", "R",
                              {{"Hips", "DEF-hips"},
                               {"Spine", "DEF-spine.001"},
                               {"Chest", "DEF-spine.002"},
                               {"UpperChest", "DEF-spine.003"},
                               {"Neck", "DEF-neck"},
                               {"Head", "DEF-head"},
                               {"Head end", "DEF-head.tip"},
                               {"LeftShoulder", "DEF-shoulder.$"},
                               {"LeftUpperArm", "DEF-upper_arm.$"},
                               {"LeftLowerArm", "DEF-forearm.$"},
                               {"LeftHand", "DEF-hand.$"},
                               {"LeftHand end", "DEF-f_middle.01.$"},
                               {"LeftUpperLeg", "DEF-thigh.$"},
                               {"LeftLowerLeg", "DEF-shin.$"},
                               {"LeftFoot", "DEF-foot.$"},
                               {"LeftToes", "DEF-toe.$"},
                               {"LeftToes end", "DEF-toe_tip.$"}})},
            {"biped", naming("L", "R",
                             {{"Hips", "Bip01 Pelvis"},
                              {"Spine", "Bip01 Spine"},
                              {"Chest", "Bip01 Spine1"},
                              {"UpperChest", "Bip01 Spine2"},
                              {"Neck", "Bip01 Neck"},
                              {"Head", "Bip01 Head"},
                              {"Head end", "Bip01 HeadNub"},
                              {"LeftShoulder", "Bip01 $ Clavicle"},
                              {"LeftUpperArm", "Bip01 $ UpperArm"},
                              {"LeftLowerArm", "Bip01 $ Forearm"},
                              {"LeftHand", "Bip01 $ Hand"},
                              {"LeftHand end", "Bip01 $ Finger1"},
                              {"LeftUpperLeg", "Bip01 $ Thigh"},
                              {"LeftLowerLeg", "Bip01 $ Calf"},
                              {"LeftFoot", "Bip01 $ Foot"},
                              {"LeftToes", "Bip01 $ Toe0"},
                              {"LeftToes end", "Bip01 $ Toe0Nub"}})},
            {"biovision", naming("Left", "Right",
                                 {{"Hips", "Hips"},
                                  {"Spine", "Chest"},
                                  {"Chest", "Chest2"},
                                  {"UpperChest", "Chest3"},
                                  {"Neck", "Neck"},
                                  {"Head", "Head"},
                                  {"Head end", "End Site"},
                                  {"LeftShoulder", "$Collar"},
                                  {"LeftUpperArm", "$Shoulder"},
                                  {"LeftLowerArm", "$Elbow"},
                                  {"LeftHand", "$Wrist"},
                                  {"LeftHand end", "$Wrist end"},
                                  {"LeftUpperLeg", "$Hip"},
                                  {"LeftLowerLeg", "$Knee"},
                                  {"LeftFoot", "$Ankle"},
                                  {"LeftToes", "$Toe"},
                                  {"LeftToes end", "$Toe end"}})},
            {"poser", naming("l", "r",
                             {{"Hips", "hip"},
                              {"Spine", "abdomen"},
                              {"Chest", "waist"},
                              {"UpperChest", "chest"},
                              {"Neck", "neck"},
                              {"Head", "head"},
                              {"Head end", "leftEye"},
                              {"LeftShoulder", "$Collar"},
                              {"LeftUpperArm", "$Shldr"},
                              {"LeftLowerArm", "$ForeArm"},
                              {"LeftHand", "$Hand"},
                              {"LeftHand end", "$Mid1"},
                              {"LeftUpperLeg", "$Thigh"},
                              {"LeftLowerLeg", "$Shin"},
                              {"LeftFoot", "$Foot"},
                              {"LeftToes", "$Toe"},
                              {"LeftToes end", "$Toe_end"}})},
            {"small letters", naming("left", "right",
                                     {{"Hips", "hips"},
                                      {"Spine", "spine"},
                                      {"Chest", "chest"},
                                      {"UpperChest", "upperchest"},
                                      {"Neck", "neck"},
                                      {"Head", "head"},
                                      {"Head end", "head_end"},
                                      {"LeftShoulder", "$shoulder"},
                                      {"LeftUpperArm", "$arm"},
                                      {"LeftLowerArm", "$forearm"},
                                      {"LeftHand", "$hand"},
                                      {"LeftHand end", "$fingers"},
                                      {"LeftUpperLeg", "$upleg"},
                                      {"LeftLowerLeg", "$leg"},
                                      {"LeftFoot", "$foot"},
                                      {"LeftToes", "$toes"},
                                      {"LeftToes end", "$toes_end"}})}};
}

/// Checks that every bone's node has the expected name.
void expect_all_right(const Skeleton& skeleton, const BoneMap& map, const Naming& names, double confidence) {
    for (std::size_t i = 0; i < bone_count; ++i) {
        const std::string bone = name(static_cast<Bone>(i));
        const auto wanted = names.find(bone);
        ASSERT_GE(map.bones[i].node, 0) << bone;
        EXPECT_EQ(skeleton[static_cast<std::size_t>(map.bones[i].node)].name,
                  wanted == names.end() ? bone : wanted->second)
            << bone << ": " << map.bones[i].reasons;
        EXPECT_GE(map.bones[i].confidence, confidence) << bone << ": " << map.bones[i].reasons;
        EXPECT_FALSE(map.bones[i].reasons.empty());
    }
    EXPECT_TRUE(map.is_usable());
}

TEST(BoneMap, FindsTheBonesByEveryHabitOfNaming) {
    for (const Habit& habit : habits()) {
        SCOPED_TRACE(habit.name);
        const Skeleton skeleton = make_figure(habit.names);
        const BoneMap map = match_bones(skeleton);
        expect_all_right(skeleton, map, habit.names, 0.9);
        EXPECT_EQ(map.rest, RestPose::T);
    }
}

Naming nameless() {
    Naming names;
    int count = 0;
    for (const FigureNode& node : figure_nodes()) names[node.key] = "node_" + std::to_string(count++);
    return names;
}

TEST(BoneMap, WithoutNamesFindsThemByShapeWhereverTheFigureFaces) {
    for (const double turn : {0.0, 0.7, 1.6, 3.1, -2.2}) {
        SCOPED_TRACE(turn);
        const Skeleton skeleton = make_figure(nameless(), turn);
        const BoneMap map = match_bones(skeleton);
        expect_all_right(skeleton, map, nameless(), 0.5);
        for (const BoneMatch& match : map.bones)
            EXPECT_LT(match.confidence, 0.7) << "nothing but the shape says so";
    }
}

TEST(BoneMap, LessBonesOfTheSpineAreTheFirstOnes) {
    const Skeleton two = make_figure({{"UpperChest", ""}, {"Chest", "Spine1"}});
    EXPECT_EQ(match_bones(two)[Bone::UpperChest].node, -1);
    EXPECT_EQ(two[static_cast<std::size_t>(match_bones(two)[Bone::Chest].node)].name, "Spine1");
    const Skeleton one = make_figure({{"UpperChest", ""}, {"Chest", ""}});
    EXPECT_EQ(match_bones(one)[Bone::Chest].node, -1);
    EXPECT_TRUE(match_bones(one).is_usable()) << "fifteen are enough";
}

TEST(BoneMap, SaysWhatIsMissing) {
    Naming names;
    for (const char* key : {"LeftHand", "LeftHand end", "LeftLowerArm"}) names[key] = "";
    const BoneMap map = match_bones(make_figure(names));
    EXPECT_EQ(map.missing, (std::vector<Bone>{Bone::LeftLowerArm, Bone::LeftHand}));
    EXPECT_FALSE(map.is_usable());
}

/// As in RobotExpressive: Body has a child named Hips, which the spine follows, and the legs beside it.
TEST(BoneMap, HipsBesideTheLegsAreNotTheBodys) {
    const Skeleton figure = make_figure({});
    const BoneMap before = match_bones(figure);
    ASSERT_TRUE(before.is_usable());
    std::vector<Node> nodes = figure.nodes();
    const auto node = [&](Bone bone) -> Node& { return nodes[static_cast<std::size_t>(before[bone].node)]; };
    const auto body = static_cast<std::int32_t>(nodes.size());
    nodes.push_back({"Body", node(Bone::Hips).parent, node(Bone::Hips).rest});
    node(Bone::Hips).parent = node(Bone::LeftUpperLeg).parent = node(Bone::RightUpperLeg).parent = body;
    node(Bone::Hips).rest = {};
    const Skeleton robot = *Skeleton::make(nodes);
    const BoneMap map = match_bones(robot);
    EXPECT_EQ(map[Bone::Hips].node, body) << map[Bone::Hips].reasons;
    EXPECT_TRUE(map.is_usable());
    for (const Bone bone : {Bone::Spine, Bone::Head, Bone::LeftFoot, Bone::RightUpperLeg})
        EXPECT_EQ(map[bone].node, before[bone].node) << name(bone);
}

TEST(BoneMap, AHandAloneIsNoBody) {
    std::vector<Node> nodes{{"hand_l", -1, {}}};
    for (int finger = 0; finger < 5; ++finger) {
        for (int bone = 0; bone < 3; ++bone) {
            Node node{"bone_" + std::to_string(3 * finger + bone),
                      bone == 0 ? 0 : static_cast<std::int32_t>(nodes.size() - 1),
                      {}};
            node.rest.translation = {bone == 0 ? 0.02 * (finger - 2) : 0.0, 0.0, 0.04};
            nodes.push_back(node);
        }
    }
    const BoneMap map = match_bones(*Skeleton::make(nodes));
    EXPECT_FALSE(map.is_usable());
    EXPECT_GE(map.missing.size(), 14u);
}

/// A figure on all fours with a level spine, although every bone has a human name.
TEST(BoneMap, WhatGoesOnAllFoursIsNotSolvedAsABody) {
    Skeleton figure = make_figure({});
    std::vector<Node> nodes = figure.nodes();
    for (Node& node : nodes) {
        glm::dvec3& t = node.rest.translation;
        if (node.name == "Spine" || node.name == "Chest" || node.name == "UpperChest" || node.name == "Neck")
            t = {0.0, 0.0, t.y};
        if (node.name.find("Arm") != node.name.npos || node.name.find("Hand") != node.name.npos)
            t = {0.0, -std::abs(t.x), 0.0};
    }
    const BoneMap map = match_bones(*Skeleton::make(nodes));
    EXPECT_FALSE(map.upright);
    EXPECT_FALSE(map.is_usable());
}

TEST(BoneMap, TellsHowTheArmsAreHeld) {
    for (const auto& [down, rest] :
         {std::pair(0.0, RestPose::T), std::pair(45.0, RestPose::A), std::pair(85.0, RestPose::Other)}) {
        std::vector<Node> nodes = make_figure({}).nodes();
        const double radians = down * 3.14159265358979 / 180.0;
        for (Node& node : nodes) {
            if (node.name == "LeftShoulder")
                node.rest.rotation = glm::angleAxis(-radians, glm::dvec3(0, 0, 1));
            if (node.name == "RightShoulder")
                node.rest.rotation = glm::angleAxis(radians, glm::dvec3(0, 0, 1));
        }
        EXPECT_EQ(match_bones(*Skeleton::make(nodes)).rest, rest) << down;
    }
}

TEST(BoneMap, OfAnythingComesOutWhole) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> place(-1.0, 1.0);
    const std::vector<Habit> all = habits();
    for (int round = 0; round < 300; ++round) {
        std::vector<Node> nodes;
        const std::size_t count = 1 + random() % 60;
        for (std::size_t i = 0; i < count; ++i) {
            std::string label = "n" + std::to_string(i);
            if (random() % 2) {
                const Naming& names = all[random() % all.size()].names;
                label = std::next(names.begin(), static_cast<long>(random() % names.size()))->second + label;
            }
            Node node{label, i == 0 ? -1 : static_cast<std::int32_t>(random() % i), {}};
            for (int k = 0; k < 3; ++k) node.rest.translation[k] = place(random);
            nodes.push_back(node);
        }
        const Skeleton skeleton = *Skeleton::make(nodes);
        const BoneMap map = match_bones(skeleton);
        std::vector<bool> taken(count);
        for (const BoneMatch& match : map.bones) {
            if (match.node < 0) continue;
            ASSERT_LT(static_cast<std::size_t>(match.node), count);
            EXPECT_FALSE(taken[static_cast<std::size_t>(match.node)]) << "one node is two bones";
            taken[static_cast<std::size_t>(match.node)] = true;
        }
        EXPECT_EQ(map, match_bones(skeleton));
    }
}

// Seen in a robot whose forearm has a bone for each finger's part of the palm: any of them could be the hand.
TEST(BoneMap, TheHandIsTheBoneOfThePalmWithTheMiddleFinger) {
    const Skeleton plain = make_figure({{"LeftHand", "Palm3.L"}, {"LeftHand end", "Ring1.L"}});
    std::vector<Node> nodes;
    for (std::size_t i = 0; i < plain.size(); ++i) nodes.push_back(plain[i]);
    const std::size_t ring = *plain.find("Palm3.L"), finger = *plain.find("Ring1.L");
    nodes.push_back({"Palm2.L", nodes[ring].parent, nodes[ring].rest});
    nodes.push_back({"Middle1.L", static_cast<std::int32_t>(nodes.size() - 1), nodes[finger].rest});
    const Skeleton skeleton = Skeleton::make(std::move(nodes)).value();
    const BoneMap map = match_bones(skeleton);
    EXPECT_EQ(map[Bone::LeftHand].node, static_cast<std::int32_t>(*skeleton.find("Palm2.L")));
}

}  // namespace
}  // namespace tendril::test
