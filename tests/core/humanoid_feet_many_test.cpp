// Many characters at once give the same results as each alone, on any number of threads.
#include <tendril/humanoid/feet_many.hpp>

#include "humanoid_feet_support.hpp"

namespace tendril::test {
namespace {

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
    for (const FeetJob& job : jobs) EXPECT_FALSE(job.report.valid);
    step_many({}, Ground(), 0.1, {.threads = -7});
}

}  // namespace
}  // namespace tendril::test
