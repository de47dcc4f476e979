#include "app/labs/rig/control_shape.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/gtc/quaternion.hpp>

#include "app/document/json_complete.hpp"
#include "app/labs/rig/value_json.hpp"

namespace tendril::app {
namespace {

/// Fixed, without "-0.00".
std::string fixed(double value) {
    char text[48];
    std::snprintf(text, sizeof text, "%.2f", std::abs(value) < 0.005 ? 0.0 : value);
    return text;
}

glm::dvec3 along(int axis) {
    glm::dvec3 v(0.0);
    v[axis] = 1.0;
    return v;
}

}  // namespace

double Rail::place(double value) const {
    const double range = high - low;
    return range > 0.0 ? ((value - low) / range - 0.5) * length : 0.0;
}
double Rail::value(double place) const {
    return low + (place / length + 0.5) * (high - low);
}

Rail rail_of(const rig::Control& control) {
    constexpr double unlimited = 2.0;
    Rail rail{.open_low = !control.minimum, .open_high = !control.maximum};
    if (control.minimum) rail.low = control.minimum->x;
    if (control.maximum) rail.high = control.maximum->x;
    if (rail.open_low && !rail.open_high) rail.low = rail.high - unlimited;
    if (rail.open_high && !rail.open_low) rail.high = rail.low + unlimited;
    return rail;
}

HandleFrame frame_of(const rig::Transform& pose) {
    return {glm::vec3(pose.translation), glm::quat(pose.rotation), glm::vec3(pose.scale)};
}

rig::Transform transform_of(const HandleFrame& frame) {
    return {glm::dvec3(frame.position), glm::dquat(frame.rotation), glm::dvec3(frame.scale)};
}

Json changed_transform(const rig::Transform& transform, const HandleFrame& from, const HandleFrame& to) {
    const Json all = transform_json(transform);
    Json changed = Json::object();
    if (to.position != from.position) changed["translation"] = all["translation"];
    if (to.rotation != from.rotation) changed["rotation"] = all["rotation"];
    if (to.scale != from.scale) changed["scale"] = all["scale"];
    return changed;
}

std::optional<ControlShape> ControlShape::of(const RigPart& part, const rig::Hierarchy& elements,
                                             std::size_t element) {
    const rig::Element& made = part.rig.definition().elements[element];
    if (!made.control) return std::nullopt;
    ControlShape shape(*made.control, part.state.controls[element], made.initial);
    const rig::ElementId id = part.rig.id(element), parent = elements.parent(id);
    if (parent) shape.space_ = *elements.known(parent, rig::Space::Global);
    shape.rest_ = *elements.known(id, rig::Space::Local, rig::Pose::Input);
    shape.now_ = *elements.known(id, rig::Space::Global);
    return shape;
}

rig::Transform ControlShape::pose() const {
    if (kind() != rig::ControlKind::Float) return now_;
    rig::Transform knob = now_;
    knob.translation += knob.rotation * glm::dvec3(rail_of(control_).place(number()), 0.0, 0.0);
    return knob;
}

glm::dvec3 ControlShape::placed(const glm::dvec3& value) const {
    glm::dvec3 local = value;
    if (kind() == rig::ControlKind::Vector2d)
        local = rest_.translation +
                rest_.rotation * (value.x * along(control_.axes[0]) + value.y * along(control_.axes[1]));
    return rig::compose(space_, {.translation = local}).translation;
}

bool ControlShape::ends_at(std::size_t part, double value) const {
    const auto i = static_cast<glm::length_t>(part);
    const bool low = control_.minimum && value <= (*control_.minimum)[i];
    const bool high = control_.maximum && value >= (*control_.maximum)[i];
    return low || high;
}

bool ControlShape::at_limit() const {
    if (!control_.minimum && !control_.maximum) return false;
    const rig::Value first = rig::clamped(control_, rig::rest_value(control_, initial_));
    if (value_ == first) return false;
    if (kind() == rig::ControlKind::Float) return ends_at(0, number());
    const auto part = [&](const glm::dvec3& now, const glm::dvec3& then, std::size_t parts) {
        for (std::size_t i = 0; i < parts; ++i) {
            const auto at = static_cast<glm::length_t>(i);
            if (now[at] != then[at] && ends_at(i, now[at])) return true;
        }
        return false;
    };
    if (const auto* point = std::get_if<glm::dvec3>(&value_))
        return part(*point, std::get<glm::dvec3>(first), kind() == rig::ControlKind::Vector2d ? 2 : 3);
    if (const auto* transform = std::get_if<rig::Transform>(&value_))
        return part(transform->translation, std::get<rig::Transform>(first).translation, 3);
    return false;
}

bool ControlShape::can_be_dragged() const {
    return kind() != rig::ControlKind::Bool;
}

Drag ControlShape::drag() const {
    switch (kind()) {
        case rig::ControlKind::Transform:
            return Drag::Position | Drag::Rotation | Drag::Scale;
        case rig::ControlKind::Rotation:
            return Drag::Rotation;
        case rig::ControlKind::Bool:
            return Drag::Nothing;
        default:
            return Drag::Position;
    }
}

std::optional<GizmoPart> ControlShape::part() const {
    if (kind() == rig::ControlKind::Float) return GizmoPart::MoveX;
    if (kind() != rig::ControlKind::Vector2d) return std::nullopt;
    const int upright = 3 - control_.axes[0] - control_.axes[1];
    return upright == 0 ? GizmoPart::MoveYZ : upright == 1 ? GizmoPart::MoveZX : GizmoPart::MoveXY;
}

Json ControlShape::value_at(const HandleFrame& from, const HandleFrame& to) const {
    if (kind() == rig::ControlKind::Float) {
        const glm::dvec3 by = glm::dvec3(to.position) - now_.translation;
        return rail_of(control_).value((glm::inverse(now_.rotation) * by).x);
    }
    rig::Transform wanted = now_;
    if (to.position != from.position) wanted.translation = glm::dvec3(to.position);
    if (to.rotation != from.rotation) wanted.rotation = rig::normalised(glm::dquat(to.rotation));
    if (to.scale != from.scale) wanted.scale = glm::dvec3(to.scale);
    const rig::Transform local = rig::relative(space_, wanted);
    switch (kind()) {
        case rig::ControlKind::Position:
            return value_json(local.translation);
        case rig::ControlKind::Rotation:
            return value_json(local.rotation);
        case rig::ControlKind::Vector2d: {
            const glm::dvec3 by = glm::inverse(rest_.rotation) * (local.translation - rest_.translation);
            return Json::array({by[control_.axes[0]], by[control_.axes[1]]});
        }
        default:
            break;
    }
    return changed_transform(local, from, to);
}

std::string ControlShape::text() const {
    if (kind() == rig::ControlKind::Float) return fixed(number());
    if (kind() == rig::ControlKind::Bool) return on() ? "on" : "off";
    if (kind() == rig::ControlKind::Rotation) return {};
    if (const auto* point = std::get_if<glm::dvec3>(&value_)) {
        const std::string two = fixed(point->x) + ", " + fixed(point->y);
        return kind() == rig::ControlKind::Vector2d ? two : two + ", " + fixed(point->z);
    }
    return {};
}

}  // namespace tendril::app
