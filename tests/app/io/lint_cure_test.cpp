// Feet that slide, float or sink in a clip, and the clip after lint has fixed it.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <glm/trigonometric.hpp>

#include "app/io/character/character.hpp"
#include "tests/app/io/lint_support.hpp"
#include "tests/core/random.hpp"
#include "tests/labels.hpp"
#include "tests/places.hpp"
#include "tests/says.hpp"

namespace tendril::app {
namespace {

using tendril::test::Random;

class LintCure : public LintFigure {
  protected:
    /// Fixes findings until there are none, like a user who clicks on each.
    Clip mended(Clip clip, int most) const {
        for (int i = 0;; ++i) {
            const LintReport report = run(clip);
            if (report.findings.empty()) return clip;
            EXPECT_LT(i, most) << texts(report);
            if (i >= most) return clip;
            EXPECT_TRUE(report.findings[0].has_cure) << texts(report);
            const Expected<Clip> next = cure(skeleton, map, clip, report.findings[0]);
            EXPECT_TRUE(next) << next.message();
            if (!next) return clip;
            clip = *next;
        }
    }
    std::vector<Placement> placed(const Clip& clip, double time) const {
        return test_posed::placed_in(skeleton, clip, time);
    }
    /// The maximum distance of a node between two clips, metres.
    double apart(const Clip& a, const Clip& b, const char* node, double from, double to) const {
        double most = 0.0;
        for (double time = from; time <= to; time += 1.0 / 240.0)
            most = std::max(most, glm::distance(placed(a, time)[*skeleton.find(node)].position,
                                                placed(b, time)[*skeleton.find(node)].position));
        return most;
    }
};

double ramp(double time, double first, double last) {
    const double u = std::clamp((time - first) / (last - first), 0.0, 1.0);
    return u * u * (3.0 - 2.0 * u);
}
/// Moves a foot away from the first to the second of these times, and back from the third to the fourth.
void slide(Frames& frames, const char* side, const glm::dvec3& way, const std::array<double, 4>& t) {
    frames.edit([&](std::size_t k, double time) {
        frames.move_foot(k, side, way * (ramp(time, t[0], t[1]) - ramp(time, t[2], t[3])));
    });
}

TEST_F(LintCure, ASkatingFootIsMadeToStand) {
    // The left foot is flat on the ground from 1.21 s to 1.49 s.
    for (const double rate : {24.0, 30.0, 60.0, 120.0}) {
        for (const glm::dvec3& way :
             {glm::dvec3(0.06, 0, 0), glm::dvec3(0, 0, -0.1), glm::dvec3(0.04, 0, 0.04)}) {
            Frames frames = walk(rate);
            slide(frames, "Left", way, {1.25, 1.45, 1.6, 1.9});
            const Clip clip = frames.clip(), whole = mended(clip, 2);
            const LintReport before = run(clip), after = run(whole);
            EXPECT_GT(before.skating, 0.05);
            EXPECT_LT(after.skating, 0.02) << rate;
            for (const char* node : {"Head", "RightFoot", "LeftHand"})
                EXPECT_LT(apart(clip, whole, node, 0.0, 3.3), 0.02) << node;
            EXPECT_LT(apart(clip, whole, "LeftFoot", 0.0, 0.9), 1e-9);
            EXPECT_LT(apart(clip, whole, "LeftFoot", 2.0, 3.3), 1e-9);
        }
    }
}

TEST_F(LintCure, FloatingFeetAreLoweredAndSinkingFeetRaised) {
    for (const double rate : {30.0, 60.0}) {
        for (const double by : {-0.06, -0.035, 0.04, 0.06}) {
            Frames frames = walk(rate);
            frames.edit([&](std::size_t k, double time) {
                frames.poses[k][0].translation.y += by * (ramp(time, 1.0, 1.25) - ramp(time, 1.75, 2.0));
            });
            const Clip clip = frames.clip();
            ASSERT_FALSE(run(clip).findings.empty()) << by;
            const Clip whole = mended(clip, 8);
            EXPECT_LT(apart(clip, whole, "LeftFoot", 0.0, 0.4), 1e-9);
            EXPECT_LT(apart(clip, whole, "Head", 0.0, 3.3), std::abs(by) + 0.03);
        }
    }
}

TEST_F(LintCure, AFootOutOfReachLowersTheHipsAndKeepsTheOtherFoot) {
    const double rate = 60.0;
    Frames frames(skeleton, figure.clips[0], rate, 0.0);
    std::vector<rig::Transform> bent = rest_pose(skeleton);
    for (const char* const side : {"Left", "Right"}) {
        const auto bend = [&](const char* bone, double angle) {
            bent[*skeleton.find(std::string(side) + bone)].rotation =
                glm::angleAxis(angle, glm::dvec3(1, 0, 0));
        };
        bend("UpperLeg", -0.2), bend("LowerLeg", 0.4), bend("Foot", -0.2);
    }
    bent[0].translation.y -=
        test_posed::placed_as(skeleton, bent)[*skeleton.find("LeftFoot")].position.y - 0.09;
    frames.poses.assign(121, bent);
    frames.edit([&](std::size_t k, double time) {
        frames.poses[k][0].translation.y += 0.05 * (ramp(time, 0.5, 0.8) - ramp(time, 1.3, 1.6));
    });
    const Clip clip = frames.clip(), whole = mended(clip, 4);
    const std::size_t left = *skeleton.find("LeftFoot"), right = *skeleton.find("RightFoot"),
                      hips = *skeleton.find("Hips");
    const auto at_rest = placed(clip, 0.0), then = placed(whole, 1.05);
    EXPECT_NEAR(then[left].position.y, at_rest[left].position.y, 0.003);
    EXPECT_NEAR(then[right].position.y, at_rest[right].position.y, 0.003);
    EXPECT_LT(then[hips].position.y, at_rest[hips].position.y + 0.02);
}

TEST_F(LintCure, CubicAndSteppedTracksAndNodesWithoutKeysAreFixedToo) {
    for (const Interpolation kind : {Interpolation::Cubic, Interpolation::Step}) {
        Frames frames = walk(60.0, 2.2);
        slide(frames, "Left", {0.07, 0, 0}, {1.25, 1.45, 1.6, 1.9});
        Clip clip = frames.clip();
        for (Channel& channel : clip.channels) {
            Track<glm::dquat>& track = channel.rotation;
            track.interpolation = kind;
            if (kind != Interpolation::Cubic) continue;
            const std::vector<glm::dquat> keys = track.values;
            track.values.clear();
            for (std::size_t i = 0; i < keys.size(); ++i) {
                const std::size_t a = i > 0 ? i - 1 : 0, b = std::min(i + 1, keys.size() - 1);
                const glm::dquat slope = (keys[b] - keys[a]) / (track.times[b] - track.times[a]);
                track.values.insert(track.values.end(), {slope, keys[i], slope});
            }
        }
        const Clip whole = mended(clip, 2);
        EXPECT_LT(apart(clip, whole, "LeftFoot", 0.0, 0.9), 1e-9);
        EXPECT_EQ(whole.channels[1].rotation.interpolation, kind);
    }
    // Hips without keys, above feet with keys.
    Clip still{.name = "still", .duration = 2.0, .channels = {}};
    Channel thigh{.node = *skeleton.find("LeftUpperLeg")}, shin{.node = *skeleton.find("LeftLowerLeg")};
    for (int i = 0; i <= 60; ++i) {
        const double time = std::min(i / 30.0, 2.0),
                     half = 0.12 * (ramp(time, 0.5, 0.7) - ramp(time, 1.4, 1.6));
        thigh.rotation.times.push_back(time), shin.rotation.times.push_back(time);
        thigh.rotation.values.push_back({std::cos(2 * half), -std::sin(2 * half), 0, 0});
        shin.rotation.values.push_back({std::cos(4 * half), std::sin(4 * half), 0, 0});
    }
    still.channels = {thigh, shin};
    mended(still, 3);
}

TEST_F(LintCure, AfterRandomFaultsNoFootIsLeftWrong) {
    Random random(11);
    for (int i = 0; i < 60; ++i) {
        const double rate = i % 2 == 0 ? 30.0 : 60.0;
        Frames frames = walk(rate);
        const char* const side = random.chance(2) ? "Left" : "Right";
        const double begin = 0.4 + 0.03 * static_cast<double>(random.below(60)),
                     length = 0.1 + 0.01 * static_cast<double>(random.below(30));
        const glm::vec3 point = random.point(0.07f);
        const glm::dvec3 way(point.x, 0.6f * point.y, point.z);
        slide(frames, side, way, {begin, begin + length, begin + length + 0.1, begin + 2.0 * length + 0.1});
        Clip clip = frames.clip();
        for (int pass = 0; pass < 6; ++pass) {
            const LintReport report = run(clip);
            const auto wrong = std::ranges::find_if(
                report.findings, [](const Finding& each) { return each.fault <= Fault::Sinking; });
            if (wrong == report.findings.end()) break;
            ASSERT_LT(pass, 5) << i << ": " << texts(report);
            const Expected<Clip> next = cure(skeleton, map, clip, *wrong);
            ASSERT_TRUE(next) << next.message();
            clip = *next;
        }
        for (const Finding& each : run(clip).findings) ADD_FAILURE() << i << ": " << each.text;
    }
}

TEST_F(LintCure, AFindingOfAnotherClipIsRefused) {
    Frames frames = walk(60.0);
    for (std::size_t k = 74; k < 92; ++k) frames.move_foot(k, "Left", {0, -0.04, 0});
    const LintReport report = run(frames.clip());
    const auto sunk = std::ranges::find(report.findings, Fault::Sinking, &Finding::fault);
    ASSERT_NE(sunk, report.findings.end()) << texts(report);
    Finding finding = *sunk;
    const Clip brief = walk(60.0, 0.5).clip();
    const Expected<Clip> refused = cure(skeleton, map, brief, finding);
    ASSERT_FALSE(refused);
    EXPECT_TRUE(tendril::test::says(std::string(refused.message()), "cure finding clip LeftFoot"))
        << refused.message();
    finding.node = static_cast<std::int32_t>(*skeleton.find("Head"));
    EXPECT_FALSE(cure(skeleton, map, frames.clip(), finding));
}

// A fix must not cause another fault: each one leaves fewer findings and no new one, and no joint turns
// faster than before or than the lint tolerates.
class LintFixes : public LintFigure {
  protected:
    /// The maximum turn of each joint from one frame to the next, degrees. Not from the first frame to the
    /// second: captured clips begin with a calibration pose.
    static std::vector<double> turns(const Skeleton& skeleton, const Clip& clip, const LintReport& report) {
        std::vector<double> most(skeleton.size(), 0.0);
        std::vector<rig::Transform> last(skeleton.size()), next(skeleton.size());
        for (std::size_t i = 1; i < report.frames; ++i) {
            sample(clip, skeleton, std::min(static_cast<double>(i) / report.rate, clip.duration), next);
            for (std::size_t k = 0; i > 1 && k < skeleton.size(); ++k) {
                const glm::dquat turn = next[k].rotation * glm::conjugate(last[k].rotation);
                const double sine = glm::length(glm::dvec3(turn.x, turn.y, turn.z));
                most[k] = std::max(most[k], glm::degrees(2.0 * std::atan2(sine, std::abs(turn.w))));
            }
            std::swap(last, next);
        }
        return most;
    }
    /// Fixes the findings in an order, as a user may; returns the clip and counts the fixes.
    static Clip fixed(const Skeleton& skeleton, const BoneMap& map, Clip clip, Random& order, int& fixes) {
        for (fixes = 0;; ++fixes) {
            const LintReport before = lint(skeleton, map, clip);
            std::vector<Finding> all = before.findings;
            std::erase_if(all, [](const Finding& each) { return !each.has_cure; });
            if (all.empty()) return clip;
            const Finding& finding = all[order.below(static_cast<std::uint32_t>(all.size()))];
            const Expected<Clip> next = cure(skeleton, map, clip, finding);
            EXPECT_TRUE(next) << next.message();
            if (!next) return clip;
            const LintReport after = lint(skeleton, map, *next);
            EXPECT_LT(after.findings.size(), before.findings.size()) << finding.text;
            for (const Finding& each : new_findings(before, after))
                ADD_FAILURE() << finding.text << ": new: " << each.text;
            const std::vector<double> was = turns(skeleton, clip, before), is = turns(skeleton, *next, after);
            for (std::size_t k = 0; k < is.size(); ++k) {
                const auto node = static_cast<std::int32_t>(k);
                const bool is_knee =
                    node == map[Bone::LeftLowerLeg].node || node == map[Bone::RightLowerLeg].node;
                const double tolerated =
                    (is_knee ? LintSettings{}.knee : LintSettings{}.turn) * (2.0 + 60.0 / before.rate) / 3.0;
                EXPECT_LE(is[k], std::max(was[k], tolerated) + 1e-6)
                    << finding.text << ": " << skeleton[k].name;
            }
            clip = *next;
        }
    }
};

LABEL(slow, "LintFixes.*");
LABEL(slow, "LintCure.AfterRandomFaultsNoFootIsLeftWrong");
LABEL(slow, "LintCure.ASkatingFootIsMadeToStand");

TEST_F(LintFixes, OfSkatingFeetOnNearlyStraightLegsCauseNoOtherFault) {
    Random random(5);
    for (int i = 0; i < test::rounds(24); ++i) {
        const double rate = i % 3 == 0 ? 30.0 : i % 3 == 1 ? 60.0 : 120.0;
        Frames frames = walk(rate);
        // Both feet slide in stances that follow each other, and the hips are so high that the legs are
        // nearly straight.
        const double high = 0.01 * static_cast<double>(2 + random.below(5));
        const double a = 0.02 * random.point(1.0f).x + 0.05, b = 0.02 * random.point(1.0f).z + 0.05;
        frames.edit([&](std::size_t k, double time) {
            frames.poses[k][0].translation.y += high;
            frames.move_foot(k, "Left", {a * (ramp(time, 1.2, 1.5) - ramp(time, 1.6, 1.9)), -high, 0.0});
            frames.move_foot(k, "Right", {0.0, -high, b * (ramp(time, 1.7, 2.0) - ramp(time, 2.1, 2.4))});
        });
        const Clip clip = frames.clip();
        ASSERT_FALSE(run(clip).findings.empty()) << i;
        int fixes = 0;
        const Clip whole = fixed(skeleton, map, clip, random, fixes);
        EXPECT_TRUE(run(whole).findings.empty()) << i << ": " << texts(run(whole));
        if (::testing::Test::HasFailure()) FAIL() << i << ", legs " << high << " m longer";
    }
}

TEST_F(LintFixes, OfCapturedClipsWithSkatingFeetCauseNoOtherFault) {
    const std::filesystem::path folder = test::characters_folder();
    if (!std::filesystem::is_directory(folder)) GTEST_SKIP() << folder << " is not there";
    std::size_t skating = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() != ".bvh") continue;
        const Character character = read_character(entry.path().string());
        const BoneMap bones = bone_map(character);
        for (const Clip& clip : character.clips) {
            const LintReport report = lint(character.skeleton, bones, clip);
            if (std::ranges::find(report.findings, Fault::Skating, &Finding::fault) == report.findings.end())
                continue;
            ++skating;
            // The order of the fixes does not matter.
            for (std::uint32_t seed = 1; seed <= (report.frames > 1000 || !test::is_thorough() ? 1u : 2u);
                 ++seed) {
                SCOPED_TRACE(entry.path().filename().string() + ", order " + std::to_string(seed));
                Random order(seed);
                int fixes = 0;
                const Clip whole = fixed(character.skeleton, bones, clip, order, fixes);
                EXPECT_TRUE(lint(character.skeleton, bones, whole).findings.empty());
                EXPECT_LE(fixes, static_cast<int>(report.findings.size()));
            }
        }
    }
    EXPECT_GT(skating, 0u);
}

}  // namespace
}  // namespace tendril::app
