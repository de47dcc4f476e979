// Shared by tests of bodies that collide: crossed ropes, knots, and whether they still hold.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "rope_support.hpp"

namespace tendril::test {

inline void collide(World& world, const char* a, const char* b) {
    allow(world.set_collides(world.id(a), world.id(b), true));
}

inline std::vector<glm::dvec3> points_of(const World& world, const char* body) {
    const rope::Body& it = *world.find(body);
    const auto first = world.state().position.begin() + static_cast<std::ptrdiff_t>(it.first);
    return {first, first + static_cast<std::ptrdiff_t>(it.count)};
}

/// The smallest distance between two segments, sampled exactly enough by nearest points.
inline double segment_distance(const glm::dvec3& a0, const glm::dvec3& a1, const glm::dvec3& b0,
                               const glm::dvec3& b1) {
    const auto to_line = [](const glm::dvec3& p, const glm::dvec3& q0, const glm::dvec3& q1) {
        const glm::dvec3 along = q1 - q0;
        const double t = std::clamp(glm::dot(p - q0, along) / glm::dot(along, along), 0.0, 1.0);
        return glm::length(q0 + t * along - p);
    };
    double best =
        std::min({to_line(a0, b0, b1), to_line(a1, b0, b1), to_line(b0, a0, a1), to_line(b1, a0, a1)});
    const glm::dvec3 u = a1 - a0, v = b1 - b0, n = glm::cross(u, v);
    const double square = glm::dot(n, n);
    if (square <= 0.0) return best;
    const glm::dvec3 r = b0 - a0;
    const double s = glm::dot(glm::cross(r, v), n) / square, t = glm::dot(glm::cross(r, u), n) / square;
    if (s >= 0.0 && s <= 1.0 && t >= 0.0 && t <= 1.0)
        best = std::min(best, std::abs(glm::dot(r, n)) / std::sqrt(square));
    return best;
}

/// The smallest distance between the centre lines of two ropes.
inline double distance_between(const World& world, const char* a, const char* b) {
    const std::vector<glm::dvec3> p = points_of(world, a), q = points_of(world, b);
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i + 1 < p.size(); ++i)
        for (std::size_t j = 0; j + 1 < q.size(); ++j)
            best = std::min(best, segment_distance(p[i], p[i + 1], q[j], q[j + 1]));
    return best;
}

/// The Gauss linking integral of two polygons over 4 pi. For closed ones it is an integer, how often they are
/// linked, and changes by one if segments pass through each other. For open ones it also jumps by one, and
/// otherwise changes continuously. Exact for each pair of segments (A. Banchoff, 1976; formula by K. Klenin,
/// J. Langowski, 2000).
inline double gauss_integral(const std::vector<glm::dvec3>& p, const std::vector<glm::dvec3>& q) {
    double sum = 0.0;
    for (std::size_t i = 0; i + 1 < p.size(); ++i)
        for (std::size_t j = 0; j + 1 < q.size(); ++j) {
            const glm::dvec3 r13 = q[j] - p[i], r14 = q[j + 1] - p[i], r24 = q[j + 1] - p[i + 1],
                             r23 = q[j] - p[i + 1];
            std::array<glm::dvec3, 4> n{glm::cross(r13, r14), glm::cross(r14, r24), glm::cross(r24, r23),
                                        glm::cross(r23, r13)};
            bool flat = false;
            for (glm::dvec3& each : n) {
                const double size = glm::length(each);
                flat |= !(size > 1e-300);
                each /= size;
            }
            if (flat) continue;
            double area = 0.0;
            for (std::size_t k = 0; k < 4; ++k)
                area += std::asin(std::clamp(glm::dot(n[k], n[(k + 1) % 4]), -1.0, 1.0));
            const double side = glm::dot(glm::cross(q[j + 1] - q[j], p[i + 1] - p[i]), r13);
            sum += side > 0.0 ? area : -area;
        }
    return sum / (4.0 * pi);
}

/// The knot determinant of a polygon that is closed in front of all of it, as seen along a general direction:
/// 1 if unknotted, 3 for a trefoil, 5 for a figure eight (Fox's colourings). Segments that pass through each
/// other change it.
inline int knot_determinant(std::vector<glm::dvec3> p) {
    const glm::dvec3 towards = glm::normalize(glm::dvec3(0.117, 0.293, 0.871));
    const glm::dvec3 right = glm::normalize(glm::cross(towards, glm::dvec3(0.31, 0.95, 0.02)));
    const glm::dvec3 up = glm::cross(towards, right);
    for (glm::dvec3& each : p) each = {glm::dot(each, right), glm::dot(each, up), glm::dot(each, towards)};
    const double front = 1e3;
    glm::dvec3 last = p.back(), first = p.front();
    last.z = first.z = front;
    p.push_back(last), p.push_back(first);
    const std::size_t count = p.size();
    const auto end_of = [&](std::size_t i) { return p[(i + 1) % count]; };
    struct Crossing {
        double over, under;  // positions along the polygon
    };
    std::vector<Crossing> crossings;
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t j = i + 2; j < count; ++j) {
            if (i == 0 && j + 1 == count) continue;
            const glm::dvec3 u = end_of(i) - p[i], v = end_of(j) - p[j], r = p[j] - p[i];
            const double area = u.x * v.y - u.y * v.x;
            if (area == 0.0) continue;
            const double s = (r.x * v.y - r.y * v.x) / area, t = (r.x * u.y - r.y * u.x) / area;
            if (s < 0.0 || s >= 1.0 || t < 0.0 || t >= 1.0) continue;
            const double a = static_cast<double>(i) + s, b = static_cast<double>(j) + t;
            const bool i_over = p[i].z + s * u.z > p[j].z + t * v.z;
            crossings.push_back(i_over ? Crossing{a, b} : Crossing{b, a});
        }
    std::sort(crossings.begin(), crossings.end(),
              [](const Crossing& a, const Crossing& b) { return a.under < b.under; });
    const std::size_t n = crossings.size();
    if (n < 3) return 1;
    const auto arc_at = [&](double where) {  // arc k ends at crossing k
        const auto next = std::upper_bound(crossings.begin(), crossings.end(), where,
                                           [](double w, const Crossing& c) { return w < c.under; });
        return static_cast<std::size_t>(next - crossings.begin()) % n;
    };
    std::vector<std::vector<double>> m(n, std::vector<double>(n, 0.0));
    for (std::size_t k = 0; k < n; ++k) {
        m[k][arc_at(crossings[k].over)] += 2.0;
        m[k][k] -= 1.0;
        m[k][(k + 1) % n] -= 1.0;
    }
    double determinant = 1.0;
    for (std::size_t c = 0; c + 1 < n; ++c) {
        std::size_t pivot = c;
        for (std::size_t k = c; k + 1 < n; ++k)
            if (std::abs(m[k][c]) > std::abs(m[pivot][c])) pivot = k;
        std::swap(m[c], m[pivot]);
        determinant *= m[c][c];
        if (determinant == 0.0) return 0;
        for (std::size_t k = c + 1; k + 1 < n; ++k) {
            const double factor = m[k][c] / m[c][c];
            for (std::size_t l = c; l + 1 < n; ++l) m[k][l] -= factor * m[c][l];
        }
    }
    return static_cast<int>(std::lround(std::abs(determinant)));
}

}  // namespace tendril::test
