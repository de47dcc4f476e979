#include "rig/value.hpp"

#include <cmath>

#include "rig/checks.hpp"
#include "tendril/magnitude.hpp"

namespace tendril::rig {
namespace {

bool in_range(double value) noexcept {
    return std::abs(value) <= static_cast<double>(max_magnitude);
}
bool in_range(const glm::dvec3& value) noexcept {
    return in_range(value.x) && in_range(value.y) && in_range(value.z);
}

}  // namespace

const char* name(Type type) noexcept {
    constexpr const char* names[] = {"bool", "number", "vector", "rotation", "transform"};
    return names[static_cast<std::size_t>(type)];
}

Value neutral(Type type) noexcept {
    switch (type) {
        case Type::Bool:
            return false;
        case Type::Number:
            return 0.0;
        case Type::Vector:
            return glm::dvec3(0.0);
        case Type::Rotation:
            return glm::dquat(1.0, 0.0, 0.0, 0.0);
        case Type::Transform:
            break;
    }
    return Transform();
}

Result check(const char* what, const Value& value) noexcept {
    if (const auto* number = std::get_if<double>(&value)) {
        return detail::check_number({}, what, *number);
    } else if (const auto* vector = std::get_if<glm::dvec3>(&value)) {
        return detail::check_vector({}, what, *vector);
    } else if (const auto* rotation = std::get_if<glm::dquat>(&value)) {
        if (const auto valid = checked({.rotation = *rotation}, {}, what); !valid) return valid.error();
    } else if (const auto* transform = std::get_if<Transform>(&value)) {
        if (const auto valid = checked(*transform, {}, what); !valid) return valid.error();
    }
    return {};
}

Value normalised(const Value& value) noexcept {
    if (const auto* rotation = std::get_if<glm::dquat>(&value)) return normalised(*rotation);
    if (const auto* transform = std::get_if<Transform>(&value))
        return Transform{transform->translation, normalised(transform->rotation), transform->scale};
    return value;
}

bool is_in_range(const Value& value) noexcept {
    if (const auto* number = std::get_if<double>(&value)) return in_range(*number);
    if (const auto* vector = std::get_if<glm::dvec3>(&value)) return in_range(*vector);
    if (const auto* transform = std::get_if<Transform>(&value))
        return in_range(transform->translation) && in_range(transform->scale);
    return true;  // rotations are normalised where they are made
}

}  // namespace tendril::rig
