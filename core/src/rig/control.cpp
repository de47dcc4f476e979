#include "tendril/rig/control.hpp"

#include <algorithm>

#include "math/checks.hpp"
#include "rig/math.hpp"
#include "rig/value.hpp"

namespace tendril::rig {
namespace {

/// The unit vector of one of the control's own axes, in its parent's space.
glm::dvec3 axis_of(const Transform& base, int axis) noexcept {
    glm::dvec3 unit(0.0);
    unit[axis] = 1.0;
    return detail::rotated(base.rotation, unit);
}

glm::dvec3 within(const Control& control, glm::dvec3 value) noexcept {
    for (int part = 0; part < 3; ++part) {
        if (control.maximum) value[part] = std::min(value[part], (*control.maximum)[part]);
        if (control.minimum) value[part] = std::max(value[part], (*control.minimum)[part]);
    }
    return value;
}

}  // namespace

Type type_of(ControlKind kind) noexcept {
    constexpr Type types[] = {Type::Transform, Type::Vector, Type::Rotation,
                              Type::Number,    Type::Bool,   Type::Vector};
    return types[static_cast<std::size_t>(kind)];
}

Value rest_value(const Control& control, const Transform& initial) noexcept {
    switch (control.kind) {
        case ControlKind::Transform:
            return initial;
        case ControlKind::Position:
            return initial.translation;
        case ControlKind::Rotation:
            return initial.rotation;
        case ControlKind::Float:
            return 0.0;
        case ControlKind::Bool:
            return false;
        case ControlKind::Vector2d:
            break;
    }
    return glm::dvec3(0.0);
}

Value clamped(const Control& control, const Value& value) noexcept {
    if (const auto* transform = std::get_if<Transform>(&value))
        return Transform{within(control, transform->translation), transform->rotation, transform->scale};
    if (const auto* number = std::get_if<double>(&value))
        return within(control, glm::dvec3(*number, 0.0, 0.0)).x;
    if (const auto* vector = std::get_if<glm::dvec3>(&value)) {
        const glm::dvec3 inside = within(control, *vector);
        return control.kind == ControlKind::Vector2d ? glm::dvec3(inside.x, inside.y, 0.0) : inside;
    }
    return value;
}

Transform posed(const Control& control, const Transform& base, const Value& value) noexcept {
    Transform pose = base;
    switch (control.kind) {
        case ControlKind::Transform:
            return std::get<Transform>(value);
        case ControlKind::Position:
            pose.translation = std::get<glm::dvec3>(value);
            break;
        case ControlKind::Rotation:
            pose.rotation = std::get<glm::dquat>(value);
            break;
        case ControlKind::Float:
        case ControlKind::Bool:
            break;
        case ControlKind::Vector2d: {
            const auto& by = std::get<glm::dvec3>(value);
            pose.translation = detail::plus(
                pose.translation, detail::plus(detail::times(axis_of(base, control.axes[0]), by.x),
                                               detail::times(axis_of(base, control.axes[1]), by.y)));
        }
    }
    return pose;
}

Result check(const char* what, const Control& control) noexcept {
    const std::string name(what);
    if (control.kind == ControlKind::Vector2d)
        for (const int axis : control.axes)
            if (axis < 0 || axis > 2)
                return tendril::detail::refused({}, std::string_view(name + ".axes"), "x, y or z (0 to 2)",
                                                axis);
    if (control.kind == ControlKind::Vector2d && control.axes[0] == control.axes[1])
        return {ErrorCode::InvalidArgument, name + ".axes must be two different axes"};
    for (const auto& [end, text] :
         {std::pair{&control.minimum, ".minimum"}, std::pair{&control.maximum, ".maximum"}})
        if (*end)
            if (const Result bad = check((name + text).c_str(), **end); !bad) return bad;
    if (!control.minimum || !control.maximum) return {};
    const int parts = control.kind == ControlKind::Float ? 1 : control.kind == ControlKind::Vector2d ? 2 : 3;
    for (int part = 0; part < parts; ++part)
        if (!((*control.minimum)[part] <= (*control.maximum)[part]))
            return tendril::detail::refused({}, std::string_view(name + ".minimum"), "at most the maximum",
                                            (*control.minimum)[part]);
    return {};
}

Result check_value(const char* what, const Control& control, const Value& value) noexcept {
    if (type_of(value) != type_of(control.kind))
        return {ErrorCode::InvalidArgument, std::string(what) + " must be a " + name(type_of(control.kind)) +
                                                ", as the control is a " + name(control.kind) + ", got a " +
                                                name(type_of(value))};
    return check(what, value);
}

}  // namespace tendril::rig
