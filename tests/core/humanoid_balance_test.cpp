// Centre of mass, support, and a body that keeps its balance while it reaches.
#include <gtest/gtest.h>
#include <tendril/humanoid/balance.hpp>
#include <tendril/humanoid/body.hpp>
#include <tendril/humanoid/footsteps.hpp>

#include "humanoid_figure.hpp"
#include "tests/labels.hpp"
#include "tests/says.hpp"

namespace tendril::test {
namespace {

Skeleton scaled_figure(double scale) {
    std::vector<Node> nodes = make_figure({}).nodes();
    for (Node& node : nodes) node.rest.translation *= scale;
    return *Skeleton::make(std::move(nodes));
}

class HumanoidBalance : public testing::Test, protected Figured {
  protected:
    explicit HumanoidBalance(double scale = 1.0) : Figured{scaled_figure(scale)}, scale_(scale) {}

    double margin(const std::vector<rig::Transform>& pose) const {
        const auto at = placed(pose);
        return find_support(soles, at).margin(masses.centre(at));
    }
    /// Moves the targets from rest to their goals in two thirds of `frames`.
    struct Reached {
        std::vector<rig::Transform> pose;
        BodyReport report;
    };
    Reached reach(const std::vector<BodyTarget>& targets, bool balance, int frames = 60) {
        BodyState state;
        Reached reached;
        const auto from = placed(rest);
        for (int frame = 1; frame <= frames; ++frame) {
            std::vector<BodyTarget> now = targets;
            const double part = std::min(1.0, 1.5 * frame / frames);
            for (BodyTarget& each : now) {
                const glm::dvec3 start = from[node(bone_of(each.effector))].position;
                each.position = glm::mix(start, each.position, part);
            }
            reached.pose = rest;
            const auto report = body.solve(reached.pose, now, state, {.balance = balance});
            EXPECT_TRUE(report) << report.message();
            if (report) reached.report = *report;
        }
        return reached;
    }
    static glm::dvec3 plus_z(const glm::dvec3& point, double by) { return point + glm::dvec3(0.0, 0.0, by); }

