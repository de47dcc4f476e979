// The task callback: every piece runs once, on the program's own workers where it has some, and gives the
// same bits however the pieces are ordered.
#include "tendril/tasks.hpp"

#include <atomic>
#include <thread>

#include "ik_many_support.hpp"

namespace tendril::test {
namespace {

/// Stands for an engine's job system.
struct Jobs {
    int calls = 0;
    std::uint32_t pieces = 0;
    bool backwards = false, aside = false;
};

void run_on_jobs(void* user, TaskFunction task, void* context, std::uint32_t count) {
    Jobs& jobs = *static_cast<Jobs*>(user);
    ++jobs.calls;
    jobs.pieces += count;
    if (jobs.aside) {
        std::vector<std::thread> workers;
        for (std::uint32_t i = 0; i < count; ++i) workers.emplace_back([=] { task(context, i); });
        for (std::thread& worker : workers) worker.join();
        return;
    }
    for (std::uint32_t i = 0; i < count; ++i) task(context, jobs.backwards ? count - 1 - i : i);
}

TEST(Tasks, SolveManyRunsOnTheProgramsOwnWorkersAndGivesTheSameBits) {
    Random random(41);
    const Crowd crowd = some_crowd(5000, 10, random, 0.05f, 1.1f);
    const Answer expected = solve_many(crowd, {});
    for (const bool backwards : {false, true}) {
        for (const bool aside : {false, true}) {
            Jobs jobs{.backwards = backwards, .aside = aside};
            const Answer answer = solve_many(crowd, {.tasks = {run_on_jobs, &jobs}}, 4);
            EXPECT_EQ(jobs.calls, 1);
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
    EXPECT_EQ(jobs.calls, 0);
}

}  // namespace
}  // namespace tendril::test
