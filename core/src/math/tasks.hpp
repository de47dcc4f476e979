// Runs the pieces of a call as its options say. Not installed.
#pragma once

#include <cstdint>

#include "tendril/tasks.hpp"

namespace tendril::detail {

inline constexpr std::uint32_t max_threads = 256;

/// Calls `task(context, i)` for each i below `count` and returns when all are done. One piece runs on the
/// calling thread. `threads` (1 to max_threads) bounds how many of the library's own threads take part, the
/// caller's among them; where `tasks.run` is given it decides instead.
void run_tasks(const Tasks& tasks, std::uint32_t threads, TaskFunction task, void* context,
               std::uint32_t count) noexcept;

/// The same for anything that can be called with an index and does not throw.
template <class Piece>
void run_pieces(const Tasks& tasks, std::uint32_t threads, std::uint32_t count, const Piece& piece) noexcept {
    run_tasks(
        tasks, threads,
        [](void* context, std::uint32_t index) noexcept { (*static_cast<const Piece*>(context))(index); },
        const_cast<Piece*>(&piece), count);
}

}  // namespace tendril::detail