    double scale_;
    Masses masses = *find_masses(skeleton, map);
    Soles soles = *find_soles(skeleton, map);
    Body body = *Body::make(skeleton, map, default_limits(skeleton, map));
};

TEST_F(HumanoidBalance, MassesAreThePapers) {
    double sum = 0.0;
    for (const MassPoint& each : masses.points) sum += each.share;
    EXPECT_EQ(masses.points.size(), 16u);
    EXPECT_NEAR(sum, 1.0, 1e-12);
    const glm::dvec3 centre = masses.centre(placed(rest));
    EXPECT_NEAR(centre.x, 0.0, 1e-12);
    // An adult's centre of mass is at 0.55 to 0.58 of the height; raising the arms to the sides lifts it
    // slightly.
    EXPECT_GT(centre.y, 0.54 * 1.8);
    EXPECT_LT(centre.y, 0.60 * 1.8);
}

TEST_F(HumanoidBalance, BothFeetSupportTheRestPose) {
    const Support support = find_support(soles, placed(rest));
    EXPECT_EQ(support.standing, (std::array{1.0, 1.0}));
    ASSERT_GE(support.count, 6u);
    // Support runs from the heels, 5 cm behind the ankles, to the tips, 6 cm ahead of the balls.
    EXPECT_NEAR(support.margin({0.0, 1.0, -0.05}), 0.0, 1e-9);
    EXPECT_NEAR(support.margin({0.1, 1.0, 0.15 + 0.07 * soles.leg}), 0.0, 1e-3);
    EXPECT_NEAR(support.margin({0.0, 3.0, 1.15 + 0.07 * soles.leg}), -1.0, 1e-3);
    EXPECT_GT(margin(rest), 0.03);
    EXPECT_EQ(support.nearest({0.0, 1.0, 0.0}), glm::dvec3(0.0, 1.0, 0.0));
}

TEST_F(HumanoidBalance, ARotationIsBlendedInOnceForAnyDuration) {
    const auto turned = [&](bool balance, int frames) {
        BodyTarget foot{.effector = Effector::LeftFoot,
                        .position = at(rest, Bone::LeftFoot),
                        .rotation = glm::angleAxis(0.6, glm::dvec3(0.0, 1.0, 0.0)),
                        .weight = 0.3};
        const auto pose = reach({foot}, balance, frames).pose;
        const auto node = static_cast<std::size_t>(map[Bone::LeftFoot].node);
        const glm::dquat now = placed(pose)[node].rotation(), was = placed(rest)[node].rotation();
        return 2.0 * std::acos(std::min(1.0, std::abs((now * glm::conjugate(was)).w)));
    };
    const double once = turned(false, 60);
    EXPECT_GT(once, 0.05);
    for (const int frames : {1, 10, 60}) EXPECT_NEAR(turned(true, frames), once, 0.02) << frames;
}

TEST_F(HumanoidBalance, ARotationOfZeroWeightHasNoEffect) {
    const auto foot = [&](bool balance, double weight, bool rotated) {
        BodyTarget target{.effector = Effector::LeftFoot,
                          .position = at(rest, Bone::LeftFoot) + glm::dvec3(0.0, 0.3, 0.3),
                          .weight = weight};
        if (rotated) target.rotation = glm::angleAxis(0.6, glm::dvec3(0.0, 1.0, 0.0));
        const auto node = static_cast<std::size_t>(map[Bone::LeftFoot].node);
        return placed(reach({target}, balance).pose)[node].rotation();
    };
    for (const bool balance : {false, true})
        for (const double weight : {0.0, 1e-3}) {
            const glm::dquat off = foot(balance, weight, true) * glm::conjugate(foot(balance, weight, false));
            EXPECT_LT(glm::length(glm::dvec3(off.x, off.y, off.z)), 1e-3) << balance << ' ' << weight;
        }
}

TEST_F(HumanoidBalance, ARisingFootLeavesTheSupportWithoutAJump) {
    double before = 0.0;
    for (int i = 0; i <= 200; ++i) {
        std::array<SolePoints, 2> at = sole_points(soles, placed(rest));
        for (glm::dvec3* each : {&at[0].heel, &at[0].toe}) each->y += 0.001 * i;
        const double now = find_support(soles, at).margin({0.0, 0.0, 0.0});
        if (i > 0) {
            EXPECT_LT(std::abs(now - before), 0.008) << i << " mm";
        }
        before = now;
    }
    EXPECT_NEAR(before, -(0.1 - 0.5 * 0.11 * soles.leg), 0.02);  // outside the right foot
}

double area_of(const Support& support) {
    double twice = 0.0;
    for (std::size_t i = 0; i < support.count; ++i) {
        const glm::dvec3 &a = support.corners[i], &b = support.corners[(i + 1) % support.count];
        twice += a.x * b.z - b.x * a.z;
    }
    return 0.5 * twice;
}

TEST_F(HumanoidBalance, APitchingFootChangesTheSupportWithoutAJump) {
    const std::array<SolePoints, 2> flat = sole_points(soles, placed(rest));
    for (const double roll : {0.0, 1e-6, 0.01, 0.2}) {
        for (const bool both : {false, true}) {
            Support before;
            for (int i = 0; i <= 7200; ++i) {
                std::array<SolePoints, 2> at = flat;
                const double pitch = 2.0 * 3.14159265358979 * i / 7200.0;
                const glm::dquat turn = glm::angleAxis(roll, glm::dvec3(0.0, 0.0, 1.0)) *
                                        glm::angleAxis(pitch, glm::dvec3(1.0, 0.0, 0.0));
                for (std::size_t side = 0; side < (both ? 2 : 1); ++side) {  // pivots on the toe or heel
                    glm::dvec3& far = pitch < 3.14159265358979 ? at[side].heel : at[side].toe;
                    const glm::dvec3 near = pitch < 3.14159265358979 ? at[side].toe : at[side].heel;
                    far = near + turn * (far - near);
                }
                const Support now = find_support(soles, at);
                ASSERT_GT(now.count, 0u);
                if (i > 0 && i != 3600) {  // at 3600 the other end of the foot takes over
                    EXPECT_NEAR(area_of(now), area_of(before), 1e-3) << i << ' ' << roll;
                    EXPECT_LT(glm::distance(now.middle, before.middle), 2e-3) << i << ' ' << roll;
                }
                before = now;
            }
        }
    }
}

TEST_F(HumanoidBalance, MassesAreFiniteForAnyNodeScale) {
    for (int exponent = -300; exponent <= 300; exponent += 10) {
        const double scale = std::pow(10.0, exponent);
        for (std::size_t i = 0; i < skeleton.size(); ++i) {
            std::vector<Node> nodes = skeleton.nodes();
            nodes[i].rest.scale = glm::dvec3(scale);
            const auto odd = Skeleton::make(std::move(nodes));
            if (!odd) continue;
            const BoneMap names = match_bones(*odd);
            const auto found = find_masses(*odd, names);
            const auto feet = find_soles(*odd, names);
            if (!found) continue;
            ASSERT_TRUE(feet) << feet.message();
            std::vector<Placement> where(odd->size());
            place(*odd, rest_pose(*odd), where);
            const glm::dvec3 centre = found->centre(where);
            for (const MassPoint& each : found->points)
                EXPECT_TRUE(std::isfinite(each.at.x + each.at.y + each.at.z)) << exponent << ' ' << i;
            EXPECT_TRUE(std::isfinite(centre.x + centre.y + centre.z)) << exponent << ' ' << i;
            EXPECT_TRUE(std::isfinite(find_support(*feet, where).margin(centre))) << exponent << ' ' << i;
        }
    }
}

TEST_F(HumanoidBalance, NothingIsSupportedInTheAir) {
    const Ground ground = *Ground::flat(-1.0);
    const Support support = find_support(soles, placed(rest), &ground);
    EXPECT_EQ(support.count, 0u);
    EXPECT_LT(support.margin({0.0, 0.0, 0.0}), -1e8);
}

TEST_F(HumanoidBalance, HipsMoveBackWhenAHandReachesAhead) {
    const std::vector<BodyTarget> targets{{Effector::RightHand, {-0.2, 1.1, 0.95}}};
    const Reached off = reach(targets, false), on = reach(targets, true);
    EXPECT_LT(margin(off.pose), -0.04);  // leans without moving the hips
    EXPECT_GT(margin(on.pose), 0.02);
    EXPECT_LT(on.report.residual, 1e-3);
    EXPECT_LT(at(on.pose, Bone::Hips).z, at(off.pose, Bone::Hips).z - 0.08);
}

TEST_F(HumanoidBalance, BodySquatsOnTheBallsOfTheFeetToReachTheFloor) {
    const std::vector<BodyTarget> targets{{Effector::RightHand, {-0.2, 0.15, 0.6}}};
    const Reached on = reach(targets, true);
    EXPECT_GT(margin(on.pose), 0.005);
    EXPECT_LT(on.report.residual, 2e-3);
    EXPECT_LT(at(on.pose, Bone::Hips).y, 0.7);
    // At the limits of the ankles the heels rise; the balls neither sink nor slide.
    for (const SolePoints& sole : sole_points(soles, placed(on.pose))) {
        EXPECT_GT(sole.heel.y, -0.005);
        EXPECT_NEAR(sole.toe.y, 0.0, 0.005);
        EXPECT_NEAR(sole.toe.z, 0.15, 0.01);
    }
}

TEST_F(HumanoidBalance, HandStopsShortBeforeTheBodyFalls) {
    const std::vector<BodyTarget> targets{{Effector::RightHand, {-0.2, 1.0, 1.6}}};
    const Reached off = reach(targets, false), on = reach(targets, true);
    EXPECT_LT(margin(off.pose), -0.4);
    EXPECT_GT(margin(on.pose), 0.0);
    EXPECT_GT(on.report.residual, 0.3);
    EXPECT_GT(on.report.outside, 0.0);  // the hand pulls the centre of mass slightly out of the safe area
    EXPECT_LT(on.report.outside, 0.02);
}

TEST_F(HumanoidBalance, AFootSupportsWhereItIsNotAtItsTarget) {
    const glm::dvec3 foot = at(rest, Bone::LeftFoot), hand = at(rest, Bone::RightHand);
    for (const double far : {0.3, 0.6, 1.0, 2.0, 3.0}) {
        BodyState state;
        std::vector<rig::Transform> pose = rest;
        std::vector<Placement> before;
        double moved = 0.0;
        BodyReport last;
        for (int frame = 1; frame <= 600; ++frame) {
            const double part = std::min(1.0, frame / 240.0);
            const BodyTarget targets[]{
                {Effector::LeftFoot, plus_z(foot, part * far)},
                {Effector::RightHand, glm::mix(hand, glm::dvec3(-0.3, 1.1, 2.0), part)}};
            pose = rest;
            const auto report = body.solve(pose, targets, state, {.balance = true});
            ASSERT_TRUE(report) << report.message();
            last = *report;
            const std::vector<Placement> now = placed(pose);
            for (std::size_t i = 0; i < now.size() && frame > 480; ++i)
                moved = std::max(moved, glm::distance(now[i].position, before[i].position));
            before = now;
        }
        EXPECT_GT(margin(pose), -0.01) << far;
        EXPECT_LT(last.outside, 0.04) << far;
        EXPECT_LT(moved, 1e-4) << far;  // the pose is at rest
    }
}

TEST_F(HumanoidBalance, RarelyLosesBalanceForAnyFootAndHandTargets) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    int falls = 0;
    for (int i = 0; i < 30; ++i) {
        const double fx = any(random), fz = any(random), hx = any(random), hy = any(random), hz = any(random);
        const std::vector<BodyTarget> targets{
            {Effector::LeftFoot, at(rest, Bone::LeftFoot) + glm::dvec3(1.5 * fx, 0.0, 2.5 * fz)},
            {Effector::RightHand, {-0.3 + 1.2 * hx, 1.1 + 0.7 * hy, 1.2 * hz}}};
        const double stands = margin(reach(targets, true, 300).pose);
        EXPECT_GT(stands, -0.25) << i;
        if (stands < -0.01) ++falls;
    }
    EXPECT_LE(falls, 3);
}

TEST_F(HumanoidBalance, AnUnbalancedClipMayStaySo) {
    std::vector<rig::Transform> pose = rest;
    const auto hips = static_cast<std::size_t>(map[Bone::Hips].node);
    pose[hips].rotation = glm::angleAxis(0.3, glm::dvec3(1.0, 0.0, 0.0));  // leans, feet off the floor behind
    const std::vector<rig::Transform> clip = pose;
    BodyState state;
    const std::vector<BodyTarget> targets{{Effector::RightHand, at(pose, Bone::RightHand)}};
    ASSERT_TRUE(body.solve(pose, targets, state, {.balance = true}));
    for (std::size_t i = 0; i < pose.size(); ++i)
        EXPECT_LT(glm::distance(placed(pose)[i].position, placed(clip)[i].position), 1e-3)
            << skeleton[i].name;
}

TEST_F(HumanoidBalance, SmallMovesOfTheTargetGiveSmallMovesOfThePose) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    double worst = 0.0;
    for (int path = 0; path < 20; ++path) {
        BodyState state;
        std::vector<Placement> before;
        const glm::dvec3 start = at(rest, Bone::RightHand);
        const glm::dvec3 end(-0.3 + 0.9 * any(random), 1.0 + 0.8 * any(random), 0.3 + 0.9 * any(random));
        const int frames = static_cast<int>(std::ceil(glm::distance(start, end) / 0.005));
        for (int frame = 0; frame <= frames; ++frame) {
            std::vector<rig::Transform> pose = rest;
            const BodyTarget target{Effector::RightHand,
                                    glm::mix(start, end, static_cast<double>(frame) / frames)};
            ASSERT_TRUE(body.solve(pose, {&target, 1}, state, {.balance = true}));
            const std::vector<Placement> now = placed(pose);
            for (std::size_t i = 0; i < now.size() && frame > 0; ++i)
                worst = std::max(worst, glm::distance(now[i].position, before[i].position));
            before = now;
        }
    }
    EXPECT_LT(worst, 13.0 * 0.005);  // as fast as without balance (body.hpp)
}

