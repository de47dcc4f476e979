// Feet on the ground: bounds for whole walks, and each rule of planting alone.
#include "humanoid_feet_support.hpp"
#include "tests/labels.hpp"

namespace tendril::test {
namespace {

const double pi = std::acos(-1.0);

/// Stairs as triangles, with risers.
Ground mesh_stairs() {
    std::vector<glm::dvec3> points;
    std::vector<std::uint32_t> triangles;
    const auto add = [&](double y, double z, double next_y, double next_z) {
        const auto first = static_cast<std::uint32_t>(points.size());
        points.insert(points.end(), {{-20, y, z}, {20, y, z}, {20, next_y, next_z}, {-20, next_y, next_z}});
        for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u}) triangles.push_back(first + corner);
    };
    add(0.0, -30.0, 0.0, 0.0);
    for (int i = 0; i < 100; ++i) {
        add(0.15 * i, 0.3 * i, 0.15 * i, 0.3 * (i + 1));
        add(0.15 * i, 0.3 * (i + 1), 0.15 * (i + 1), 0.3 * (i + 1));
    }
    return *Ground::mesh(points, triangles);
}

Ground hills() {
    HeightField field{.x = -20.0, .z = -20.0, .cell = 0.125, .columns = 321, .heights = {}};
    for (int row = 0; row < 321; ++row)
        for (int column = 0; column < 321; ++column) {
            const double x = 0.125 * column, z = 0.125 * row;
            field.heights.push_back(0.15 * std::sin(2.0 * x) * std::cos(1.6 * z) + 0.05 * std::sin(4.1 * z));
        }
    return *Ground::terrain(field);
}

struct NamedGround {
    const char* name;
    Ground ground;
    double climb;  // minimum climb
};
std::vector<NamedGround> grounds() {
    return {{"flat", *Ground::flat(), 0.0},
            {"slope of 20 degrees", *Ground::slope(20.0 * pi / 180.0), 1.0},
            {"stairs of 0.15 on 0.3", *Ground::stairs(0.15, 0.3), 1.0},
            {"stairs of 0.1 on 0.35", *Ground::stairs(0.1, 0.35), 1.0},
            {"stairs of 0.18 on 0.28", *Ground::stairs(0.18, 0.28), 1.0},
            {"stairs as a mesh", mesh_stairs(), 1.0},
            {"hills", hills(), 0.1}};
}

class FeetWalk : public ::testing::Test {
  protected:
    const Skeleton skeleton = make_figure({});
    const Clip clip = FigureWalk(skeleton).clip();
};

TEST_F(FeetWalk, PlantedFeetStandStillAndNothingJumps) {
    for (const NamedGround& each : grounds()) {
        Measured all;
        int round = 0;
        Walker walker(skeleton, clip);
        // Walks up, down, along and across, through the loop seams of the clip.
        const std::pair<double, double> ways[]{
            {0.0, -1.0}, {pi, 8.0}, {0.5 * pi, 3.1}, {0.25 * pi, 0.0}, {2.4, 8.0}};
        for (const auto& [heading, z] : ways)
            for (const double start : {0.0, 0.13, 0.55})
                for (const double speed : {0.5, 1.0, 1.5})
                    for (const double rate : {60.0, 120.0}) {
                        if (!is_sampled(round++)) continue;
                        WalkOptions walk{
                            .rate = rate, .speed = speed, .start = start, .seconds = 5.0, .heading = heading};
                        walk.from.z = z;
                        all.add(walker.walk(each.ground, walk));
                    }
        SCOPED_TRACE(each.name);
        EXPECT_LT(all.sink, 0.005);
        EXPECT_LT(all.floating, 0.005);
        EXPECT_LT(all.skate, 0.005);
        EXPECT_LT(all.beyond, 0.05);
        EXPECT_LE(all.stretch, 0.995 + 1e-9);
        EXPECT_EQ(all.alone, 0);
        EXPECT_GT(20 * all.planted, 9 * all.feet)
            << "a walk's foot stands half of the time, a little less on stairs";
        EXPECT_GE(all.climbed, each.climb);
    }
}

