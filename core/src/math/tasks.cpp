#include "math/tasks.hpp"

#include <algorithm>
#include <array>
#include <atomic>

#ifdef _WIN32
#ifndef NOMINMAX
#define NOMINMAX
#endif
#include <windows.h>

#include <process.h>
#else
#include <pthread.h>
#endif

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

// The system's own threads: std::thread throws if it cannot start one, and this library is compiled without
// exceptions.
#ifdef _WIN32
using Thread = HANDLE;

unsigned __stdcall work(void* shared) noexcept {
    static_cast<Shared*>(shared)->work();
    return 0;
}
bool start(Thread& thread, Shared& shared) noexcept {
    thread = reinterpret_cast<HANDLE>(_beginthreadex(nullptr, 0, work, &shared, 0, nullptr));
    return thread != nullptr;
}
void join(Thread thread) noexcept {
    WaitForSingleObject(thread, INFINITE);
    CloseHandle(thread);
}
#else
using Thread = pthread_t;

void* work(void* shared) noexcept {
    static_cast<Shared*>(shared)->work();
    return nullptr;
}
bool start(Thread& thread, Shared& shared) noexcept {
    return pthread_create(&thread, nullptr, work, &shared) == 0;
}
void join(Thread thread) noexcept {
    pthread_join(thread, nullptr);
}
#endif

void run_on_threads(Shared& shared, std::uint32_t threads) noexcept {
    std::array<Thread, max_threads> started;
    std::size_t count = 0;
    const std::size_t wanted = std::min({threads, shared.count, max_threads}) - 1;
    while (count < wanted && start(started[count], shared)) ++count;
    shared.work();
    for (std::size_t i = 0; i < count; ++i) join(started[i]);
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
