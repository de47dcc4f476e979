// Motion lint on the built-in figure's clips, with and without planted faults, and on third-party files.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <stdexcept>

#include "app/io/character/character.hpp"
#include "app/io/json_complete.hpp"
#include "tests/app/io/lint_support.hpp"
#include "tests/core/random.hpp"
#include "tests/labels.hpp"
#include "tests/places.hpp"
#include "tests/says.hpp"

namespace tendril::app {
namespace {

using tendril::test::Random;

class LintTest : public LintFigure {
  protected:
    std::int32_t node(const char* name) const { return static_cast<std::int32_t>(*skeleton.find(name)); }
    Skeleton lying_figure() const {
        std::vector<Node> nodes = skeleton.nodes();
        nodes[0].rest.rotation = glm::angleAxis(glm::radians(90.0), glm::dvec3(1, 0, 0));
        return *Skeleton::make(nodes);
    }
    /// Expects findings, all of this kind and node.
    void expect_only(const Clip& clip, Fault fault, const char* name, std::size_t first, std::size_t last,
                     double amount, double tolerance) const {
        const LintReport report = run(clip);
        ASSERT_FALSE(report.findings.empty());
        for (const Finding& each : report.findings) {
            EXPECT_EQ(humanoid::name(each.fault), std::string(humanoid::name(fault))) << each.text;
            EXPECT_EQ(each.node, node(name)) << each.text;
            EXPECT_GE(each.frame, first) << each.text;
            EXPECT_LE(each.frame, last) << each.text;
            EXPECT_NEAR(each.amount, amount, tolerance) << each.text;
        }
        EXPECT_EQ(report.findings.size(), 1u) << texts(report);
    }
};

/// 0 up to frame `first`, 1 from frame `last` on.
double ramp(std::size_t frame, std::size_t first, std::size_t last) {
    if (frame <= first) return 0.0;
    if (frame >= last) return 1.0;
    return static_cast<double>(frame - first) / static_cast<double>(last - first);
}

TEST_F(LintTest, FindsNothingInItsOwnClips) {
    for (const Clip& clip : figure.clips) {
        const LintReport report = run(clip);
        EXPECT_TRUE(report.findings.empty()) << clip.name << ": " << texts(report);
        EXPECT_TRUE(report.has_floor);
        EXPECT_NEAR(report.floor, 0.0, 0.01);
    }
}

TEST_F(LintTest, FindsNothingInVariationsOfThem) {
    Random random(10);
    constexpr double rates[]{24.0, 25.0, 30.0, 50.0, 60.0, 90.0, 120.0};
    for (int i = 0; i < 150; ++i) {
        const bool walks = i % 3 != 0;
        Clip clip = figure.clips[walks ? 0 : 1];
        const double faster = 1.0 + 0.25 * static_cast<double>(random.around(1.0f));
        clip.duration /= faster;
        for (Channel& channel : clip.channels) {
            for (double& time : channel.rotation.times) time = std::min(time / faster, clip.duration);
            for (double& time : channel.translation.times) time = std::min(time / faster, clip.duration);
        }
        const double rate = rates[random.below(7)];
        Frames frames(skeleton, clip, rate, 1.0 + static_cast<double>(random.below(3)));
        const double angle = 3.2 * static_cast<double>(random.around(1.0f));
        const glm::dquat turn = glm::angleAxis(angle, glm::dvec3(0, 1, 0));
        const glm::vec3 point = random.point(20.0f);
        const bool in_place = random.chance(4), lifted = random.chance(3);
        const double pace = walks ? faster / rate : 0.0;  // metres that the walk advances per frame
        for (std::size_t k = 0; k < frames.poses.size(); ++k) {
            rig::Transform& root = frames.poses[k][0];
            if (in_place) root.translation.z -= pace * static_cast<double>(k);
            root.translation = turn * root.translation + glm::dvec3(point.x, lifted ? 3.0 : 0.0, point.z);
            root.rotation = turn * root.rotation;
        }
        const LintReport report = run(frames.clip());
        EXPECT_TRUE(report.findings.empty())
            << i << ", " << clip.name << " at " << rate << ", " << faster << " times as fast"
            << (in_place ? ", in place" : "") << ": " << texts(report);
    }
}

TEST_F(LintTest, FindsASkatingFoot) {
    // The left foot is flat on the ground from 0.11 s to 0.39 s of each 1.1 s.
    for (const double rate : {30.0, 60.0}) {
        const auto at = [&](double seconds) { return static_cast<std::size_t>(std::lround(seconds * rate)); };
        for (const glm::dvec3& way :
             {glm::dvec3(0.06, 0, 0), glm::dvec3(0, 0, -0.1), glm::dvec3(0.03, 0, 0.03)}) {
            Frames frames = walk(rate);
            const std::size_t first = at(1.1 + 0.15), last = at(1.1 + 0.35);
            for (std::size_t k = first; k < at(1.1 + 0.9); ++k)
                frames.move_foot(k, "Left", way * ramp(k, first, last) * (1.0 - ramp(k, at(1.9), at(2.0))));
            expect_only(frames.clip(), Fault::Skating, "LeftFoot", first, last + 1, 1000.0 * glm::length(way),
                        0.35 * 1000.0 * glm::length(way));
        }
    }
}

TEST_F(LintTest, FindsFeetSlowerThanTheBody) {
    Frames frames = walk();
    for (std::size_t k = 0; k < frames.poses.size(); ++k) frames.poses[k][0].translation.z *= 1.25;
    const LintReport report = run(frames.clip());
    EXPECT_GE(report.findings.size(), 4u);
    for (const Finding& each : report.findings) EXPECT_EQ(each.fault, Fault::Skating) << each.text;
}

TEST_F(LintTest, FindsLoweredHipsAndFloatingFeet) {
    for (const double by : {-0.06, -0.035, 0.04, 0.06}) {
        Frames frames = walk();
        for (std::size_t k = 60; k < 120; ++k)
            frames.poses[k][0].translation.y += by * ramp(k, 60, 75) * (1.0 - ramp(k, 105, 119));
        const LintReport report = run(frames.clip());
        ASSERT_FALSE(report.findings.empty()) << by;
        for (const Finding& each : report.findings) {
            EXPECT_EQ(each.fault, by < 0.0 ? Fault::Sinking : Fault::Floating) << each.text;
            // The toe tip dips by 20 mm when a foot lifts.
            EXPECT_NEAR(each.amount, 1000.0 * std::abs(by), 21.0) << each.text;
            EXPECT_GE(each.frame, 60u);
            EXPECT_LE(each.frame, 120u);
        }
    }
}

TEST_F(LintTest, FindsAndFixesAPoppingKnee) {
    Random random(4);
    for (int i = 0; i < 60; ++i) {
        const double rate = i % 2 == 0 ? 30.0 : 60.0;
        Frames frames = walk(rate);
        const char* const side = random.chance(2) ? "Left" : "Right";
        const std::size_t frame = 5 + random.below(frames.poses.size() - 10);
        const double degrees = 25.0 + static_cast<double>(random.below(30));
        const std::string knee = std::string(side) + "LowerLeg";
        frames.at(frame, knee.c_str()).rotation *= glm::angleAxis(glm::radians(degrees), glm::dvec3(1, 0, 0));
        const Clip clip = frames.clip();
        const LintReport report = run(clip);
        const auto pop = std::ranges::find(report.findings, Fault::KneePop, &Finding::fault);
        ASSERT_NE(pop, report.findings.end())
            << i << ", frame " << frame << ", " << degrees << ": " << texts(report);
        EXPECT_EQ(pop->node, node(knee.c_str()));
        EXPECT_EQ(pop->frame, frame);
        EXPECT_NEAR(pop->amount, degrees, 0.3 * degrees);
        for (const Finding& each : report.findings) EXPECT_NE(each.fault, Fault::Skating) << each.text;
        ASSERT_TRUE(pop->has_cure);
        const LintReport after = run(*cure(skeleton, map, clip, *pop));
        EXPECT_TRUE(after.findings.empty()) << i << ": " << texts(after);
    }
}

TEST_F(LintTest, FindsAKneeThatSnapsStraight) {
    // The right foot goes beyond its leg's reach, as careless foot IK moves it.
    Frames frames = walk();
    for (std::size_t k = 40; k < 60; ++k) {
        const glm::dvec3 hip = frames.placed(k)[*skeleton.find("RightUpperLeg")].position;
        const glm::dvec3 foot = frames.placed(k)[*skeleton.find("RightFoot")].position;
        const double far = 0.60 + 0.018 * static_cast<double>(k - 40);
        frames.move_foot(k, "Right", hip + glm::normalize(foot - hip) * far - foot);
    }
    const LintReport report = run(frames.clip());
    EXPECT_TRUE(std::ranges::any_of(report.findings, [&](const Finding& each) {
        return each.fault == Fault::KneePop && each.node == node("RightLowerLeg") && each.frame > 45 &&
               each.frame < 62;
    })) << texts(report);
}

TEST_F(LintTest, FindsKneesAndElbowsBentTheWrongWay) {
    for (const double most : {40.0, 50.0, 60.0, 110.0})
        for (const bool is_knee : {true, false}) {
            Frames frames = walk();
            const char* const name = is_knee ? "LeftLowerLeg" : "RightLowerArm";
            for (std::size_t k = 0; k < frames.poses.size(); ++k) {
                const double bend = most * ramp(k, 60, 90) * (1.0 - ramp(k, 110, 140));
                frames.at(k, name).rotation =
                    glm::angleAxis(glm::radians(is_knee ? -bend : bend),
                                   is_knee ? glm::dvec3(1, 0, 0) : glm::dvec3(0, -1, 0));
            }
            const LintReport report = run(frames.clip());
            const auto fault = std::ranges::find(report.findings, Fault::Limit, &Finding::fault);
            ASSERT_NE(fault, report.findings.end()) << name << ' ' << most << ": " << texts(report);
            EXPECT_EQ(fault->node, node(name)) << fault->text;
            EXPECT_GE(fault->frame, 80u);
            EXPECT_LE(fault->frame, 112u);
            EXPECT_GT(fault->amount, 0.6 * most) << fault->text;
            EXPECT_LT(fault->amount, most + 1.0) << fault->text;
            EXPECT_STREQ(fault->unit, "deg");
        }
}

TEST_F(LintTest, FindsAKneeBentSidewaysOrTwistedAndStatesTheTolerance) {
    for (const glm::dvec3& axis : {glm::dvec3(0, 0, 1), glm::dvec3(0, 0, -1), glm::dvec3(0, 1, 0)})
        for (const double most : {15.0, 40.0, 80.0}) {
            Frames frames = walk();
            for (std::size_t k = 40; k < 80; ++k) {
                glm::dquat& knee = frames.at(k, "LeftLowerLeg").rotation;
                knee = knee * glm::angleAxis(glm::radians(most * ramp(k, 40, 60)), axis);
            }
            const LintReport report = run(frames.clip());
            const auto fault = std::ranges::find(report.findings, Fault::Limit, &Finding::fault);
            ASSERT_EQ(fault != report.findings.end(), most > 20.0) << texts(report);
            if (fault == report.findings.end()) continue;
            EXPECT_NEAR(fault->amount, most, 0.2 * most) << fault->text;
            EXPECT_TRUE(test::says(fault->text, "LeftLowerLeg beyond its limit 20 are tolerated"))
                << fault->text;
        }
}

/// However the thigh is twisted on its way up: beyond a right angle that is a swing to another side.
TEST_F(LintTest, AnAmountBeyondALimitIsTheSmallestRotationBack) {
    const auto about = [](const glm::dvec3& axis, double degrees) {
        return glm::angleAxis(glm::radians(degrees), axis);
    };
    for (const double lift : {156.0, 170.0})
        for (const double twist : {0.0, 20.0, -40.0, 44.0}) {
            Frames frames = walk();
            for (std::size_t k = 0; k < frames.poses.size(); ++k)
                frames.at(k, "LeftUpperLeg").rotation =
                    about({1, 0, 0}, -lift) * about({0, 1, 0}, twist) * about({0, 0, 1}, 0.3 * twist);
            BodyLimits limits = default_limits(skeleton, map);
            const LintReport report = lint(skeleton, map, frames.clip(), {.limits = &limits});
            const auto fault = std::ranges::find(report.findings, node("LeftUpperLeg"), &Finding::node);
            ASSERT_NE(fault, report.findings.end()) << texts(report);
            EXPECT_GT(fault->amount, lift - 120.0 - 15.0) << twist << ": " << fault->text;
            EXPECT_LT(fault->amount, lift - 120.0 + 1.0) << twist << ": " << fault->text;
        }
}

TEST_F(LintTest, UsesTheGivenLimits) {
    const Clip clip = walk().clip();
    const BodyLimits like = default_limits(skeleton, map);
    const BodyLimits learned = learned_limits(skeleton, map, std::span(&clip, 1), like);
    EXPECT_TRUE(lint(skeleton, map, clip, {.limits = &learned}).findings.empty());
    // The punch goes beyond the walk.
    const LintReport report = lint(skeleton, map, figure.clips[1], {.limits = &learned});
    EXPECT_FALSE(report.findings.empty());
    for (const Finding& each : report.findings) EXPECT_EQ(each.fault, Fault::Limit) << each.text;
    const BodyLimits none = no_limits();
    EXPECT_TRUE(lint(skeleton, map, figure.clips[1], {.limits = &none}).findings.empty());
}

TEST_F(LintTest, FindsAWalkThatLiesOnItsSide) {
    for (const glm::dvec3& axis : {glm::dvec3(1, 0, 0), glm::dvec3(-1, 0, 0), glm::dvec3(0, 0, 1)}) {
        Clip clip = figure.clips[0];
        const glm::dquat turn = glm::angleAxis(glm::radians(90.0), axis);
        for (glm::dvec3& value : clip.channels[0].translation.values) value = turn * value;
        for (glm::dquat& value : clip.channels[0].rotation.values) value = turn * value;
        const LintReport report = run(clip);
        const auto fault = std::ranges::find(report.findings, Fault::Axis, &Finding::fault);
        ASSERT_NE(fault, report.findings.end()) << texts(report);
        EXPECT_NEAR(fault->amount, 90.0, 1e-6);
        const LintReport after = run(*cure(skeleton, map, clip, *fault));
        EXPECT_TRUE(after.findings.empty()) << texts(after);
    }
}

TEST_F(LintTest, FindsAFigureThatRestsOnItsSideOrIsAGiant) {
    const Skeleton lying = lying_figure();
    const LintReport report = lint(lying, match_bones(lying), Clip{.name = "none"});
    ASSERT_EQ(report.findings.size(), 1u) << texts(report);
    EXPECT_EQ(report.findings[0].fault, Fault::Axis);
    EXPECT_NEAR(report.findings[0].amount, 90.0, 6.0);

    std::vector<Node> nodes = skeleton.nodes();
    for (Node& each : nodes) each.rest.translation *= 100.0;
    const Skeleton giant = *Skeleton::make(nodes);
    const LintReport tall = lint(giant, match_bones(giant), Clip{.name = "none"});
    ASSERT_EQ(tall.findings.size(), 1u) << texts(tall);
    EXPECT_EQ(tall.findings[0].fault, Fault::Scale);
    EXPECT_NEAR(tall.findings[0].amount, 180.0, 1.0);
}

/// Some files store motion relative to a rest pose that lies down, although the figure walks upright.
TEST_F(LintTest, ALyingRestPoseIsNoFaultIfTheFigureWalksUpright) {
    const Skeleton lying = lying_figure();
    for (const Clip& clip : figure.clips)
        for (const Finding& each : lint(lying, match_bones(lying), clip).findings)
            EXPECT_NE(each.fault, Fault::Axis) << each.text;
}

/// A rig may put all of an arm's twist into the forearm, or into the collar bone: the arm looks the same.
TEST_F(LintTest, AnArmIsJudgedByItsShapeHoweverItsTwistIsDivided) {
    const glm::dvec3 along(1, 0, 0);  // the left arm's
    const auto twisted = [&](double degrees) {
        Frames frames = walk();
        for (std::size_t k = 0; k < frames.poses.size(); ++k) {
            frames.at(k, "LeftUpperArm").rotation = glm::dquat(1, 0, 0, 0);
            frames.at(k, "LeftLowerArm").rotation = glm::angleAxis(glm::radians(degrees), along) *
                                                    glm::angleAxis(glm::radians(-100.0), glm::dvec3(0, 1, 0));
        }
        return run(frames.clip());
    };
    for (const double twist : {0.0, 70.0, -70.0, 85.0})
        EXPECT_TRUE(twisted(twist).findings.empty()) << twist << ": " << texts(twisted(twist));
    // A fifth of a turn beyond the shoulder's range, it bends backwards.
    const LintReport report = twisted(165.0);
    ASSERT_EQ(report.findings.size(), 1u) << texts(report);
    EXPECT_EQ(report.findings[0].fault, Fault::Limit);
    EXPECT_EQ(report.findings[0].node, node("LeftLowerArm"));
}

namespace fs = std::filesystem;

/// The faults of each third-party file that can be read; empty: careful work, in which nothing may be
/// found.
const std::map<std::string, std::set<std::string>>& faults_of_files() {
    static const std::map<std::string, std::set<std::string>> faults = [] {
        std::map<std::string, std::set<std::string>> all;
        const Json file = read_json_file(tendril::test::source_path("tests/app/data/faults_of_files.json"));
        for (const auto& [name, row] : file.items()) all[name] = row.at("faults");
        return all;
    }();
    return faults;
}

/// The files of both folders that can be read, by name.
template <class Use>
void for_each_file(const Use& use) {
    for (const fs::path& folder : {tendril::test::characters_folder(), tendril::test::found_path("")}) {
        if (!fs::is_directory(folder)) continue;
        for (const auto& entry : fs::directory_iterator(folder)) {
            if (!ends_as_character(entry.path())) continue;
            Character character;
            try {
                character = read_character(entry.path());
            } catch (const std::runtime_error&) {
                continue;  // covered by another test
            }
            use(entry.path().filename().string(), character);
        }
    }
}

bool has_files() {
    return fs::is_directory(tendril::test::characters_folder()) &&
           fs::is_directory(tendril::test::found_path(""));
}

LABEL(slow, "LintFiles.*");
LABEL(slow, "LintTest.FindsAndFixesAPoppingKnee");

TEST(LintFiles, ThirdPartyFilesHaveTheKnownFaults) {
    if (!has_files()) GTEST_SKIP() << "they are not there";
    std::size_t files = 0;
    for_each_file([&](const std::string& name, const Character& character) {
        SCOPED_TRACE(name);
        ++files;
        const auto known = faults_of_files().find(name);
        if (known == faults_of_files().end()) {
            ADD_FAILURE() << "not in the table";
            return;
        }
        std::map<Fault, int> counts;
        for (const Clip& clip : character.clips)
            for (const Finding& each : lint(character.skeleton, bone_map(character), clip).findings) {
                EXPECT_TRUE(known->second.count(humanoid::name(each.fault)))
                    << clip.name << ": " << each.text;
                ++counts[each.fault];
            }
        EXPECT_EQ(counts.size(), known->second.size());
        if (name == "robot.glb") {
            EXPECT_EQ(counts[Fault::SignFlip], 7) << "one in each of seven clips";
            EXPECT_EQ(counts[Fault::Limit], 1) << "it falls on its chest; its arms do what arms do";
        }
    });
    EXPECT_EQ(files, faults_of_files().size());
}

/// A third-party clip with a key in each frame, into which faults are planted.
class PlantedClip {
  public:
    PlantedClip(const Character& character, const Clip& clip)
        : character_(character), map_(bone_map(character)) {
        const Skeleton& skeleton = character.skeleton;
        height = bounds_at_rest(character, test_posed::placed(character, -1)).height();
        keys = {.name = clip.name, .duration = clip.duration, .channels = {}};
        for (std::size_t node = 0; node < skeleton.size(); ++node) keys.channels.push_back({.node = node});
        const humanoid::Frames frames = frames_at(clip, frame_rate(clip));
        std::vector<rig::Transform> pose(skeleton.size());
        for (std::size_t i = 0; i < frames.count; ++i) {
            const double time = std::min(frames.time(i), clip.duration);
            sample(clip, skeleton, time, pose);
            for (Channel& channel : keys.channels) {
                const rig::Transform key = key_of(skeleton, pose, channel.node);
                channel.translation.times.push_back(time);
                channel.translation.values.push_back(key.translation);
                auto& turns = channel.rotation.values;
                const bool is_flipped = !turns.empty() && glm::dot(turns.back(), key.rotation) < 0.0;
                channel.rotation.times.push_back(time);
                turns.push_back(is_flipped ? -key.rotation : key.rotation);
            }
        }
        for (const Channel& channel : clip.channels)
            if (!channel.scale.times.empty()) keys.channels[channel.node].scale = channel.scale;
    }
    /// The rotations of a bone, one per frame.
    std::vector<glm::dquat>& turns(Bone bone) { return keys.channels[node(bone)].rotation.values; }
    /// Moves the roots of the skeleton in a frame; metres.
    void move(std::size_t frame, const glm::dvec3& by) {
        for (Channel& channel : keys.channels)
            if (character_.skeleton[channel.node].parent < 0) channel.translation.values[frame] += by;
    }
    std::size_t frames() const { return keys.channels.front().rotation.values.size(); }
    Placement placed(std::size_t frame, Bone bone) const {
        const double time = keys.channels.front().rotation.times[frame];
        return test_posed::placed_in(character_.skeleton, keys, time)[node(bone)];
    }
    LintReport report() const {
        EXPECT_TRUE(check(keys, character_.skeleton)) << check(keys, character_.skeleton).message();
        return lint(character_.skeleton, map_, keys);
    }
    Clip keys{};
    double height = 0.0;