TEST_F(FeetWalk, AtTheEdgeOfAStepPlantedFeetNeitherFloatNorSink) {
    Walker walker(skeleton, clip);
    Measured all;
    for (const double start : {0.0, 0.13, 0.26, 0.37, 0.55, 0.8})
        for (const double speed : {0.5, 1.0}) {
            WalkOptions walk{.speed = speed, .start = start, .heading = pi};
            walk.from.z = 8.0;
            walk.options.edge = 0.0;  // feet keep the position where they come down
            for (const Ground& ground : {*Ground::stairs(0.1, 0.35), *Ground::stairs(0.18, 0.28)})
                all.add(walker.walk(ground, walk));
        }
    EXPECT_LT(all.sink, 0.005);
    EXPECT_LT(all.floating, 0.005);
}

TEST_F(FeetWalk, OnFlatGroundItStaysCloseToTheClip) {
    Walker walker(skeleton, clip);
    FeetState state;
    for (int frame = 0; frame < 200; ++frame) {
        walker.step(*Ground::flat(), {}, frame, state);
        for (const Bone bone : {Bone::Hips, Bone::LeftFoot, Bone::RightFoot, Bone::LeftToes, Bone::Head})
            EXPECT_LT(glm::distance(walker.now(bone).position, walker.now_clip(bone).position), 0.03)
                << "a lock lets go when the foot is on its way";
        for (const Bone bone : {Bone::LeftLowerLeg, Bone::RightLowerLeg})
            EXPECT_LT(glm::distance(walker.now(bone).position, walker.now_clip(bone).position), 0.03);
    }
}

TEST_F(FeetWalk, WithoutSuitableGroundTheClipIsLeftAlone) {
    const std::vector<glm::dvec3> points{{-90, -3, -90}, {90, -3, -90}, {0, -3, 90}};
    const std::vector<std::uint32_t> triangle{0, 1, 2};
    const Ground steep = *Ground::slope(60.0 * pi / 180.0), deep = *Ground::mesh(points, triangle),
                 high = *Ground::stairs(2.0, 0.3);
    const auto expect_alone = [&](const Ground& ground, FootAlone why, double z) {
        Walker walker(skeleton, clip);
        FeetState state;
        WalkOptions walk;
        walk.from.z = -0.6;
        for (int frame = 0; frame < 400; ++frame) {
            const FeetReport report = walker.step(ground, walk, frame, state);
            if (walker.now_clip(Bone::Hips).position.z < z) continue;
            for (const FootReport& foot : report.feet) {
                EXPECT_EQ(foot.alone, why);
                EXPECT_FALSE(foot.planted);
            }
            if (walker.now_clip(Bone::Hips).position.z < z + 1.8) continue;  // still easing out
            EXPECT_EQ(walker.pose(), walker.clip_pose()) << frame;
        }
    };
    expect_alone(Ground(), FootAlone::NoHit, -9.0);
    expect_alone(deep, FootAlone::TooFar, -9.0);
    expect_alone(steep, FootAlone::TooSteep, 0.8);
    expect_alone(high, FootAlone::TooFar, 0.8);
    EXPECT_TRUE(says(name(FootAlone::TooSteep), "too steep"));
}

TEST_F(FeetWalk, ATargetOutOfTheLegsReachIsReported) {
    Walker walker(skeleton, clip);
    FeetState state;
    WalkOptions walk;
    walk.options.pelvis_drop = 0.02;
    int alone = 0;
    for (int frame = 0; frame < 300; ++frame) {
        const FeetReport report = walker.step(*Ground::stairs(0.3, 0.5), walk, frame, state);
        for (const FootReport& foot : report.feet) alone += foot.alone == FootAlone::CannotReach;
        EXPECT_LE(report.drop, 0.02);
    }
    EXPECT_GT(alone, 10);
}

