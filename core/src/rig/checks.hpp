// Checks of what comes into a rig from outside. Not installed.
#pragma once

#include <cmath>
#include <string>
#include <string_view>

#include "math/checks.hpp"
#include "tendril/vec3.hpp"

namespace tendril::rig::detail {

using tendril::detail::Argument;
using tendril::detail::refused;

inline std::string quoted(std::string_view name) {
    std::string result(1, '"');
    result += name;
    result += '"';
    return result;
}
/// Finite and at most max_magnitude in magnitude.
inline Result check_number(std::string_view operation, const Argument& argument, double value) noexcept {
    if (std::abs(value) <= static_cast<double>(max_magnitude)) return {};
    return refused(operation, argument, "finite and at most 1e9 in magnitude", value);
}
/// `argument` must not name a member: x, y or z is added as the member.
inline Result check_vector(std::string_view operation, std::string_view argument,
                           const glm::dvec3& value) noexcept {
    constexpr std::string_view names[]{"x", "y", "z"};
    for (int i = 0; i < 3; ++i) {
        const Argument component(argument, tendril::detail::no_index, names[i]);
        if (const Result bad = check_number(operation, component, value[i]); !bad) return bad;
    }
    return {};
}
inline Result check_weight(std::string_view operation, const Argument& argument, double value) noexcept {
    return value >= 0.0 && value <= 1.0 ? Result() : refused(operation, argument, "from 0 to 1", value);
}

}  // namespace tendril::rig::detail
