// Feet of IK rigs that hang outside the legs: they are moved below them, and every joint moves as before.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <tendril/humanoid/attach.hpp>
#include <tendril/humanoid/body.hpp>
#include <tendril/humanoid/lint.hpp>

#include "app/io/character/bake.hpp"
#include "app/io/character/bvh.hpp"
#include "app/io/character/character.hpp"
#include "app/io/character/export.hpp"
#include "app/io/character/gltf.hpp"
#include "app/io/character/gltf_write.hpp"
#include "app/io/character/stick_figure.hpp"
#include "app/io/json.hpp"
#include "tests/app/io/posed.hpp"
#include "tests/app/support/temp_folder.hpp"
#include "tests/core/humanoid_feet_support.hpp"
#include "tests/labels.hpp"
#include "tests/places.hpp"
#include "tests/says.hpp"

namespace tendril::app {
namespace {

namespace fs = std::filesystem;
using humanoid::Bone;
using humanoid::Clip;
using humanoid::Placement;
using humanoid::Skeleton;
using test_posed::placed_in;

/// The figure's walk with these feet as roots that keep their positions, moved by `off`.
Character ik_rig(const std::vector<std::string>& feet, const glm::dvec3& off = glm::dvec3(0.0),
                 double rate = 30.0) {
    Character rig = stick_figure();
    rig.clips.resize(1);
    const Skeleton before = rig.skeleton;
    const Clip walk = rig.clips[0];
    const std::vector<Placement> rest = test_posed::placed(rig, -1);
    std::vector<humanoid::Node> nodes = before.nodes();
    for (const std::string& name : feet) {
        const std::size_t foot = before.find(name).value();
        nodes[foot].parent = -1;
        nodes[foot].rest = humanoid::relative(Placement(), rest[foot]);
        nodes[foot].rest.translation += off;
        std::erase_if(rig.clips[0].channels, [&](const auto& each) { return each.node == foot; });
        humanoid::Channel channel{.node = foot};
        for (double time = 0.0; time <= walk.duration; time += 1.0 / rate) {
            const rig::Transform at = humanoid::relative(Placement(), placed_in(before, walk, time)[foot]);
            channel.translation.times.push_back(time);
            channel.translation.values.push_back(at.translation + off);
            channel.rotation.values.push_back(at.rotation);
        }
        channel.rotation.times = channel.translation.times;
        rig.clips[0].channels.push_back(channel);
    }
    rig.skeleton = skeleton_of(std::move(nodes));
    return rig;
}

const std::vector<std::string> both_feet{"LeftFoot", "RightFoot"};

void expect_same_motion(const Character& before, const Character& after) {
    ASSERT_EQ(before.skeleton.size(), after.skeleton.size());
    ASSERT_EQ(before.clips, after.clips) << "keys stay as they are";
    std::vector<Clip> clips = before.clips;
    clips.push_back({.name = "rest", .duration = 0.0, .channels = {}});
    for (const Clip& clip : clips) {
        for (int i = 0; i <= 233; ++i) {
            const double time = clip.duration * i / 233.0;
            const auto was = placed_in(before.skeleton, clip, time),
                       is = placed_in(after.skeleton, clip, time);
            for (std::size_t node = 0; node < was.size(); ++node) {
                const std::string where = clip.name + ' ' + before.skeleton[node].name;
                ASSERT_LT(glm::distance(was[node].position, is[node].position), 1e-9) << where;
                for (int axis = 0; axis < 3; ++axis)
                    ASSERT_LT(glm::distance(was[node].axes[axis], is[node].axes[axis]), 1e-4) << where;
            }
        }
    }
}

std::string all_notes(const Character& character) {
    return test_posed::lines(character.notes);
}

class LooseFeet : public ::testing::Test {
  protected:
    fs::path file(const char* name) const { return folder_ / name; }
    fs::path written(const Character& character, const char* name) const {
        std::ofstream(file(name), std::ios::binary)
            << gltf_bytes(character, character.clips[0], 0.0, {}, true);
        return file(name);
    }
    static Character as_in_file(const fs::path& path) {
        return parse_gltf(character_bytes(path), path.filename().string(), path.parent_path());
    }
    /// An export has the file's hierarchy and the motion of `clip`.
    void expect_exported(const Character& character, const fs::path& from, const Clip& clip) const {
        const Character before = as_in_file(from);
        for (const char* name : {"out.glb", "out.bvh"}) {
            SCOPED_TRACE(name);
            const ExportReport report =
                export_clip({character, from.string(), character.clips[0], clip, 60.0}, file(name));
            EXPECT_LT(report.worst, 5e-4) << report.text();
            if (std::string(name).ends_with("bvh")) continue;
            EXPECT_TRUE(std::ranges::equal(as_in_file(file(name)).skeleton.nodes(), before.skeleton.nodes(),
                                           {}, &humanoid::Node::parent, &humanoid::Node::parent));
        }
    }
    static void expect_works(const Character& character) {
        const humanoid::BoneMap map = bone_map(character);
        EXPECT_TRUE(map.is_usable());
        for (const auto& [foot, leg] : {std::pair(Bone::LeftFoot, Bone::LeftLowerLeg),
                                        std::pair(Bone::RightFoot, Bone::RightLowerLeg)}) {
            ASSERT_GE(map[foot].node, 0);
            EXPECT_EQ(character.skeleton[static_cast<std::size_t>(map[foot].node)].parent, map[leg].node);
        }
        const auto feet = humanoid::Feet::make(character.skeleton, map);
        EXPECT_TRUE(feet) << feet.message();
        const auto body = humanoid::Body::make(character.skeleton, map);
        EXPECT_TRUE(body) << body.message();
    }