/// Body sizes from a doll to a giant.
class HumanoidBalanceSizes : public HumanoidBalance, public testing::WithParamInterface<double> {
  protected:
    HumanoidBalanceSizes() : HumanoidBalance(GetParam()) {}
};

LABEL(slow, "Sizes/HumanoidBalanceSizes.*");

TEST_P(HumanoidBalanceSizes, BalanceNeverGetsWorseAndReachIsNearlyKept) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    int rescued = 0;
    for (int i = 0; i < 60; ++i) {
        const double x = any(random), y = any(random), z = any(random);
        const Effector hand = i % 2 == 0 ? Effector::RightHand : Effector::LeftHand;
        const std::vector<BodyTarget> targets{
            {hand, scale_ * glm::dvec3(1.1 * x, 1.0 + 0.9 * y, 0.2 + 1.1 * z)}};
        const Reached off = reach(targets, false, 120), on = reach(targets, true, 120);
        const double before = margin(off.pose) / scale_, after = margin(on.pose) / scale_;
        EXPECT_GT(after, std::min(before, 0.0) - 0.002) << i;
        // Crouching to reach behind lifts the heels, which shrinks the support on the side it leans to.
        EXPECT_GT(after, -0.015) << i << ": " << x << ' ' << y << ' ' << z;
        if (before < 0.0 && after > 0.0) ++rescued;
        // The hand gives up about as much as the centre of mass would have been out of balance.
        EXPECT_LT(on.report.residual / scale_,
                  off.report.residual / scale_ + (z > 0.0 ? 1.5 : 2.5) * std::max(0.06 - before, 0.0) + 0.05)
            << i << ": " << x << ' ' << y << ' ' << z;
    }
    EXPECT_GT(rescued, 10);
}

