// The depth to which a foot passes through the ground while it is in the air.
#include <tendril/humanoid/lint.hpp>

#include "humanoid_feet_support.hpp"

namespace tendril::test {
namespace {

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

}  // namespace
}  // namespace tendril::test
