// Footholds on stairs: the whole sole on a tread, reached smoothly.
#include <tendril/humanoid/feet_many.hpp>
#include <tendril/humanoid/lint.hpp>

#include "humanoid_feet_support.hpp"
#include "tests/labels.hpp"

namespace tendril::test {
namespace {

constexpr double footholds_pi = 3.141592653589793;

/// Maximum depth of the line from heel to toe in the ground.
double sole_depth(const Ground& ground, const FootReport& foot) {
    double depth = 0.0;
    for (int i = 0; i <= 12; ++i) {
        const glm::dvec3 at = glm::mix(foot.heel, foot.toe, i / 12.0);
        const auto hit = ground.below(at + glm::dvec3(0, 0.5, 0));
        if (hit) depth = std::max(depth, hit->height - at.y);
    }
    return depth;
}

class Footholds : public ::testing::Test {
  protected:
    /// Calls `visit(frame, report)` for each frame of a walk on the stairs; `up` or down.
    void walk(const Ground& stairs, bool up, double speed, double start, auto visit) {
        WalkOptions walk{.speed = speed, .start = start, .heading = up ? 0.0 : footholds_pi};
        walk.from.z = up ? -1.0 : 6.0;
        FeetState state;
        for (int frame = 0; frame < 300; ++frame) visit(frame, walker.step(stairs, walk, frame, state));
    }