INSTANTIATE_TEST_SUITE_P(Sizes, HumanoidBalanceSizes, testing::Values(0.1, 0.5, 1.0, 3.0, 20.0));

// Steps of a body that reaches farther than its feet allow.

constexpr double frame = 1.0 / 60.0;

class HumanoidFootsteps : public testing::Test, protected Figured {
  protected:
    /// One frame of a body that reaches from its rest pose.
    BodyReport solve(std::vector<BodyTarget> targets, double dt = frame) {
        BodyOptions options{.balance = true};
        options.ground = ground;
        options.feet = advance_steps(steps, soles, dt);
        pose = rest;
        const auto report = body.solve(pose, targets, state, options);
        EXPECT_TRUE(report) << report.message();
        place(skeleton, rest, clip);
        place(skeleton, pose, solved);
        if (dt > 0.0 && plan_step(steps, soles, masses.centre(solved), clip, state, ground)) ++begun;
        return report ? *report : BodyReport();
    }
    /// Moves the right hand from its rest position to `to` at 1 m/s, then waits for 3 s.
    BodyReport reach(const glm::dvec3& to) {
        const glm::dvec3 from{-0.72, 1.45, 0.0};
        const int frames = static_cast<int>(glm::distance(from, to) / frame) + 1;
        BodyReport report;
        for (int i = 1; i <= frames + 180; ++i)
            report = solve(
                {{Effector::RightHand, glm::mix(from, to, std::min(1.0, static_cast<double>(i) / frames))}});
        return report;
    }
    double margin() const { return find_support(soles, solved).margin(masses.centre(solved)); }

