// A mock job system for tests of the task callback.
#pragma once

#include <thread>
#include <vector>

#include "tendril/tasks.hpp"

namespace tendril::test {

struct Jobs {
    std::uint64_t calls = 0, pieces = 0;
    bool backwards = false, threaded = false;  ///< threaded: each piece on its own thread
};

inline void run_on_jobs(void* user, TaskFunction task, void* context, std::uint32_t count) {
    Jobs& jobs = *static_cast<Jobs*>(user);
    ++jobs.calls;
    jobs.pieces += count;
    if (jobs.threaded) {
        std::vector<std::thread> workers;
        for (std::uint32_t i = 0; i < count; ++i) workers.emplace_back([=] { task(context, i); });
        for (std::thread& worker : workers) worker.join();
        return;
    }
    for (std::uint32_t i = 0; i < count; ++i) task(context, jobs.backwards ? count - 1 - i : i);
}

}  // namespace tendril::test
