// The task callback: every piece runs once, on the program's workers if any, with the same bits in any order.
#include "tendril/tasks.hpp"

#include "ik_many_support.hpp"
#include "jobs.hpp"

namespace tendril::test {
namespace {

TEST(Tasks, SolveManyRunsOnTheProgramsOwnWorkersAndGivesTheSameBits) {
    Random random(41);
    const Crowd crowd = some_crowd(5000, 10, random, 0.05f, 1.1f);
    const Answer expected = solve_many(crowd, {});
    for (const bool backwards : {false, true}) {
        for (const bool aside : {false, true}) {
            Jobs jobs{.backwards = backwards, .aside = aside};
            const Answer answer = solve_many(crowd, {.tasks = {run_on_jobs, &jobs}}, 4);
            EXPECT_EQ(jobs.calls, 1u);
            EXPECT_EQ(jobs.pieces, 4u);
            EXPECT_EQ(difference(answer, expected), "");
        }
    }
}

TEST(Tasks, ASingleThreadNeedsNoCallback) {
    Random random(42);
    const Crowd crowd = some_crowd(500, 10, random);
    Jobs jobs;
    solve_many(crowd, {.tasks = {run_on_jobs, &jobs}});
    EXPECT_EQ(jobs.calls, 0u);
}

}  // namespace
}  // namespace tendril::test
