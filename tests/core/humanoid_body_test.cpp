// Whole-body reaching, on the figure of 1.8 m.
#include <tendril/humanoid/body.hpp>
#include <tendril/humanoid/hold.hpp>

#include "humanoid_figure.hpp"
#include "tests/labels.hpp"
#include "tests/says.hpp"

namespace tendril::test {
namespace {

constexpr Effector five[]{Effector::LeftHand, Effector::RightHand, Effector::Head, Effector::LeftFoot,
                          Effector::RightFoot};

class HumanoidBody : public testing::TestWithParam<bool>, protected Figured {
  protected:
    HumanoidBody() { place(skeleton, rest, placements); }
    /// A pose within the default limits; limbs turn by about `amount` radians.
    std::vector<rig::Transform> random_pose(RandomPoses& random, double amount) {
        std::vector<rig::Transform> pose;
        do {
            pose = rest;
            for (std::size_t i = 1; i < bone_count; ++i) {
                const auto bone = static_cast<Bone>(i);
                const bool trunk =
                    bone <= Bone::Head || bone == Bone::LeftShoulder || bone == Bone::RightShoulder;
                const double most = trunk ? 0.2 * amount : amount;
                const ik::Limit& limit = joints.limit(bone);
                if (limit.kind == ik::JointKind::Hinge) {
                    pose[node(bone)].rotation =
                        glm::angleAxis(random.from(0.0, 2.0 * most), glm::dvec3(limit.axis));
                } else {
                    const glm::dvec3 turn = random.vector(0.5 * most);
                    pose[node(bone)].rotation = glm::normalize(glm::dquat(1.0, turn.x, turn.y, turn.z));
                }
            }
        } while (worst_excess(pose) > 0.0);
        return pose;
    }
    double worst_excess(const std::vector<rig::Transform>& pose) {
        place(skeleton, pose, placements);
        double worst = 0.0;
        for (std::size_t i = 0; i < bone_count; ++i)
            worst = std::max(worst, static_cast<double>(joints.excess(static_cast<Bone>(i), placements)));
        return worst;
    }
    std::vector<BodyTarget> targets_of(const std::vector<rig::Transform>& pose) {
        place(skeleton, pose, placements);
        std::vector<BodyTarget> targets;
        for (const Effector each : five) targets.push_back({each, placements[node(bone_of(each))].position});
        return targets;
    }
    double worst_length_change(const std::vector<rig::Transform>& pose) {
        const auto before = positions_of(skeleton, rest), now = positions_of(skeleton, pose);
        double worst = 0.0;
        for (std::size_t i = 0; i < skeleton.size(); ++i) {
            if (skeleton[i].parent < 0) continue;
            const auto parent = static_cast<std::size_t>(skeleton[i].parent);
            worst = std::max(worst, std::abs(glm::distance(now[i], now[parent]) -
                                             glm::distance(before[i], before[parent])));
        }
        return worst;
    }

