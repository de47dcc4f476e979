#include "app/view/globe.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <vector>

#include "app/view/edges.hpp"
#include "app/view/surface_support.hpp"

namespace tendril::app {
namespace {

constexpr std::uint32_t rows = 38, columns = 64;  ///< rows and columns of points, without the two poles

using Triangle = std::array<std::uint32_t, 3>;

glm::vec3 on_ball(std::uint32_t row, std::uint32_t column) {
    const float down = glm::pi<float>() * static_cast<float>(row + 1) / static_cast<float>(rows + 1);
    const float round = glm::two_pi<float>() * static_cast<float>(column) / static_cast<float>(columns);
    return {std::sin(down) * std::cos(round), std::cos(down), std::sin(down) * std::sin(round)};
}

std::uint32_t at(std::uint32_t row, std::uint32_t column) {
    return row * columns + column % columns;
}

/// Counter-clockwise from outside.
const std::vector<Triangle>& triangles() {
    static const std::vector<Triangle> list = [] {
        constexpr std::uint32_t top = rows * columns, bottom = top + 1;
        std::vector<Triangle> made;
        for (std::uint32_t c = 0; c < columns; ++c) {
            made.push_back({top, at(0, c + 1), at(0, c)});
            for (std::uint32_t r = 0; r + 1 < rows; ++r) {
                made.push_back({at(r, c), at(r, c + 1), at(r + 1, c)});
                made.push_back({at(r, c + 1), at(r + 1, c + 1), at(r + 1, c)});
            }
            made.push_back({bottom, at(rows - 1, c), at(rows - 1, c + 1)});
        }
        return made;
    }();
    return list;
}

/// Each edge with the two triangles that share it: (a, b, one, other).
const std::vector<std::array<std::uint32_t, 4>>& edges_of_triangles() {
    static const std::vector<std::array<std::uint32_t, 4>> list = [] {
        std::vector<std::array<std::uint32_t, 3>> sides;  // low vertex, high vertex, triangle
        for (std::uint32_t t = 0; t < triangles().size(); ++t)
            for (std::size_t i = 0; i < 3; ++i) {
                const std::uint32_t a = triangles()[t][i], b = triangles()[t][(i + 1) % 3];
                sides.push_back({std::min(a, b), std::max(a, b), t});
            }
        std::sort(sides.begin(), sides.end());
        std::vector<std::array<std::uint32_t, 4>> made;
        for (std::size_t i = 0; i + 1 < sides.size(); i += 2)
            made.push_back({sides[i][0], sides[i][1], sides[i][2], sides[i + 1][2]});
        return made;
    }();
    return list;
}

}  // namespace

void globe(DrawList& list, const Camera& camera, const std::function<glm::vec3(glm::vec3)>& surface,
           glm::vec3 colour) {
    std::vector<glm::vec3> points;
    points.reserve(rows * columns + 2);
    for (std::uint32_t r = 0; r < rows; ++r)
        for (std::uint32_t c = 0; c < columns; ++c) points.push_back(surface(on_ball(r, c)));
    points.push_back(surface({0.0f, 1.0f, 0.0f}));
    points.push_back(surface({0.0f, -1.0f, 0.0f}));
    if (!std::all_of(points.begin(), points.end(), can_be_built)) return;

    std::vector<glm::vec3> normals(points.size(), glm::vec3(0.0f));
    for (const auto& [a, b, c] : triangles()) {
        const glm::vec3 area = glm::cross(points[b] - points[a], points[c] - points[a]);
        normals[a] += area, normals[b] += area, normals[c] += area;
    }
    Edges edges(list, camera);
    const std::uint32_t first = list.mesh.next();
    for (std::size_t i = 0; i < points.size(); ++i) {
        const glm::vec3 normal = unit_or(normals[i], {0.0f, 1.0f, 0.0f});
        // The outline adds half a pixel all around.
        points[i] -= edges.metres(points[i]) * normal;
        list.mesh.vertices.push_back({points[i], normal, colour, colour});
    }
    std::vector<bool> front;
    front.reserve(triangles().size());
    for (const auto& [a, b, c] : triangles()) {
        front.push_back(edges.front(glm::cross(points[b] - points[a], points[c] - points[a]), points[a]));
        if (front.back()) list.mesh.triangle(first + a, first + b, first + c);
    }
    for (const auto& [a, b, one, other] : edges_of_triangles()) {
        if (front[one] == front[other]) continue;
        const glm::vec3 normal = list.mesh.vertices[first + a].normal + list.mesh.vertices[first + b].normal;
        const glm::vec3 sight = unit_or(edges.to_eye(points[a]), normal);
        edges.outline(first + a, first + b, normal - glm::dot(normal, sight) * sight, colour);
    }
    edges.join();
}

}  // namespace tendril::app
