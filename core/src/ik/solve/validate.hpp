// Validates the input of a solve. Not installed.
#pragma once

#include <glm/vec3.hpp>
#include <limits>
#include <span>

#include "tendril/ik/limit.hpp"
#include "tendril/ik/method.hpp"
#include "tendril/ik/plane.hpp"
#include "tendril/ik/state.hpp"
#include "tendril/magnitude.hpp"
#include "tendril/quat.hpp"

namespace tendril::ik {
struct Options;
}

namespace tendril::ik::detail {

/// Report of a refused solve. Its infinite residual never compares as success.
template <class Report>
Report refusal(const Result& why) noexcept {
    Report report;
    report.status = decltype(report.status)::InvalidInput;
    if constexpr (requires { report.residual; })
        report.residual = std::numeric_limits<decltype(report.residual)>::infinity();
    report.accepted = why;
    return report;
}

/// True if every coordinate is finite and at most max_magnitude.
bool are_points(std::span<const glm::vec3> points) noexcept;

/// False for NaN.
inline bool within(float value, float minimum, float maximum) noexcept {
    return value >= minimum && value <= maximum;
}

inline bool within(float value, FieldRange range) noexcept {
    return within(value, static_cast<float>(range.low), static_cast<float>(range.high));
}
/// Coordinates, metres.
inline constexpr FieldRange anywhere{-max_magnitude, max_magnitude};
/// Ranges of start_stretch_ratio (low end excluded) and of max_stretch_scale.
inline constexpr FieldRange stretch_starts{0.0, 1.0}, stretch_scales{1.0, 100.0};

inline constexpr const char* turn_names[] = {"whole_chain", "each_joint"};

/// Unit length to 1e-3.
inline bool is_unit(const glm::quat& q) noexcept {
    return within(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z, 0.998f, 1.002f);
}

/// Refuses the first option that is out of the range given in options.hpp, for a chain of this many bones.
/// Checks only the number of joint limits.
Result check(const Options& options, std::size_t bones) noexcept;
Result check(const Plane& plane, std::size_t bones) noexcept;

/// True if the state has the right sizes and unit quaternions. Other numbers are only checked if pole.valid.
bool is_valid(const State& state, std::size_t bones) noexcept;

/// True if the method exists and takes this many bones.
bool takes(Method method, std::size_t bones) noexcept;

}  // namespace tendril::ik::detail
