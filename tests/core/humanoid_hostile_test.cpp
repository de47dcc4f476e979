// Every library function that takes a skeleton, map or pose, with unsuitable input: another character's map,
// duplicate nodes, a bone above its parent; non-finite or enormous poses. Either it is refused and nothing
// changes, or the output is finite and passes the input checks; bones keep their lengths, and hands and the
// head allocate nothing.
#include <cstring>
#include <tendril/tendril.hpp>

#include "humanoid_figure.hpp"
#include "memory.hpp"
#include "random.hpp"
#include "tests/labels.hpp"
#include "tests/says.hpp"

namespace tendril::test {
namespace {

bool is_fine(double value) {
    return std::isfinite(value);
}
bool is_fine(const glm::dvec3& v) {
    return is_fine(v.x) && is_fine(v.y) && is_fine(v.z);
}
bool is_fine(const rig::Transform& local) {
    return is_fine(local.translation) && is_fine(local.scale) &&
           is_fine(glm::dot(local.rotation, local.rotation));
}
bool is_fine(const std::vector<rig::Transform>& pose) {
    return std::all_of(pose.begin(), pose.end(), [](const rig::Transform& each) { return is_fine(each); });
}

class HostileHumanoid : public testing::Test {
  protected:
    double unit() { return static_cast<double>(random.bits() >> 11) * 0x1p-53; }
    double between(double from, double to) { return from + (to - from) * unit(); }
    /// Any double: non-finite values too.
    double any() {
        constexpr double endless = std::numeric_limits<double>::infinity(),
                         none = std::numeric_limits<double>::quiet_NaN();
        constexpr double numbers[]{0.0, -0.0, 1e-300, -1e-12, 1e-6,  1.0,   -3.0,    1e4,
                                   1e8, -1e9, 1.1e9,  1e18,   1e154, 1e300, endless, none};
        return numbers[random.below(std::size(numbers))];
    }
    /// Usually a plausible value, sometimes any double.
    double number(double from, double to, std::size_t odd = 60) {
        return random.chance(odd) ? any() : between(from, to);
    }
    glm::dvec3 point(double range, std::size_t odd = 60) {
        return {number(-range, range, odd), number(-range, range, odd), number(-range, range, odd)};
    }
    glm::dquat rotation(std::size_t odd = 60) {
        if (random.chance(odd)) return {any(), any(), any(), any()};
        return rig::normalised(glm::dquat(between(-1, 1), between(-1, 1), between(-1, 1), between(-1, 1)));
    }

    Skeleton skeleton() {
        if (random.chance(8)) return {};
        std::vector<Node> nodes = make_figure({}, between(0.0, 7.0)).nodes();
        if (random.chance(3)) {  // shuffled parents, or only part of the figure
            nodes.resize(1 + random.below(nodes.size()));
            for (std::size_t i = 0; i < nodes.size(); ++i)
                if (random.chance(4)) nodes[i].parent = static_cast<std::int32_t>(random.below(i + 1)) - 1;
        }
        const double size = random.chance(3) ? std::pow(10.0, between(-8.0, 8.0)) : 1.0;
        for (Node& node : nodes) {
            node.rest.translation *= size;
            if (random.chance(40)) node.rest.translation = point(2.0, 2);
            if (random.chance(40)) node.rest.rotation = rotation(8);
            if (random.chance(60)) node.rest.scale = {any(), 1.0, any()};
        }
        Expected<Skeleton> made = Skeleton::make(nodes);
        return made ? *made : make_figure({});
    }
    BoneMap map_of(const Skeleton& body) {
        BoneMap map = match_bones(random.chance(5) ? make_figure({}) : body);
        while (random.chance(2)) {
            BoneMatch& match = map.bones[random.below(bone_count)];
            if (random.chance(2))
                match.node = map.bones[random.below(bone_count)].node;
            else
                match.node = static_cast<std::int32_t>(random.below(body.size() + 6)) - 3;
            if (random.chance(20)) match.node = std::numeric_limits<std::int32_t>::max();
        }
        if (random.chance(2)) map.missing.clear(), map.upright = true;
        return map;
    }
    std::vector<rig::Transform> pose_of(const Skeleton& body) {
        std::vector<rig::Transform> pose = rest_pose(body);
        for (rig::Transform& local : pose) {
            if (random.chance(3)) local.rotation = rotation(300);
            if (random.chance(200)) local.translation = point(1.0, 3);
            if (random.chance(300)) local.scale = point(2.0, 3);
        }
        if (!pose.empty() && random.chance(2)) pose[0].translation += point(1.0, 200);
        if (random.chance(20)) pose.resize(random.below(pose.size() + 2));
        return pose;
    }
    Ground ground() {
        switch (random.below(5)) {
            case 0:
                return *Ground::flat(between(-1.0, 1.0));
            case 1:
                return *Ground::slope(between(-1.2, 1.2));
            case 2:
                return *Ground::stairs(between(-0.5, 0.5), between(0.05, 0.5));
            case 3: {
                HeightField field{.x = -2.0, .z = -2.0, .cell = 0.1, .columns = 41, .heights = {}};
                for (int i = 0; i < 41 * 41; ++i) field.heights.push_back(between(-0.3, 0.3));
                return *Ground::terrain(field);
            }
            default:
                return {};
        }
    }
    double far() { return std::pow(10.0, between(-9.0, 8.0)); }
    double step_time() {
        constexpr double times[]{0.0, 1.0 / 60, 1.0 / 60, 1.0 / 60, 1e-300, 1e-12, 1e-6, 0.4, 1e6, 1e300};
        return random.chance(30) ? any() : times[random.below(std::size(times))];
    }

