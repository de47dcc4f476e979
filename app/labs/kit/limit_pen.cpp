#include "app/labs/kit/limit_pen.hpp"

#include <glm/geometric.hpp>

namespace tendril::app {
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

}  // namespace tendril::app
