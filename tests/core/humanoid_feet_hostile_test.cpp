// Feet with hostile input is refused, and equal states give equal bits. Any poses on any grounds are in
// humanoid_hostile_test.cpp.
#include "humanoid_feet_support.hpp"

namespace tendril::test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

class FeetHostile : public ::testing::Test, protected Figured {
  protected:
    RandomPoses number{7};
    const Feet feet = *Feet::make(skeleton, map);
};

bool is_finite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

TEST_F(FeetHostile, RefusedInputChangesNothing) {
    FeetState state;
    const Ground flat = *Ground::flat();
    std::vector<rig::Transform> good = rest_pose(skeleton);
    ASSERT_TRUE(feet.step(good, flat, 0.1, state).accepted);
    const FeetState before = state;
    const auto refuses = [&](std::vector<rig::Transform> made, const FeetOptions& options) {
        const bool valid = feet.step(made, flat, 0.1, state, options).accepted.ok();
        return !valid && state == before;
    };
    for (const double bad : {nan, infinite, 1e300}) {
        std::vector<rig::Transform> made = rest_pose(skeleton);
        made[static_cast<std::size_t>(map[Bone::LeftFoot].node)].translation.x = bad;
        EXPECT_TRUE(refuses(made, {}));
        made = rest_pose(skeleton);
        made[0].rotation.x = bad;
        EXPECT_TRUE(refuses(made, {}));
    }
    EXPECT_TRUE(refuses({}, {}));
    EXPECT_TRUE(refuses(std::vector<rig::Transform>(3), {}));
    FeetOptions options{.low = nan};
    EXPECT_TRUE(refuses(rest_pose(skeleton), options));
    options = {.leave_speed = 0.1};
    EXPECT_TRUE(says(check(options).message(), "feet leave_speed enter_speed 0.1"));
    options = {};
    options.root.scale.x = 0.0;
    EXPECT_FALSE(check(options));
    FeetState broken;
    broken.feet[1].lift = nan;
    EXPECT_FALSE(check(broken));
}

TEST_F(FeetHostile, ZeroLengthBonesAndZeroScalesAreAccepted) {
    FeetState state;
    for (const double scale : {0.0, 1e-30, -1.0, 3.0}) {
        std::vector<rig::Transform> made = rest_pose(skeleton);
        made[static_cast<std::size_t>(map[Bone::LeftUpperLeg].node)].scale = glm::dvec3(scale);
        made[static_cast<std::size_t>(map[Bone::RightFoot].node)].translation = glm::dvec3(0.0);
        const FeetReport report = feet.step(made, *Ground::stairs(0.1, 0.2), 1.0 / 60, state);
        EXPECT_TRUE(report.accepted);
        for (const rig::Transform& each : made) EXPECT_TRUE(is_finite(each.translation));
        EXPECT_TRUE(check(state));
    }
}

TEST_F(FeetHostile, TheSameStateGivesTheSameBitsAndNoStepAllocates) {
    const Clip clip = FigureWalk(skeleton).clip();
    const Ground stairs = *Ground::stairs(0.15, 0.3);
    std::vector<rig::Transform> made(skeleton.size());
    FeetState state, saved;
    std::vector<std::vector<rig::Transform>> first;
    const auto play = [&](int from, int to, const auto& each) {
        for (int frame = from; frame < to; ++frame) {
            sample(clip, skeleton, std::fmod(frame / 60.0, clip.duration), made);
            made[0].translation.z += std::floor(frame / 60.0 / clip.duration) * 1.1;
            without_memory([&] { feet.step(made, stairs, 1.0 / 60, state); });
            each(frame);
        }
    };
    play(0, 200, [&](int frame) {
        if (frame == 99) saved = state;
        if (frame >= 100) first.push_back(made);
    });
    state = saved;
    play(100, 200, [&](int frame) { EXPECT_EQ(made, first[static_cast<std::size_t>(frame - 100)]); });
}

TEST_F(FeetHostile, LegsNotBelowTheHipsAreRefused) {
    std::vector<Node> nodes = skeleton.nodes();
    const auto leg = static_cast<std::size_t>(map[Bone::LeftUpperLeg].node);
    nodes.push_back({"ground", -1, {}});
    nodes[leg].rest.translation += glm::dvec3(0, 1, 0);
    nodes[leg].parent = static_cast<std::int32_t>(nodes.size()) - 1;
    const Skeleton apart = *Skeleton::make(nodes);
    EXPECT_TRUE(says(Feet::make(apart, map).message(), "LeftUpperLeg is not below the hips"));
    EXPECT_FALSE(Feet::make(skeleton, BoneMap()));
}

/// The same joint positions with random bone axes and scales.
Skeleton with_other_axes(const Skeleton& plain) {
    std::vector<Placement> placements(plain.size());
    place(plain, rest_pose(plain), placements);
    std::vector<Node> nodes = plain.nodes();
    std::vector<rig::Transform> global(nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const double angle = 1.7 * static_cast<double>(i);
        global[i].rotation = glm::angleAxis(angle, glm::normalize(glm::dvec3(1, 2, 3)));
        global[i].scale = glm::dvec3(i % 3 == 0 ? -0.7 : 1.6);  // including mirrored
        global[i].translation = placements[i].position;
        const std::int32_t parent = nodes[i].parent;
        nodes[i].rest =
            parent < 0 ? global[i] : rig::relative(global[static_cast<std::size_t>(parent)], global[i]);
    }
    return *Skeleton::make(nodes);
}

TEST_F(FeetHostile, BonesMayHaveAnyAxes) {
    const Skeleton other = with_other_axes(skeleton);
    const Feet other_feet = *Feet::make(other, match_bones(other));
    const Ground stairs = *Ground::stairs(0.2, 0.15);
    for (int round = 0; round < 100; ++round) {
        FeetOptions options;
        options.root.translation.z = number(-1.0, 5.0);
        std::vector<rig::Transform> a = rest_pose(skeleton), b = rest_pose(other);
        FeetState state_a, state_b;
        const FeetReport one = feet.step(a, stairs, 0.1, state_a, options);
        const FeetReport two = other_feet.step(b, stairs, 0.1, state_b, options);
        std::vector<Placement> at_a(skeleton.size()), at_b(skeleton.size());
        place(skeleton, a, at_a);
        place(other, b, at_b);
        for (std::size_t i = 0; i < at_a.size(); ++i)
            ASSERT_LT(glm::distance(at_a[i].position, at_b[i].position), 1e-6) << skeleton[i].name;
        for (std::size_t i = 0; i < 2; ++i) {
            EXPECT_LT(glm::distance(one.feet[i].toe, two.feet[i].toe), 1e-6);
            EXPECT_LT(glm::distance(one.feet[i].heel, two.feet[i].heel), 1e-6);
        }
    }
}

}  // namespace
}  // namespace tendril::test
