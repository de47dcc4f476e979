// Shared by tests of cloth that collides: whether anything pierces it.
#pragma once

#include <glm/geometric.hpp>

#include "jobs.hpp"
#include "rope_collision_support.hpp"

namespace tendril::test {

inline bool pierces(const glm::dvec3& p, const glm::dvec3& q, const glm::dvec3& a, const glm::dvec3& b,
                    const glm::dvec3& c) {
    const glm::dvec3 n = glm::cross(b - a, c - a);
    const double above = glm::dot(n, p - a), below = glm::dot(n, q - a);
    if (above * below >= 0.0) return false;
    const glm::dvec3 x = p + above / (above - below) * (q - p);
    return glm::dot(glm::cross(b - a, x - a), n) > 0.0 && glm::dot(glm::cross(c - b, x - b), n) > 0.0 &&
           glm::dot(glm::cross(a - c, x - c), n) > 0.0;
}

/// The number of segments of colliding bodies that pierce a triangle of a whole cloth, except for those
/// within two particles of it.
inline int pierced(const World& world) {
    const rope::State& state = world.state();
    const auto body_of = [&](std::size_t i) -> const rope::Body& {
        std::size_t b = 0;
        while (i >= state.bodies[b].first + state.bodies[b].count) ++b;
        return state.bodies[b];
    };
    int count = 0;
    for (const rope::Body& cloth : state.bodies) {
        if (cloth.kind != rope::Body::Kind::Cloth) continue;
        for (const rope::Link& link : state.links) {
            if (link.kind != rope::Link::Kind::Stretch) continue;
            const rope::Body& other = body_of(link.a);
            const glm::dvec3 p = state.position[link.a], q = state.position[link.b];
            for (std::size_t i = cloth.first; i + cloth.row + 1 < cloth.first + cloth.count; ++i) {
                const std::size_t column = (i - cloth.first) % cloth.row, row = (i - cloth.first) / cloth.row;
                if (column + 1 == cloth.row) continue;
                bool near = false;
                for (const std::size_t end : {link.a, link.b}) {
                    if (&other != &cloth) break;
                    const auto apart = [](std::size_t x, std::size_t y) { return x < y ? y - x : x - y; };
                    near |= apart((end - cloth.first) % cloth.row, column) <= 2 &&
                            apart((end - cloth.first) / cloth.row, row) <= 2;
                }
                if (near) continue;
                const glm::dvec3 a = state.position[i], b = state.position[i + 1],
                                 c = state.position[i + cloth.row], d = state.position[i + cloth.row + 1];
                count += pierces(p, q, a, b, c) + pierces(p, q, d, c, b);
            }
        }
    }
    return count;
}

}  // namespace tendril::test