    Random random{20261126};
};

TEST_F(HostileHumanoid, AnInvalidPoseIsRefusedAndTheStateStaysValid) {
    std::size_t refused = 0, taken = 0, steps[3]{};
    const int all = rounds(1200);
    for (int round = all; round > 0; --round) {
        const Skeleton body = round % 2 == 0 ? skeleton() : make_figure({}, between(0.0, 7.0));
        const BoneMap map = round % 2 == 0 ? map_of(body) : match_bones(body);
        Expected<Body> solver = Body::make(body, map, default_limits(body, map), default_capsules(body, map));
        const Expected<Feet> feet = Feet::make(body, map);
        const Expected<Hands> hands = Hands::make(body, map);
        const Expected<LookAt> look_at = LookAt::make(body, map);
        Expected<SpringChain> spring = SpringChain::make(body, map, random.below(body.size() + 1));
        const Expected<Masses> masses = find_masses(body, map);
        if (!check(map, body)) {
            EXPECT_FALSE(solver || feet || hands || look_at || spring || masses)
                << check(map, body).message();
            ++refused;
        }
        BodyState body_state;
        FeetState feet_state, many_state;
        HandsState hands_state;
        LookAtState look_state;
        SpringChainState spring_state;
        for (int frame = 0; frame < 12; ++frame) {
            const Ground below = ground();
            const std::vector<rig::Transform> clip = pose_of(body);
            const double dt = step_time();
            const rig::Transform root{.translation = point(2.0, 100), .rotation = rotation(100)};
            std::vector<rig::Transform> pose = clip;
            const auto node_of = [&](Bone bone) { return static_cast<std::size_t>(map[bone].node); };
            const auto holds = [&](const char* what, bool valid, bool state_stays) {
                taken += valid;
                if (!valid) {
                    EXPECT_TRUE(same_bits(pose, clip)) << what;
                    EXPECT_TRUE(state_stays) << what;
                } else {
                    EXPECT_TRUE(is_fine(pose)) << what;
                    for (std::size_t i = 0; i < pose.size(); ++i)
                        EXPECT_NEAR(glm::length(pose[i].rotation), glm::length(clip[i].rotation), 1e-9)
                            << what;
                }
                pose = clip;
                return valid;
            };
            if (solver) {
                std::vector<BodyTarget> targets;
                for (std::size_t i = 0; i < effector_count; ++i)
                    if (random.chance(3))
                        targets.push_back(
                            {static_cast<Effector>(i), point(2.0, 50), std::nullopt, number(0.0, 2.0)});
                if (!targets.empty() && random.chance(2)) targets[0].rotation = rotation();
                BodyOptions options{.max_iterations = 1 + static_cast<int>(random.below(8))};
                if (random.chance(10)) options.settle = any();
                const BodyState before = body_state;
                const Expected<BodyReport> report = solver->solve(pose, targets, body_state, options);
                holds("body", bool(report), body_state == before);
                if (report) {
                    EXPECT_TRUE(is_fine(report->residual) && is_fine(report->penetration));
                    for (const double residual : report->residuals) EXPECT_TRUE(is_fine(residual));
                    // The output is valid input again, unless the rest pose is invalid.
                    std::vector<rig::Transform> rest = rest_pose(body);
                    BodyState copy = body_state;
                    const Expected<BodyReport> again = solver->solve(rest, {}, copy, {});
                    EXPECT_TRUE(again || std::string_view(again.error().message()).find("state") ==
                                             std::string_view::npos)
                        << again.error().message();
                }
            }
            if (feet) {
                FeetOptions options{.weight = random.chance(10) ? any() : std::min(between(0.0, 2.0), 1.0),
                                    .root = root,
                                    .root_velocity = point(1.0, 100),
                                    .max_turn = between(0.0, 1.48),
                                    .max_slope = between(0.0, 1.48)};
                const FeetState before = feet_state;
                FeetJob job{.feet = &*feet, .pose = pose, .state = &many_state, .options = options};
                many_state = feet_state;
                step_many({&job, 1}, below, dt);
                const std::vector<rig::Transform> many = std::exchange(pose, clip);
                const FeetReport report = feet->step(pose, below, dt, feet_state, options);
                EXPECT_TRUE(same_bits(many, pose) && many_state == feet_state);
                EXPECT_TRUE(check(feet_state)) << check(feet_state).message();
                for (const FootReport& foot : report.feet)
                    EXPECT_TRUE(is_fine(foot.heel) && is_fine(foot.toe));
                EXPECT_TRUE(is_fine(report.base) && is_fine(report.drop));
                for (std::size_t i = 0; report.accepted && i < pose.size(); ++i)
                    EXPECT_TRUE(i == node_of(Bone::Hips) || pose[i].translation == clip[i].translation);
                steps[0] += holds("feet", report.accepted.ok(), feet_state == before);
            }
            if (hands) {
                const HandsState before = hands_state;
                HandTargets targets;
                for (HandTarget& each : targets)
                    each = {rotation() * glm::dvec3(far(), 0, 0), std::nullopt, number(0.0, 1.0)};
                if (random.chance(2)) targets[0].rotation = rotation();
                if (random.chance(5) && pose.size() == body.size()) {
                    std::vector<Placement> placed(body.size());
                    place(body, pose, placed);
                    targets[0].position = placed[node_of(Bone::LeftUpperArm)].position;
                }
                HandsReport report;
                const HandsOptions options{.root = root, .view = random.chance(2) ? 3.14 : 1.0};
                without_memory([&] { report = hands->step(pose, targets, dt, hands_state, options); });
                for (const HandReport& hand : report.hands)
                    EXPECT_TRUE(is_fine(hand.residual) && is_fine(hand.position) && is_fine(hand.weight));
                steps[1] += holds("hands", report.accepted.ok(), hands_state == before);
            }
            if (look_at) {
                const LookAtState before = look_state;
                LookAtOptions options;
                options.target = random.chance(9) ? glm::dvec3(0, 1.6, 0) : far() * point(1.0, 50);
                options.root = root;
                if (random.chance(2)) options.view = 3.14;
                LookAtReport report;
                without_memory([&] { report = look_at->step(pose, options, dt, look_state); });
                EXPECT_TRUE(is_fine(report.weight) && is_fine(report.left) && is_fine(look_state.gaze));
                steps[2] += holds("look at", report.accepted.ok(), look_state == before);
            }
            if (spring) {
                const SpringChainState before = spring_state;
                const SpringOptions options{.strength = number(0.01, 100.0), .root = root};
                const SpringReport report = random.chance(8) ? spring->teleport(pose, options, spring_state)
                                                             : spring->step(pose, options, dt, spring_state);
                EXPECT_TRUE(is_fine(report.angle) && is_fine(report.speed));
                for (const SpringMass& mass : spring_state.masses)
                    EXPECT_TRUE(is_fine(mass.position) && is_fine(mass.velocity) && is_fine(mass.target));
                holds("spring", report.accepted.ok(), spring_state == before);
            }
            if (HasFailure()) FAIL() << "round " << round << ", frame " << frame << ", dt " << dt;
        }
    }
    EXPECT_GT(refused, 0u);
    EXPECT_GT(taken, 0u);
    for (const std::size_t each : steps) EXPECT_GT(each, static_cast<std::size_t>(4 * all));
}

TEST_F(HostileHumanoid, AMapThatDoesNotFitCountsAsEmpty) {
    for (int round = rounds(1000); round > 0; --round) {
        const Skeleton body = skeleton();
        BoneMap map = map_of(body);
        const bool fits = bool(check(map, body));
        const std::vector<BodyCapsule> capsules = default_capsules(body, map);
        const std::vector<SkinPoint> points(40, {point(2.0), random.below(body.size() + 2)});
        const std::vector<BodyCapsule> fitted = fitted_capsules(body, map, points);
        const std::vector<TwistBone> twists = twist_bones(body, map);
        const std::vector<rig::Transform> t = t_pose(body, map);
        EXPECT_EQ(t.size(), body.size());
        EXPECT_TRUE(is_fine(t));
        EXPECT_TRUE(is_fine(facing(body, map).forward));
        EXPECT_EQ(TwistNodes::find(body, map).turns(t).size(), 4u);
        std::vector<Placement> placements(body.size());
        place(body, t, placements);
        for (const BodyCapsule& each : capsules) static_cast<void>(place(each, map, placements));
        static_cast<void>(place(BodyCapsule{.bone = Bone::Head}, map, placements));
        const Expected<Soles> soles = find_soles(body, map);
        if (!fits) {
            EXPECT_TRUE(capsules.empty() && fitted.empty() && twists.empty());
            EXPECT_EQ(t, rest_pose(body));
            EXPECT_FALSE(soles);
        }
        Clip clip{.name = "it", .duration = 0.1};
        if (body.size() > 0)
            clip.channels.push_back(
                {.node = 0,
                 .rotation = {Interpolation::Linear, {0.0, 0.1}, {rotation(1000), rotation(1000)}}});
        if (!check(clip, body)) continue;
        const LintReport report = lint(body, map, clip);
        for (const Finding& each : report.findings) static_cast<void>(cure(body, map, clip, each));
        static_cast<void>(cure(body, map, clip, {.node = 9999, .has_cure = true}));
        // A finding from another clip, with a single frame.
        Clip still = clip;
        still.duration = 0.0;
        for (const Fault fault : {Fault::Skating, Fault::Floating, Fault::Sinking})
            EXPECT_FALSE(
                cure(body, map, still, {.fault = fault, .node = map[Bone::LeftFoot].node, .has_cure = true}));
        static_cast<void>(learned_limits(body, map, {&clip, 1}, default_limits(body, map)));
        if (soles) {
            EXPECT_TRUE(is_fine(clip_floor(body, *soles, clip)));
        }
        review(map, body);
        if (HasFailure()) FAIL() << "round " << round;
    }
}

TEST(HumanoidMap, IsRefusedByItsBonesName) {
    const Skeleton body = make_figure({});
    const BoneMap good = match_bones(body);
    EXPECT_TRUE(check(good, body));
    const auto said = [&](Bone bone, std::int32_t node) {
        BoneMap map = good;
        map[bone].node = node;
        EXPECT_FALSE(Body::make(body, map));
        return std::string(check(map, body).message());
    };
    EXPECT_TRUE(says(said(Bone::LeftHand, 77), "bone map LeftHand skeleton 77"));
    EXPECT_TRUE(says(said(Bone::LeftHand, -2), "bone map LeftHand skeleton -2"));
    EXPECT_TRUE(
        says(said(Bone::RightHand, good[Bone::LeftHand].node), "bone map RightHand another LeftHand"));
    BoneMap swapped = good;
    std::swap(swapped[Bone::LeftUpperArm].node, swapped[Bone::LeftLowerArm].node);
    EXPECT_TRUE(
        says(std::string(check(swapped, body).message()), "bone map LeftLowerArm above LeftUpperArm"));
    EXPECT_TRUE(check(BoneMap{}, Skeleton{}));
}

}  // namespace
}  // namespace tendril::test