    std::vector<rig::Transform> pose = rest;
    std::vector<Placement> clip{skeleton.size()}, solved{skeleton.size()};
    Masses masses = *find_masses(skeleton, map);
    Soles soles = *find_soles(skeleton, map);
    Body body = *Body::make(skeleton, map, default_limits(skeleton, map));
    BodyState state;
    FootstepsState steps;
    const Ground* ground = nullptr;
    int begun = 0;
};

TEST_F(HumanoidFootsteps, ANearTargetNeedsNoStep) {
    reach({-0.2, 1.1, 0.95});
    EXPECT_EQ(begun, 0);
    EXPECT_FALSE(steps.away());
}

TEST_F(HumanoidFootsteps, AStepRisesAndLandsOnTime) {
    steps.feet[1] = {{}, {0.0, 0.0, 0.4}, 0.0};
    double highest = 0.0;
    int frames = 0;
    for (double before = 0.0; steps.stepping(); ++frames) {
        const std::array<FootShift, 2> feet = advance_steps(steps, soles, frame);
        highest = std::max(highest, feet[1].lift);
        EXPECT_EQ(feet[0], FootShift());
        EXPECT_GE(feet[1].stand.z, before);
        before = feet[1].stand.z;
    }
    EXPECT_NEAR(frames, 18, 1);
    EXPECT_NEAR(highest, 0.1 * soles.leg, 0.005);
    EXPECT_EQ(advance_steps(steps, soles, frame)[1], (FootShift{{0.0, 0.0, 0.4}, 0.0}));
}