    BodyLimits limits = default_limits(skeleton, map);
    BodyJoints joints = *BodyJoints::make(skeleton, map, limits);
    Body body = *Body::make(skeleton, map, GetParam() ? limits : no_limits());
    std::vector<Placement> placements = std::vector<Placement>(skeleton.size());
};

LABEL(slow, "Limits/HumanoidBody.TargetsWhereTheClipHasTheEffectorsChangeNothing/*");
LABEL(slow, "Limits/HumanoidBody.FollowsTargetsInAndOutOfReachWithoutALeap/*");
LABEL(slow, "Limits/HumanoidBody.ASlowTargetGivesASlowPoseAndAStillOneAStillPose/*");
LABEL(slow, "Limits/HumanoidBody.KeepsLengthsAndLimitsForAnyTargets/*");

TEST_P(HumanoidBody, ReachesFiveTargetsWithinAMillimetre) {
    RandomPoses random(1);
    for (int i = 0; i < 400; ++i) {
        const auto targets = targets_of(random_pose(random, 0.5));
        auto pose = rest;
        BodyState state;
        const auto report = body.solve(pose, targets, state);
        ASSERT_TRUE(report) << report.message();
        EXPECT_LT(report->residual, 1e-3) << i;
        const auto at = positions_of(skeleton, pose);
        for (const BodyTarget& target : targets)
            EXPECT_NEAR(glm::distance(at[node(bone_of(target.effector))], target.position),
                        report->residuals[static_cast<std::size_t>(target.effector)], 1e-9);
    }
}

TEST_P(HumanoidBody, AStiffJointTurnsLessAndTheHandArrives) {
    RandomPoses random(7);
    double turned[2]{};
    for (int i = 0; i < 100; ++i) {
        auto targets = targets_of(random_pose(random, 0.5));
        targets.resize(1);
        for (const bool stiff : {false, true}) {
            BodyLimits changed = GetParam() ? limits : no_limits();
            const Bone bone =
                humanoid::bone_of(targets[0].effector) == Bone::LeftHand ? Bone::LeftUpperArm : Bone::Spine;
            changed[static_cast<std::size_t>(bone)].stiffness = stiff ? 0.95f : 0.0f;
            Body other = *Body::make(skeleton, map, changed);
            auto pose = rest;
            BodyState state;
            const auto report = other.solve(pose, targets, state);
            ASSERT_TRUE(report) << report.message();
            EXPECT_LT(report->residual, 1e-3) << i;
            const double dot = std::abs(glm::dot(pose[node(bone)].rotation, rest[node(bone)].rotation));
            turned[stiff] += 2.0 * std::acos(std::min(dot, 1.0));
        }
    }
    EXPECT_LT(turned[1], 0.5 * turned[0]);
}

TEST_P(HumanoidBody, KeepsLengthsAndLimitsForAnyTargets) {
    RandomPoses random(2);
    const double sizes[]{0.3, 1.0, 5.0, 1e3, 1e9};
    for (int i = 0; i < 10000; ++i) {
        const auto start = positions_of(skeleton, rest);
        std::vector<BodyTarget> targets;
        for (std::size_t k = 0; k < effector_count; ++k) {
            const auto effector = static_cast<Effector>(k);
            if (random.from(0.0, 1.0) < 0.3) continue;
            const glm::dvec3 off = random.vector(sizes[i % 5] * 0.99);
            targets.push_back({effector, start[node(bone_of(effector))] * (i % 5 == 4 ? 0.0 : 1.0) + off});
            if (random.from(0.0, 1.0) < 0.3) targets.back().rotation = random.rotation();
            if (random.from(0.0, 1.0) < 0.3) targets.back().weight = random.from(0.0, 5.0);
        }
        auto pose = rest;
        BodyState state;
        const auto report = body.solve(pose, targets, state);
        ASSERT_TRUE(report) << report.message();
        for (const glm::dvec3& each : positions_of(skeleton, pose))
            ASSERT_TRUE(std::isfinite(each.x + each.y + each.z)) << i;
        // At 1e9 m, doubles resolve a tenth of a micrometre.
        ASSERT_LT(worst_length_change(pose), sizes[i % 5] > 1e6 ? 1e-6 : 1e-12) << i;
        if (GetParam()) {
            ASSERT_LT(worst_excess(pose), 0.1 * 3.14159 / 180.0) << i;
        }
    }
}

TEST_P(HumanoidBody, ASlowTargetGivesASlowPoseAndAStillOneAStillPose) {
    RandomPoses random(3);
    for (const double step : {5e-3, 1e-3, 2e-4})
        for (int i = 0; i < (step < 1e-3 ? 4 : 12); ++i) {
            const auto from = targets_of(rest), to = targets_of(random_pose(random, 0.5));
            double way = 0.0;
            for (std::size_t k = 0; k < 5; ++k)
                way = std::max(way, glm::distance(from[k].position, to[k].position));
            const int frames = static_cast<int>(std::ceil(way / step));
            BodyState state;
            auto before = positions_of(skeleton, rest);
            for (int frame = 1; frame <= frames; ++frame) {
                auto targets = to;
                for (std::size_t k = 0; k < 5; ++k)
                    targets[k].position =
                        glm::mix(from[k].position, to[k].position, static_cast<double>(frame) / frames);
                auto pose = rest;
                ASSERT_TRUE(body.solve(pose, targets, state));
                const auto now = positions_of(skeleton, pose);
                ASSERT_LT(farthest(before, now), 20.0 * way / frames) << step << ' ' << i << ' ' << frame;
                before = now;
            }
            for (int frame = 0; frame < 3; ++frame) {
                auto pose = rest;
                ASSERT_TRUE(body.solve(pose, to, state));
                const auto now = positions_of(skeleton, pose);
                ASSERT_LT(farthest(before, now), 1e-5);
                before = now;
            }
        }
}

TEST_P(HumanoidBody, FollowsTargetsInAndOutOfReachWithoutALeap) {
    RandomPoses random(4);
    for (int i = 0; i < 12; ++i) {
        const std::size_t count = i % 3 == 0 ? 1 : i % 3 == 1 ? 2 : 5;
        std::vector<glm::dvec3> size(count), speed(count);
        for (std::size_t k = 0; k < count; ++k) size[k] = random.vector(1.0), speed[k] = random.vector(1.0);
        const auto home = targets_of(rest);
        BodyState state;
        std::vector<BodyTarget> last;
        auto before = positions_of(skeleton, rest);
        for (int frame = 0; frame < 1500; ++frame) {
            std::vector<BodyTarget> targets(home.begin(), home.begin() + static_cast<std::ptrdiff_t>(count));
            double moved = 0.0;
            for (std::size_t k = 0; k < count; ++k) {
                for (int axis = 0; axis < 3; ++axis)
                    targets[k].position[axis] +=
                        size[k][axis] * std::sin(0.004 * frame * (1.0 + speed[k][axis]));
                if (!last.empty())
                    moved = std::max(moved, glm::distance(targets[k].position, last[k].position));
            }
            auto pose = rest;
            ASSERT_TRUE(body.solve(pose, targets, state));
            const auto now = positions_of(skeleton, pose);
            if (!last.empty() && moved > 2e-4) {
                ASSERT_LT(farthest(before, now), 20.0 * moved) << i << ' ' << frame;
            }
            before = now;
            last = targets;
        }
    }
}

TEST_P(HumanoidBody, ConflictingTargetsAreSharedByWeight) {
    const std::vector<BodyTarget> targets{{Effector::LeftHand, {3.0, 1.3, 0.0}, {}, 1.0},
                                          {Effector::RightHand, {-3.0, 1.3, 0.0}, {}, 3.0},
                                          {Effector::LeftFoot, {0.1, 0.09, 0.0}, {}, 1e-3},
                                          {Effector::RightFoot, {-0.1, 0.09, 0.0}, {}, 1e-3}};
    BodyState state;
    std::vector<glm::dvec3> before;
    for (int frame = 0; frame < 60; ++frame) {
        auto pose = rest;
        const auto report = body.solve(pose, targets, state);
        ASSERT_TRUE(report);
        const auto now = positions_of(skeleton, pose);
        if (frame >= 40) {
            EXPECT_LT(farthest(before, now), 1e-5) << frame;
        }
        before = now;
        if (frame < 59) continue;
        // Force balance: weight times residual is the same on both sides.
        const double left = report->residuals[static_cast<std::size_t>(Effector::LeftHand)];
        const double right = report->residuals[static_cast<std::size_t>(Effector::RightHand)];
        EXPECT_NEAR(left / right, 3.0, 0.15);
    }
}

TEST_P(HumanoidBody, TargetsWhereTheClipHasTheEffectorsChangeNothing) {
    RandomPoses random(5);
    for (int i = 0; i < rounds(50); ++i) {
        const auto clip = random_pose(random, 1.0);
        const auto targets = targets_of(clip);
        auto pose = clip;
        BodyState state;
        ASSERT_TRUE(body.solve(pose, targets, state));
        EXPECT_LT(farthest(positions_of(skeleton, clip), positions_of(skeleton, pose)), 1e-9);
    }
}

TEST_P(HumanoidBody, WithoutTargetsThePoseStaysBitForBit) {
    RandomPoses random(6);
    const auto clip = random_pose(random, 1.0);
    auto pose = clip;
    BodyState state;
    ASSERT_TRUE(body.solve(pose, std::vector<BodyTarget>{{Effector::LeftHand, {0.3, 1.2, 0.4}}}, state));
    EXPECT_NE(pose, clip);
    EXPECT_NE(state, BodyState{});
    pose = clip;
    ASSERT_TRUE(
        body.solve(pose, std::vector<BodyTarget>{{Effector::LeftHand, {0.3, 1.2, 0.4}, {}, 0.0}}, state));
    EXPECT_EQ(pose, clip);
    EXPECT_EQ(state, BodyState{});
}

TEST_P(HumanoidBody, OneHandReachesByItsArmAndTheFeetStay) {
    auto pose = rest;
    BodyState state;
    const auto report =
        body.solve(pose, std::vector<BodyTarget>{{Effector::LeftHand, {0.35, 1.25, 0.35}}}, state);
    ASSERT_TRUE(report);
    EXPECT_LT(report->residual, 1e-3);
    const auto before = positions_of(skeleton, rest), now = positions_of(skeleton, pose);
    const auto moved = [&](Bone bone) { return glm::distance(before[node(bone)], now[node(bone)]); };
    EXPECT_LT(moved(Bone::LeftFoot), 1e-3);
    EXPECT_LT(moved(Bone::RightFoot), 1e-3);
    EXPECT_LT(moved(Bone::Hips), 0.05);
    EXPECT_LT(moved(Bone::Head), 0.08);
    EXPECT_GT(moved(Bone::LeftLowerArm), 0.1);
}

TEST_P(HumanoidBody, SinkingHipsBendTheKneesForward) {
    auto pose = rest;
    BodyState state;
    const auto report = body.solve(pose, std::vector<BodyTarget>{{Effector::Hips, {0.0, 0.75, 0.0}}}, state);
    ASSERT_TRUE(report);
    EXPECT_LT(report->residual, 1e-3);
    const auto now = positions_of(skeleton, pose);
    for (const Bone knee : {Bone::LeftLowerLeg, Bone::RightLowerLeg}) EXPECT_GT(now[node(knee)].z, 0.2);
}

TEST_P(HumanoidBody, AHandTakesItsTargetsRotationAndSharesTheTwist) {
    const glm::dquat half = glm::angleAxis(1.2, glm::dvec3(1, 0, 0));  // about the forearm's rest direction
    auto pose = rest;
    BodyState state;
    const auto at = positions_of(skeleton, rest)[node(Bone::LeftHand)];
    const std::vector<BodyTarget> targets{{Effector::LeftHand, at, half}};
    for (int i = 0; i < 5; ++i) {
        pose = rest;
        ASSERT_TRUE(body.solve(pose, targets, state));
        place(skeleton, pose, placements);
        const auto angle_of = [&](Bone bone) {
            const glm::dquat q = placements[node(bone)].rotation();
            return 2.0 * std::acos(std::min(std::abs(q.w), 1.0));
        };
        EXPECT_NEAR(angle_of(Bone::LeftHand), 1.2, 1e-3) << i;
        EXPECT_NEAR(angle_of(Bone::LeftLowerArm), 0.6, 1e-2) << i;
    }
}

TEST_P(HumanoidBody, NodesBetweenBonesAndAboveThemTurnAlong) {
    // The same figure below a rotated, moved and doubled root, with a node in the middle of a forearm.
    std::vector<Node> nodes{
        {"root", -1, {{1.0, 0.5, -2.0}, glm::angleAxis(0.7, glm::dvec3(0, 1, 0)), {2.0, 2.0, 2.0}}}};
    for (const Node& each : skeleton.nodes()) {
        nodes.push_back(each);
        nodes.back().parent += 1;
    }
    const auto hand = node(Bone::LeftHand) + 1, forearm = node(Bone::LeftLowerArm) + 1;
    nodes.push_back({"between", static_cast<std::int32_t>(forearm), {{0.1, 0.0, 0.0}}});
    nodes[hand].parent = static_cast<std::int32_t>(nodes.size()) - 1;
    nodes[hand].rest.translation -= glm::dvec3(0.1, 0.0, 0.0);
    const Skeleton larger = *Skeleton::make(nodes);
    const BoneMap mapped = match_bones(larger);
    ASSERT_TRUE(mapped.is_usable());
    Body other = *Body::make(larger, mapped, GetParam() ? default_limits(larger, mapped) : no_limits());
    std::vector<Placement> at(larger.size());
    auto pose = rest_pose(larger);
    place(larger, pose, at);
    const glm::dvec3 target = at[hand].position + at[0].axes * glm::dvec3(-0.3, -0.2, 0.3);
    BodyState state;
    const auto report = other.solve(pose, std::vector<BodyTarget>{{Effector::LeftHand, target}}, state);
    ASSERT_TRUE(report);
    place(larger, pose, at);
    EXPECT_LT(glm::distance(at[hand].position, target), 2e-3);
    EXPECT_LT(report->residual, 2e-3);
}

TEST_P(HumanoidBody, BadInputIsRefusedAndNothingMoves) {
    auto pose = rest;
    BodyState state;
    const auto refused = [&](const std::vector<BodyTarget>& targets, const BodyOptions& options = {}) {
        const auto report = body.solve(pose, targets, state, options);
        EXPECT_EQ(pose, rest);
        return std::string(report.message());
    };
    const double nan = std::nan("");
    EXPECT_TRUE(
        says(refused({{Effector::Head, {0.0, nan, 0.0}}}), "Body::solve targets[0].position.y 1e9 nan"));
    EXPECT_TRUE(says(refused({{Effector::Head, {}}, {Effector::Head, {}}}),
                     "Body::solve targets[1].effector once head"));
    EXPECT_TRUE(says(refused({{Effector::Head, {}, glm::dquat(0.0, 0.0, 0.0, 0.0)}}),
                     "targets[0].rotation quaternion of length 1e-6 to 1e9"));
    EXPECT_TRUE(says(refused({{Effector::Head, {}}}, {.tolerance = 0.0}),
                     "Body::solve options.tolerance over 0 to 1 0"));
    state.turns.resize(body.bones().size(), glm::dquat(1.0, 0.0, 0.0, 0.0));
    state.clip[2].z = nan;
    EXPECT_TRUE(says(refused({{Effector::Head, {}}}), "Body::solve state.clip[2].z nan"));
    state.clip[2].z = 0.0;
    state.turns.resize(3);
    EXPECT_FALSE(refused({{Effector::Head, {}}}).empty());
    BoneMap gap = map;
    gap[Bone::LeftHand] = {};
    review(gap, skeleton);
    EXPECT_TRUE(says(std::string(Body::make(skeleton, gap).message()), "Body LeftHand mapped none"));
}

INSTANTIATE_TEST_SUITE_P(Limits, HumanoidBody, testing::Bool(),
                         [](const auto& each) { return each.param ? "default" : "none"; });

TEST(HumanoidBodyMap, NamesTheBoneThatIsNotBelowTheHips) {
    std::vector<Node> nodes;
    const Skeleton figure = make_figure({});
    for (std::size_t i = 0; i < figure.size(); ++i) nodes.push_back(figure[i]);
    nodes.push_back({"Foot.L", -1, {}});
    const Skeleton skeleton = *Skeleton::make(std::move(nodes));
    BoneMap map = match_bones(skeleton);
    map.bones[static_cast<std::size_t>(Bone::LeftFoot)].node = static_cast<std::int32_t>(skeleton.size()) - 1;
    const auto body = Body::make(skeleton, map);
    ASSERT_FALSE(body);
    EXPECT_STREQ(body.message(), "Foot.L is not below the hips. Pick another node for LeftFoot");
}

struct Kept {
    bool limits = false, capsules = false, balance = false, hold = false;
};

/// The figure and its targets at another size, mirrored, or with the targets in another order.
struct Alike {
    double scale = 1.0;
    bool mirrored = false, reversed = false;

