// Options whose members each have a range: one table each, and one way to check them. Not installed.
#pragma once

#include <span>

#include "rig/checks.hpp"

namespace tendril::humanoid::detail {

template <class Options>
struct OptionRange {
    const char* name;
    double Options::*member;
    double minimum, maximum;
    const char* requirement;  // "from 0 to 1"
};

/// Names the first member that is out of range or NaN.
template <class Options>
Result check_ranges(const char* operation, const Options& options,
                    std::span<const OptionRange<Options>> ranges) noexcept {
    for (const OptionRange<Options>& range : ranges) {
        const double value = options.*range.member;
        if (!(value >= range.minimum && value <= range.maximum))
            return rig::detail::refused(operation, range.name, range.requirement, value);
    }
    return {};
}

}  // namespace tendril::humanoid::detail
