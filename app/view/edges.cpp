#include "app/view/edges.hpp"

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "app/view/surface_support.hpp"

namespace tendril::app {

Stroke& Edges::add(glm::vec3 a, glm::vec3 b, glm::vec3 normal, glm::vec3 colour) {
    return list_.strokes.emplace_back(Stroke{.a = a,
                                             .b = b,
                                             .radius_a = width,
                                             .radius_b = width,
                                             .colour = glm::vec4(colour, 1.0f),
                                             .normal = normal,
                                             .unit = Unit::Pixels,
                                             .shade = Shade::Edge});
}

void Edges::outline(glm::vec3 a, glm::vec3 b, glm::vec3 normal, glm::vec3 colour) {
    add(a, b, unit_or(normal, to_eye(a)), colour);
}

void Edges::crease(glm::vec3 a, glm::vec3 b, glm::vec3 normal, glm::vec3 colour) {
    constexpr float pixels_nearer = 2.0f;
    const auto nearer = [&](glm::vec3 point) {
        const glm::vec3 way = to_eye(point);
        const float length = glm::length(way), step = pixels_nearer * camera_.metres_per_pixel(point);
        return length > step ? point + step / length * way : point;
    };
    outline(nearer(a), nearer(b), normal, colour);
}

void Edges::outline(std::uint32_t a, std::uint32_t b, glm::vec3 normal, glm::vec3 colour) {
    outline(list_.mesh.vertices[a].position, list_.mesh.vertices[b].position, normal, colour);
    joined_.push_back({a, b, list_.strokes.size() - 1});
}

void Edges::meet(std::uint32_t vertex, std::uint32_t other) {
    std::uint32_t& slot = slots_[vertex - first_];
    if (slot == 0) {
        const glm::vec3 at = list_.mesh.vertices[vertex].position;
        // Points behind the eye are invisible, so their cuts do not matter.
        joints_.push_back({.pixel = camera_.project(at).value_or(glm::vec2(0.0f))});
        slot = static_cast<std::uint32_t>(joints_.size());
    }
    Joint& joint = joints_[slot - 1];
    if (joint.count < 2) joint.others[joint.count] = other;
    ++joint.count;
}

float Edges::mitre_at(std::uint32_t vertex, std::uint32_t other) const {
    const Joint& here = joint(vertex);
    if (here.count != 2) return 0.0f;
    const std::uint32_t third = here.others[0] == other ? here.others[1] : here.others[0];
    const glm::vec2 to = joint(other).pixel - here.pixel, from = here.pixel - joint(third).pixel;
    const float lengths = glm::length(to) * glm::length(from);
    if (!(lengths > 1e-6f)) return 0.0f;
    // The tangent of half the angle between the two.
    const float cosine = glm::dot(from, to) / lengths, sine = (from.x * to.y - from.y * to.x) / lengths;
    return cosine > -0.6f ? -sine / (1.0f + cosine) : 0.0f;
}

void Edges::join() {
    slots_.assign(list_.mesh.next() - first_, 0);
    joints_.clear();
    for (const Joined& outline : joined_) {
        meet(outline.a, outline.b);
        meet(outline.b, outline.a);
    }
    for (const Joined& outline : joined_) {
        // Seen from b, left and right swap and so do forwards and backwards: the lean has the same sign.
        list_.strokes[outline.stroke].mitre = {mitre_at(outline.a, outline.b),
                                               mitre_at(outline.b, outline.a)};
    }
    joined_.clear();
}

/// The mitre of a line of that direction for a cut perpendicular to `tangent` on the screen.
float Edges::mitre(glm::vec3 point, glm::vec3 tangent, glm::vec3 direction) const {
    constexpr float most = 2.0f;
    const float pixel = camera_.metres_per_pixel(point);
    const auto at = camera_.project(point), on = camera_.project(point + pixel * direction),
               turned = camera_.project(point + pixel * tangent);
    if (!at || !on || !turned) return 0.0f;
    const glm::vec2 line = *on - *at, curve = *turned - *at;
    const float along = glm::dot(line, curve);
    // Pixels count downwards, which swaps left and right.
    const float lean = (line.x * curve.y - line.y * curve.x) / along;
    return along > 0.0f && std::abs(lean) < most ? lean : 0.0f;
}

void Edges::thread(glm::vec3 a, glm::vec3 b, glm::vec3 tangent_a, glm::vec3 tangent_b, float radius,
                   glm::vec3 colour) {
    const glm::vec3 along = unit_or(b - a, glm::vec3(0.0f)), way = to_eye(0.5f * (a + b));
    const glm::vec3 across = unit_or(way - glm::dot(way, along) * along, glm::vec3(0.0f));
    // The mean of the normals across a round rod. Lighting is linear in it as in a normal.
    Stroke& stroke = add(a, b, 0.25f * glm::pi<float>() * across, colour);
    stroke.radius_a = stroke.radius_b = radius;
    stroke.unit = Unit::Metres;
    stroke.mitre = {mitre(a, tangent_a, along), mitre(b, tangent_b, along)};
}

}  // namespace tendril::app
