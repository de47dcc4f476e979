// Motion lint on the built-in figure's clips, with and without planted faults, and on third-party files.
#include <gtest/gtest.h>

#include <filesystem>

#include "app/io/character/read.hpp"
#include "tests/app/io/lint_support.hpp"
#include "tests/core/random.hpp"
#include "tests/places.hpp"

namespace tendril::app {
namespace {

using tendril::test::Random;

class LintTest : public LintFigure {
  protected:
    std::int32_t node(const char* name) const { return static_cast<std::int32_t>(*skeleton.find(name)); }
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

/// 0 up to `first`, 1 from `last` on.
double ramp(std::size_t frame, std::size_t first, std::size_t last) {
    if (frame <= first) return 0.0;
    if (frame >= last) return 1.0;
    return static_cast<double>(frame - first) / static_cast<double>(last - first);
}

TEST_F(LintTest, finds_nothing_in_its_own_clips) {
    for (const Clip& clip : figure.clips) {
        const LintReport report = run(clip);
        EXPECT_TRUE(report.findings.empty()) << clip.name << ": " << texts(report);
        EXPECT_TRUE(report.has_floor);
        EXPECT_NEAR(report.floor, 0.0, 0.01);
    }
}

TEST_F(LintTest, finds_nothing_in_variations_of_them) {
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

TEST_F(LintTest, finds_a_slid_foot) {
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

TEST_F(LintTest, finds_feet_that_are_slower_than_the_body) {
    Frames frames = walk();
    for (std::size_t k = 0; k < frames.poses.size(); ++k) frames.poses[k][0].translation.z *= 1.25;
    const LintReport report = run(frames.clip());
    EXPECT_GE(report.findings.size(), 4u);
    for (const Finding& each : report.findings) EXPECT_EQ(each.fault, Fault::Skating) << each.text;
}

TEST_F(LintTest, finds_a_sunk_foot) {
    for (const double depth : {0.03, 0.04}) {
        Frames frames = walk();
        for (std::size_t k = 74; k < 92; ++k)
            frames.move_foot(k, "Left", {0, -depth * std::sin(3.14159 * ramp(k, 74, 91)), 0});
        const LintReport report = run(frames.clip());
        ASSERT_FALSE(report.findings.empty()) << depth;
        EXPECT_EQ(report.findings[0].fault, Fault::Sinking) << texts(report);
        EXPECT_NEAR(report.findings[0].amount, 1000.0 * depth, 12.0) << texts(report);
        EXPECT_EQ(report.findings[0].node, node("LeftFoot"));
        EXPECT_GE(report.findings[0].frame, 74u);
        EXPECT_LE(report.findings[0].frame, 91u);
    }
}

TEST_F(LintTest, finds_hips_that_are_lowered_and_feet_that_float) {
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

TEST_F(LintTest, finds_a_popped_knee_and_mends_it) {
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
        const Finding* pop = nullptr;
        for (const Finding& each : report.findings)
            if (each.fault == Fault::KneePop) pop = &each;
        ASSERT_NE(pop, nullptr) << i << ", frame " << frame << ", " << degrees << ": " << texts(report);
        EXPECT_EQ(pop->node, node(knee.c_str()));
        EXPECT_EQ(pop->frame, frame);
        EXPECT_NEAR(pop->amount, degrees, 0.3 * degrees);
        for (const Finding& each : report.findings) EXPECT_NE(each.fault, Fault::Skating) << each.text;
        ASSERT_TRUE(pop->has_cure);
        const LintReport after = run(*cure(skeleton, map, clip, *pop));
        EXPECT_TRUE(after.findings.empty()) << i << ": " << texts(after);
    }
}

TEST_F(LintTest, finds_a_knee_that_snaps_straight) {
    // The right foot goes beyond its leg's reach, as careless foot IK moves it.
    Frames frames = walk();
    for (std::size_t k = 40; k < 60; ++k) {
        const glm::dvec3 hip = frames.placed(k)[*skeleton.find("RightUpperLeg")].position;
        const glm::dvec3 foot = frames.placed(k)[*skeleton.find("RightFoot")].position;
        const double far = 0.60 + 0.018 * static_cast<double>(k - 40);
        frames.move_foot(k, "Right", hip + glm::normalize(foot - hip) * far - foot);
    }
    const LintReport report = run(frames.clip());
    const bool found = std::any_of(report.findings.begin(), report.findings.end(), [&](const Finding& each) {
        return each.fault == Fault::KneePop && each.node == node("RightLowerLeg") && each.frame > 45 &&
               each.frame < 62;
    });
    EXPECT_TRUE(found) << texts(report);
}

TEST_F(LintTest, finds_a_flipped_key_and_a_jump) {
    Clip clip = walk().clip();
    auto& keys = clip.channels[static_cast<std::size_t>(node("LeftUpperArm"))].rotation.values;
    keys[30] = -keys[30];
    expect_only(clip, Fault::SignFlip, "LeftUpperArm", 30, 30, 358.0, 3.0);
    Frames frames = walk();
    for (std::size_t k = 100; k < frames.poses.size(); ++k) frames.poses[k][0].translation.x += 0.2;
    const LintReport report = run(frames.clip());
    const auto jump = std::find_if(report.findings.begin(), report.findings.end(),
                                   [](const Finding& each) { return each.fault == Fault::Jump; });
    ASSERT_NE(jump, report.findings.end()) << texts(report);
    EXPECT_EQ(jump->node, node("Hips"));
    EXPECT_EQ(jump->frame, 100u);
    EXPECT_NEAR(jump->amount, 200.0, 5.0);
}

TEST_F(LintTest, finds_a_knee_and_an_elbow_that_bend_the_wrong_way) {
    for (const bool is_knee : {true, false}) {
        Frames frames = walk();
        const char* const name = is_knee ? "LeftLowerLeg" : "RightLowerArm";
        for (std::size_t k = 0; k < frames.poses.size(); ++k) {
            const double bend = 110.0 * ramp(k, 60, 90) * (1.0 - ramp(k, 110, 140));
            frames.at(k, name).rotation = glm::angleAxis(
                glm::radians(is_knee ? -bend : bend), is_knee ? glm::dvec3(1, 0, 0) : glm::dvec3(0, -1, 0));
        }
        const LintReport report = run(frames.clip());
        const auto fault = std::find_if(report.findings.begin(), report.findings.end(),
                                        [](const Finding& each) { return each.fault == Fault::Limit; });
        ASSERT_NE(fault, report.findings.end()) << name << ": " << texts(report);
        EXPECT_EQ(fault->node, node(name)) << fault->text;
        EXPECT_GE(fault->frame, 85u);
        EXPECT_LE(fault->frame, 112u);
        EXPECT_GT(fault->amount, 65.0) << fault->text;
        EXPECT_STREQ(fault->unit, "deg");
    }
}

TEST_F(LintTest, judges_by_the_limits_that_it_is_given) {
    const Clip clip = walk().clip();
    const BodyLimits like = default_limits(skeleton, map);
    const BodyLimits learned = learned_limits(skeleton, map, std::span(&clip, 1), like);
    EXPECT_TRUE(lint(skeleton, map, clip, {.limits = &learned}).findings.empty());
    // The punch goes where the walk never was.
    const LintReport report = lint(skeleton, map, figure.clips[1], {.limits = &learned});
    EXPECT_FALSE(report.findings.empty());
    for (const Finding& each : report.findings) EXPECT_EQ(each.fault, Fault::Limit) << each.text;
    const BodyLimits none = no_limits();
    EXPECT_TRUE(lint(skeleton, map, figure.clips[1], {.limits = &none}).findings.empty());
}

TEST_F(LintTest, finds_a_walk_that_lies_on_its_side) {
    for (const glm::dvec3& axis : {glm::dvec3(1, 0, 0), glm::dvec3(-1, 0, 0), glm::dvec3(0, 0, 1)}) {
        Clip clip = figure.clips[0];
        const glm::dquat turn = glm::angleAxis(glm::radians(90.0), axis);
        for (glm::dvec3& value : clip.channels[0].translation.values) value = turn * value;
        for (glm::dquat& value : clip.channels[0].rotation.values) value = turn * value;
        const LintReport report = run(clip);
        ASSERT_FALSE(report.findings.empty());
        const auto fault = std::find_if(report.findings.begin(), report.findings.end(),
                                        [](const Finding& each) { return each.fault == Fault::Axis; });
        ASSERT_NE(fault, report.findings.end()) << texts(report);
        EXPECT_NEAR(fault->amount, 90.0, 1e-6);
        const LintReport after = run(*cure(skeleton, map, clip, *fault));
        EXPECT_TRUE(after.findings.empty()) << texts(after);
    }
}

TEST_F(LintTest, finds_a_figure_that_rests_on_its_side_or_is_a_giant) {
    std::vector<Node> nodes = skeleton.nodes();
    nodes[0].rest.rotation = glm::angleAxis(glm::radians(90.0), glm::dvec3(1, 0, 0));
    const Skeleton lying = *Skeleton::make(nodes);
    const LintReport report = lint(lying, match_bones(lying), Clip{.name = "none"});
    ASSERT_EQ(report.findings.size(), 1u) << texts(report);
    EXPECT_EQ(report.findings[0].fault, Fault::Axis);
    EXPECT_NEAR(report.findings[0].amount, 90.0, 6.0);

    nodes = skeleton.nodes();
    for (Node& each : nodes) each.rest.translation *= 100.0;
    const Skeleton giant = *Skeleton::make(nodes);
    const LintReport tall = lint(giant, match_bones(giant), Clip{.name = "none"});
    ASSERT_EQ(tall.findings.size(), 1u) << texts(tall);
    EXPECT_EQ(tall.findings[0].fault, Fault::Scale);
    EXPECT_NEAR(tall.findings[0].amount, 180.0, 1.0);
}

/// Some files store their motion relative to a pose in which the figure lies: it walks upright all the same.
TEST_F(LintTest, a_rest_pose_that_lies_is_no_fault_where_the_figure_walks_upright) {
    std::vector<Node> nodes = skeleton.nodes();
    nodes[0].rest.rotation = glm::angleAxis(glm::radians(90.0), glm::dvec3(1, 0, 0));
    const Skeleton lying = *Skeleton::make(nodes);
    EXPECT_EQ(lint(lying, match_bones(lying), Clip{.name = "none"}).findings.size(), 1u);
    for (const Clip& clip : figure.clips) {
        const LintReport report = lint(lying, match_bones(lying), clip);
        for (const Finding& each : report.findings) EXPECT_NE(each.fault, Fault::Axis) << each.text;
    }
}

/// A rig may put all of an arm's twist into the forearm, or into the collar bone: the arm looks the same.
TEST_F(LintTest, an_arm_is_judged_by_its_shape_however_its_twist_is_divided) {
    const glm::dvec3 along(1, 0, 0);  // the left arm's
    for (const double twist : {0.0, 70.0, -70.0, 85.0}) {
        Frames frames = walk();
        const glm::dquat by = glm::angleAxis(glm::radians(twist), along),
                         bent = glm::angleAxis(glm::radians(-100.0), glm::dvec3(0, 1, 0));
        for (std::size_t k = 0; k < frames.poses.size(); ++k) {
            frames.at(k, "LeftUpperArm").rotation = glm::dquat(1, 0, 0, 0);
            frames.at(k, "LeftLowerArm").rotation = by * bent;
        }
        const LintReport report = run(frames.clip());
        EXPECT_TRUE(report.findings.empty()) << twist << ": " << texts(report);
    }
    // A fifth of a turn beyond what the shoulder can do, it bends backwards.
    Frames frames = walk();
    for (std::size_t k = 0; k < frames.poses.size(); ++k) {
        frames.at(k, "LeftUpperArm").rotation = glm::dquat(1, 0, 0, 0);
        frames.at(k, "LeftLowerArm").rotation = glm::angleAxis(glm::radians(165.0), along) *
                                                glm::angleAxis(glm::radians(-100.0), glm::dvec3(0, 1, 0));
    }
    const LintReport report = run(frames.clip());
    ASSERT_EQ(report.findings.size(), 1u) << texts(report);
    EXPECT_EQ(report.findings[0].fault, Fault::Limit);
    EXPECT_EQ(report.findings[0].node, node("LeftLowerArm"));
}

TEST(LintFiles, those_of_others_are_what_they_were_found_to_be) {
    const std::filesystem::path folder = tendril::test::characters_folder();
    if (!std::filesystem::is_directory(folder)) GTEST_SKIP() << folder << " is not there";
    const auto faults = [&](const char* file) {
        const Character character = read_character(folder / file);
        std::map<Fault, int> counts;
        for (const Clip& clip : character.clips)
            for (const Finding& each :
                 lint(character.skeleton, match_bones(character.skeleton), clip).findings)
                ++counts[each.fault];
        return counts;
    };
    using Counts = std::map<Fault, int>;
    // Careful work: nothing.
    EXPECT_EQ(faults("cesium_man.gltf"), Counts());
    EXPECT_EQ(faults("human_clip.glb"), Counts());
    EXPECT_EQ(faults("pab_skeleton.fbx"), Counts());
    // Exported without regard for quaternion signs.
    EXPECT_EQ(faults("snake.glb").size(), 1u);
    EXPECT_GT(faults("snake.glb")[Fault::SignFlip], 0);
    EXPECT_EQ(faults("robot.glb")[Fault::SignFlip], 15);
    // Its head turns all the way round, and falls on its chest; its arms do what arms do.
    EXPECT_EQ(faults("robot.glb")[Fault::Limit], 2);
    // Euler angles have no signs of quaternions to flip.
    EXPECT_EQ(faults("pab_walk.fbx")[Fault::SignFlip], 0);
    // A raw capture: toes that jump by 28 degrees within 1/120 s.
    EXPECT_GT(faults("cmu_01_01.bvh")[Fault::Jump], 0);
    EXPECT_EQ(faults("cmu_01_01.bvh")[Fault::KneePop], 0);
}

}  // namespace
}  // namespace tendril::app
