// Families of recorded arms with one fault each: lag, repeated poses, a crossed axis, a hand beyond the end
// effector.
#include "tendril/ik/incident.hpp"
#include "tests/labels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <random>

namespace tendril::ik {
namespace {

class Random {
  public:
    explicit Random(unsigned seed) : random_(seed) {}
    float uniform(float low, float high) {
        return low + (high - low) * static_cast<float>(random_() >> 8) / 16777216.0f;
    }
    std::size_t below(std::size_t count) { return random_() % count; }
    glm::vec3 in_ball() {
        for (;;) {
            const glm::vec3 v(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
            if (glm::length(v) > 0.1f && glm::length(v) < 1.0f) return v;
        }
    }

  private:
    std::mt19937 random_;
};

/// Two bones of 0.5 m from the origin, with the elbow towards `side`.
std::vector<glm::vec3> arm(glm::vec3 target, glm::vec3 side) {
    const float far = glm::length(target), d = std::clamp(far, 0.01f, 0.99999f);
    const glm::vec3 line = target / far, off = glm::normalize(side - line * glm::dot(side, line));
    return {glm::vec3(0.0f), 0.5f * d * line + std::sqrt(0.25f - 0.25f * d * d) * off, d * line};
}

std::vector<ChainIncident> incidents_of(std::size_t frames, const IncidentOptions& options,
                                        const std::function<std::vector<glm::vec3>(std::size_t)>& joints,
                                        const std::function<glm::vec3(std::size_t)>& target,
                                        std::optional<glm::vec3> pole = {}) {
    IncidentFinder finder(options);
    for (std::size_t i = 0; i < frames; ++i) {
        const auto pose = joints(i);
        finder.add({.joints = pose, .target = target(i), .pole = pole});
    }
    finder.finish();
    return finder.incidents();
}

std::string said(const std::vector<ChainIncident>& incidents) {
    std::string text;
    for (const ChainIncident& each : incidents)
        text += std::to_string(each.frame) + ' ' + name(each.kind) + ", " + each.cause + '\n';
    return text;
}

/// Targets of several kinds, moving at a fraction `speed` of the reach per frame.
std::vector<glm::vec3> moving_target(Random& random, std::size_t kind, std::size_t frames, float speed) {
    const glm::vec3 centre = random.uniform(0.45f, 0.65f) * glm::normalize(random.in_ball());
    const glm::vec3 a = glm::normalize(random.in_ball()), b = glm::normalize(glm::cross(a, random.in_ball()));
    const float radius = random.uniform(0.1f, 0.3f), pace = speed / radius;
    glm::vec3 at = centre, way(0.0f), from = centre, to = centre + radius * b;
    std::vector<glm::vec3> targets;
    float along = 0.0f;
    for (std::size_t i = 0; i < frames; ++i) {
        const float t = pace * static_cast<float>(i);
        if (kind == 0) at = centre + radius * (std::cos(t) * a + std::sin(t) * b);
        if (kind == 1) at = centre + radius * (std::sin(t) * a + std::sin(1.7f * t) * b);
        if (kind == 2) at = centre + radius * std::sin(t) * a;
        if (kind == 3) {  // straight from point to point
            along += speed / glm::distance(from, to);
            if (along >= 1.0f) along = 0.0f, from = to, to = centre + radius * random.in_ball();
            at = glm::mix(from, to, along);
        }
        if (kind == 4) {  // a moving hand
            way = 0.9f * way + 0.5f * speed * random.in_ball() - 0.02f * (at - centre);
            at += way;
        }
        if (kind == 5 && i % 20 == 0) at = centre + radius * random.in_ball();  // a sudden jump
        targets.push_back(at);
    }
    return targets;
}

std::size_t lag_in(const std::vector<ChainIncident>& incidents) {
    for (const ChainIncident& each : incidents)
        if (each.kind == IncidentKind::Lag) return static_cast<std::size_t>(each.amount);
    return 0;
}

LABEL(slow, "Incident.FindsLagDespiteNoiseAndMisses");

// 150 lag, 150 do not; with noise, and tips that miss by an offset or by a fraction.
TEST(Incident, FindsLagDespiteNoiseAndMisses) {
    std::size_t found = 0;
    for (unsigned seed = 0; seed < 300; ++seed) {
        Random random(seed);
        const std::size_t frames = 80 + random.below(200), lag = seed % 2 == 0 ? 0 : 1 + random.below(5);
        const auto targets =
            moving_target(random, seed / 2 % 6, frames, std::exp(random.uniform(-5.0f, -3.0f)));
        const glm::vec3 side = 2.0f * glm::normalize(random.in_ball());
        const float noise = std::array{0.0f, 0.001f, 0.004f}[random.below(3)];
        const std::size_t miss = random.below(4);
        const glm::vec3 offset = miss == 1 ? random.uniform(0.05f, 0.1f) * random.in_ball() : glm::vec3(0.0f);
        const float share = miss == 2 ? random.uniform(0.93f, 0.98f) : 1.0f;
        const auto all = incidents_of(
            frames, {},
            [&](std::size_t i) {
                return arm(share * targets[i < lag ? 0 : i - lag] + offset + noise * random.in_ball(), side);
            },
            [&](std::size_t i) { return targets[i]; }, side);
        const std::size_t seen = lag_in(all);
        EXPECT_TRUE(lag > 0 || seen == 0) << "seed " << seed;
        found += lag > 0 && seen == lag;
    }
    EXPECT_GE(found, 142u) << "of 150";
}

// Late from one frame to another, in time before and after; or from the first frame to the last.
TEST(Incident, FindsLagThatLastsForAWhile) {
    std::size_t found = 0;
    for (unsigned seed = 0; seed < 100; ++seed) {
        Random random(seed);
        const bool always = seed % 3 == 0;
        const std::size_t lag = always ? 1 + random.below(30) : 2 + random.below(14);
        const std::size_t first = always ? 0 : 60 + random.below(60);
        const std::size_t end = always ? 240 : first + 20 + random.below(100);
        const auto targets = moving_target(random, seed % 5, 270, random.uniform(0.008f, 0.02f));
        const glm::vec3 side = 2.0f * glm::normalize(random.in_ball());
        const auto all = incidents_of(
            240, {},
            [&](std::size_t i) { return arm(targets[30 + i - (i < first || i >= end ? 0 : lag)], side); },
            [&](std::size_t i) { return targets[30 + i]; }, side);
        found += std::ranges::any_of(all, [&](const ChainIncident& each) {
            return each.kind == IncidentKind::Lag && each.amount == static_cast<double>(lag) &&
                   each.frame + 2 > first && each.frame < first + 6 &&
                   each.last_frame + 6 > std::min<std::size_t>(end, 240) && each.last_frame < end + 6;
        });
    }
    EXPECT_GE(found, 97u) << "of 100";
}

/// A pole target far off the line to any of the targets.
glm::vec3 beside(Random& random, const std::vector<glm::vec3>& targets) {
    glm::vec3 sum(0.0f);
    for (const glm::vec3& each : targets) sum += each;
    return 2.0f * glm::normalize(glm::cross(sum, random.in_ball()));
}

TEST(Incident, FindsAPoseRepeatedOverAnyNumberOfFrames) {
    for (unsigned seed = 0; seed < 120; ++seed) {
        Random random(seed);
        const std::size_t held = seed % 3 == 0 ? seed / 6 : seed % 6, first = 30 + random.below(20);
        // The target moves on, or it stands still too, and the chain catches up with it or stays late.
        const bool target_goes_on = seed % 3 == 0, catches_up = seed % 2 == 0;
        const auto targets = moving_target(random, 0, 120, 0.015f);
        const glm::vec3 side = beside(random, targets);
        const auto shown = [&](std::size_t i) {
            if (i < first) return i;
            if (i < first + held) return first - 1;
            return catches_up || target_goes_on ? i : i - held;
        };
        const auto all = incidents_of(
            110, {}, [&](std::size_t i) { return arm(targets[shown(i)], side); },
            [&](std::size_t i) { return targets[target_goes_on ? i : shown(i)]; }, side);
        const auto repeated = std::ranges::find(all, IncidentKind::Repeated, &ChainIncident::kind);
        ASSERT_EQ(repeated != all.end(), held > 0) << "seed " << seed << ", " << held;
        if (held == 0) continue;
        EXPECT_EQ(std::ranges::count(all, IncidentKind::Flip, &ChainIncident::kind), 0) << "seed " << seed;
        if (target_goes_on && catches_up) {
            EXPECT_EQ(all.size(), 1u) << "seed " << seed << ": " << said(all);
        }
        EXPECT_EQ(repeated->frame, first) << "seed " << seed;
        EXPECT_EQ(repeated->last_frame, first + held - 1);
        EXPECT_EQ(repeated->amount, static_cast<double>(held));
    }
}

// The chain is updated in every n-th frame, or in 5 of 6 (n = 0); the target likewise, or in every frame.
TEST(Incident, ALowerUpdateRateIsOneIncidentUnlessTheTargetSharesIt) {
    for (unsigned seed = 0; seed < 80; ++seed) {
        Random random(seed);
        const std::size_t n = std::array{2u, 3u, 4u, 0u}[seed % 4];
        const bool target_too = seed / 4 % 2 == 0;
        const auto targets = moving_target(random, seed / 8 % 2, 150, random.uniform(0.01f, 0.02f));
        const glm::vec3 side = beside(random, targets);
        const auto shown = [&](std::size_t i) {
            return n == 0 ? i - (i % 6 == 5 && i > 6 ? 1 : 0) : i / n * n;
        };
        const auto all = incidents_of(
            150, {}, [&](std::size_t i) { return arm(targets[shown(i)], side); },
            [&](std::size_t i) { return targets[target_too ? shown(i) : i]; }, side);
        ASSERT_EQ(all.size(), target_too ? 0u : 1u) << "seed " << seed << ", " << n << ": " << said(all);
        if (target_too) continue;
        EXPECT_EQ(all[0].kind, IncidentKind::Repeated);
        EXPECT_NEAR(all[0].hertz, n == 0 ? 50.0 : 60.0 / static_cast<double>(n), 0.5) << "seed " << seed;
        EXPECT_LT(all[0].frame, 12u);
        EXPECT_GT(all[0].last_frame, 138u);
    }
}

TEST(Incident, ADisplacedFrameOrTwoSwappedOnesAreOneIncident) {
    for (unsigned seed = 0; seed < 120; ++seed) {
        Random random(seed);
        std::size_t at = 40 + random.below(60);
        const auto targets = moving_target(random, 0, 150, random.uniform(0.008f, 0.03f));
        const glm::vec3 side = beside(random, targets);
        while (glm::distance(targets[at], targets[at + 1]) < 0.005f) ++at;
        const glm::vec3 aside = random.uniform(0.15f, 0.4f) * glm::normalize(random.in_ball());
        const auto all = incidents_of(
            150, {},
            [&](std::size_t i) {
                const bool swaps = seed % 3 == 0 && (i == at || i == at + 1);
                auto joints = arm(targets[swaps ? 2 * at + 1 - i : i], side);
                for (glm::vec3& joint : joints)
                    if (seed % 3 == 1 && i == at) joint += aside;
                return joints;
            },
            [&](std::size_t i) { return targets[i]; }, side);
        ASSERT_EQ(all.size(), seed % 3 == 2 ? 0u : 1u) << "seed " << seed << ": " << said(all);
        if (all.empty()) continue;
        EXPECT_EQ(all[0].kind, IncidentKind::Misplaced);
        EXPECT_EQ(all[0].frame, at) << "seed " << seed << ": " << all[0].cause;
        EXPECT_EQ(all[0].last_frame, at + (seed % 3 == 0 ? 1 : 0));
    }
}

TEST(Incident, APoleTargetThatJumpsIsTheNamedCause) {
    for (unsigned seed = 0; seed < 60; ++seed) {
        Random random(seed);
        const auto targets = moving_target(random, 0, 120, 0.01f);
        const bool jumps = seed % 2 == 0, follows = seed % 4 == 0, back = seed % 3 == 0;
        const glm::vec3 from = 2.0f * glm::normalize(glm::cross(targets[60], random.in_ball()));
        IncidentFinder finder;
        for (std::size_t i = 0; i < 120; ++i) {
            const glm::vec3 pole = jumps && (back ? i == 60 : i >= 60) ? -from : from;
            const auto joints = arm(targets[i], follows ? pole : from);
            finder.add({.joints = joints, .target = targets[i], .pole = pole});
        }
        finder.finish();
        const auto& all = finder.incidents();
        ASSERT_EQ(all.size(), jumps ? 1u : 0u) << "seed " << seed << ": " << said(all);
        if (!jumps) continue;
        EXPECT_EQ(all[0].kind, IncidentKind::PoleJump);
        EXPECT_EQ(all[0].frame, 60u);
        EXPECT_NEAR(all[0].amount, 4.0, 0.01);
        EXPECT_EQ(std::string(all[0].cause).ends_with("the bend of the chain with it"), follows);
    }
}

TEST(Incident, AMovingRootIsNotBlamedOnTargetOrSolver) {
    for (unsigned seed = 0; seed < 60; ++seed) {
        Random random(seed);
        const std::size_t late = seed % 3 == 0 ? 1 + seed % 6 : 0;
        const bool stays = seed % 3 == 1;
        const auto targets = moving_target(random, 0, 240, 0.01f);
        const glm::vec3 side = beside(random, targets);
        // The root walks, or jumps at frame 120 and stays there or comes back.
        const auto root = [&](std::size_t i) {
            if (late > 0) return glm::vec3(0.02f * static_cast<float>(i), 0.0f, 0.0f);
            return stays && i >= 120    ? glm::vec3(0.2f, 0, 0)
                   : !stays && i == 120 ? glm::vec3(0, 0.07f, 0)
                                        : glm::vec3(0.0f);
        };
        const auto target = [&](std::size_t i) {
            return targets[i] + (late > 0 ? root(i) : glm::vec3(0.0f));
        };
        const auto all = incidents_of(
            240, {},
            [&](std::size_t i) {
                auto joints = arm(stays ? targets[i] : target(i - std::min(i, late)) - root(i), side);
                for (glm::vec3& joint : joints) joint += root(i);
                return joints;
            },
            target);
        ASSERT_EQ(all.size(), 1u) << "seed " << seed << ": " << said(all);
        EXPECT_EQ(all[0].kind, late > 0 ? IncidentKind::Lag : IncidentKind::Misplaced) << said(all);
        if (late > 0) continue;
        EXPECT_NEAR(all[0].amount, stays ? 0.2 : 0.07, 0.02);
        EXPECT_EQ(all[0].frame, 120u);
    }
}

// The elbow changes sides at the farthest point of a move out and back.
TEST(Incident, AFlipOfANearlyStraightArmIsExplained) {
    for (unsigned seed = 0; seed < 60; ++seed) {
        Random random(seed);
        const bool straight = seed % 2 == 0;
        const float far = straight ? random.uniform(0.9955f, 0.999f) : random.uniform(0.9f, 0.99f);
        const glm::vec3 line = glm::normalize(glm::vec3(1, 0.5f, 0.7f) + 0.3f * random.in_ball());
        const glm::vec3 side = glm::cross(line, random.in_ball());
        const auto target = [&](std::size_t i) {
            return (far - 0.0001f * std::abs(static_cast<float>(i) - 59.5f)) * line;
        };
        const auto all = incidents_of(
            120, {}, [&](std::size_t i) { return arm(target(i), i < 60 ? side : -side); }, target);
        ASSERT_EQ(all.size(), 1u) << "seed " << seed;
        EXPECT_EQ(all[0].flip, straight ? FlipCause::Straight : FlipCause::Unexplained) << far;
    }
}

TEST(Incident, AChainThatSlowsDownAndRestsIsNotRepeated) {
    for (const std::size_t rest : {2u, 5u, 30u}) {
        const auto target = [&](std::size_t i) {
            const std::size_t leg = i / (20 + rest), in = std::min<std::size_t>(i % (20 + rest), 20);
            const float t = static_cast<float>(in) / 20.0f;
            return glm::vec3(0.5f, 0.1f * (static_cast<float>(leg) + t * t * (3.0f - 2.0f * t)), 0.0f);
        };
        const auto all = incidents_of(
            100, {}, [&](std::size_t i) { return arm(target(i), glm::vec3(0, 0, 2)); }, target,
            glm::vec3(0, 0, 2));
        EXPECT_TRUE(all.empty()) << rest << ": " << (all.empty() ? "" : name(all[0].kind));
    }
}

// An arm without a pole target, bent towards an axis that its target's line misses by 0.02 to 0.4 degrees.
TEST(Incident, AFlipAtAReferenceAxisIsExplained) {
    for (unsigned seed = 0; seed < 60; ++seed) {
        Random random(seed);
        glm::vec3 axis(0.0f);
        axis[static_cast<int>(seed % 3)] = seed % 2 == 0 ? 1.0f : -1.0f;
        const glm::vec3 a = glm::normalize(glm::cross(axis, random.in_ball())), b = glm::cross(axis, a);
        const float aside = std::tan(glm::radians(random.uniform(0.02f, 0.4f))),
                    speed = random.uniform(0.02f, 0.05f);
        const auto target = [&](std::size_t i) {
            return 0.8f * glm::normalize(axis + aside * b + speed * (static_cast<float>(i) - 29.6f) * a);
        };
        const auto all = incidents_of(
            60, {}, [&](std::size_t i) { return arm(target(i), axis); }, target);
        ASSERT_GE(all.size(), 1u) << "seed " << seed;
        EXPECT_EQ(all[0].flip, FlipCause::PassedAxis) << "seed " << seed << ": " << all[0].cause;
        EXPECT_NEAR(static_cast<double>(all[0].frame), 30.0, 1.0);
        const ReachPose on{.joints = arm(0.8f * axis, a), .target = 0.8f * axis};
        const ReachPose off{.joints = arm(target(30), axis), .target = target(30)};
        EXPECT_TRUE(passed_axis(on, off) && passed_axis(off, on)) << "seed " << seed;
    }
}

TEST(Incident, TwoStretchedBonesAreTwoIncidentsADisplacedJointOne) {
    for (unsigned seed = 0; seed < 60; ++seed) {
        Random random(seed);
        const bool stretches = seed % 2 == 0;
        const std::size_t ramp = 1 + 5 * (seed / 2 % 2);  // frames to full size
        const auto targets = moving_target(random, 0, 60, 0.002f);
        const glm::vec3 side = 2.0f * glm::normalize(random.in_ball());
        const float amount = random.uniform(0.06f, 0.1f);
        const auto joints = [&](std::size_t i) {
            auto all = arm(targets[i], side);
            const std::size_t since = i < 20 || i >= 40 ? 0 : std::min(i - 19, ramp);
            const float by = amount * static_cast<float>(since) / static_cast<float>(ramp);
            if (stretches)
                all = {all[0], all[1] + by * all[1], all[2] + by * all[1] + 0.5f * by * (all[2] - all[1])};
            else  // away from the line between its neighbours, or along one of its bones
                all[1] += by * glm::normalize(all[1] - (seed % 4 == 1 ? 0.5f : 0.8f) * all[2]);
            return all;
        };
        const auto all = incidents_of(
            60, {}, joints, [&](std::size_t i) { return joints(i)[2]; }, side);
        const auto lengths = std::ranges::count(all, IncidentKind::Length, &ChainIncident::kind);
        EXPECT_EQ(lengths, stretches ? 2 : 1) << "seed " << seed;
    }
}

TEST(Incident, JointsMayFollowTheEndEffector) {
    Random random(5);
    const auto targets = moving_target(random, 0, 120, 0.01f);
    const auto with_hand = [&](std::size_t i) {
        auto joints = arm(targets[i], glm::vec3(0, 2, 0));
        joints.push_back(joints[2] + glm::vec3(0.18f, i < 60 ? 0.0f : 0.01f, 0.0f));
        return joints;
    };
    const auto target = [&](std::size_t i) { return targets[i]; };
    const auto at_wrist = incidents_of(120, {.end_effector = 2}, with_hand, target, glm::vec3(0, 2, 0));
    EXPECT_TRUE(at_wrist.empty());
    const auto at_tip = incidents_of(120, {}, with_hand, target, glm::vec3(0, 2, 0));
    ASSERT_FALSE(at_tip.empty());
    EXPECT_EQ(at_tip[0].kind, IncidentKind::Missed);
    const auto stuck = incidents_of(
        120, {.end_effector = 2},
        [&](std::size_t i) {
            auto joints = with_hand(std::min<std::size_t>(i, 80));
            joints[3].y += 1e-6f * static_cast<float>(i);  // the hand is still moving
            return joints;
        },
        target, glm::vec3(0, 2, 0));
    ASSERT_FALSE(stuck.empty());
    EXPECT_EQ(stuck.back().kind, IncidentKind::Missed);
    EXPECT_EQ(stuck.back().joint, 2u);
}

TEST(FlipRules, TakeATurnAsExplainedByWhateverMovedFarEnough) {
    const auto explained = [](const InputMove& move, const FlipRule& rule = {}) {
        return explains(move, 1.0, 2.0, rule);
    };
    EXPECT_FALSE(explained({}));
    EXPECT_TRUE(explained({.distance = 0.041, .angle = 0.21}));
    EXPECT_FALSE(explained({.distance = 0.039, .angle = 0.21}));
    EXPECT_FALSE(explained({.distance = 0.041, .angle = 0.19}));
    EXPECT_TRUE(explained({.turn = 0.21}));
    EXPECT_TRUE(explained({.share = 0.021}));
    const FlipRule anything{.angle_share = 0.0f, .reach_share = 0.0f};
    EXPECT_FALSE(explained({}, anything)) << "nothing moved";
    EXPECT_TRUE(explained(move_between({1, 0, 0}, {1, 1e-6, 0}), anything));
    EXPECT_TRUE(explained({.share = 1e-6}, anything));
    const InputMove quarter = move_between({2, 0, 0}, {0, 2, 0});
    EXPECT_DOUBLE_EQ(quarter.distance, std::sqrt(8.0));
    EXPECT_DOUBLE_EQ(quarter.angle, std::acos(0.0));
    EXPECT_EQ(move_between({}, {1, 0, 0}).angle, 0.0) << "seen from itself it has no direction";
}

}  // namespace
}  // namespace tendril::ik
