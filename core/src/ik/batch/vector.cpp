// The available vector units.
#include "ik/batch/vector.hpp"

#include <array>

#include "math/dispatch.hpp"
#include "tendril/ik/many.hpp"

namespace tendril::ik {
namespace detail {
namespace {

/// Units that the machine has and this file was compiled for.
struct Units {
    std::array<VectorUnit, 16> units{};
    std::array<std::string_view, 16> names{};
    std::size_t count = 0;

    Units() noexcept {
        tendril::detail::for_each_target([&](std::int64_t target) {
            if (count == names.size()) return;
            names[count] = hwy::TargetName(target);
            units[count].classify = classify_with(target);
            units[count].begin = begin_with(target);
            units[count].iterate = iterate_with(target);
            units[count].classify_limited = classify_limited_with(target);
            units[count].solve_limited = solve_limited_with(target);
            units[count].step_limited = step_limited_with(target);
            transfers_with(target, units[count++]);
        });
    }
};

const Units& units() noexcept {
    static const Units found;
    return found;
}

}  // namespace

const VectorUnit* vector_unit_named(std::string_view name) noexcept {
    const Units& all = units();
    for (std::size_t i = 0; i < all.count; ++i) {
        if (all.names[i] == name) return &all.units[i];
    }
    return nullptr;
}

}  // namespace detail

std::span<const std::string_view> vector_units() noexcept {
    const detail::Units& all = detail::units();
    return {all.names.data(), all.count};
}

}  // namespace tendril::ik
