// Checks of a rig's input. Not installed.
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
/// Checks that a number is finite and at most max_magnitude in magnitude.
inline Result check_number(std::string_view operation, const Argument& argument, double value) noexcept {
    if (std::abs(value) <= static_cast<double>(max_magnitude)) return {};
    return refused(operation, argument, "finite and at most 1e9 in magnitude", value);
}
/// Names the refused coordinate: `targets[1].position.y`.
inline Result check_vector(std::string_view operation, const Argument& argument,
                           const glm::dvec3& value) noexcept {
    for (int i = 0; i < 3; ++i) {
        if (check_number(operation, argument, value[i])) continue;
        std::string member(argument.member);
        if (!member.empty()) member += '.';
        member += "xyz"[i];
        return check_number(operation, Argument(argument.name, argument.index, member), value[i]);
    }
    return {};
}

}  // namespace tendril::rig::detail
