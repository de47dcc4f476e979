// Loops that a thread shares with others while they have nothing else to do. Not installed.
//
//     ForkJoin loops;
//     loops.begin();                                     // one thread, which the work belongs to
//     loops.run(parts, [&](std::uint32_t part) { ... }); // again and again; returns when all parts are done
//     loops.end();
//
//     while (...) loops.help();                          // any others, at any time, meanwhile or never
//
// A loop waits only for parts that somebody has begun, so it ends whether or not anybody helps, and however
// threads are scheduled. Handing out a part costs an atomic operation and no system call.
#pragma once

#include <atomic>
#include <cstdint>

#include "tendril/tasks.hpp"

namespace tendril::detail {

class ForkJoin {
  public:
    ForkJoin() = default;
    /// Nobody may be at work in one that is moved: nothing is in it then.
    ForkJoin(ForkJoin&&) noexcept : ForkJoin() {}

    void begin() noexcept { shared_ = true; }
    void end() noexcept { shared_ = false; }
    /// Whether there may be help. Where there is none, a loop is best run without parts.
    bool shared() const noexcept { return shared_; }

    /// Calls `part(i)` for each i below `count`, at most max_parts, in any order, on this thread and on those
    /// that help. This thread begins with the first and others with the last, so that in loop after loop
    /// each finds in its cache most of what it needs.
    template <class Part>
    void run(std::uint32_t count, const Part& part) noexcept {
        run([](void* context, std::uint32_t index) noexcept { (*static_cast<const Part*>(context))(index); },
            const_cast<Part*>(&part), count);
    }
    /// Takes parts of the loop that is running, if there is one, until none are left; whether there were any.
    bool help() noexcept { return work(false); }

    static constexpr std::uint32_t max_parts = 0xffff;

  private:
    bool work(bool from_first) noexcept;
    void run(TaskFunction part, void* context, std::uint32_t count) noexcept;

    bool shared_ = false;  ///< of the thread that runs loops alone
    TaskFunction part_ = nullptr;
    void* context_ = nullptr;
    /// Which loop it is, in the upper half, and from where to where its parts are not begun yet, 16 bits
    /// each. Who takes one off at an end has that part, and may read what the loop is.
    alignas(64) std::atomic<std::uint64_t> open_{0};
    alignas(64) std::atomic<std::uint32_t> done_{0};
};

/// For what looks again and again whether something has changed: `looked` is how often it has. After some
/// time others get the processor.
void pause(std::uint32_t looked) noexcept;

}  // namespace tendril::detail
