// The four modes. Arguments are checked first; after that nothing can fail, because a pull is noexcept.
#include "chain/checks.hpp"
#include "chain/pull.hpp"
#include "tendril/chain/chain.hpp"
#include "tendril/magnitude.hpp"

namespace tendril {

template <>
std::span<const Field> fields<Segment>() noexcept {
    static constexpr Field rows[] = {
        field<&Segment::position>("position", {-max_magnitude, max_magnitude}, "m").needed(),
        field<&Segment::length>("length", {0.0, max_magnitude}, "m").needed()};
    return rows;
}

template <>
std::span<const Field> fields<FixedOptions>() noexcept {
    static constexpr Field rows[] = {field<&FixedOptions::iterations>("iterations", {1, 100'000}),
                                     field<&FixedOptions::tolerance>("tolerance", {0.0, max_magnitude}, "m")};
    return rows;
}

Result Chain::forward(glm::vec3 target) {
    if (const Result bad = detail::check_point("forward", "target", target); !bad) return bad;
    if (!empty()) detail::pull_towards_tail(segments_, 0, target, default_direction_);
    return {};
}

Result Chain::backward(glm::vec3 target) {
    if (const Result bad = detail::check_point("backward", "target", target); !bad) return bad;
    if (!empty()) detail::pull_towards_head(segments_, size() - 1, target, default_direction_);
    return {};
}

FixedResult Chain::fixed(glm::vec3 target, const FixedOptions& options) {
    FixedResult result;  // the only return value, so that no message is copied
    result.accepted = detail::check_point("fixed", "target", target);
    if (result.accepted) result.accepted = check_fields("fixed", options, "options");
    if (!result.accepted || empty()) return result;

    result.residual = detail::distance(segments_.front().position, target);
    if (size() == 1) return result;  // a single segment is the tail, which stays
    const glm::vec3 tail = segments_.back().position;
    do {
        detail::pull_towards_tail(segments_, 0, target, default_direction_);
        detail::pull_towards_head(segments_, size() - 1, tail, default_direction_);
        result.residual = detail::distance(segments_.front().position, target);
        ++result.iterations;
    } while (result.iterations < options.iterations && result.residual > options.tolerance);
    return result;
}

Result Chain::with_index(std::size_t index, glm::vec3 target) {
    if (const Result bad = detail::check_index("with_index", index, size()); !empty() && !bad) return bad;
    if (const Result bad = detail::check_point("with_index", "target", target); !bad) return bad;
    if (empty()) return {};
    detail::pull_towards_tail(segments_, index, target, default_direction_);
    detail::pull_towards_head(segments_, index, target, default_direction_);
    return {};
}

}  // namespace tendril
