// Matching nodes to bones: by common names, by shape alone, and incomplete where bones are missing.
#include <gtest/gtest.h>

#include <sstream>

#include "humanoid_figure.hpp"

namespace tendril::test {
namespace {

using Naming = std::map<std::string, std::string>;

/// A naming convention: the words for the sides, and the names in the order of `keys`, with $ for the side.
/// An empty name omits the bone.
struct NamingConvention {
    const char *tool, *left, *right, *pattern;
    double confidence = 0.9;  ///< minimum for every bone; shape alone gives 0.6

    Naming names() const {
        constexpr const char* keys[]{
            "Hips",         "Spine",        "Chest",        "UpperChest",   "Neck",        "Head",
            "Head end",     "LeftShoulder", "LeftUpperArm", "LeftLowerArm", "LeftHand",    "LeftHand end",
            "LeftUpperLeg", "LeftLowerLeg", "LeftFoot",     "LeftToes",     "LeftToes end"};
        Naming names;
        std::istringstream all(pattern);
        std::string text;
        for (const std::string key : keys) {
            std::getline(all, text, '|');
            const auto with = [&](const std::string& side) {
                const auto at = text.find('$');
                return at == text.npos ? text : text.substr(0, at) + side + text.substr(at + 1);
            };
            names[key] = with(left);
            if (key.starts_with("Left")) names["Right" + key.substr(4)] = with(right);
        }
        return names;
    }
};
constexpr NamingConvention conventions[]{
    {"Mixamo", "Left", "Right",
     "mixamorig:Hips|mixamorig:Spine|mixamorig:Spine1|mixamorig:Spine2|mixamorig:Neck|mixamorig:Head|"
     "mixamorig:HeadTop_End|mixamorig:$Shoulder|mixamorig:$Arm|mixamorig:$ForeArm|mixamorig:$Hand|"
     "mixamorig:$HandMiddle1|mixamorig:$UpLeg|mixamorig:$Leg|mixamorig:$Foot|mixamorig:$ToeBase|"
     "mixamorig:$Toe_End"},
    {"Unreal", "l", "r",
     "pelvis|spine_01|spine_02|spine_03|neck_01|head|head_leaf|clavicle_$|upperarm_$|lowerarm_$|hand_$|"
     "middle_01_$|thigh_$|calf_$|foot_$|ball_$|ball_leaf_$"},
    {"VRoid", "L", "R",
     "J_Bip_C_Hips|J_Bip_C_Spine|J_Bip_C_Chest|J_Bip_C_UpperChest|J_Bip_C_Neck|J_Bip_C_Head|J_Sec_Hair1|"
     "J_Bip_$_Shoulder|J_Bip_$_UpperArm|J_Bip_$_LowerArm|J_Bip_$_Hand|J_Bip_$_Middle1|J_Bip_$_UpperLeg|"
     "J_Bip_$_LowerLeg|J_Bip_$_Foot|J_Bip_$_ToeBase|J_Bip_$_ToeBase_end"},
    {"Rigify", "L", "R",
     "DEF-hips|DEF-spine.001|DEF-spine.002|DEF-spine.003|DEF-neck|DEF-head|DEF-head.tip|DEF-shoulder.$|"
     "DEF-upper_arm.$|DEF-forearm.$|DEF-hand.$|DEF-f_middle.01.$|DEF-thigh.$|DEF-shin.$|DEF-foot.$|DEF-toe.$|"
     "DEF-toe_tip.$"},
    {"Character Studio", "L", "R",
     "Bip01 Pelvis|Bip01 Spine|Bip01 Spine1|Bip01 Spine2|Bip01 Neck|Bip01 Head|Bip01 HeadNub|"
     "Bip01 $ Clavicle|Bip01 $ UpperArm|Bip01 $ Forearm|Bip01 $ Hand|Bip01 $ Finger1|Bip01 $ Thigh|"
     "Bip01 $ Calf|Bip01 $ Foot|Bip01 $ Toe0|Bip01 $ Toe0Nub"},
    {"Source engine", "L", "R",
     "ValveBiped.Bip01_Pelvis|ValveBiped.Bip01_Spine|ValveBiped.Bip01_Spine1|ValveBiped.Bip01_Spine2|"
     "ValveBiped.Bip01_Neck1|ValveBiped.Bip01_Head1|ValveBiped.forward|ValveBiped.Bip01_$_Clavicle|"
     "ValveBiped.Bip01_$_UpperArm|ValveBiped.Bip01_$_Forearm|ValveBiped.Bip01_$_Hand|"
     "ValveBiped.Bip01_$_Finger1|ValveBiped.Bip01_$_Thigh|ValveBiped.Bip01_$_Calf|ValveBiped.Bip01_$_Foot|"
     "ValveBiped.Bip01_$_Toe0|end.$"},
    {"Biovision", "Left", "Right",
     "Hips|Chest|Chest2|Chest3|Neck|Head|End Site|$Collar|$Shoulder|$Elbow|$Wrist|$Wrist end|$Hip|$Knee|"
     "$Ankle|$Toe|$Toe end"},
    {"Poser", "l", "r",
     "hip|abdomen|waist|chest|neck|head|leftEye|$Collar|$Shldr|$ForeArm|$Hand|$Mid1|$Thigh|$Shin|$Foot|$Toe|"
     "$Toe_end"},
    {"small letters", "left", "right",
     "hips|spine|chest|upperchest|neck|head|head_end|$shoulder|$arm|$forearm|$hand|$fingers|$upleg|$leg|"
     "$foot|$toes|$toes_end"},
    {"Acclaim", "l", "r",
     "hips|lowerback|upperback|thorax|lowerneck|head|head end|$clavicle|$humerus|$radius|$hand|$fingers|"
     "$femur|$tibia|$foot|$toes|$toes end"},
    {"Acclaim, converted", "l", "r",
     "hips|lowerback|upperback|thorax|neck|head|head end|$shoulderjoint|$humerus|$radius|$hand|$thumb|"
     "$femur|$tibia|$foot|$toes|$toes end"},
    {"CMU", "Left", "Right",
     "Hips|LowerBack|Spine|Spine1|Neck1|Head|End|$Shoulder|$Arm|$ForeArm|$Hand|$HandIndex1|$UpLeg|$Leg|$Foot|"
     "$ToeBase|$ToeBase end"},
    {"Motive", "L", "R",
     "Hip|Ab|Chest||Neck|Head|Head end|$Shoulder|$UArm|$FArm|$Hand|$Hand end|$Thigh|$Shin|$Foot|$Toe|$Toe "
     "end"},
    {"Motive, with the asset's name", "L", "R",
     "Bob_Hip|Bob_Ab|Bob_Chest||Bob_Neck|Bob_Head|Bob_Head end|Bob_$Shoulder|Bob_$UArm|Bob_$FArm|Bob_$Hand|"
     "Bob_$Hand end|Bob_$Thigh|Bob_$Shin|Bob_$Foot|Bob_$Toe|Bob_$Toe end"},
    {"Xsens", "Left", "Right",
     "Pelvis|L5|L3|T8|Neck|Head|Head end|$Shoulder|$UpperArm|$ForeArm|$Hand|$Hand end|$UpperLeg|$LowerLeg|"
     "$Foot|$Toe|$Toe end"},
    {"Rokoko", "Left", "Right",
     "Hips|Spine1|Spine2|Spine3|Neck|Head|Head end|$Shoulder|$Arm|$ForeArm|$Hand|$Finger1Proximal|$Thigh|"
     "$Shin|$Foot|$Toe|$ToeTip"},
    {"Perception Neuron", "Left", "Right",
     "Robot_Hips|Robot_Spine|Robot_Spine1|Robot_Spine2|Robot_Neck|Robot_Head|Robot_Head end|Robot_$Shoulder|"
     "Robot_$Arm|Robot_$ForeArm|Robot_$Hand|Robot_$InHandMiddle|Robot_$UpLeg|Robot_$Leg|Robot_$Foot|"
     "Robot_$Toe|Robot_$Toe end"},
    {"Vicon", "Left", "Right",
     "Pelvis|Lumbar|Thorax||Neck|Head|Head end|$Clavicle|$Humerus|$Radius|$Hand|$Hand "
     "end|$Femur|$Tibia|$Foot|"
     "$Toes|$Toes end"},
    {"Unity", "Left", "Right",
     "Hips|Spine|Chest|Upper Chest|Neck|Head|Jaw|$ Shoulder|$ Upper Arm|$ Lower Arm|$ Hand|"
     "$ Middle Proximal|$ Upper Leg|$ Lower Leg|$ Foot|$ Toes|$ Toes end"},
    {"MotionBuilder", "Left", "Right",
     "Character1_Hips|Character1_Spine|Character1_Spine1|Character1_Spine2|Character1_Neck|Character1_Head|"
     "Character1_Head end|Character1_$Shoulder|Character1_$Arm|Character1_$ForeArm|Character1_$Hand|"
     "Character1_$HandMiddle1|Character1_$UpLeg|Character1_$Leg|Character1_$Foot|Character1_$ToeBase|"
     "Character1_$FootMiddle1"},
    {"Auto-Rig", "l", "r",
     "root.x|spine_01.x|spine_02.x|spine_03.x|neck.x|head.x|head_end|shoulder.$|arm_stretch.$|"
     "forearm_stretch.$|hand.$|c_middle1.$|thigh_stretch.$|leg_stretch.$|foot.$|toes_01.$|toes_end.$",
     0.6},
    {"DAZ Genesis 8", "l", "r",
     "hip|abdomenLower|abdomenUpper|chestLower|neckLower|head|tongue|$Collar|$ShldrBend|$ForearmBend|$Hand|"
     "$Mid1|$ThighBend|$Shin|$Foot|$Toe|$BigToe"},
    {"DAZ Genesis 9", "l", "r",
     "hip|spine1|spine2|spine3|neck1|head|tongue01|$_shoulder|$_upperarm|$_forearm|$_hand|$_mid1|$_thigh|"
     "$_shin|$_foot|$_toes|$_bigtoe1"},
    {"SMPL", "L", "R",
     "m_avg_Pelvis|m_avg_Spine1|m_avg_Spine2|m_avg_Spine3|m_avg_Neck|m_avg_Head|m_avg_Head end|"
     "m_avg_$_Collar|m_avg_$_Shoulder|m_avg_$_Elbow|m_avg_$_Wrist|m_avg_$_Hand|m_avg_$_Hip|m_avg_$_Knee|"
     "m_avg_$_Ankle|m_avg_$_Foot|m_avg_$_Foot end",
     0.6},
    {"Reallusion", "L", "R",
     "CC_Base_Hip|CC_Base_Waist|CC_Base_Spine01|CC_Base_Spine02|CC_Base_NeckTwist01|CC_Base_Head|"
     "CC_Base_FacialBone|CC_Base_$_Clavicle|CC_Base_$_Upperarm|CC_Base_$_Forearm|CC_Base_$_Hand|"
     "CC_Base_$_Mid1|CC_Base_$_Thigh|CC_Base_$_Calf|CC_Base_$_Foot|CC_Base_$_ToeBase|CC_Base_$_BigToe1",
     0.6},
    {"MakeHuman", "L", "R",
     "root|spine05|spine03|spine01|neck01|head|jaw|clavicle.$|upperarm01.$|lowerarm01.$|wrist.$|"
     "finger3-1.$|upperleg01.$|lowerleg01.$|foot.$|toe1-1.$|toe1-2.$",
     0.6},
    {"Advanced Skeleton", "L", "R",
     "Root_M|Spine1_M|Spine2_M|Chest_M|Neck_M|Head_M|HeadEnd_M|Scapula_$|Shoulder_$|Elbow_$|Wrist_$|"
     "MiddleFinger1_$|Hip_$|Knee_$|Ankle_$|Toes_$|ToesEnd_$",
     0.6},
    {"Kinect", "Left", "Right",
     "PELVIS|SPINE_NAVEL|SPINE_CHEST||NECK|HEAD|NOSE|CLAVICLE_$|SHOULDER_$|ELBOW_$|WRIST_$|HANDTIP_$|HIP_$|"
     "KNEE_$|ANKLE_$|FOOT_$|FOOT_$ end",
     0.6},
    {"Roblox", "Left", "Right",
     "LowerTorso|UpperTorso|||Neck|Head|Head end||$UpperArm|$LowerArm|$Hand|$Hand end|$UpperLeg|$LowerLeg|"
     "$Foot||$Foot end",
     0.6},
    {"MikuMikuDance", "左", "右",
     "センター|上半身|上半身2||首|頭|両目|$肩|$腕|$ひじ|$手首|$中指１|$足|$ひざ|$足首|$つま先|$足先EX"},
    {"Maya, lf and rt", "lf", "rt",
     "pelvis_jnt|spine_01_jnt|spine_02_jnt|spine_03_jnt|neck_jnt|head_jnt|head_end|$_clavicle_jnt|"
     "$_shoulder_jnt|$_elbow_jnt|$_wrist_jnt|$_middle_01_jnt|$_leg_jnt|$_knee_jnt|$_ankle_jnt|$_ball_jnt|"
     "$_toe_end"}};

/// Checks that every bone's node has the expected name.
void expect_names(const Skeleton& skeleton, const BoneMap& map, const Naming& names, double confidence) {
    for (std::size_t i = 0; i < bone_count; ++i) {
        const std::string bone = name(static_cast<Bone>(i));
        const auto expected = names.find(bone);
        if (expected != names.end() && expected->second.empty()) continue;
        ASSERT_GE(map.bones[i].node, 0) << bone;
        EXPECT_EQ(skeleton[static_cast<std::size_t>(map.bones[i].node)].name,
                  expected == names.end() ? bone : expected->second)
            << bone << ": " << map.bones[i].reasons;
        EXPECT_GE(map.bones[i].confidence, confidence) << bone << ": " << map.bones[i].reasons;
        EXPECT_FALSE(map.bones[i].reasons.empty());
    }
    EXPECT_TRUE(map.is_usable());
}

TEST(BoneMap, RecognisesEveryNamingConvention) {
    for (const NamingConvention& convention : conventions) {
        SCOPED_TRACE(convention.tool);
        const Skeleton skeleton = make_figure(convention.names());
        const BoneMap map = match_bones(skeleton);
        expect_names(skeleton, map, convention.names(), convention.confidence);
        EXPECT_EQ(map.rest, RestPose::T);
    }
}

TEST(BoneMap, ASplitLimbBeginsAtItsFirstPiece) {
    const NamingConvention& convention =
        *std::find_if(std::begin(conventions), std::end(conventions),
                      [](const NamingConvention& each) { return each.tool == std::string("MakeHuman"); });
    const Naming names = convention.names();
    const Skeleton whole = make_figure(names);
    std::vector<Node> nodes(whole.nodes().begin(), whole.nodes().end());
    for (std::size_t i = 0; i < whole.size(); ++i) {
        const std::string& name = whole[i].name;
        const std::size_t number = name.find("01.");
        if (number == name.npos || whole.children(i).empty()) continue;
        const auto below = static_cast<std::size_t>(whole.children(i)[0]);
        Node half = nodes[below];
        half.name = name.substr(0, number) + "02" + name.substr(number + 2);
        half.rest.translation = nodes[below].rest.translation *= 0.5;
        nodes[below].parent = static_cast<std::int32_t>(nodes.size());
        nodes.push_back(half);
    }
    const Skeleton split = *Skeleton::make(std::move(nodes));
    expect_names(split, match_bones(split), names, convention.confidence);
}

/// Some bones of one side have meaningless names, or another bone's name.
TEST(BoneMap, AMirroredFigureHasAMirroredMap) {
    std::mt19937 random(9);
    int count = 0;
    for (int round = 0; round < 2000; ++round) {
        const NamingConvention& convention = conventions[random() % std::size(conventions)];
        SCOPED_TRACE(convention.tool + (", " + std::to_string(round)));
        Naming names = convention.names(), others = conventions[random() % std::size(conventions)].names();
        for (auto& [key, text] : names) {
            if (text.empty() || !key.starts_with("Left") || random() % 4 > 0) continue;
            const std::string& other = others[key];
            const bool is_free =
                !other.empty() && std::none_of(names.begin(), names.end(),
                                               [&](const auto& each) { return each.second == other; });
            text = is_free && random() % 2 == 0 ? other : "part " + std::to_string(count++);
        }
        const Skeleton skeleton = make_figure(names);
        const BoneMap map = match_bones(skeleton);
        const auto places = positions_of(skeleton, rest_pose(skeleton));
        ASSERT_TRUE(check(map, skeleton)) << check(map, skeleton).message();
        for (std::size_t i = static_cast<std::size_t>(Bone::LeftShoulder); i < bone_count; ++i) {
            const auto bone = static_cast<Bone>(i);
            const BoneMatch &here = map[bone], &there = map[mirrored(bone)];
            ASSERT_EQ(here.node < 0, there.node < 0) << name(bone);
            if (here.node < 0) continue;
            EXPECT_LT(glm::length(places[static_cast<std::size_t>(here.node)] * glm::dvec3(-1.0, 1.0, 1.0) -
                                  places[static_cast<std::size_t>(there.node)]),
                      1e-9)
                << name(bone) << ": " << here.reasons << "; " << there.reasons;
        }
    }
}

Naming nameless() {
    Naming names;
    int count = 0;
    for (const FigureNode& node : figure_nodes()) names[node.key] = "node_" + std::to_string(count++);
    return names;
}

TEST(BoneMap, WithoutNamesFindsThemByShapeInAnyDirection) {
    for (const double turn : {0.0, 0.7, 1.6, 3.1, -2.2}) {
        SCOPED_TRACE(turn);
        const Skeleton skeleton = make_figure(nameless(), turn);
        const BoneMap map = match_bones(skeleton);
        expect_names(skeleton, map, nameless(), 0.5);
        for (const BoneMatch& match : map.bones)
            EXPECT_LT(match.confidence, 0.7) << "nothing but the shape says so";
    }
}

TEST(BoneMap, AShortSpineFillsItsFirstBones) {
    const Skeleton two = make_figure({{"UpperChest", ""}, {"Chest", "Spine1"}});
    EXPECT_EQ(match_bones(two)[Bone::UpperChest].node, -1);
    EXPECT_EQ(two[static_cast<std::size_t>(match_bones(two)[Bone::Chest].node)].name, "Spine1");
    const Skeleton one = make_figure({{"UpperChest", ""}, {"Chest", ""}});
    EXPECT_EQ(match_bones(one)[Bone::Chest].node, -1);
    EXPECT_TRUE(match_bones(one).is_usable()) << "fifteen are enough";
}

TEST(BoneMap, ListsTheMissingBones) {
    Naming names;
    for (const char* key : {"LeftHand", "LeftHand end", "LeftLowerArm"}) names[key] = "";
    const BoneMap map = match_bones(make_figure(names));
    EXPECT_EQ(map.missing, (std::vector<Bone>{Bone::LeftLowerArm, Bone::LeftHand}));
    EXPECT_FALSE(map.is_usable());
}

/// As in RobotExpressive: Body has a child named Hips that carries the spine; the legs are its siblings.
TEST(BoneMap, TheCommonParentOfSpineAndLegsIsTheHips) {
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

TEST(BoneMap, AHandAloneIsNotABody) {
    std::vector<Node> nodes{{"hand_l", -1, {}}};
    for (int finger = 0; finger < 5; ++finger)
        for (int bone = 0; bone < 3; ++bone) {
            Node node{"bone_" + std::to_string(3 * finger + bone),
                      bone == 0 ? 0 : static_cast<std::int32_t>(nodes.size() - 1),
                      {}};
            node.rest.translation = {bone == 0 ? 0.02 * (finger - 2) : 0.0, 0.0, 0.04};
            nodes.push_back(node);
        }
    const BoneMap map = match_bones(*Skeleton::make(nodes));
    EXPECT_FALSE(map.is_usable());
    EXPECT_GE(map.missing.size(), 14u);
}

/// A figure on all fours with a level spine, all its bones under human names.
TEST(BoneMap, AFigureOnAllFoursIsNotABody) {
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

TEST(BoneMap, ReportsTheRestPoseOfTheArms) {
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

TEST(BoneMap, AnySkeletonGivesAValidMap) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> place(-1.0, 1.0);
    for (int round = 0; round < 300; ++round) {
        std::vector<Node> nodes;
        const std::size_t count = 1 + random() % 60;
        for (std::size_t i = 0; i < count; ++i) {
            std::string label = "n" + std::to_string(i);
            if (random() % 2) {
                const Naming names = conventions[random() % std::size(conventions)].names();
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

// From a robot whose forearm has a palm bone for each finger: any of them could be the hand.
TEST(BoneMap, TheHandIsTheMiddleFingersPalmBone) {
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