TEST_F(FeetWalk, AFigureThatStartsOnStairsStandsOnThem) {
    const Ground stairs = *Ground::stairs(0.15, 0.3);
    const Skeleton skeleton_at_rest = make_figure({});
    Walker walker(skeleton_at_rest, {.duration = 1.0});
    for (const double z : {-1.0, 0.2, 3.05, 10.4}) {
        FeetState state;
        WalkOptions walk;
        walk.from.z = z;
        const FeetReport report = walker.step(stairs, walk, 0, state);
        for (std::size_t i = 0; i < 2; ++i) {
            const FootReport& foot = report.feet[i];
            EXPECT_TRUE(foot.planted) << z;
            const double ground = std::max(stairs.below(foot.heel)->height, stairs.below(foot.toe)->height);
            EXPECT_NEAR(foot.heel.y, ground, 0.001);
            EXPECT_NEAR(foot.toe.y, ground, 0.001);
            EXPECT_LE(walker.stretch(i), 0.995 + 1e-9);
        }
    }
}

TEST_F(FeetWalk, AStraightLegBendsForwardThoughItsKneeIsAside) {
    std::vector<Node> nodes = skeleton.nodes();
    nodes[*skeleton.find("LeftLowerLeg")].rest.translation.x += 0.004;
    nodes[*skeleton.find("LeftFoot")].rest.translation.x -= 0.004;
    const Skeleton bowed = *Skeleton::make(nodes);
    Walker walker(bowed, {.duration = 1.0});
    FeetState state;
    WalkOptions walk;
    walk.from.z = 0.2;
    walker.step(*Ground::stairs(0.15, 0.3), walk, 0, state);
    const glm::dvec3 middle =
        0.5 * (walker.now(Bone::LeftUpperLeg).position + walker.now(Bone::LeftFoot).position);
    const glm::dvec3 bend = walker.now(Bone::LeftLowerLeg).position - middle;
    EXPECT_GT(bend.z, 5.0 * std::abs(bend.x)) << bend.x << " " << bend.z;
}

TEST_F(FeetWalk, AFootTiltsWithTheGroundUpToALimit) {
    Walker walker(skeleton, {.duration = 1.0});
    const auto turn_on = [&](double degrees) {
        FeetState state;
        WalkOptions walk;
        walk.from.z = 3.0;
        walker.step(*Ground::slope(degrees * pi / 180.0), walk, 0, state);
        const glm::dvec3 up = walker.now(Bone::LeftFoot).rotation() * glm::dvec3(0, 1, 0);
        EXPECT_LT(up.z, 0.0);
        return std::acos(up.y) * 180.0 / pi;
    };
    EXPECT_NEAR(turn_on(20.0), 20.0, 1e-6);
    EXPECT_NEAR(turn_on(34.0), 34.0, 1e-6);
    EXPECT_NEAR(turn_on(42.0), 35.0, 1e-6);
}

TEST_F(FeetWalk, AtWeightZeroOrWithoutGroundItIsTheClipBitForBit) {
    for (const bool has_ground : {true, false}) {
        Walker walker(skeleton, clip);
        FeetState state;
        WalkOptions walk;
        if (has_ground) walk.options.weight = 0.0;
        const Ground ground = has_ground ? *Ground::stairs(0.15, 0.3) : Ground();
        for (int frame = 0; frame < 200; ++frame) {
            walker.step(ground, walk, frame, state);
            ASSERT_EQ(walker.pose(), walker.clip_pose());
        }
    }
}

TEST_F(FeetWalk, HalfTheWeightIsHalfTheCorrection) {
    Walker walker(skeleton, {.duration = 1.0});
    WalkOptions walk;
    walk.from.z = 0.15;
    const auto hips_at = [&](double weight) {
        FeetState state;
        walk.options.weight = weight;
        walker.step(*Ground::flat(0.2), walk, 0, state);
        return walker.now(Bone::Hips).position.y;
    };
    EXPECT_NEAR(hips_at(0.5), 0.5 * (hips_at(0.0) + hips_at(1.0)), 1e-9);
    EXPECT_GT(hips_at(1.0), hips_at(0.0) + 0.1);
}