    glm::dvec3 at(const glm::dvec3& v) const { return scale * glm::dvec3(mirrored ? -v.x : v.x, v.y, v.z); }
    Effector of(Effector effector) const {  // hips, head, then pairs
        return mirrored && effector > Effector::Head ? static_cast<Effector>(static_cast<int>(effector) ^ 1)
                                                     : effector;
    }
    /// The effectors' and knees' positions in each of some solves, taken back.
    std::vector<glm::dvec3> solve(const Kept& kept, std::vector<BodyTarget> targets,
                                  ObjectPose object) const {
        std::vector<Node> nodes = make_figure({}).nodes();
        for (Node& node : nodes) node.rest.translation *= scale;
        const Skeleton skeleton = *Skeleton::make(std::move(nodes));
        const BoneMap map = match_bones(skeleton);
        const auto capsules = kept.capsules ? default_capsules(skeleton, map) : std::vector<BodyCapsule>{};
        Body body =
            *Body::make(skeleton, map, kept.limits ? default_limits(skeleton, map) : no_limits(), capsules);
        for (BodyTarget& each : targets) each.effector = of(each.effector), each.position = at(each.position);
        std::vector<Grip> grips{{of(Effector::LeftHand), at({0.2, 0, 0})},
                                {of(Effector::RightHand), at({-0.2, 0, 0})}};
        object.position = at(object.position);
        if (reversed) std::ranges::reverse(targets), std::ranges::reverse(grips);
        BodyState state;
        HoldState holding;
        HoldOptions options;
        options.body.balance = kept.balance;
        std::vector<glm::dvec3> result;
        for (int i = 0; i < (kept.balance ? 1 : 3); ++i) {
            auto pose = rest_pose(skeleton);
            if (kept.hold)
                EXPECT_TRUE(hold(body, pose, targets, {grips, object}, state, holding, options));
            else
                EXPECT_TRUE(body.solve(pose, targets, state, options.body));
            const auto now = positions_of(skeleton, pose);
            for (const Effector each : five)
                for (const std::int32_t node :
                     {map[bone_of(of(each))].node,
                      skeleton[static_cast<std::size_t>(map[bone_of(of(each))].node)].parent})
                    result.push_back(at(now[static_cast<std::size_t>(node)]) / (scale * scale));
        }
        return result;
    }
};

class HumanoidBodyAlike : public testing::TestWithParam<Kept> {};
LABEL(slow, "Kept/HumanoidBodyAlike.*");

TEST_P(HumanoidBodyAlike, AnySizeSideAndOrderGivesTheSamePose) {
    RandomPoses random(11);
    const Figured figure;
    const double height = 1.8, sizes[]{0.01, 0.1, 2.0, 10.0, 100.0};
    for (int i = 0; i < 200; ++i) {
        std::vector<BodyTarget> targets;
        for (const Effector each : five) {
            const bool hand = each <= Effector::RightHand && each >= Effector::LeftHand;
            if (random(0.0, 1.0) < 0.4 || (hand && GetParam().hold)) continue;
            targets.push_back(
                {each, figure.at(figure.rest, bone_of(each)) + random.vector(hand ? 0.5 : 0.2)});
            if (random(0.0, 1.0) < 0.3) targets.back().weight = random(0.1, 5.0);
        }
        const ObjectPose object{glm::dvec3(0.0, 1.15, 0.45) + random.vector(0.25)};
        const auto solve = [&](const Alike& alike) { return alike.solve(GetParam(), targets, object); };
        const auto pose = solve({});
        EXPECT_EQ(pose, solve({.reversed = true})) << i;
        EXPECT_LT(farthest(pose, solve({.scale = sizes[i % 5]})), 1e-4 * height) << i << ' ' << sizes[i % 5];
        // Limits count in floats, and balance magnifies their rounding.
        EXPECT_LT(farthest(pose, solve({.mirrored = true})), (GetParam().balance ? 1e-4 : 1e-5) * height)
            << i;
    }
}

INSTANTIATE_TEST_SUITE_P(Kept, HumanoidBodyAlike,
                         testing::Values(Kept{}, Kept{.limits = true}, Kept{.limits = true, .capsules = true},
                                         Kept{.limits = true, .capsules = true, .balance = true},
                                         Kept{.limits = true, .capsules = true, .hold = true}));

// A body whose targets are released or reweighted while its state continues.

class HumanoidBodySwitch : public testing::Test, protected Figured {
  protected:
    double any(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine); }
    glm::dvec3 near(const glm::dvec3& at, double size) {
        const double x = any(-size, size), y = any(-size, size), z = any(-size, size);
        return at + glm::dvec3(x, y, z);
    }
    std::vector<glm::dvec3> solve(const std::vector<BodyTarget>& targets, const BodyOptions& options = {}) {
        auto pose = rest;
        const auto made = body.solve(pose, targets, state, options);
        EXPECT_TRUE(made) << made.message();
        if (made) report = *made;
        return positions_of(skeleton, pose);
    }
    /// Solves until the pose is at rest.
    std::vector<glm::dvec3> settled(const std::vector<BodyTarget>& targets) {
        std::vector<glm::dvec3> at;
        for (int i = 0; i < 40; ++i) at = solve(targets);
        return at;
    }
    double farthest(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b, Bone without) const {
        double most = 0.0;
        for (std::size_t i = 0; i < a.size(); ++i)
            if (i != node(without) && !skeleton.is_below(i, node(without)))
                most = std::max(most, glm::distance(a[i], b[i]));
        return most;
    }
    double residual(Effector effector) const { return report.residuals[static_cast<std::size_t>(effector)]; }

