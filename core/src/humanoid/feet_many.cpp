#include "tendril/humanoid/feet_many.hpp"

#include <algorithm>

#include "math/checks.hpp"
#include "math/tasks.hpp"

namespace tendril::humanoid {

void step_many(std::span<FeetJob> jobs, const Ground& ground, double dt,
               const FeetManyOptions& options) noexcept {
    constexpr std::size_t in_piece = 32;  // about 0.1 ms of work
    const auto threads = static_cast<std::uint32_t>(
        std::clamp(options.threads, 1, static_cast<int>(tendril::detail::max_threads)));
    const auto pieces = static_cast<std::uint32_t>((jobs.size() + in_piece - 1) / in_piece);
    const auto step = [&](std::uint32_t piece) noexcept {
        const std::size_t first = piece * in_piece, count = std::min(in_piece, jobs.size() - first);
        for (FeetJob& job : jobs.subspan(first, count)) {
            if (job.feet && job.state)
                job.report = job.feet->step(job.pose, ground, dt, *job.state, job.options);
            else
                job.report = {.accepted = tendril::detail::refused("step_many", job.feet ? "state" : "feet",
                                                                   "an object", "null")};
        }
    };
    tendril::detail::run_pieces(options.tasks, threads, pieces, step);
}

}  // namespace tendril::humanoid
