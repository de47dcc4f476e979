#include "app/labs/kit/limit_shape.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>

#include "tendril/elementary.hpp"

namespace tendril::app {

LimitShape::LimitShape(const ik::Limit& limit, glm::vec3 rest, glm::quat parent)
    : limit_(limit), rest_(rest), parent_(parent) {
    up_axis_ = limit.axis - rest * glm::dot(limit.axis, rest);
    up_axis_ = glm::length(up_axis_) > 1e-6f ? glm::normalize(up_axis_) : glm::vec3(0, 0, 1);
    left_axis_ = glm::cross(up_axis_, rest);
}

glm::quat LimitShape::swing(float up, float left) const {
    const glm::vec3 swing = up_axis_ * up + left_axis_ * left;
    const float angle = glm::length(swing);
    return angle < 1e-7f ? glm::quat(1, 0, 0, 0) : math::rotation_about(swing / angle, angle);
}

glm::vec3 LimitShape::direction(float up, float left) const {
    return parent_ * (swing(up, left) * rest_);
}

std::vector<glm::vec3> LimitShape::outline(int steps) const {
    std::vector<glm::vec3> points;
    for (int i = 0; i <= steps; ++i) {
        const float share = static_cast<float>(i) / static_cast<float>(steps);
        if (is_hinge()) {
            points.push_back(direction(limit_.min + (limit_.max - limit_.min) * share, 0.0f));
            continue;
        }
        const float phi = glm::two_pi<float>() * share;
        const float up = math::sine(phi), left = math::cosine(phi);
        points.push_back(direction(up * (up > 0.0f ? limit_.up : limit_.down),
                                   left * (left > 0.0f ? limit_.left : limit_.right)));
    }
    return points;
}

glm::vec3 LimitShape::side(const ik::JointAngles& angles) const {
    return parent_ *
           (swing(angles.up, angles.left) * (math::rotation_about(rest_, angles.twist) * left_axis_));
}

namespace {

constexpr int hinge_steps = 40, cone_steps = 64, dial_steps = 32;

std::vector<glm::vec3> outline_of(const LimitShape& shape) {
    return shape.outline(shape.is_hinge() ? hinge_steps : cone_steps);
}

}  // namespace

void LimitPen::line(glm::vec3 a, glm::vec3 b, float width, float alpha) const {
    list_.line(a, b, px(width), faded(view_.palette, look_.colour, alpha * look_.strength));
}

void LimitPen::outline(const LimitShape& shape) const {
    const std::vector<glm::vec3> points = outline_of(shape);
    const std::size_t last = points.size() - 1;
    if (shape.is_hinge()) line(look_.centre, at(points.front()), 2.0f, 0.9f);
    for (std::size_t i = 0; i <= last; ++i) {
        const glm::vec3 to = at(points[i]);
        if (i > 0) line(at(points[i - 1]), to, 2.0f, 0.9f);
        if (!look_.spokes) continue;
        if (!shape.is_hinge() && i % 8 == 0) line(look_.centre, to, 1.0f, 0.4f);
        if (shape.is_hinge() && i % 4 == 0 && i > 0 && i < last)
            line(look_.centre + 0.9f * (to - look_.centre), to, 1.0f, 0.6f);
    }
    if (shape.is_hinge()) line(look_.centre, at(points.back()), 2.0f, 0.9f);
}

void LimitPen::fill(const LimitShape& shape) const {
    const std::vector<glm::vec3> points = outline_of(shape);
    for (std::size_t i = 1; i < points.size(); ++i) {
        const glm::vec3 across = glm::cross(points[i - 1], points[i]);
        if (!(glm::length(across) > 1e-9f)) continue;
        const glm::vec3 normal = glm::normalize(across);
        const std::uint32_t first = list_.veil.next();
        for (const glm::vec3 corner : {look_.centre, at(points[i - 1]), at(points[i])})
            list_.veil.vertices.push_back({corner, normal, look_.colour, look_.colour});
        list_.veil.triangle(first, first + 1, first + 2);
    }
}

void LimitPen::dial(const LimitShape& shape, const ik::JointAngles& angles, float along, float size) const {
    const ik::Limit& limit = shape.limit();
    if (shape.is_hinge() || limit.twist_max <= limit.twist_min) return;
    const glm::vec3 middle = look_.centre + along * look_.radius * shape.direction(angles.up, angles.left);
    const auto point = [&](float twist) {
        return middle + size * look_.radius * shape.side({angles.up, angles.left, twist});
    };
    glm::vec3 from = point(limit.twist_min);
    line(middle, from, 1.5f, 0.8f);
    for (int i = 1; i <= dial_steps; ++i) {
        const float share = static_cast<float>(i) / dial_steps;
        const glm::vec3 to = point(limit.twist_min + (limit.twist_max - limit.twist_min) * share);
        line(from, to, 1.5f, 0.8f);
        from = to;
    }
    line(middle, from, 1.5f, 0.8f);
    list_.line(middle, point(angles.twist), px(2.0f), glm::vec4(view_.palette.text, 0.9f));
}

void LimitPen::dot(const LimitShape& shape, const ik::JointAngles& angles) const {
    const float left = shape.is_hinge() ? 0.0f : angles.left;
    list_.sphere(at(shape.direction(angles.up, left)), px(3.5f), Unit::Pixels, glm::vec4(look_.colour, 1.0f));
}

void LimitPen::needle(const LimitShape& shape, const ik::JointAngles& angles) const {
    const glm::vec3 to = at(shape.direction(angles.up, shape.is_hinge() ? 0.0f : angles.left));
    const glm::vec4 paint(look_.colour, 1.0f);
    list_.line(look_.centre, to, px(1.5f), paint).layer = Layer::Overlay;
    list_.sphere(to, px(3.5f), Unit::Pixels, paint).layer = Layer::Overlay;
}

void LimitPen::rest(const LimitShape& shape) const {
    line(look_.centre, at(shape.direction(0.0f, 0.0f)), 1.0f, 0.35f);
}

JointTurn joint_turn(const glm::dquat& turn, const glm::dvec3& along) {
    // q and -q are the same rotation: take the shorter way round.
    const glm::dquat q = turn.w < 0.0 ? -turn : turn;
    const glm::dvec3 sines(q.x, q.y, q.z);
    const double about = glm::dot(sines, glm::normalize(along));
    const double across = std::sqrt(std::max(0.0, glm::dot(sines, sines) - about * about));
    const double kept = std::sqrt(q.w * q.w + about * about);
    JointTurn measured;
    measured.swing = glm::degrees(2.0 * math::arctangent(across, kept));
    measured.twist = kept > 1e-12 * glm::length(q) ? glm::degrees(2.0 * math::arctangent(about, q.w)) : 0.0;
    measured.angle = glm::degrees(2.0 * math::arctangent(glm::length(sines), q.w));
    return measured;
}

}  // namespace tendril::app