  private:
    test::TempFolder folder_;
};

TEST_F(LooseFeet, MoveBelowTheLegsAndEveryJointMovesAsBefore) {
    const fs::path path = written(ik_rig(both_feet), "rig.glb");
    const Character before = as_in_file(path), after = read_character(path);
    EXPECT_FALSE(bone_map(before).is_usable());
    expect_works(after);
    expect_same_motion(before, after);
    EXPECT_TRUE(
        test::says(all_notes(after), "LeftFoot was moved below LeftLowerLeg RightFoot RightLowerLeg"));
}

TEST_F(LooseFeet, WorkWithAnotherUnitAndAxis) {
    Character before = ik_rig(both_feet), after = before;
    attach_feet(after);
    EXPECT_EQ(after.skeleton.moved().size(), 2u);
    for (Character* each : {&before, &after}) {
        std::vector<humanoid::Node> nodes = each->skeleton.nodes();
        normalise(nodes, each->clips, 2.5, {std::sqrt(0.5), -std::sqrt(0.5), 0.0, 0.0});
        each->skeleton = skeleton_of(std::move(nodes));
    }
    expect_same_motion(before, after);
}

TEST_F(LooseFeet, WorkInTheRobotFile) {
    const fs::path path = test::characters_folder() / "robot.glb";
    if (!fs::exists(path)) GTEST_SKIP() << path << " is not there";
    const Character before = as_in_file(path), after = read_character(path);
    expect_works(after);
    expect_same_motion(before, after);
    for (const Clip& clip : after.clips) {
        if (clip.name != "Robot_Walking") continue;
        expect_exported(after, path, clip);
        expect_exported(
            after, path,
            with_feet_on(*humanoid::Ground::slope(0.2), after.skeleton, bone_map(after), clip, 60.0));
    }
}

TEST_F(LooseFeet, StandOnTheGroundAndAreBakedAndExported) {
    const fs::path path = written(ik_rig(both_feet, glm::dvec3(0.0), 240.0), "rig.glb");
    const Character rig = read_character(path);
    const humanoid::Ground slope = *humanoid::Ground::slope(0.2);
    test::Walker walker(rig.skeleton, rig.clips[0]);
    const test::Measured all = walker.walk(slope, {.seconds = 4.0});
    EXPECT_GT(all.planted, all.feet / 4);
    EXPECT_LT(all.sink, 0.005);
    EXPECT_LT(all.floating, 0.005);
    EXPECT_LT(all.skate, 0.005);
    expect_exported(rig, path, rig.clips[0]);
    const Clip baked = with_feet_on(slope, rig.skeleton, bone_map(rig), rig.clips[0], 60.0);
    expect_exported(rig, path, baked);
    const Character figure = stick_figure();
    const Clip same = with_feet_on(slope, figure.skeleton, bone_map(figure), figure.clips[0], 60.0);
    for (double time = 0.0; time < baked.duration; time += 0.1) {
        const auto wanted = placed_in(figure.skeleton, same, time),
                   found = placed_in(rig.skeleton, baked, time);
        for (std::size_t node = 0; node < wanted.size(); ++node)
            EXPECT_LT(glm::distance(wanted[node].position,
                                    found[rig.skeleton.find(figure.skeleton[node].name).value()].position),
                      0.01)
                << figure.skeleton[node].name << " at " << time;
    }
}

/// The cure moves the foot: its keys are not local to the leg.
TEST_F(LooseFeet, SinkingFeetAreCured) {
    Character rig = ik_rig(both_feet);
    attach_feet(rig);
    const humanoid::BoneMap map = bone_map(rig);
    const auto foot = static_cast<std::size_t>(map[Bone::LeftFoot].node);
    Clip sunk = rig.clips[0];
    for (humanoid::Channel& channel : sunk.channels)
        if (channel.node == foot)
            for (glm::dvec3& value : channel.translation.values)
                if (value.y < 0.12) value.y -= 0.03;
    const auto worst = [&](const Clip& clip) {
        std::optional<humanoid::Finding> found;
        for (const humanoid::Finding& each : lint(rig.skeleton, map, clip).findings)
            if (each.has_cure &&
                (each.fault == humanoid::Fault::Sinking || each.fault == humanoid::Fault::Skating ||
                 each.fault == humanoid::Fault::Floating) &&
                (!found || each.amount > found->amount))
                found = each;
        return found;
    };
    Clip cured = sunk;
    const auto first = worst(sunk);
    ASSERT_TRUE(first);
    for (int i = 0; i < 12; ++i) {
        const auto next = worst(cured);
        if (!next) break;
        auto made = cure(rig.skeleton, map, cured, *next);
        ASSERT_TRUE(made) << made.message();
        cured = std::move(*made);
    }
    const auto left = worst(cured);
    EXPECT_TRUE(!left || left->amount < 0.5 * first->amount) << first->text << " / " << left->text;
}

TEST_F(LooseFeet, ASingleFootMovesBelowItsLeg) {
    const Character rig = read_character(written(ik_rig({"RightFoot"}), "rig.glb"));
    expect_works(rig);
    EXPECT_EQ(rig.notes.size(), 1u);
    std::vector<humanoid::Node> nodes = ik_rig({"RightFoot"}).skeleton.nodes();
    for (humanoid::Node& node : nodes)
        if (node.name.starts_with("LeftFoot")) node.name = "x" + std::to_string(&node - nodes.data());
    const Skeleton lacking = *Skeleton::make(nodes);
    const auto loose = humanoid::loose_feet(lacking, humanoid::match_bones(lacking));
    ASSERT_EQ(loose.size(), 1u);
    EXPECT_EQ(loose[0].bone, Bone::RightFoot);
    EXPECT_TRUE(loose[0].fits);
}

TEST_F(LooseFeet, FeetAwayFromTheLegsStayWithANote) {
    for (const glm::dvec3& off : {glm::dvec3(0.0, 0.0, 0.9), glm::dvec3(0.0, 0.42, 0.0)}) {
        const fs::path path = written(ik_rig(both_feet, off), "rig.glb");
        const Character before = as_in_file(path), after = read_character(path);
        EXPECT_EQ(before.skeleton, after.skeleton);
        EXPECT_FALSE(bone_map(after).is_usable());
        EXPECT_TRUE(
            test::says(all_notes(after), "LeftFoot is not mapped outside the leg LeftLowerLeg RightFoot"));
    }
}

TEST_F(LooseFeet, FeetOfTwoRigsStayWithTheirOwn) {
    const Character one = ik_rig(both_feet);
    std::vector<humanoid::Node> nodes{{.name = "RigB"}, {.name = "RigA"}};
    for (const char* suffix : {"", "_2"}) {
        const auto first = static_cast<std::int32_t>(nodes.size());
        for (humanoid::Node node : one.skeleton.nodes()) {
            node.parent = node.parent >= 0 ? node.parent + first : (first > 2 ? 1 : 0);
            node.name += suffix;
            nodes.push_back(std::move(node));
        }
    }
    Character two;
    two.skeleton = *Skeleton::make(nodes);
    attach_feet(two);
    EXPECT_TRUE(bone_map(two).is_usable());
    EXPECT_EQ(two.skeleton.moved().size(), 2u);
    const humanoid::BoneMap map = bone_map(two);
    for (const Bone foot : {Bone::LeftFoot, Bone::RightFoot}) {
        const auto node = static_cast<std::size_t>(map[foot].node);
        EXPECT_TRUE(two.skeleton.is_below(node, static_cast<std::size_t>(map[Bone::Hips].node)));
        std::int32_t rig_of_foot = two.skeleton[node].key_parent();
        EXPECT_TRUE(two.skeleton.is_below(static_cast<std::size_t>(map[Bone::Hips].node),
                                          static_cast<std::size_t>(rig_of_foot)));
    }
}

TEST_F(LooseFeet, FeetBelowAShearedOrVanishingLegStayWithANote) {
    for (const glm::dvec3& scale : {glm::dvec3(1.0, 3.0, 1.0), glm::dvec3(0.0)}) {
        Character rig = ik_rig(both_feet);
        const std::size_t leg = rig.skeleton.find("LeftLowerLeg").value();
        const auto channel = std::ranges::find(rig.clips[0].channels, leg, &humanoid::Channel::node);
        ASSERT_NE(channel, rig.clips[0].channels.end());
        channel->scale = {humanoid::Interpolation::Linear, {0.0, 0.2}, {glm::dvec3(1.0), scale}};
        const Skeleton before = rig.skeleton;
        attach_feet(rig);
        const std::size_t left = before.find("LeftFoot").value(), right = before.find("RightFoot").value();
        EXPECT_EQ(rig.skeleton[left].parent, -1);
        EXPECT_GE(rig.skeleton[right].parent, 0);
        EXPECT_TRUE(test::says(all_notes(rig), "LeftFoot is not mapped scale of LeftLowerLeg"));
    }
}

TEST(Attached, KeepsWhatItCannotMoveAndComesBack) {
    const Skeleton rig = ik_rig(both_feet).skeleton;
    const std::size_t foot = rig.find("LeftFoot").value(), leg = rig.find("LeftLowerLeg").value();
    const auto moved = humanoid::attached(rig, foot, leg);
    ASSERT_TRUE(moved) << moved.message();
    EXPECT_EQ(humanoid::detached(*moved), rig);
    EXPECT_TRUE(
        test::says(humanoid::attached(*moved, foot, leg).message(), "attached moved before LeftFoot"));
    EXPECT_FALSE(humanoid::attached(rig, leg, leg));
    EXPECT_FALSE(humanoid::attached(rig, rig.size(), leg));
    EXPECT_FALSE(humanoid::attached(rig, rig.find("Hips").value(), leg));
    // Key spaces must not depend on one another.
    std::vector<humanoid::Node> nodes = moved->nodes();
    nodes[leg].keys = humanoid::KeySpace{};
    EXPECT_TRUE(test::says(Skeleton::make(nodes).message(), "keys neither above nor below"));
    nodes[leg].keys.reset();
    nodes[foot].keys->parent = 9999;
    EXPECT_TRUE(test::says(Skeleton::make(nodes).message(), "keys.parent 9999"));
}

// The figure's walk, and third-party clips, with their feet on the ground.

using test::WalkOptions;

const double pi = std::acos(-1.0);

std::vector<humanoid::Ground> grounds() {
    return {*humanoid::Ground::flat(), *humanoid::Ground::slope(20.0 * pi / 180.0),
            *humanoid::Ground::stairs(0.15, 0.3)};
}

void expect_stands(const test::Measured& all) {
    EXPECT_LT(all.sink, 0.005);
    EXPECT_LT(all.floating, 0.005);
    EXPECT_LT(all.skate, 0.005);
    EXPECT_LE(all.stretch, 0.995 + 1e-6);
}

LABEL(slow, "CharacterFeet.ClipsThatOthersMadeStandToo");
LABEL(slow, "LooseFeet.WorkInTheRobotFile");

TEST(CharacterFeet, TheFiguresSolesAreWhereItsBuilderPutsThem) {
    const Character figure = stick_figure();
    const auto soles = humanoid::find_soles(figure.skeleton, humanoid::match_bones(figure.skeleton));
    ASSERT_TRUE(soles) << soles.message();
    const std::vector<Placement> placements = test_posed::placed(figure, -1);
    const auto points = sole_points(*soles, placements);
    for (std::size_t i = 0; i < 2; ++i) {
        const glm::dvec3 ankle = placements[soles->feet[i].foot].position;
        EXPECT_LT(glm::distance(points[i].heel, ankle + stick_heel), 1e-9);
        EXPECT_LT(glm::distance(points[i].toe, ankle + stick_toe), 1e-9);
    }
}

TEST(CharacterFeet, ClipsThatOthersMadeStandToo) {
    if (!fs::is_directory(tendril::test::characters_folder()))
        GTEST_SKIP() << tendril::test::characters_folder() << " is not there";
    int walked = 0;
    for (const auto& entry : fs::directory_iterator(tendril::test::characters_folder())) {
        if (!entry.is_regular_file() || !ends_as_character(entry.path())) continue;
        const Character character = read_character(entry.path());
        const auto soles =
            humanoid::find_soles(character.skeleton, humanoid::match_bones(character.skeleton));
        if (!soles || soles->leg > 2.0) continue;  // no body, or one in other units
        for (const humanoid::Clip& clip : character.clips) {
            WalkOptions walk{.seconds = std::min(clip.duration, 10.0)};
            walk.options.floor = clip_floor(character.skeleton, *soles, clip);
            test::Walker walker(character.skeleton, clip);
            for (const humanoid::Ground& ground : grounds()) {
                SCOPED_TRACE(entry.path().filename().string() + ' ' + clip.name + ' ' + name(ground.kind()));
                const test::Measured all = walker.walk(ground, walk);
                expect_stands(all);
                EXPECT_LT(all.beyond, 0.060 * std::max(1.0, soles->leg / 0.9));  // longer legs, faster knees
                ++walked;
            }
        }
    }
    EXPECT_GT(walked, 0);
}

}  // namespace
}  // namespace tendril::app
