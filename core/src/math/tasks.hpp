// Runs the pieces of a call as its Tasks option says. Not installed.
#pragma once

#include <cstdint>

#include "tendril/tasks.hpp"

namespace tendril::detail {

inline constexpr std::uint32_t max_threads = 256;

/// Calls `task(context, i)` for each i below `count` and returns when all are done. If `tasks.run` is set, it
/// chooses the threads. Otherwise at most `threads` (1 to max_threads) run, including the calling thread.
void run_tasks(const Tasks& tasks, std::uint32_t threads, TaskFunction task, void* context,
               std::uint32_t count) noexcept;

/// The same for any callable that takes an index and does not throw.
template <class Piece>
void run_pieces(const Tasks& tasks, std::uint32_t threads, std::uint32_t count, const Piece& piece) noexcept {
    run_tasks(
        tasks, threads,
        [](void* context, std::uint32_t index) noexcept { (*static_cast<const Piece*>(context))(index); },
        const_cast<Piece*>(&piece), count);
}

}  // namespace tendril::detail
