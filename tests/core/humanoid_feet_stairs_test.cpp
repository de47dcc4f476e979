// Where feet come down on stairs, before they are planted.
#include "humanoid_feet_support.hpp"

namespace tendril::test {
namespace {

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

}  // namespace
}  // namespace tendril::test
