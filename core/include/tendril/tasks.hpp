// How a call spreads its work over threads: on the program's job system, or on threads of its own.
//
// An engine sets `run` to a few lines that pass the tasks to its own workers, as with the enqueueTask
// callback of Box2D v3. The library then starts no thread:
//
//     void run_on_jobs(void* user, tendril::TaskFunction task, void* context, std::uint32_t count) {
//         static_cast<Jobs*>(user)->parallel_for(count, [=](std::uint32_t index) { task(context, index); });
//     }
//     solve_many(batch, targets, reports, {.tasks = {run_on_jobs, &jobs}});
//     workspace.use_threads(8, {run_on_jobs, &jobs});  // rope::Workspace
//
// Results never depend on the choice: any order of the tasks, on any number of threads, gives the same bits.
#pragma once

#include <cstdint>

namespace tendril {

/// One task of a call. It must not throw, or wait for a task that has not begun.
using TaskFunction = void (*)(void* context, std::uint32_t index) noexcept;

struct Tasks {
    /// Calls `task(context, i)` once for each i from 0 to count - 1 and returns when all of them have
    /// returned: in any order, on any threads, in parallel or in sequence. Must not throw. Null: the library
    /// starts threads for the call and joins them before it returns, which costs about 20 µs per thread. If
    /// the system cannot start a thread, the calling thread does its share.
    void (*run)(void* user, TaskFunction task, void* context, std::uint32_t count) = nullptr;
    /// Passed to `run` unchanged.
    void* user = nullptr;
};

}  // namespace tendril
