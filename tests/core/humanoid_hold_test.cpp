// Hands that hold one object: the grips close within the limits, and the object yields as little as possible.
#include <tendril/humanoid/hold.hpp>

#include "humanoid_figure.hpp"
#include "memory.hpp"
#include "tests/says.hpp"

namespace tendril::test {
namespace {

constexpr double arm_length = 0.54;

struct Holder {
    explicit Holder(bool limited = true, bool shoulders = true, double turn = 0.0)
        : skeleton(make_figure(
              shoulders ? std::map<std::string, std::string>{}
                        : std::map<std::string, std::string>{{"LeftShoulder", ""}, {"RightShoulder", ""}},
              turn)),
          limits(limited ? default_limits(skeleton, map) : no_limits()) {}

    HoldReport hold(const HeldObject& object, const HoldOptions& options = {}) {
        pose = rest_pose(skeleton);
        const auto report = humanoid::hold(body, pose, {}, object, body_state, state, options);
        EXPECT_TRUE(report) << report.message();
        placed.resize(skeleton.size());
        place(skeleton, pose, placed);
        return *report;
    }
    /// Solves frame after frame until the body has arrived.
    HoldReport settle(const HeldObject& object, int frames = 25) {
        body_state = {}, state = {};
        HoldReport report;
        for (int i = 0; i < frames; ++i) report = hold(object);
        return report;
    }
    const Placement& at(Bone bone) const { return placed[static_cast<std::size_t>(map[bone].node)]; }
    /// The gap measured in the pose itself, independently of the report.
    double gap(const Grip& grip, const ObjectPose& object) const {
        return glm::distance(at(bone_of(grip.hand)).position,
                             object.position + object.rotation * grip.position);
    }
    double off(const Grip& grip, const ObjectPose& object) const {
        const glm::dquat hand = at(bone_of(grip.hand)).rotation();
        const glm::dquat held = hand * glm::inverse(*grip.rotation);
        if (grip.axis != glm::dvec3(0.0)) {
            const glm::dvec3 axis = glm::normalize(grip.axis);
            return std::acos(std::min(1.0, glm::dot(held * axis, object.rotation * axis)));
        }
        return 2.0 * std::acos(std::min(1.0, std::abs(glm::dot(held, object.rotation))));
    }
    double worst_excess() const {
        float worst = 0.0f;
        for (std::size_t i = 0; i < bone_count; ++i)
            worst = std::max(worst, body.joints().excess(static_cast<Bone>(i), placed));
        return static_cast<double>(worst);
    }