    const Skeleton skeleton = make_figure({});
    const Clip clip = FigureWalk(skeleton).clip();
    Walker walker{skeleton, clip};
};

TEST_F(Footholds, APlantedSoleIsFullyOnTreads) {
    for (const auto& [height, depth] : {std::pair(0.1, 0.35), std::pair(0.15, 0.3), std::pair(0.18, 0.28)})
        for (const bool up : {true, false})
            for (const double speed : {0.7, 1.0})
                for (const double start : {0.0, 0.13, 0.37, 0.55}) {
                    const Ground stairs = *Ground::stairs(height, depth);
                    double deepest = 0.0;
                    int planted = 0;
                    walk(stairs, up, speed, start, [&](int, const FeetReport& report) {
                        for (const FootReport& foot : report.feet) {
                            if (!foot.planted) continue;
                            ++planted;
                            deepest = std::max(deepest, sole_depth(stairs, foot));
                        }
                    });
                    EXPECT_LT(deepest, 0.006)
                        << height << " on " << depth << ' ' << up << " at " << speed << " from " << start;
                    EXPECT_GT(planted, 210) << height << " on " << depth;
                }
}

LABEL(slow, "Footholds.KneesDoNotPop");

TEST_F(Footholds, KneesDoNotPop) {
    int pops = 0, runs = 0;
    for (const auto& [height, depth] :
         {std::pair(0.1, 0.35), std::pair(0.15, 0.3), std::pair(0.18, 0.28), std::pair(0.2, 0.25)})
        for (const bool up : {true, false})
            for (const double speed : {0.7, 1.0, 1.5})
                for (const double start : {0.0, 0.13, 0.37, 0.55}) {
                    Clip made{.name = "made", .duration = 299.0 / 60.0};
                    for (std::size_t node = 0; node < skeleton.size(); ++node)
                        made.channels.push_back({.node = node});
                    walk(*Ground::stairs(height, depth), up, speed, start, [&](int frame, const FeetReport&) {
                        for (std::size_t node = 0; node < skeleton.size(); ++node) {
                            Channel& channel = made.channels[node];
                            channel.rotation.times.push_back(frame / 60.0);
                            channel.rotation.values.push_back(walker.pose()[node].rotation);
                            channel.translation.times.push_back(frame / 60.0);
                            channel.translation.values.push_back(walker.pose()[node].translation);
                        }
                    });
                    ++runs;
                    for (const Finding& each :
                         lint(skeleton, match_bones(skeleton), made, {.rate = 60.0}).findings)
                        pops += each.fault == Fault::KneePop;
                }
    EXPECT_EQ(runs, 96);
    EXPECT_LE(pops, 3);  // 43 without footholds
}

// Where feet come down on stairs, before they are planted.

TEST(FeetOnStairs, UpwardsFeetComeDownWhereTheyThenStand) {
    const Skeleton skeleton = make_figure({});
    const Clip clip = FigureWalk(skeleton).clip();
    for (const Ground& stairs : {*Ground::stairs(0.15, 0.3), *Ground::stairs(0.1, 0.35)}) {
        for (const double start : {0.0, 0.13, 0.37, 0.55, 0.8}) {
            Walker walker(skeleton, clip);
            WalkOptions walk{.start = start};
            walk.from.z = -1.0;
            FeetState state;
            double strike[2]{}, before[2]{};
            bool down[2]{}, shifts[2]{};
            for (int frame = 0; frame < 480; ++frame) {
                const FeetReport report = walker.step(stairs, walk, frame, state);
                for (std::size_t i = 0; i < 2; ++i) {
                    const FootState& foot = state.feet[i];
                    const double low = std::min(foot.heel.y, foot.toe.y);
                    if (low < 0.002 && before[i] >= 0.002 && frame > 60)
                        down[i] = true, strike[i] = foot.lift,
                        shifts[i] = std::hypot(foot.shift_x, foot.shift_z) > 0.01;
                    before[i] = low;
                    if (low < 0.002) {
                        const glm::dvec3& heel = report.feet[i].heel;
                        EXPECT_GT(heel.y, stairs.below({heel.x, heel.y + 0.5, heel.z})->height - 0.005)
                            << "its heel is in a step";
                    }
                    if (!down[i] || !report.feet[i].planted) continue;
                    down[i] = false;
                    if (shifts[i]) {  // moved to a tread with room for the whole sole, where it comes down
                        EXPECT_GT(strike[i], foot.lift - 0.06) << frame;
                        EXPECT_LT(strike[i], foot.lift + 0.16) << frame;
                    } else {
                        EXPECT_NEAR(strike[i], foot.lift, 0.025) << frame;
                    }
                }
            }
        }
    }
}

// The depth to which a foot passes through the ground while it is in the air.

const double swing_pi = std::acos(-1.0);

/// Points of a sole: the heel, the ball below the toes' node, and the tip of the toes.
std::array<glm::dvec3, 3> sole_of(const Walker& walker, const Placement& rest, const FootReport& foot,
                                  std::size_t side) {
    const Placement& toes = walker.now(side == 0 ? Bone::LeftToes : Bone::RightToes);
    const glm::dvec3 down(0.0, walker.feet().soles().floor - rest.position.y, 0.0);
    return {foot.heel, toes.apply(glm::inverse(rest.rotation()) * down), foot.toe};
}

class FeetSwing : public ::testing::Test {
  protected:
    /// Maximum depth of the soles in the ground, metres; the clip walks at 1 m/s times `speed`.
    double through(const Ground& ground, double heading, double z, double speed, double start) {
        Walker walker(skeleton, clip);
        std::vector<Placement> rest(skeleton.size());
        place(skeleton, rest_pose(skeleton), rest);
        WalkOptions walk{.speed = speed, .start = start, .heading = heading};
        walk.from.z = z;
        FeetState state;
        double deepest = 0.0;
        for (int frame = 0; frame < 300; ++frame) {
            const FeetReport report = walker.step(ground, walk, frame, state);
            for (std::size_t side = 0; side < 2; ++side) {
                const FootReport& foot = report.feet[side];
                EXPECT_EQ(foot.alone, FootAlone::No);
                const std::size_t toes = *skeleton.find(side == 0 ? "LeftToes" : "RightToes");
                for (const glm::dvec3& point : sole_of(walker, rest[toes], foot, side)) {
                    const auto hit = ground.below({point.x, point.y + 0.5, point.z});
                    deepest = std::max(deepest, hit->height - point.y);
                }
            }
        }
        return deepest;
    }

