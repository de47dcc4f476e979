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
        EXPECT_GT(all.planted, all.feet / 2) << "a walk's foot stands more than half of the time";
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

}  // namespace
}  // namespace tendril::test
