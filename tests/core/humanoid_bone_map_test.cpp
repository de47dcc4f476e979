// Matching nodes to bones: by common names, by shape alone, and incomplete where bones are missing.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "humanoid_figure.hpp"
#include "tests/labels.hpp"
#include "tests/places.hpp"

namespace tendril::test {
namespace {

using Naming = std::map<std::string, std::string>;

/// A naming convention: the words for the sides, and the names in the order of `keys`, with $ for the side.
/// An empty name omits the bone.
struct NamingConvention {
    std::string tool, left, right, pattern;
    double confidence;  ///< minimum for every bone; shape alone gives 0.6

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
const std::vector<NamingConvention>& conventions() {
    static const auto all = [] {
        std::ifstream file(source_path("tests/core/naming_conventions.json"));
        std::vector<NamingConvention> read;
        for (const auto& each : nlohmann::json::parse(file))
            read.push_back({each.at("tool"), each.at("left"), each.at("right"), each.at("pattern"),
                            each.value("confidence", 0.9)});
        return read;
    }();
    return all;
}

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
    for (const NamingConvention& convention : conventions()) {
        SCOPED_TRACE(convention.tool);
        const Skeleton skeleton = make_figure(convention.names());
        const BoneMap map = match_bones(skeleton);
        expect_names(skeleton, map, convention.names(), convention.confidence);
        EXPECT_EQ(map.rest, RestPose::T);
    }
}

TEST(BoneMap, ASplitLimbBeginsAtItsFirstPiece) {
    const NamingConvention& convention =
        *std::find_if(conventions().begin(), conventions().end(),
                      [](const NamingConvention& each) { return each.tool == "MakeHuman"; });
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

LABEL(slow, "BoneMap.AMirroredFigureHasAMirroredMap");

/// Some bones of one side have meaningless names, or another bone's name.
TEST(BoneMap, AMirroredFigureHasAMirroredMap) {
    std::mt19937 random(9);
    int count = 0;
    for (int round = 0; round < 2000; ++round) {
        const NamingConvention& convention = conventions()[random() % conventions().size()];
        SCOPED_TRACE(convention.tool + (", " + std::to_string(round)));
        Naming names = convention.names(), others = conventions()[random() % conventions().size()].names();
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
                const Naming names = conventions()[random() % conventions().size()].names();
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