  private:
    std::size_t node(Bone bone) const { return static_cast<std::size_t>(map_[bone].node); }

    const Character& character_;
    BoneMap map_;
};

/// Pops a knee by 51 degrees.
void pop_knee(PlantedClip& popped, const PlantedClip& clean, std::size_t frame) {
    const glm::dvec3 across = glm::normalize(clean.placed(frame, Bone::LeftUpperLeg).position -
                                             clean.placed(frame, Bone::RightUpperLeg).position);
    const glm::dquat turn = clean.placed(frame, Bone::LeftLowerLeg).rotation();
    glm::dquat& knee = popped.turns(Bone::LeftLowerLeg)[frame];
    knee = glm::normalize(knee * glm::conjugate(turn) * glm::angleAxis(0.9, across) * turn);
}

/// In a fast run a knee turns by 30 degrees per frame; a pop of one frame must still be found.
TEST(LintFiles, APoppingKneeIsFoundInMostFramesOfAFastRun) {
    const fs::path file = fs::path(tendril::test::found_path("fbx_motionbuilder_jog.fbx"));
    if (!fs::exists(file)) GTEST_SKIP() << "it is not there";
    const Character character = read_character(file);
    const PlantedClip clean(character, character.clips.at(0));
    ASSERT_LT(clean.keys.duration, 1.0);
    std::size_t found = 0;
    for (std::size_t frame = 1; frame + 1 < clean.frames(); ++frame) {
        PlantedClip popped = clean;
        pop_knee(popped, clean, frame);
        const LintReport report = popped.report();
        found += std::ranges::any_of(report.findings, [&](const Finding& each) {
            return each.fault == Fault::KneePop && each.frame + 1 >= frame && each.frame <= frame + 1;
        });
    }
    EXPECT_GE(found, 12u) << "of " << clean.frames() - 2;
}

TEST(LintFiles, PlantedFaultsAreFoundInCleanThirdPartyClips) {
    if (!has_files()) GTEST_SKIP() << "they are not there";
    std::map<Fault, int> planted;
    for_each_file([&](const std::string& name, const Character& character) {
        const auto known = faults_of_files().find(name);
        if (known == faults_of_files().end() || !known->second.empty() || !bone_map(character).is_usable())
            return;
        for (const Clip& clip : character.clips) {
            SCOPED_TRACE(name + ", " + clip.name);
            const PlantedClip clean(character, clip);
            const LintReport before = clean.report();
            EXPECT_TRUE(before.findings.empty()) << before.findings.at(0).text;
            const std::size_t count = clean.frames(), middle = count / 2;
            if (count < 20) continue;
            const auto expect = [&](Fault fault, const PlantedClip& in) {
                const LintReport report = in.report();
                EXPECT_TRUE(std::ranges::any_of(report.findings,
                                                [&](const Finding& each) { return each.fault == fault; }))
                    << humanoid::name(fault) << " is not among: " << texts(report);
                ++planted[fault];
            };
            PlantedClip flipped = clean;
            glm::dquat& key = flipped.turns(Bone::LeftUpperArm)[middle];
            key = -key;
            expect(Fault::SignFlip, flipped);
            PlantedClip jumped = clean;
            for (std::size_t i = middle; i < count; ++i) jumped.move(i, {0.25 * clean.height, 0.0, 0.0});
            expect(Fault::Jump, jumped);
            PlantedClip popped = clean;
            pop_knee(popped, clean, middle);
            expect(Fault::KneePop, popped);
            PlantedClip scaled = clean;
            for (Channel& channel : scaled.keys.channels)
                for (glm::dvec3& value : channel.translation.values) value *= 10.0;
            expect(Fault::Scale, scaled);
            PlantedClip sunk = clean;
            for (std::size_t i = 0; i < count; ++i) {
                const double part = static_cast<double>(i) / static_cast<double>(count - 1);
                const double down = std::clamp(std::min(part - 0.4, 0.65 - part) / 0.05, 0.0, 1.0);
                sunk.move(i, {0.0, -0.06 * clean.height * down, 0.0});
            }
            if (before.has_floor) expect(Fault::Sinking, sunk);
        }
    });
    for (const Fault fault : {Fault::SignFlip, Fault::Jump, Fault::Sinking, Fault::KneePop, Fault::Scale})
        EXPECT_GE(planted[fault], 3) << humanoid::name(fault);
}

}  // namespace
}  // namespace tendril::app
