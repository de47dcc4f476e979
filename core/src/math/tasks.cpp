#include "math/tasks.hpp"

#include <pthread.h>

#include <algorithm>
#include <array>
#include <atomic>

namespace tendril::detail {
namespace {

/// State shared by the threads of one call: each takes the next piece until none are left.
struct Shared {
    TaskFunction task;
    void* context;
    std::uint32_t count;
    std::atomic<std::uint32_t> next{0};

    void work() noexcept {
        for (std::uint32_t i; (i = next.fetch_add(1)) < count;) task(context, i);
    }
};

void* work(void* shared) noexcept {
    static_cast<Shared*>(shared)->work();
    return nullptr;
}

/// Uses POSIX threads: std::thread throws if it cannot start a thread, and this library is compiled without
/// exceptions.
void run_on_threads(Shared& shared, std::uint32_t threads) noexcept {
    std::array<pthread_t, max_threads> started;
    std::size_t count = 0;
    const std::size_t wanted = std::min({threads, shared.count, max_threads}) - 1;
    while (count < wanted && pthread_create(&started[count], nullptr, work, &shared) == 0) ++count;
    shared.work();
    for (std::size_t i = 0; i < count; ++i) pthread_join(started[i], nullptr);
}

}  // namespace

void run_tasks(const Tasks& tasks, std::uint32_t threads, TaskFunction task, void* context,
               std::uint32_t count) noexcept {
    if (count == 0) return;
    if (count == 1) return task(context, 0);
    if (tasks.run != nullptr) return tasks.run(tasks.user, task, context, count);
    Shared shared{task, context, count};
    run_on_threads(shared, std::max(1u, threads));
}

}  // namespace tendril::detail
