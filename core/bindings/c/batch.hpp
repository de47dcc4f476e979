// Many chains at once in C: a batch with the reports of its last solve.
#pragma once

#include <span>
#include <vector>

#include "rope.hpp"
#include "tendril/ik/many.hpp"

namespace tendril::door {

struct Batch {
    ik::Batch batch;
    std::vector<ik::ManyReport> reports;
};

Expected<Batch> make_batch(std::size_t chains, std::size_t bones, int threads);
Result solve_many(Batch& batch, std::span<const glm::vec3> targets, ik::ManyOptions options,
                  const tendril_tasks* tasks, ik::ManySummary& summary) noexcept;
/// The same for joints of the caller.
Result solve_many(Batch& batch, std::span<glm::vec3> joints, std::span<const glm::vec3> targets,
                  ik::ManyOptions options, const tendril_tasks* tasks, ik::ManySummary& summary) noexcept;
Result report_of(const Batch& batch, std::size_t chain, ik::ManyReport& report) noexcept;

}  // namespace tendril::door
