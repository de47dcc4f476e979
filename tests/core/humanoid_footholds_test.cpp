// Footholds on stairs: the whole sole on a tread, reached smoothly.
#include <tendril/humanoid/lint.hpp>

#include "humanoid_feet_support.hpp"

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
    EXPECT_LE(pops, 9);  // 43 without footholds
}

}  // namespace
}  // namespace tendril::test
