// A loop that one thread splits into parts and shares with idle threads. Not installed.
//
//     ForkJoin loops;
//     loops.begin();                                     // one thread, the owner of the work
//     loops.run(parts, [&](std::uint32_t part) { ... }); // repeatedly; returns when all parts are done
//     loops.end();
//
//     while (...) loops.help();                          // any other threads, at any time or never
//
// A loop waits only for parts that have been started, so it ends whether or not other threads help, and
// however they are scheduled. Handing out a part costs one atomic operation and no system call.
#pragma once

#include <atomic>
#include <cstdint>

#include "tendril/tasks.hpp"

namespace tendril::detail {

class ForkJoin {
  public:
    ForkJoin() = default;
    /// Moving yields a new object. No thread may be working in the source.
    ForkJoin(ForkJoin&&) noexcept : ForkJoin() {}

    void begin() noexcept { shared_ = true; }
    void end() noexcept { shared_ = false; }
    /// True if other threads may help. Otherwise run the loop without parts.
    bool shared() const noexcept { return shared_; }

    /// Calls `part(i)` for each i below `count`, at most max_parts, in any order, on this thread and on
    /// helping ones. This thread starts with the first part and helpers with the last, so that in loop after
    /// loop each finds most of its data in its cache.
    template <class Part>
    void run(std::uint32_t count, const Part& part) noexcept {
        run([](void* context, std::uint32_t index) noexcept { (*static_cast<const Part*>(context))(index); },
            const_cast<Part*>(&part), count);
    }
    /// Works on the running loop, if any, until no parts are left. Returns whether it did any work.
    bool help() noexcept { return work(false); }

    static constexpr std::uint32_t max_parts = 0xffff;

  private:
    bool work(bool from_first) noexcept;
    void run(TaskFunction part, void* context, std::uint32_t count) noexcept;

    bool shared_ = false;  ///< only the owner uses it
    TaskFunction part_ = nullptr;
    void* context_ = nullptr;
    /// Upper half: the loop's number. Lower half: first and end index of the parts not started yet, 16 bits
    /// each. The thread that takes a part off either end owns it, and may then read the loop's function and
    /// context.
    alignas(64) std::atomic<std::uint64_t> open_{0};
    alignas(64) std::atomic<std::uint32_t> done_{0};
};

/// For polling loops: `polls` is the number of polls so far. After a while it yields the processor.
void pause(std::uint32_t polls) noexcept;

}  // namespace tendril::detail