TEST_F(FeetWalk, AnInPlaceClipWithAMovingRootIsTheSameWalk) {
    Clip in_place = clip;
    Track<glm::dvec3>& hips = in_place.channels[0].translation;
    for (std::size_t i = 0; i < hips.times.size(); ++i) hips.values[i].z -= hips.times[i] * FigureWalk::speed;
    const Ground stairs = *Ground::stairs(0.15, 0.3);
    Walker walker(skeleton, clip), moved(skeleton, in_place);
    FeetState state, moved_state;
    for (int frame = 0; frame < 300; ++frame) {
        const FeetReport report = walker.step(stairs, {}, frame, state);
        WalkOptions walk;
        walk.from.z = frame / 60.0 * FigureWalk::speed;
        const FeetReport same = moved.step(stairs, walk, frame, moved_state);
        for (std::size_t i = 0; i < 2; ++i) {
            EXPECT_EQ(report.feet[i].planted, same.feet[i].planted) << frame;
            EXPECT_LT(glm::distance(report.feet[i].toe, same.feet[i].toe), 1e-6);
        }
    }
}

TEST_F(FeetWalk, AnInPlaceClipUsesTheRootsVelocity) {
    Clip in_place = clip;
    Track<glm::dvec3>& hips = in_place.channels[0].translation;
    for (std::size_t i = 0; i < hips.times.size(); ++i) hips.values[i].z -= hips.times[i] * FigureWalk::speed;
    for (const bool told : {true, false}) {
        Walker walker(skeleton, in_place);
        FeetState state;
        WalkOptions walk;
        if (told) walk.options.root_velocity.z = FigureWalk::speed;
        int planted = 0;
        glm::dvec3 before{0.0};
        bool was = false;
        for (int frame = 0; frame < 200; ++frame) {
            const FootReport foot = walker.step(*Ground::flat(), walk, frame, state).feet[0];
            planted += foot.planted;
            if (told && foot.planted && was) {
                EXPECT_NEAR(foot.toe.z - before.z, -FigureWalk::speed / 60.0, 1e-4);
            }
            was = foot.planted;
            before = foot.toe;
        }
        if (told)
            EXPECT_GT(planted, 100) << "the floor moves backwards below it";
        else
            EXPECT_LT(planted, 40) << "its feet slide, but for where they turn round";
    }
}

// A standing figure that slides: its feet move at the test's speed.
class FeetSlide : public ::testing::Test {
  protected:
    void slide(double speed, double seconds) {
        for (int i = 0; i < std::lround(seconds * 60.0); ++i) {
            x += speed / 60.0;
            std::vector<rig::Transform> pose = rest_pose(skeleton);
            pose[0].translation += glm::dvec3(x, lift, 0.0);
            report = feet.step(pose, ground, 1.0 / 60.0, state);
        }
    }
    double offset() const { return report.feet[0].toe.x - (x + 0.1); }

    const Skeleton skeleton = make_figure({});
    const Feet feet = *Feet::make(skeleton, match_bones(skeleton));
    Ground ground = *Ground::flat();
    FeetState state;
    FeetReport report;
    double x = 0.0, lift = 0.0;
};

/// Feet look ahead by speed and braking, so the speed from before the gap must not be used.
TEST_F(FeetSlide, MeasuresSpeedOverAGapInTheGround) {
    slide(2.0, 0.2);
    ground = Ground();
    slide(0.5, 0.2);
    EXPECT_NEAR(state.feet[0].velocity.x, 0.5, 1e-9);
}

