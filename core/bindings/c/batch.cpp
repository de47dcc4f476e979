#include "batch.hpp"

#include <cstdio>

namespace tendril::door {

Expected<Batch> make_batch(std::size_t chains, std::size_t bones, int threads) {
    Expected<ik::Batch> made = ik::Batch::make(chains, bones, threads);
    if (!made) return made.error();
    return Batch{std::move(*made), std::vector<ik::ManyReport>(chains)};
}

namespace {

/// Fails if not one chain was accepted.
Result judged(const Batch& batch, const ik::ManySummary& summary) noexcept {
    return summary.invalid == batch.batch.size() ? summary.accepted : Result();
}

}  // namespace

Result solve_many(Batch& batch, std::span<const glm::vec3> targets, ik::ManyOptions options,
                  const tendril_tasks* tasks, ik::ManySummary& summary) noexcept {
    options.tasks = tasks_of(tasks);
    summary = ik::solve_many(batch.batch, targets, batch.reports, options);
    return judged(batch, summary);
}

Result solve_many(Batch& batch, std::span<glm::vec3> joints, std::span<const glm::vec3> targets,
                  ik::ManyOptions options, const tendril_tasks* tasks, ik::ManySummary& summary) noexcept {
    options.tasks = tasks_of(tasks);
    summary = ik::solve_many(batch.batch, joints, targets, batch.reports, options);
    return judged(batch, summary);
}

Result report_of(const Batch& batch, std::size_t chain, ik::ManyReport& report) noexcept {
    if (chain < batch.reports.size()) {
        report = batch.reports[chain];
        return {};
    }
    char text[Result::max_message];
    std::snprintf(text, sizeof text, "ik_batch_report: chain must be under %zu, got %zu",
                  batch.reports.size(), chain);
    return {ErrorCode::OutOfRange, text};
}

}  // namespace tendril::door
