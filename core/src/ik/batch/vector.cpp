// Which vector units there are.
#include "ik/batch/vector.hpp"

#include <array>

#include "tendril/ik/many.hpp"

#define HWY_DISABLED_TARGETS HWY_AVX3_DL  // as in the files that it dispatches to
#include <hwy/highway.h>

namespace tendril::ik {
namespace detail {
namespace {

/// Those that both the machine has and this file was compiled for.
struct Units {
    std::array<VectorUnit, 16> units{};
    std::array<std::string_view, 16> names{};
    std::size_t count = 0;

    Units() noexcept {
        // A lower bit is a better target.
        std::int64_t targets = hwy::SupportedTargets() & HWY_TARGETS;
        if (targets == 0) targets = HWY_STATIC_TARGET;
        for (; targets != 0 && count < names.size(); targets &= targets - 1) {
            const std::int64_t target = targets & -targets;
            names[count] = hwy::TargetName(target);
            units[count].classify = classify_with(target);
            units[count].iterate = iterate_with(target);
            units[count].classify_limited = classify_limited_with(target);
            units[count].solve_limited = solve_limited_with(target);
            transfers_with(target, units[count++]);
        }
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