TEST_F(HumanoidFootsteps, NothingJumps) {
    const glm::dvec3 from{-0.72, 1.45, 0.0}, to{-0.2, 1.0, 2.0};
    std::vector<Placement> before;
    double worst = 0.0;
    for (int i = 1; i <= 300; ++i) {
        solve({{Effector::RightHand, glm::mix(from, to, std::min(1.0, i / 120.0))}});
        for (std::size_t k = 0; k < solved.size() && !before.empty(); ++k)
            worst = std::max(worst, glm::distance(solved[k].position, before[k].position));
        before = solved;
    }
    EXPECT_GE(begun, 2);
    EXPECT_LT(worst, 0.16);  // the hips catch up with a foot that moves 5 cm a frame
}

TEST_F(HumanoidFootsteps, WithoutTargetsTheFeetStepBack) {
    reach({-0.2, 1.0, 1.6});
    ASSERT_TRUE(steps.away());
    for (int i = 0; i < 90; ++i) solve({});
    EXPECT_FALSE(steps.away());
    solve({});
    EXPECT_EQ(pose, rest);
    EXPECT_EQ(state, BodyState());
}

TEST_F(HumanoidFootsteps, AFootClimbsOneStairAfterAnother) {
    const Ground stairs = *Ground::stairs(0.3, 0.4);
    ground = &stairs;
    const auto hips = static_cast<std::size_t>(map[Bone::Hips].node);
    rest[hips].translation.z -= 0.3;
    const glm::dvec3 from{-0.72, 1.45, -0.3}, to{-0.2, 2.0, 1.9};
    double highest = 0.0;
    for (int i = 1; i <= 900; ++i) {
        solve({{Effector::RightHand, glm::mix(from, to, std::min(1.0, i / 600.0))}});
        for (const SolePoints& sole : sole_points(soles, solved)) highest = std::max(highest, sole.toe.y);
    }
    EXPECT_FALSE(steps.stepping());
    std::array<double, 2> up{};
    for (std::size_t side = 0; side < 2; ++side) {
        const SolePoints sole = sole_points(soles, solved)[side];
        up[side] = stairs.highest(sole.toe.x, sole.toe.z)->height;
        EXPECT_NEAR(sole.toe.y, up[side], 0.03) << side;
    }
    // Above the clip's ground, the second stair is more than half a leg up.
    EXPECT_GT(0.6, 0.5 * soles.leg);
    EXPECT_GT(std::max(up[0], up[1]), 0.59);
}

TEST_F(HumanoidFootsteps, StepsEndForAnyTarget) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    int few = 0;
    for (int i = 0; i < 40; ++i) {
        state = {}, steps = {}, begun = 0;
        const double x = any(random), y = any(random), z = any(random);
        const BodyReport report = reach({-0.3 + 1.3 * x, 1.0 + 0.9 * y, 0.3 + 1.3 * z});
        EXPECT_LE(begun, 4) << i;
        few += begun <= 2;
        EXPECT_FALSE(steps.stepping()) << i;
        EXPECT_LT(report.residual, 0.03) << i;
        EXPECT_GT(margin(), 0.0) << i;
    }
    EXPECT_GE(few, 30);
}

TEST_F(HumanoidFootsteps, OptionsOutOfRangeAreClamped) {
    const auto after = [&](const FootstepOptions& options) {
        FootstepsState taken{.feet = {Footstep{{}, {0.0, 0.0, 0.4}, 0.0}}};
        return advance_steps(taken, soles, 0.01, options);
    };
    EXPECT_EQ(after({.seconds = 1e-9, .lift = 7.0}), after({.seconds = 0.05, .lift = 1.0}));
    EXPECT_EQ(after({.seconds = 1e9, .lift = std::nan("")}), after({.seconds = 5.0, .lift = 0.0}));
}

TEST_F(HumanoidFootsteps, BadStatesAreReset) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    steps.feet[0].to.x = nan;
    EXPECT_FALSE(check(steps));
    EXPECT_EQ(advance_steps(steps, soles, frame), (std::array<FootShift, 2>{}));
    EXPECT_FALSE(steps.away());
    const auto report =
        body.solve(pose, {}, state, {.balance = true, .feet = {FootShift{{nan, 0.0, 0.0}, 0.0}}});
    EXPECT_TRUE(says(report.message(), "options.feet.left.stand.x"));
}

}  // namespace
}  // namespace tendril::test
