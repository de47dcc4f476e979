// The four modes. Everything is checked first; after that nothing can fail, for the pull is noexcept.
#include <stdexcept>

#include "chain/checks.hpp"
#include "chain/pull.hpp"
#include "tendril/chain/chain.hpp"

namespace tendril {
namespace {

constexpr int max_iterations = 100'000;

void require_options(const FixedOptions& options) {
    if (options.iterations < 1 || options.iterations > max_iterations) {
        detail::refuse("fixed", "options.iterations", "1 to 100000", std::to_string(options.iterations));
    }
    detail::require_length("fixed", "options.tolerance", options.tolerance);
}

}  // namespace

void Chain::forward(glm::vec3 target) {
    detail::require_point("forward", "target", target);
    if (!empty()) detail::pull_towards_tail(segments_, 0, target, default_direction_);
}

void Chain::backward(glm::vec3 target) {
    detail::require_point("backward", "target", target);
    if (!empty()) detail::pull_towards_head(segments_, size() - 1, target, default_direction_);
}

FixedResult Chain::fixed(glm::vec3 target, const FixedOptions& options) {
    detail::require_point("fixed", "target", target);
    require_options(options);
    if (empty()) return {};

    FixedResult result{0, detail::distance(segments_.front().position, target)};
    if (size() == 1) return result;  // it is the tail, and the tail stays
    const glm::vec3 tail = segments_.back().position;
    do {
        detail::pull_towards_tail(segments_, 0, target, default_direction_);
        detail::pull_towards_head(segments_, size() - 1, tail, default_direction_);
        result.residual = detail::distance(segments_.front().position, target);
        ++result.iterations;
    } while (result.iterations < options.iterations && result.residual > options.tolerance);
    return result;
}

void Chain::with_index(std::size_t index, glm::vec3 target) {
    if (!empty()) detail::require_index("with_index", index, size());
    detail::require_point("with_index", "target", target);
    if (empty()) return;
    detail::pull_towards_tail(segments_, index, target, default_direction_);
    detail::pull_towards_head(segments_, index, target, default_direction_);
}

}  // namespace tendril