    const Skeleton skeleton = make_figure({});
    const Clip clip = FigureWalk(skeleton).clip();
};

TEST_F(FeetSwing, ClearsSlopesUpToFortyDegrees) {
    for (const double degrees : {20.0, 30.0, 40.0})
        for (const double speed : {0.7, 1.0})
            for (const auto& [heading, z] : {std::pair(0.0, -1.0), std::pair(swing_pi, 6.0),
                                             std::pair(0.5 * swing_pi, 3.1), std::pair(0.25 * swing_pi, 0.0)})
                for (const double start : {0.0, 0.37})
                    EXPECT_LT(through(*Ground::slope(degrees * swing_pi / 180.0), heading, z, speed, start),
                              0.0105)
                        << degrees << " degrees, heading " << heading << " at " << speed << " from " << start;
}

TEST_F(FeetSwing, ClearsStairsUpAndDown) {
    for (const auto& [height, depth] : {std::pair(0.1, 0.35), std::pair(0.15, 0.3), std::pair(0.18, 0.28)})
        for (const double speed : {0.7, 1.0})
            for (const auto& [heading, z] : {std::pair(0.0, -1.0), std::pair(swing_pi, 6.0)})
                for (const double start : {0.0, 0.37})
                    EXPECT_LT(through(*Ground::stairs(height, depth), heading, z, speed, start), 0.0105)
                        << height << " on " << depth << ", heading " << heading << " at " << speed << " from "
                        << start;
}

TEST_F(FeetSwing, AFastSlopeIsNoJump) {
    // The foot is lifted by the slope's rise at once, not by an ease that lags behind.
    Walker walker(skeleton, clip);
    FeetState state;
    WalkOptions walk;
    walk.from.z = 1.0;
    for (int frame = 0; frame < 300; ++frame) {
        walker.step(*Ground::slope(40.0 * swing_pi / 180.0), walk, frame, state);
        if (frame < 30) continue;
        for (const FootState& foot : state.feet) EXPECT_LT(std::abs(foot.ease.value), 0.02) << frame;
    }
}

// Many characters at once give the same results as each alone, on any number of threads.

TEST(FeetMany, EqualSeparateSolvesOnAnyNumberOfThreads) {
    constexpr std::size_t count = 100;
    const Skeleton skeleton = make_figure({});
    const Clip clip = FigureWalk(skeleton).clip();
    const Feet feet = *Feet::make(skeleton, match_bones(skeleton));
    const Ground stairs = *Ground::stairs(0.15, 0.3);
    const auto play = [&](int threads) {
        std::vector<std::vector<rig::Transform>> poses(count, std::vector<rig::Transform>(skeleton.size()));
        std::vector<FeetState> states(count);
        std::vector<FeetJob> jobs;
        for (std::size_t i = 0; i < count; ++i) {
            jobs.push_back({.feet = &feet, .pose = poses[i], .state = &states[i]});
            jobs.back().options.root.translation.z = 0.03 * static_cast<double>(i);
        }
        for (int frame = 0; frame < 30; ++frame) {
            for (std::vector<rig::Transform>& pose : poses) sample(clip, skeleton, frame / 60.0, pose);
            if (threads > 0)
                step_many(jobs, stairs, 1.0 / 60, {.threads = threads});
            else
                for (FeetJob& job : jobs)
                    job.report = feet.step(job.pose, stairs, 1.0 / 60, *job.state, job.options);
        }
        return std::pair(poses, states);
    };
    const auto alone = play(0);
    for (const int threads : {1, 3, 1000}) EXPECT_EQ(play(threads), alone) << threads;
}

TEST(FeetMany, MissingInputIsInvalid) {
    std::vector<FeetJob> jobs(3);
    step_many(jobs, Ground(), 0.1);
    for (const FeetJob& job : jobs) EXPECT_TRUE(says(job.report.accepted.message(), "step_many feet"));
    step_many({}, Ground(), 0.1, {.threads = -7});
}

}  // namespace
}  // namespace tendril::test
