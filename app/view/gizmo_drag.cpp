#include "app/view/gizmo.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>

namespace tendril::app {
namespace {

constexpr float min_slant = 0.1f;   ///< sine of the slant below which an axis or plane drag is linear
constexpr float ring_slant = 0.3f;  ///< sine of the slant below which a ring is pulled like a rope
constexpr float min_factor = 0.01f;

bool finite(glm::vec3 v) {
    return std::isfinite(v.x + v.y + v.z) && glm::dot(v, v) < 1e30f;
}

glm::quat valid_rotation(const glm::quat& rotation) {
    const float length = glm::length(rotation);
    return length > 1e-6f && length < 1e6f ? rotation / length : glm::quat(1.0f, 0.0f, 0.0f, 0.0f);
}

glm::vec3 unit_axis(int axis) {
    glm::vec3 v(0.0f);
    v[axis] = 1.0f;
    return v;
}

std::string formatted(const char* format, double a, double b = 0.0) {
    const auto clean = [](double value) { return std::abs(value) < 5e-4 ? 0.0 : value; };  // no "-0.00"
    char text[64];
    std::snprintf(text, sizeof text, format, clean(a), clean(b));
    return text;
}

}  // namespace

GizmoDrag::GizmoDrag(GizmoPart part, const HandleFrame& frame, const Ray& caught, float reach,
                     bool orthographic)
    : part_(part), from_(frame), reach_(reach > 1e-9f && std::isfinite(reach) ? reach : 1.0f) {
    from_.rotation = valid_rotation(frame.rotation);
    if (!finite(from_.position)) from_.position = glm::vec3(0.0f);
    last_ = from_;
    const int axis = axis_of(part);
    axis_ = from_.rotation * unit_axis(axis);
    u_ = from_.rotation * unit_axis((axis + 1) % 3);
    v_ = from_.rotation * unit_axis((axis + 2) % 3);
    const glm::vec3 way = from_.position - caught.origin;
    const float direction = glm::length(caught.direction);
    sight_ = finite(caught.direction) && direction > 1e-6f ? caught.direction / direction
                                                           : glm::vec3(0.0f, 0.0f, -1.0f);
    if (!orthographic && finite(way) && glm::length(way) > 1e-6f) {
        distance_ = glm::length(way);
        inverse_distance_ = 1.0f / distance_;
        sight_ = way / distance_;
    }
    edge_on_ = std::abs(glm::dot(sight_, axis_)) < ring_slant;
    const glm::vec3 at = facing(caught).value_or(glm::vec3(0.0f));
    caught_ = measured(at);
    last_angle_ = caught_.x;
    const glm::vec3 nearest = -(sight_ - glm::dot(sight_, axis_) * axis_);
    caught_at_ = edge_on_ ? std::atan2(glm::dot(nearest, v_), glm::dot(nearest, u_)) : caught_.x;
}

/// The point where a line of sight meets the plane that faces the eye, relative to the centre.
std::optional<glm::vec3> GizmoDrag::facing(const Ray& ray) const {
    if (!finite(ray.origin) || !finite(ray.direction)) return std::nullopt;
    glm::vec3 at;
    if (inverse_distance_ == 0.0f) {
        at = ray.origin - from_.position;
        at -= glm::dot(at, sight_) * sight_;
    } else {
        const float towards = glm::dot(ray.direction, sight_);
        if (!(towards > 0.05f * glm::length(ray.direction))) return std::nullopt;
        at = distance_ * (ray.direction / towards - sight_);
    }
    return finite(at) ? std::optional(at) : std::nullopt;
}

/// A point at distance t along an axis of slant p appears at m = t p / (1 + t a / d) in the plane that faces
/// the eye, where a is the axis's component away from the eye and d the distance to the eye. Solved for t.
float GizmoDrag::along_axis(glm::vec3 at, glm::vec3 axis) const {
    const float away = glm::dot(axis, sight_);
    const glm::vec3 across = axis - away * sight_;
    const float slant = glm::length(across);
    if (slant < 1e-6f) return 0.0f;
    const float seen = glm::dot(at, across) / slant;
    return seen / std::max(slant - seen * away * inverse_distance_, min_slant);
}

/// The point where the line of sight through `at` meets the part's plane.
glm::vec2 GizmoDrag::in_plane(glm::vec3 at) const {
    const float height = glm::dot(at, axis_), upright = glm::dot(sight_, axis_);
    const float side = upright < 0.0f ? -1.0f : 1.0f;
    const float slant = side * std::max(side * (upright + height * inverse_distance_), min_slant);
    const glm::vec3 met = at - height / slant * (sight_ + inverse_distance_ * at);
    return {glm::dot(met, u_), glm::dot(met, v_)};
}

/// Radians about the axis. An edge-on ring rotates by as much as its near side is pulled.
float GizmoDrag::about_axis(glm::vec3 at) const {
    if (!edge_on_) {
        const glm::vec2 met = in_plane(at);
        return glm::length(met) > 1e-6f * reach_ ? std::atan2(met.y, met.x) : last_angle_;
    }
    const glm::vec3 nearest = -(sight_ - glm::dot(sight_, axis_) * axis_);
    return glm::dot(at, glm::normalize(glm::cross(axis_, nearest))) / reach_;
}

glm::vec2 GizmoDrag::measured(glm::vec3 at) const {
    if (is_plane(part_)) return in_plane(at);
    return {changed_by(part_) == Drag::Rotation ? about_axis(at) : along_axis(at, axis_), 0.0f};
}

HandleFrame GizmoDrag::changed(const HandleFrame& now, const HandleFrame& dragged) const {
    HandleFrame frame = now;
    const glm::vec3 by = dragged.position - now.position;
    if (is_plane(part_))
        frame.position += glm::dot(by, u_) * u_ + glm::dot(by, v_) * v_;
    else if (changed_by(part_) == Drag::Position)
        frame.position += glm::dot(by, axis_) * axis_;
    else if (changed_by(part_) == Drag::Scale)
        frame.scale[axis_of(part_)] = dragged.scale[axis_of(part_)];
    else
        frame.rotation = dragged.rotation;
    return frame;
}

HandleFrame GizmoDrag::to(const Ray& ray) {
    const auto at = facing(ray);
    if (!at) return last_;
    const glm::vec2 now = measured(*at), by = now - caught_;
    if (!std::isfinite(now.x + now.y)) return last_;
    HandleFrame frame = from_;
    if (is_plane(part_)) {
        frame.position += by.x * u_ + by.y * v_;
    } else if (changed_by(part_) == Drag::Position) {
        frame.position += by.x * axis_;
    } else if (changed_by(part_) == Drag::Scale) {
        frame.scale[axis_of(part_)] *= std::max(1.0f + by.x / reach_, min_factor);
    } else {
        constexpr double round = 2.0 * glm::pi<double>();
        const double step = static_cast<double>(now.x) - static_cast<double>(last_angle_);
        turned_ += edge_on_ ? step : std::remainder(step, round);
        last_angle_ = now.x;
        const auto angle = static_cast<float>(std::remainder(turned_, round));
        frame.rotation = glm::normalize(from_.rotation * glm::angleAxis(angle, unit_axis(axis_of(part_))));
    }
    if (finite(frame.position) && finite(frame.scale)) last_ = frame;
    return last_;
}

std::string GizmoDrag::text(const HandleFrame& now) const {
    constexpr const char* axes[] = {"X", "Y", "Z"};
    constexpr const char* planes[] = {"YZ", "ZX", "XY"};
    const int axis = axis_of(part_);
    const glm::vec3 by = now.position - from_.position;
    if (is_plane(part_))
        return formatted("%.2f, %.2f m in ", glm::dot(by, u_), glm::dot(by, v_)) + planes[axis];
    switch (changed_by(part_)) {
        case Drag::Position:
            return formatted("%.2f m along ", glm::dot(by, axis_)) + axes[axis];
        case Drag::Rotation:
            return formatted("%.1f\u00b0 about ", glm::degrees(turned_)) + axes[axis];
        default:
            return formatted("%.2f times along ", now.scale[axis] / from_.scale[axis]) + axes[axis];
    }
}

}  // namespace tendril::app
