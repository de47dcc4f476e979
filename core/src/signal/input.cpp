#include "tendril/signal/input.hpp"

#include <cmath>

namespace tendril::signal {
namespace {

// Each comparison is false for NaN.
bool is_rotation(double w, double x, double y, double z) noexcept {
    const double square = w * w + x * x + y * y + z * z;
    return square >= 1e-6 && square <= 1e6;
}

}  // namespace

bool is_input(double value) noexcept {
    return std::abs(value) <= static_cast<double>(max_magnitude);
}
bool is_input(float value) noexcept {
    return std::abs(value) <= max_magnitude;
}
bool is_input(const glm::vec3& value) noexcept {
    return is_input(value.x) && is_input(value.y) && is_input(value.z);
}
bool is_input(const glm::dvec3& value) noexcept {
    return is_input(value.x) && is_input(value.y) && is_input(value.z);
}
bool is_input(const glm::quat& value) noexcept {
    return is_rotation(static_cast<double>(value.w), static_cast<double>(value.x),
                       static_cast<double>(value.y), static_cast<double>(value.z));
}
bool is_input(const glm::dquat& value) noexcept {
    return is_rotation(value.w, value.x, value.y, value.z);
}

bool is_step(double dt) noexcept {
    return dt > 0.0 && std::isfinite(dt);
}

}  // namespace tendril::signal
