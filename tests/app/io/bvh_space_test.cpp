// Properties that a BVH file leaves open, found from its zero pose and its motion: the up axis, the unit, the
// meaning of the root's positions, and a rest pose that stands.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <sstream>
#include <string>
#include <tendril/humanoid/retarget.hpp>
#include <tendril/humanoid/t_pose.hpp>
#include <utility>
#include <vector>

#include "app/io/character/bvh.hpp"
#include "app/io/character/character.hpp"
#include "app/io/character/stick_figure.hpp"
#include "tests/app/io/fbx_file.hpp"
#include "tests/app/io/posed.hpp"
#include "tests/app/support/temp_folder.hpp"
#include "tests/says.hpp"

namespace tendril::app::bvh_space {
namespace {

/// A joint, its OFFSET with Y up, and for the folded figure the turn about Z with which it stands.
struct Joint {
    const char* name;
    const char* parent;
    glm::dvec3 offset;
    double turn = 0.0;
};

/// Stands in its zero pose, 1.6 m tall, in centimetres.
const std::vector<Joint> standing{{"Hips", "", {0, 0, 0}},
                                  {"Spine", "Hips", {0, 12, 0}},
                                  {"Chest", "Spine", {0, 20, 0}},
                                  {"Neck", "Chest", {0, 22, 0}},
                                  {"Head", "Neck", {0, 10, 0}},
                                  {"LeftArm", "Chest", {16, 18, 0}},
                                  {"LeftForeArm", "LeftArm", {28, 0, 0}},
                                  {"LeftHand", "LeftForeArm", {25, 0, 0}},
                                  {"RightArm", "Chest", {-16, 18, 0}},
                                  {"RightForeArm", "RightArm", {-28, 0, 0}},
                                  {"RightHand", "RightForeArm", {-25, 0, 0}},
                                  {"LeftUpLeg", "Hips", {10, 0, 0}},
                                  {"LeftLeg", "LeftUpLeg", {0, -42, 0}},
                                  {"LeftFoot", "LeftLeg", {0, -42, 0}},
                                  {"LeftToe", "LeftFoot", {0, -6, 14}},
                                  {"RightUpLeg", "Hips", {-10, 0, 0}},
                                  {"RightLeg", "RightUpLeg", {0, -42, 0}},
                                  {"RightFoot", "RightLeg", {0, -42, 0}},
                                  {"RightToe", "RightFoot", {0, -6, 14}}};

/// In its zero pose all bones point along X, as some captures are written.
const std::vector<Joint> folded{{"Hips", "", {-42, 91, -40}, 90},
                                {"Spine", "Hips", {12, 0, 0}},
                                {"Chest", "Spine", {20, 0, 0}},
                                {"Neck", "Chest", {22, 0, 0}},
                                {"Head", "Neck", {10, 0, 0}},
                                {"LeftArm", "Chest", {18, 0, 16}, 180},
                                {"LeftForeArm", "LeftArm", {28, 0, 0}},
                                {"LeftHand", "LeftForeArm", {25, 0, 0}},
                                {"RightArm", "Chest", {18, 0, -16}, 180},
                                {"RightForeArm", "RightArm", {28, 0, 0}},
                                {"RightHand", "RightForeArm", {25, 0, 0}},
                                {"LeftUpLeg", "Hips", {0, 0, 10}, 180},
                                {"LeftLeg", "LeftUpLeg", {42, 0, 0}},
                                {"LeftFoot", "LeftLeg", {42, 0, 0}, 90},
                                {"LeftToe", "LeftFoot", {14, -6, 0}},
                                {"RightUpLeg", "Hips", {0, 0, -10}, 180},
                                {"RightLeg", "RightUpLeg", {42, 0, 0}},
                                {"RightFoot", "RightLeg", {42, 0, 0}, 90},
                                {"RightToe", "RightFoot", {14, -6, 0}}};

struct Written {
    std::vector<Joint> joints = standing;
    bool rest_z_up = false;             ///< offsets with Z up
    std::array<double, 3> root_turn{};  ///< degrees about Z, X, Y, added in every frame
    glm::dvec3 root{0, 90, 0};          ///< its position in the first frame
    glm::dvec3 way{0, 0, 2};            ///< movement per frame
    double unit = 1.0;                  ///< scales all lengths
    double tread = 0.0;                 ///< amplitude of the feet's alternating tilt, degrees
    int frames = 20;
};

std::string written(const Written& from) {
    std::ostringstream text;
    std::vector<const Joint*> order;
    const auto point = [&](glm::dvec3 at) {
        if (from.rest_z_up) at = {at.x, -at.z, at.y};
        text << "OFFSET " << from.unit * at.x << ' ' << from.unit * at.y << ' ' << from.unit * at.z << '\n';
    };
    const auto joint = [&](const auto& self, const Joint& of) -> void {
        const bool is_root = *of.parent == '\0';
        text << (is_root ? "ROOT " : "JOINT ") << of.name << "\n{\n";
        point(of.offset);
        text << "CHANNELS " << (is_root ? "6 Xposition Yposition Zposition" : "3")
             << " Zrotation Xrotation Yrotation\n";
        order.push_back(&of);
        bool has_children = false;
        for (const Joint& each : from.joints)
            if (std::string(each.parent) == of.name) has_children = true, self(self, each);
        if (!has_children) {
            text << "End Site\n{\n";
            point(0.1 * of.offset);
            text << "}\n";
        }
        text << "}\n";
    };
    text << "HIERARCHY\n";
    joint(joint, from.joints.front());
    text << "MOTION\nFrames: " << from.frames << "\nFrame Time: 0.05\n";
    for (int i = 0; i < from.frames; ++i) {
        const glm::dvec3 at = from.unit * (from.root + static_cast<double>(i) * from.way);
        text << at.x << ' ' << at.y << ' ' << at.z;
        for (const Joint* each : order) {
            const bool is_root = each == order[0];
            double turn = each->turn + (is_root ? from.root_turn[0] : 0.0);
            if (std::string(each->name) == "LeftFoot") turn += from.tread * std::cos(0.3 * i);
            if (std::string(each->name) == "RightFoot") turn -= from.tread * std::cos(0.3 * i);
            text << ' ' << turn << ' ' << (is_root ? from.root_turn[1] : 0.0) << ' '
                 << (is_root ? from.root_turn[2] : 0.0);
        }
        text << '\n';
    }
    return text.str();
}

glm::dvec3 at(const Character& character, const char* node, bool in_motion = true) {
    return test_posed::at(character, node, in_motion ? 0 : -1);
}

std::string all_text(const Character& character) {
    return test_posed::lines(character.sentences());
}

/// Upright at rest and in the first frame, where it stands on the floor.
void expect_standing(const Character& character) {
    for (const bool in_motion : {false, true}) {
        SCOPED_TRACE(in_motion ? "in motion" : "at rest");
        const auto y = [&](const char* node) { return at(character, node, in_motion).y; };
        EXPECT_GT(y("Head") - y("Hips"), 0.4);
        EXPECT_GT(y("Hips") - y("LeftFoot"), 0.7);
        EXPECT_GT(y("Hips") - y("RightFoot"), 0.7);
    }
    EXPECT_NEAR(at(character, "LeftToe").y, 0.0, 0.05);
    EXPECT_TRUE(bone_map(character).is_usable());
}

TEST(BvhSpace, AStandingZeroPoseWithYUpIsKept) {
    const Character character = parse_bvh(written({}), "it.bvh");
    expect_standing(character);
    EXPECT_EQ(character.scale, 0.01);
    EXPECT_EQ(character.space, FileSpace());
    EXPECT_EQ(character.sentences().size(), 1u) << all_text(character);
    EXPECT_TRUE(test::says(all_text(character), "unit centimetres"));
}

TEST(BvhSpace, AZeroPoseThatDoesNotStandIsReplacedByOneFromTheMotion) {
    const Character character = parse_bvh(written({.joints = folded, .root = {173, 90, -518}}), "it.bvh");
    expect_standing(character);
    EXPECT_EQ(character.scale, 0.01);
    EXPECT_NEAR(at(character, "Hips").y, 0.90, 1e-9);
    EXPECT_NEAR(at(character, "Hips").x, 1.73, 1e-9);
    EXPECT_NEAR(at(character, "Hips", false).y, 0.90, 1e-9);
    EXPECT_EQ(character.space.positions, RootPositions::Replace);
    EXPECT_TRUE(test::says(all_text(character), "positions replace its OFFSET floor"));
    EXPECT_TRUE(test::says(all_text(character), "rest pose frame of the motion"));
}

/// The stick figure with the clip of a file, carried over, and their scale.
std::pair<Character, double> on_the_figure(const Character& source) {
    Character figure = stick_figure();
    const humanoid::BoneMap map = bone_map(figure), from = bone_map(source);
    const auto made = humanoid::retarget({source.skeleton, from}, source.clips[0], {figure.skeleton, map});
    EXPECT_TRUE(made) << made.message();
    figure.clips = {made->clip};
    return {std::move(figure), made->scale};
}

/// It walks as in its file, whatever its heading in the frame that becomes its rest pose.
TEST(BvhSpace, AFramesHeadingIsNotTheFiguresForward) {
    for (const double yaw : {-128.0, -18.0, 0.0, 18.0, 64.0, 90.0, 170.0}) {
        SCOPED_TRACE(yaw);
        const Character source =
            parse_bvh(written({.joints = folded, .root_turn = {0, yaw, 0}, .root = {0, 90, 0}}), "it.bvh");
        expect_standing(source);
        EXPECT_LT(glm::distance(facing(source.skeleton, bone_map(source)).forward, {0, 0, 1}), 1e-9);
        const auto [shown, scale] = on_the_figure(source);
        const auto ahead = [](const Character& of, const char* toes) {
            const glm::dvec3 foot = at(of, toes) - at(of, "LeftFoot");
            return glm::normalize(glm::dvec3(foot.x, 0.0, foot.z));
        };
        EXPECT_LT(glm::distance(ahead(shown, "LeftToes"), ahead(source, "LeftToe")), 1e-6);
        const glm::dvec3 way = test_posed::at(shown, "Hips", 0, 0.95) - at(shown, "Hips");
        EXPECT_LT(glm::distance(way, {0.0, 0.0, 0.38 * scale}), 1e-3);
    }
}

/// Nor do that frame's feet define its stance: a frame is the same however many follow it.
TEST(BvhSpace, AFrameRetargetsTheSameInAFileOfAnyLength) {
    for (const int frames : {1, 2, 4, 10, 60}) {
        const Character source = parse_bvh(
            written(
                {.joints = folded, .root = {0, 90, 0}, .way = {0, 0, 4}, .tread = 15.0, .frames = frames}),
            "it.bvh");
        const Character shown = on_the_figure(source).first;
        const auto tilt = [&](const char* foot, const char* toes) {
            const glm::dvec3 now = at(shown, toes) - at(shown, foot),
                             rest = at(shown, toes, false) - at(shown, foot, false);
            return glm::degrees(std::asin(rest.y / glm::length(rest)) - std::asin(now.y / glm::length(now)));
        };
        // At rest it points 23 degrees down in the file, and stands 30 degrees down.
        EXPECT_NEAR(tilt("LeftFoot", "LeftToes") + tilt("RightFoot", "RightToes"), 2.0 * (23.2 - 30.0), 1.0)
            << frames;
        EXPECT_NEAR(std::abs(tilt("LeftFoot", "LeftToes") - tilt("RightFoot", "RightToes")), 30.0, 1.0)
            << frames;
    }
}

TEST(BvhSpace, RootPositionsAreAddedIfOnlyThatPutsTheFeetOnTheFloor) {
    Written from{.joints = folded, .root = {173, -1, -518}};
    Character character = parse_bvh(written(from), "it.bvh");
    expect_standing(character);
    EXPECT_EQ(character.space.positions, RootPositions::Add);
    EXPECT_NEAR(at(character, "Hips").y, 0.90, 1e-9);
    EXPECT_NEAR(at(character, "Hips").x, 1.31, 1e-9);
    EXPECT_TRUE(test::says(all_text(character), "positions are added to its OFFSET floor"));

    read_as(character, character.scale, {.up = UpAxis::Y, .positions = RootPositions::Replace});
    EXPECT_NEAR(at(character, "Hips").y, -0.01, 1e-9);
    EXPECT_EQ(all_text(character).find("OFFSET"), std::string::npos) << "it is no guess any more";
    read_as(character, character.scale, {.up = UpAxis::Y, .positions = RootPositions::Add});
    EXPECT_NEAR(at(character, "Hips").y, 0.90, 1e-9);
}

TEST(BvhSpace, TheUpAxisIsTheZeroPosesAndTheMotions) {
    const Character character =
        parse_bvh(written({.rest_z_up = true, .root = {0, 40, 90}, .way = {0, -2, 0}}), "it.bvh");
    EXPECT_EQ(character.space.up, UpAxis::Z);
    expect_standing(character);
    EXPECT_EQ(character.scale, 0.01);
    EXPECT_TRUE(test::says(all_text(character), "up zero pose motion Z"));
    EXPECT_GT(at(character, "LeftToe").z, at(character, "LeftFoot").z) << "it faces forwards still";
}

TEST(BvhSpace, IfTheyDifferTheUpAxisIsTheMotions) {
    // Y up at rest; in motion turned about X, so that it stands along Z and walks along -Y.
    const Character z_up =
        parse_bvh(written({.root_turn = {0, 90, 0}, .root = {30, 60, 90}, .way = {0, -2, 0}}), "it.bvh");
    EXPECT_EQ(z_up.space.up, UpAxis::Z);
    expect_standing(z_up);
    EXPECT_TRUE(test::says(all_text(z_up), "zero pose along Y motion along Z rotated"));
    // And the other way round.
    const Character y_up = parse_bvh(written({.rest_z_up = true, .root_turn = {0, -90, 0}}), "it.bvh");
    EXPECT_EQ(y_up.space.up, UpAxis::Y);
    expect_standing(y_up);
}

TEST(BvhSpace, AFigureLyingOnTheFloorIsNotRaised) {
    const Character lying =
        parse_bvh(written({.root_turn = {0, -90, 0}, .root = {50, 12, 130}, .way = {0, 0, 0}}), "it.bvh");
    EXPECT_EQ(lying.space.up, UpAxis::Y);
    EXPECT_NEAR(at(lying, "Head").y, at(lying, "Hips").y, 1e-9);
}

TEST(BvhSpace, TheUnitComesFromTheStandingFigure) {
    const struct {
        double unit;
        const char* name;
        double metres;
    } units[] = {{0.01, "metres", 1.0},
                 {0.1, "decimetres", 0.1},
                 {1.0, "centimetres", 0.01},
                 {10.0, "millimetres", 0.001}};
    for (const auto& each : units) {
        for (const std::vector<Joint>& joints : {standing, folded}) {
            const Character character = parse_bvh(written({.joints = joints, .unit = each.unit}), "it.bvh");
            EXPECT_DOUBLE_EQ(character.scale, each.metres);
            EXPECT_TRUE(test::says(all_text(character), each.name));
            expect_standing(character);
        }
    }
}

/// A figure of 1.8 units as an FBX.
std::string fbx_figure(std::vector<test::FbxRecord> settings) {
    test::FbxScene scene;
    scene.settings = std::move(settings);
    const Character figure = stick_figure();
    std::vector<std::int64_t> ids(figure.skeleton.size());
    for (const std::int32_t each : figure.skeleton.order()) {
        const humanoid::Node& node = figure.skeleton[static_cast<std::size_t>(each)];
        ids[static_cast<std::size_t>(each)] =
            scene.model(node.name, node.parent < 0 ? 0 : ids[static_cast<std::size_t>(node.parent)],
                        {test::FbxScene::vector("Lcl Translation", node.rest.translation)});
    }
    return scene.text();
}

std::optional<UnitDoubt> doubt_of(const Character& character) {
    return doubted_unit(bounds_at_rest(character, test_posed::placed(character, -1)).height(),
                        character.scale, bone_map(character));
}

TEST(UnitOfAFile, AnFbxFilesMissingUnitIsGuessedAndReported) {
    const test::TempFolder folder;
    test::write(folder / "none.fbx", fbx_figure({}));
    const Character guessed = read_character(folder / "none.fbx");
    EXPECT_EQ(guessed.scale, 1.0);
    EXPECT_NEAR(at(guessed, "HeadTop_End", false).y, 1.8, 1e-9);
    EXPECT_TRUE(test::says(all_text(guessed), "no unit height metres"));
    EXPECT_FALSE(doubt_of(guessed));

    test::write(folder / "stated.fbx", fbx_figure({test::FbxScene::property("UnitScaleFactor", {1.0})}));
    const Character stated = read_character(folder / "stated.fbx");
    EXPECT_EQ(stated.scale, 0.01) << "it is taken at its word";
    EXPECT_EQ(all_text(stated), "");
    const auto doubt = doubt_of(stated);
    ASSERT_TRUE(doubt);
    EXPECT_EQ(doubt->unit.metres, 1.0);
    EXPECT_TRUE(test::says(text(*doubt), "17.8 mm tall metres 1.78 m"));
}

TEST(UnitOfAFile, IsNotDoubtedForAChildOrAThing) {
    const auto doubt = [](double scale) {
        Character figure = stick_figure();
        read_as(figure, scale, {});
        figure.scale = 1.0;
        return doubt_of(figure);
    };
    for (const double scale : {0.3, 0.5, 1.0, 1.6}) EXPECT_FALSE(doubt(scale)) << scale;
    for (const double scale : {0.2, 2.0, 100.0}) EXPECT_TRUE(doubt(scale)) << scale;
    EXPECT_STREQ(doubt(2.0)->unit.name, "") << "3.6 m, or in decimetres 0.36 m";
    EXPECT_NEAR(doubt(2.0)->then, 1.75, 1e-12);
}

}  // namespace
}  // namespace tendril::app::bvh_space