TEST_F(FeetSlide, LocksWhenSlowAndReleasesWhenFast) {
    slide(2.0, 0.2);
    EXPECT_FALSE(report.feet[0].planted);
    slide(0.4, 0.2);
    EXPECT_FALSE(report.feet[0].planted) << "not under 0.3 m/s";
    slide(0.25, 0.2);
    EXPECT_TRUE(report.feet[0].planted);
    slide(0.9, 0.1);
    EXPECT_TRUE(report.feet[0].planted) << "not over 1 m/s";
    EXPECT_NEAR(offset(), -0.25 / 60 * 11 - 0.09, 1e-3);
    slide(1.1, 1.0 / 60.0);
    EXPECT_FALSE(report.feet[0].planted);
}

TEST_F(FeetSlide, ALockBreaksAtItsDistanceAndDecaysWithItsHalfLife) {
    slide(0.0, 0.1);
    slide(0.29, 0.2 / 0.29 - 0.03);
    EXPECT_TRUE(report.feet[0].planted);
    EXPECT_LT(offset(), -0.18);
    EXPECT_GT(offset(), -0.2);
    slide(0.29, 0.05);
    EXPECT_FALSE(report.feet[0].planted);
    const double begin = offset();
    slide(2.0, 0.05);
    EXPECT_NEAR(offset(), 0.5 * begin, 1e-6) << "half of it every 50 ms";
    slide(2.0, 0.05);
    EXPECT_NEAR(offset(), 0.25 * begin, 1e-6);
}

TEST_F(FeetSlide, AFootThatLeapsFollowsTheClip) {
    slide(0.0, 0.1);
    slide(0.25, 0.2);
    const double begin = offset();
    EXPECT_NEAR(begin, -0.05, 0.01);
    slide(8.0, 1.0 / 60.0);
    EXPECT_FALSE(report.feet[0].planted);
    EXPECT_NEAR(offset(), begin * std::exp2(-1.0 / 3.0), 1e-6)
        << "what the lock moved it by eases, and no more";
}

TEST_F(FeetSlide, PlantsUpToFiveCentimetresHigh) {
    slide(0.0, 0.1);
    EXPECT_TRUE(report.feet[0].planted);
    for (lift = 0.0; lift < 0.045; lift += 0.002) slide(0.0, 1.0 / 60.0);
    EXPECT_TRUE(state.feet[0].locked);
    lift = 0.051;
    slide(0.0, 1.0 / 60.0);
    EXPECT_FALSE(state.feet[0].locked);
}

TEST_F(FeetSlide, InStanceTheSoleComesDownToTheGround) {
    lift = 0.03;
    slide(0.0, 0.1);
    EXPECT_LT(report.feet[0].toe.y, 0.03);
    slide(0.0, 0.4);
    EXPECT_TRUE(report.feet[0].planted);
    EXPECT_NEAR(report.feet[0].toe.y, 0.0, 0.001);
    lift = 0.3;
    slide(0.0, 1.0);
    EXPECT_NEAR(report.feet[0].toe.y, 0.3, 1e-6) << "out of stance it is as high as in the clip";
}

TEST_F(FeetSlide, ZeroTimeChangesNothingAndANewPoseStartsOver) {
    slide(0.25, 0.5);
    const auto step_still = [&](double at) {
        std::vector<rig::Transform> pose = rest_pose(skeleton);
        pose[0].translation += glm::dvec3(at, 0.0, 0.0);
        report = feet.step(pose, ground, 0.0, state);
        return pose;
    };
    std::vector<rig::Transform> pose = rest_pose(skeleton);
    pose[0].translation += glm::dvec3(x, 0.0, 0.0);
    step_still(x);
    const FeetState before = state;
    const auto once = step_still(x), again = step_still(x);
    EXPECT_EQ(once, again);
    EXPECT_EQ(state, before);
    EXPECT_TRUE(report.feet[0].planted);
    EXPECT_LT(offset(), -0.1);
    step_still(x + 0.05);
    EXPECT_NEAR(offset() - 0.05, 0.0, 1e-9) << "a clip that is scrubbed";
}

// Feet with hostile input is refused, and equal states give equal bits. Any poses on any grounds are in
// humanoid_hostile_test.cpp.

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