    Body body = *Body::make(skeleton, map, default_limits(skeleton, map));
    BodyState state;
    BodyReport report;
    std::mt19937 engine{5};
};

TEST_F(HumanoidBodySwitch, ReleasingAHandMovesOnlyItsArm) {
    int reached = 0;
    for (int i = 0; i < 100; ++i) {
        state = {};
        const std::vector<BodyTarget> both{{Effector::LeftHand, near({0.35, 1.2, 0.4}, 0.3)},
                                           {Effector::RightHand, near({-0.35, 1.1, 0.5}, 0.4)}};
        const auto before = settled(both);
        if (report.residual > 1e-4) continue;
        ++reached;
        const auto now = solve({both[0]});
        EXPECT_LT(farthest(before, now, Bone::RightUpperArm), 5e-3) << i;
    }
    EXPECT_GT(reached, 30);
}

TEST_F(HumanoidBodySwitch, TheTrunkSettlesGraduallyWhenOnlyAFootIsHeld) {
    const BodyTarget foot{Effector::LeftFoot, {0.15, 0.3, 0.2}}, hand{Effector::RightHand, {-0.2, 0.8, 0.9}};
    const auto before = settled({foot, hand});
    auto now = solve({foot});
    EXPECT_LT(farthest(before, now, Bone::RightUpperArm), 5e-3);
    for (int frame = 0; frame < 90; ++frame) {
        const auto next = solve({foot}, {.settle = 0.02});
        EXPECT_LT(farthest(now, next, Bone::RightUpperArm), 0.05) << frame;
        now = next;
    }
    state = {};
    EXPECT_LT(farthest(now, settled({foot}), Bone::RightUpperArm), 0.05);
}

TEST_F(HumanoidBodySwitch, ReleasingATargetLetsTheOtherOneBeReached) {
    const std::vector<BodyTarget> both{{Effector::LeftHand, {0.9, 1.3, 0.2}},
                                       {Effector::RightHand, {-1.2, 1.3, 0.2}}};
    settled(both);
    EXPECT_GT(residual(Effector::LeftHand), 0.02);
    settled({both[0]});
    EXPECT_LT(residual(Effector::LeftHand), 1e-3);
}

TEST_F(HumanoidBodySwitch, WeightsBlendSlowlyAndScaleTheResiduals) {
    for (int i = 0; i < 8; ++i) {
        state = {};
        std::vector<BodyTarget> targets{{Effector::LeftHand, near({1.4, 1.3, 0.2}, 0.3)},
                                        {Effector::RightHand, near({-1.4, 1.3, 0.2}, 0.3)}};
        auto before = settled(targets);
        const auto first = before;
        const double even = residual(Effector::LeftHand) / residual(Effector::RightHand);
        for (int k = 1; k <= 200; ++k) {
            targets[1].weight = k <= 100 ? 1.0 - 0.005 * k : 0.005 * k;
            const double way = report.residual * 0.005 / targets[1].weight;
            const auto now = solve(targets);
            ASSERT_LT(farthest(before, now, Bone::Head), 20.0 * way) << i << ' ' << k;
            before = now;
            if (k != 100) continue;
            before = settled(targets);
            EXPECT_NEAR(residual(Effector::LeftHand) / residual(Effector::RightHand), 0.5 * even, 0.15 * even)
                << i;
        }
        EXPECT_LT(farthest(first, settled(targets), Bone::Head), 0.1) << i;
    }
}

TEST_F(HumanoidBodySwitch, SettlingReturnsTheBodyAndKeepsTheHand) {
    const std::vector<BodyTarget> both{{Effector::LeftHand, {0.3, 1.2, 0.4}},
                                       {Effector::RightHand, {-0.2, 0.8, 0.9}}};
    const glm::dvec3 alone = settled({both[0]})[node(Bone::Head)];
    state = {};
    settled(both);
    auto before = solve({both[0]});
    EXPECT_GT(glm::distance(before[node(Bone::Head)], alone), 0.5) << "it has bent down";
    for (int frame = 0; frame < 90; ++frame) {
        const auto now = solve({both[0]}, {.settle = 0.02});
        EXPECT_LT(report.residual, 1e-3) << frame;
        EXPECT_LT(farthest(before, now, Bone::RightUpperArm), 0.05) << frame;
        before = now;
    }
    EXPECT_LT(glm::distance(before[node(Bone::Head)], alone), 0.05);
    EXPECT_LT(farthest(before, solve({both[0]}), Bone::RightUpperArm), 1e-5) << "then it is still";
}

}  // namespace
}  // namespace tendril::test