    Skeleton skeleton;
    BoneMap map = match_bones(skeleton);
    BodyLimits limits;
    Body body = Body::make(skeleton, map, limits).value();
    BodyState body_state;
    HoldState state;
    std::vector<rig::Transform> pose;
    std::vector<Placement> placed;
};

/// Both hands on a rim, palms inward, free to turn about it.
std::vector<Grip> rim(const Body& body, double radius) {
    return {*grip_of(body, {Effector::LeftHand, {radius, 0, 0}, {0, 0, 1}, {-1, 0, 0}, {0, 1, 0}}, 0.08),
            *grip_of(body, {Effector::RightHand, {-radius, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}}, 0.08)};
}

TEST(HumanoidHold, ClosesTheGripsWithinTheLimits) {
    RandomPoses random(7);
    int there = 0, all = 0;
    for (const bool shoulders : {true, false}) {
        Holder holder(true, shoulders);
        const std::vector<Grip> grips = rim(holder.body, 0.2);
        for (int i = 0; i < 14; ++i) {
            const double far = i % 2 == 0 ? 0.15 : 0.6;
            const HeldObject wheel{grips,
                                   {glm::dvec3(0.0, 1.25, 0.4) + random.vector(far), random.turn(2.0 * far)}};
            const HoldReport report = holder.settle(wheel);
            EXPECT_TRUE(report.closed()) << i;
            for (const Grip& grip : grips) {
                EXPECT_LT(holder.gap(grip, report.object), 1e-4 * arm_length) << i;
                EXPECT_LT(holder.off(grip, report.object), 1e-3) << i;
            }
            EXPECT_LT(holder.worst_excess(), 2e-3) << i;
            EXPECT_NEAR(report.moved, glm::distance(report.object.position, wheel.asked.position), 1e-12);
            ++all, there += report.moved < 1e-4 && report.turned < 1e-3;
        }
    }
    EXPECT_GT(there, all / 2);  // other poses do not exist, or are not found
    EXPECT_LT(there, all);
}

/// Objects held by a known pose of the arms: the object goes exactly where asked.
TEST(HumanoidHold, ReachesAPoseThatIsPossible) {
    RandomPoses random(7);
    for (const double turn : {0.0, 0.7}) {
        Holder holder(true, true, turn);
        for (int i = 0; i < 60; ++i) {
            std::vector<rig::Transform> made = rest_pose(holder.skeleton);
            for (const Bone upper : {Bone::LeftUpperArm, Bone::RightUpperArm}) {
                const double side = upper == Bone::LeftUpperArm ? 1.0 : -1.0;
                const auto turned = [&](int bone, double angle, const glm::dvec3& axis) {
                    const auto node = static_cast<std::size_t>(
                        holder.map[static_cast<Bone>(static_cast<int>(upper) + bone)].node);
                    const glm::dvec3 about = glm::angleAxis(turn, glm::dvec3(0, 1, 0)) * axis;
                    made[node].rotation = glm::angleAxis(angle, about) * made[node].rotation;
                };
                turned(0, -side * random.from(0.4, 1.2), {0, 1, 0});
                turned(0, -side * random.from(0.2, 0.8), {0, 0, 1});
                turned(1, -side * random.from(0.3, 1.2), {0, 1, 0});
            }
            place(holder.skeleton, made, holder.placed = std::vector<Placement>(made.size()));
            const ObjectPose asked{random.vector(1.0), random.turn(3.0)};
            std::vector<Grip> grips;
            for (const Effector hand : {Effector::LeftHand, Effector::RightHand})
                grips.push_back({.hand = hand,
                                 .position = glm::inverse(asked.rotation) *
                                             (holder.at(bone_of(hand)).position - asked.position)});
            const HoldReport report = holder.settle({grips, asked});
            EXPECT_TRUE(report.closed()) << i;
            EXPECT_LT(report.moved, 1e-4) << i;
            EXPECT_LT(report.turned, 1e-4) << i;
            EXPECT_EQ(report.grips[0].straight || report.grips[1].straight, false) << i;
        }
    }
}

/// Distance of a pose from the asked one, by the solver's measure.
double distance_from(const ObjectPose& asked, const ObjectPose& pose) {
    const glm::dquat turn = asked.rotation * glm::inverse(pose.rotation);
    const double angle = 2.0 * std::atan2(glm::length(glm::dvec3(turn.x, turn.y, turn.z)), std::abs(turn.w));
    return std::hypot(glm::distance(asked.position, pose.position), 0.3 * angle);
}

/// Free arms hold a pose if both hands are within reach of their shoulders. Random search, narrowing.
TEST(HumanoidHold, TheObjectYieldsAsLittleAsPossible) {
    RandomPoses random(7);
    Holder holder(false, false);
    const std::vector<Grip> grips{{Effector::LeftHand, {0.2, 0, 0}}, {Effector::RightHand, {-0.2, 0, 0}}};
    int gave = 0;
    for (int i = 0; i < 25; ++i) {
        const HeldObject bar{
            grips,
            {glm::dvec3(random.from(-0.7, 0.7), random.from(0.8, 1.9), random.from(1.1, 1.8)),
             random.turn(1.0)}};
        const HoldReport report = holder.settle(bar);
        EXPECT_TRUE(report.closed()) << i;
        const double found = distance_from(bar.asked, report.object);
        if (found < 0.02) continue;
        ++gave;
        EXPECT_TRUE(report.grips[0].straight || report.grips[1].straight) << i;
        const auto holds = [&](const ObjectPose& pose) {
            return std::ranges::all_of(grips, [&](const Grip& grip) {
                const Bone shoulder =
                    grip.hand == Effector::LeftHand ? Bone::LeftUpperArm : Bone::RightUpperArm;
                return glm::distance(pose.position + pose.rotation * grip.position,
                                     holder.at(shoulder).position) <= arm_length * 0.9992;
            });
        };
        ObjectPose best = report.object;
        double least = found, size = 0.3;
        for (int k = 0; k < 8'000; ++k, size = std::max(size * 0.999, 1e-3)) {
            const glm::dvec3 to_asked = bar.asked.position - best.position;
            ObjectPose tried = best;
            tried.position += size * (random.vector(0.3) + random.from(0.0, 0.3) * to_asked);
            tried.rotation = glm::normalize(random.turn(size) * tried.rotation);
            const double now = distance_from(bar.asked, tried);
            if (now < least && holds(tried)) best = tried, least = now;
        }
        EXPECT_LT(found, 1.02 * least + 1e-3) << i;
    }
    EXPECT_GT(gave, 8);
}

TEST(HumanoidHold, AnObjectTooLongIsSharedByBothHands) {
    Holder holder(false);
    const std::vector<Grip> grips{{Effector::LeftHand, {1.2, 0, 0}}, {Effector::RightHand, {-1.2, 0, 0}}};
    const HoldReport report = holder.settle({grips, {{0.0, 1.4, 0.2}}});
    EXPECT_FALSE(report.closed());
    EXPECT_NEAR(report.grips[0].gap, report.grips[1].gap, 2e-3);
    const double apart =
        glm::distance(holder.at(Bone::LeftHand).position, holder.at(Bone::RightHand).position);
    EXPECT_GT(apart, 1.4);  // both arms are straight
    EXPECT_NEAR(report.grips[0].gap + report.grips[1].gap, 2.4 - apart, 5e-3);
    EXPECT_TRUE(report.grips[0].straight && report.grips[1].straight);
}

TEST(HumanoidHold, ReportsTheArmThatIsStraight) {
    Holder holder;
    const std::vector<Grip> grips = rim(holder.body, 0.2);
    for (const double side : {1.0, -1.0}) {
        const HoldReport report = holder.settle({grips, {{1.2 * side, 1.3, 1.1}}});
        EXPECT_TRUE(report.closed());
        EXPECT_GT(report.moved, 0.02);
        EXPECT_TRUE(report.grips[side > 0.0 ? 0 : 1].straight);
        EXPECT_FALSE(report.grips[side > 0.0 ? 1 : 0].straight);
    }
}

/// Steering a wheel: the hands follow the rim.
TEST(HumanoidHold, HandsFollowAWheel) {
    Holder holder;
    const std::vector<Grip> grips = rim(holder.body, 0.19);
    for (const double degrees : {-60.0, -30.0, 30.0, 60.0}) {
        const ObjectPose asked{{0.0, 1.2, 0.4}, glm::angleAxis(glm::radians(degrees), glm::dvec3(0, 0, 1))};
        const HoldReport report = holder.settle({grips, asked});
        EXPECT_TRUE(report.closed()) << degrees;
        EXPECT_LT(glm::degrees(report.turned), 3.0) << degrees;
        EXPECT_LT(report.moved, 0.02) << degrees;
    }
}

TEST(HumanoidHold, OnlyReportedJumpsOccur) {
    Holder holder;
    RandomPoses random(7);
    const std::vector<Grip> grips = rim(holder.body, 0.2);
    int jumps = 0, steps = 0;
    for (int way = 0; way < 4; ++way) {
        ObjectPose asked{{0.0, 1.25, 0.35}};
        holder.settle({grips, asked});
        const glm::dvec3 along = 0.001 * glm::normalize(random.vector(1.0));
        for (int i = 0; i < 150; ++i, ++steps) {
            asked.position += along;
            const std::array before{holder.at(Bone::LeftLowerArm).position,
                                    holder.at(Bone::RightLowerArm).position,
                                    holder.at(Bone::LeftHand).position, holder.at(Bone::RightHand).position};
            const HoldReport report = holder.hold({grips, asked});
            const std::array now{holder.at(Bone::LeftLowerArm).position,
                                 holder.at(Bone::RightLowerArm).position, holder.at(Bone::LeftHand).position,
                                 holder.at(Bone::RightHand).position};
            double most = 0.0;
            for (std::size_t k = 0; k < 4; ++k) most = std::max(most, glm::distance(before[k], now[k]));
            EXPECT_TRUE(report.jumped || most < 0.03) << way << ' ' << i << ' ' << most;
            jumps += report.jumped;
        }
    }
    EXPECT_LT(jumps, steps / 100);
}

/// An object pushed aside between two frames has jumped, also while the other hand joins.
TEST(HumanoidHold, ReportsAJump) {
    Holder holder;
    const std::vector<Grip> grips = rim(holder.body, 0.2);
    const ObjectPose asked{{0.0, 1.25, 0.35}};
    for (const bool joins : {false, true}) {
        const std::span<const Grip> before = std::span(grips).subspan(joins ? 1 : 0);
        for (int i = 0; i < 30; ++i) EXPECT_FALSE(holder.hold({before, asked}).jumped && i > 20) << i;
        holder.state.hands[1].x += 4.0;
        holder.state.elbows[1].x += 4.0;
        EXPECT_TRUE(holder.hold({grips, asked}).jumped) << joins;
        EXPECT_FALSE(holder.hold({grips, asked}).jumped) << joins;
        holder.body_state = {}, holder.state = {};
    }
}

/// The object is still; a hand moves to another place on it and comes back.
TEST(HumanoidHold, ChangingAGripIsNotAJump) {
    Holder holder;
    std::vector<Grip> grips = rim(holder.body, 0.2);
    const ObjectPose asked{{0.0, 1.25, 0.35}};
    holder.settle({grips, asked});
    for (const double by : {0.1, -0.1}) {
        const glm::dvec3 before = holder.at(Bone::RightHand).position;
        grips[1].position.y += by;
        EXPECT_FALSE(holder.hold({grips, asked}).jumped);
        EXPECT_GT(glm::distance(before, holder.at(Bone::RightHand).position), 0.02);
    }
}

TEST(HumanoidHold, IterationsStopSoonAfterTheLimit) {
    Holder holder;
    const std::vector<Grip> grips = rim(holder.body, 0.2);
    for (const int most : {1, 5}) {
        holder.body_state = {}, holder.state = {};
        const HoldReport report = holder.hold({grips, {{1.2, 1.3, 1.1}}}, {.max_iterations = most});
        EXPECT_FALSE(report.settled);
        EXPECT_GE(report.iterations, most);
        EXPECT_LE(report.iterations, most + 20);
    }
}

/// The length of a direction has no effect.
TEST(HumanoidHold, PalmsMayBeOfAnyLength) {
    const Holder holder;
    const Palm palm{.hand = Effector::LeftHand, .fingers = {0, 0, 1}, .faces = {-1, 0, 0.5}};
    const Grip wanted = *grip_of(holder.body, palm, 0.08);
    for (const double size : {1e-8, 1e-3, 1e8}) {
        Palm other = palm;
        other.faces *= size, other.fingers *= 1.0 / size;
        if (size < 1e-7) other.fingers = palm.fingers;
        const auto grip = grip_of(holder.body, other, 0.08);
        ASSERT_TRUE(grip) << grip.message();
        EXPECT_LT(glm::distance(grip->position, wanted.position), 1e-9);
        EXPECT_GT(std::abs(glm::dot(*grip->rotation, *wanted.rotation)), 1.0 - 1e-12);
    }
    EXPECT_TRUE(
        says(grip_of(holder.body, {.faces = {0, -1e-10, 0}}, 0.1).message(), "palm.faces a direction 1e-10"));
    const glm::dvec3 along{0.3, 0.2, 0.9};
    EXPECT_TRUE(says(grip_of(holder.body, {.fingers = along, .faces = 1e8 * along}, 0.1).message(),
                     "palm.faces across the fingers"));
}

TEST(HumanoidHold, AllocatesNothingInLaterFrames) {
    Holder holder;
    const std::vector<Grip> grips = rim(holder.body, 0.2);
    holder.hold({grips, {{0.1, 1.2, 0.4}}});
    std::vector<rig::Transform> pose = rest_pose(holder.skeleton);
    bool held = false;
    without_memory([&] {
        const ObjectPose asked{{0.3, 1.3, 0.9}, glm::angleAxis(0.4, glm::dvec3(0, 0, 1))};
        held = static_cast<bool>(
            humanoid::hold(holder.body, pose, {}, {grips, asked}, holder.body_state, holder.state));
    });
    EXPECT_TRUE(held);
}

TEST(HumanoidHold, OneHandHolds) {
    Holder holder;
    const std::vector<Grip> grips{
        *grip_of(holder.body, {Effector::RightHand, {0, 0, 0}, {0, 0, 1}, {1, 0, 0}}, 0.08)};
    const ObjectPose asked{{-0.25, 1.2, 0.45}};
    const HoldReport report = holder.settle({grips, asked});
    EXPECT_TRUE(report.closed());
    EXPECT_LT(report.moved, 1e-3);
    EXPECT_FALSE(report.grips[0].holds);
    EXPECT_LT(holder.gap(grips[0], report.object), 1e-5);
    // The palm is at its grip, and faces left.
    const Placement& hand = holder.at(Bone::RightHand);
    const glm::dvec3 palm = hand.rotation() * glm::dvec3(0, -1, 0),
                     fingers = hand.rotation() * glm::dvec3(-1, 0, 0);
    EXPECT_LT(glm::distance(hand.position + 0.08 * fingers, report.object.position), 1e-3);
    EXPECT_GT(palm.x, 0.9);
    EXPECT_GT(fingers.z, 0.9);
}

TEST(HumanoidHold, RefusesBadInputByName) {
    Holder holder;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const std::vector<rig::Transform> rest = rest_pose(holder.skeleton);
    const auto refused = [&](const std::vector<Grip>& grips, const ObjectPose& asked = {},
                             const std::vector<BodyTarget>& targets = {}, const HoldOptions& options = {}) {
        std::vector<rig::Transform> pose = rest;
        BodyState body_state;
        HoldState state;
        const auto report = hold(holder.body, pose, targets, {grips, asked}, body_state, state, options);
        EXPECT_EQ(pose, rest);
        EXPECT_EQ(body_state, BodyState());
        EXPECT_EQ(state, HoldState());
        return report ? std::string("not refused") : std::string(report.message());
    };
    const Grip left{Effector::LeftHand}, right{Effector::RightHand};
    EXPECT_TRUE(says(refused({}), "hold object.grips one or two 0"));
    EXPECT_TRUE(says(refused({left, right, left}), "hold object.grips one or two 3"));
    EXPECT_TRUE(says(refused({left, left}), "object.grips 1 hand left_hand"));
    EXPECT_TRUE(says(refused({{Effector::Head}}), "object.grips 0 hand left_hand right_hand head"));
    EXPECT_TRUE(says(refused({{Effector::LeftHand, {0, nan, 0}}}), "object.grips[0].position.y nan"));
    EXPECT_TRUE(says(refused({{.axis = {1e300, 0, 0}}}), "object.grips[0].axis.x"));
    EXPECT_TRUE(says(refused({{.rotation = glm::dquat(0, 0, 0, 0)}}), "object.grips 0 rotation length 0"));
    EXPECT_TRUE(says(refused({left}, {{nan, 0, 0}}), "object.asked.position x nan"));
    EXPECT_TRUE(says(refused({left}, {{0, 0, 0}, glm::dquat(0, 0, 0, 0)}), "object.asked.rotation length 0"));
    EXPECT_TRUE(says(refused({left}, {}, {{Effector::LeftHand}}), "targets 0 effector left_hand"));
    EXPECT_TRUE(says(refused({left}, {}, {{Effector::Head, {0, nan, 0}}}), "targets[0].position.y nan"));
    EXPECT_TRUE(says(refused({left}, {}, {}, {.turn_length = 0.04}), "options.turn_length 0.05 1000 0.04"));
    EXPECT_TRUE(says(refused({left, {Effector::RightHand, {8e8, 0, 0}}}, {{8e8, 0, 0}}),
                     "hold: object.grips[1].position 1e9 1.6e+09"));
    HoldState bad;
    bad.hands[1].z = nan;
    std::vector<rig::Transform> pose = rest;
    const auto report = hold(holder.body, pose, {}, {std::span(&left, 1), {}}, holder.body_state, bad);
    EXPECT_TRUE(says(report ? "" : report.message(), "state.hands[1].z nan"));
    EXPECT_TRUE(says(grip_of(holder.body, {Effector::Hips}, 0.1).message(), "palm.hand hips"));
    EXPECT_TRUE(
        says(grip_of(holder.body, {.fingers = {0, 0, 0}}, 0.1).message(), "palm.fingers direction 0"));
    EXPECT_TRUE(says(grip_of(holder.body, {.fingers = {0, 1, 0}}, 0.1).message(), "palm.faces"));
    EXPECT_TRUE(says(grip_of(holder.body, {}, nan).message(), "reach nan"));
}

/// For any request, nothing is NaN and every limit holds.
TEST(HumanoidHold, StaysFinite) {
    RandomPoses random(7);
    Holder holder;
    for (int i = 0; i < 60; ++i) {
        const double size = std::pow(10.0, random.from(-9.0, 9.0));
        std::vector<Grip> grips{{.hand = Effector::LeftHand, .position = random.vector(size)},
                                {.hand = Effector::RightHand, .position = random.vector(i % 3 ? size : 0.0)}};
        if (i % 2) grips[0].rotation = random.turn(3.0), grips[0].axis = random.vector(1.0);
        if (i % 5 == 0) grips.pop_back();
        const HoldReport report = holder.hold({grips, {random.vector(i % 7 ? 2.0 : size), random.turn(3.1)}});
        for (const rig::Transform& each : holder.pose) ASSERT_TRUE(rig::checked(each, "pose", "node")) << i;
        ASSERT_TRUE(std::isfinite(report.moved + report.turned + report.grips[0].gap + report.grips[1].off));
        EXPECT_LT(holder.worst_excess(), 2e-3) << i;
    }
}

}  // namespace
}  // namespace tendril::test
