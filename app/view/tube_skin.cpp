#include "app/view/tube_skin.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "app/view/surface_support.hpp"

namespace tendril::app {

namespace {

/// The ball's normal at the point seen in line with the point that has `normal` on a concentric ball `part`
/// times as large. The mesh is smaller than the tube by its outline, which the shading must not show.
glm::vec3 within(glm::vec3 normal, glm::vec3 sight, float part) {
    const float towards = glm::dot(normal, sight);
    const glm::vec3 across = part * (normal - towards * sight);
    // Since sides are flat, corners slightly behind the outline count as on it.
    constexpr float behind = -0.3f;
    const float raised =
        std::sqrt(std::max(1.0f - glm::dot(across, across), 0.0f)) + 2.0f * std::min(towards - behind, 0.0f);
    return unit_or(across + raised * sight, normal);
}

}  // namespace

TubeSkin::TubeSkin(DrawList& list, const Camera& camera, int sides)
    : list_(list), edges_(list, camera), sides_(static_cast<std::uint32_t>(std::clamp(sides, 3, max_sides))) {
    for (std::uint32_t j = 0; j < sides_; ++j) {
        const float angle = glm::two_pi<float>() * static_cast<float>(j) / static_cast<float>(sides_);
        circle_[j] = {std::cos(angle), std::sin(angle)};
    }
}

void TubeSkin::cover(std::span<const Ring> rings) {
    constexpr float thin = 1.0f;
    bool joined = false;  // the previous band exists, with the corners at which this one begins
    std::uint32_t from = 0;
    for (std::size_t i = 0; i + 1 < rings.size(); ++i) {
        const Ring &a = rings[i], &b = rings[i + 1];
        const bool seen = (a.outside & b.outside) == 0 && !b.first;
        const bool is_thin = a.pixels < thin && b.pixels < thin;
        if (!seen || is_thin) {
            if (seen && a.lean == 0.0f && b.lean == 0.0f)
                edges_.thread(a.centre, b.centre, a.axis, b.axis, a.tube_radius,
                              0.5f * (a.colour + b.colour));
            joined = false;
            continue;
        }
        if (!joined) from = corners(a);
        const std::uint32_t to = corners(b);
        band(from, to, joined);
        from = to;
        joined = true;
    }
    edges_.join();
}

/// Appends a ring's corners and returns the index of the first one.
std::uint32_t TubeSkin::corners(const Ring& ring) {
    const std::uint32_t first = list_.mesh.next();
    const float up = std::sin(ring.lean), out = std::cos(ring.lean);
    const glm::vec3 sight = unit_or(edges_.to_eye(ring.centre), ring.u);
    const float pixels = std::max(ring.pixels, 2.0f * Edges::width);
    const float part = 1.0f - Edges::width / pixels;
    // The outline's mean position: most of it is within the tube, its paler part beyond.
    outwards_ = (1.0f - 0.3f * Edges::width / pixels) / part;
    for (std::uint32_t j = 0; j < sides_; ++j) {
        const glm::vec3 away = circle_[j].x * ring.u + circle_[j].y * ring.v;
        list_.mesh.vertices.push_back({.position = ring.centre + ring.radius * away,
                                       .normal = within(out * away + up * ring.axis, sight, part),
                                       .colour = ring.colour,
                                       .back = ring.colour});
    }
    return first;
}

/// The facing of the quadrilateral a b d c.
TubeSkin::Facing TubeSkin::facing(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) const {
    const glm::vec3 normal = glm::cross(at(d) - at(a), at(c) - at(b));
    const std::vector<Vertex>& vertices = list_.mesh.vertices;
    if (glm::dot(normal, vertices[a].normal + vertices[d].normal) < 0.0f) return Facing::Inside;
    return edges_.front(normal, at(a)) ? Facing::Front : Facing::Away;
}

/// Appends a triangle whose front is on the side of its normals. In a bend too sharp for the tube some
/// triangles are inside out, and a pixel of them may show between the others.
void TubeSkin::triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const std::vector<Vertex>& v = list_.mesh.vertices;
    const bool front = edges_.front(glm::cross(at(b) - at(a), at(c) - at(a)), at(a));
    const bool wanted = edges_.front(v[a].normal + v[b].normal + v[c].normal, at(a));
    list_.mesh.triangle(a, front == wanted ? b : c, front == wanted ? c : b);
}

void TubeSkin::band(std::uint32_t from, std::uint32_t to, bool joined) {
    PerSide here{};
    for (std::uint32_t j = 0; j < sides_; ++j) {
        const std::uint32_t k = after(j);
        here[j] = facing(from + j, from + k, to + j, to + k);
        if (here[j] == Facing::Away) continue;
        triangle(from + j, from + k, to + j);
        triangle(to + j, from + k, to + k);
    }
    for (std::uint32_t j = 0; j < sides_; ++j) {
        const std::uint32_t k = after(j);
        edge(here[j], here[k], from + k, to + k);
        if (joined) edge(here[j], last_[j], from + j, from + k);
    }
    last_ = here;
}

void TubeSkin::edge(Facing one, Facing other, std::uint32_t a, std::uint32_t b) {
    if (one == other || one == Facing::Inside || other == Facing::Inside) return;
    const Vertex &p = list_.mesh.vertices[a], &q = list_.mesh.vertices[b];
    const glm::vec3 sight = unit_or(edges_.to_eye(p.position), p.normal);
    edges_.outline(a, b, within(0.5f * (p.normal + q.normal), sight, outwards_),
                   0.5f * (p.colour + q.colour));
}

}  // namespace tendril::app
