// What a character's feet stand on, asked by rays straight down.
//
//     Expected<Ground> ground = Ground::stairs(0.15, 0.3);
//     if (!ground) return log(ground.message());  // "stairs: step_depth must be from 0.01 to 1e3 m, got 0"
//     if (const auto hit = ground->below(ankle)) foot_height = hit->height;
//
// A plain value: copy it, keep it. Y is up, metres. Copying a mesh copies its triangles, so one that many
// characters walk on is made once and passed by reference.
//
// Cost of a ray: some 10 ns on flat ground, slopes and stairs, 30 on a terrain, 200 on a mesh of any size:
// its triangles are sorted into a grid of as many squares as there are triangles, about. Making it is linear.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "tendril/result.hpp"
#include "tendril/vec3.hpp"

namespace tendril::humanoid {

enum class GroundKind : std::uint8_t { None, Flat, Slope, Stairs, Terrain, Mesh };
/// "none", "flat", "slope", "stairs", "terrain", "mesh"
const char* name(GroundKind kind) noexcept;

struct GroundHit {
    double height = 0.0;               ///< metres
    glm::dvec3 normal{0.0, 1.0, 0.0};  ///< of length 1, never downwards
    bool operator==(const GroundHit&) const = default;
};

/// Heights at the corners of a grid of squares, bilinear between them. There is nothing beside the grid.
struct HeightField {
    double x = 0.0, z = 0.0;        ///< of the first corner
    double cell = 0.5;              ///< width of a square, 0.001 to 1e6 m
    std::size_t columns = 0;        ///< corners along X, at least 2
    std::vector<double> heights{};  ///< row by row, along Z; at least 2 rows
    bool operator==(const HeightField&) const = default;
};

class Ground {
  public:
    /// None: no ray hits anything.
    Ground() = default;
    /// Level, everywhere.
    static Expected<Ground> flat(double height = 0.0);
    /// Rises along +Z from z = 0 on: max(0, z) * tan(angle). Radians, -1.5 to 1.5.
    static Expected<Ground> slope(double angle);
    /// Rise along +Z: step_height * floor(max(0, z) / step_depth). Metres: height from -100 to 100, depth
    /// from 0.01 to 1e3.
    static Expected<Ground> stairs(double step_height, double step_depth);
    /// Refuses fewer than 2 x 2 corners, more than 1e8, a list that is no whole number of rows, and heights
    /// that are not finite or over 1e6 m.
    static Expected<Ground> terrain(HeightField field);
    /// Triangles as three places in `vertices` each, seen from above whichever way they wind. Refuses none,
    /// more than 2e7, a place that is not there and coordinates that are not finite or over 1e6 m. Triangles
    /// that stand upright or have no area are never hit.
    static Expected<Ground> mesh(std::span<const glm::dvec3> vertices,
                                 std::span<const std::uint32_t> triangles);

    GroundKind kind() const noexcept { return static_cast<GroundKind>(shape_.index()); }

    /// What a ray from there straight down meets first. Of a mesh, what is above `from` does not count; the
    /// others have one height at each place, and answer with that even where `from` is below it.
    std::optional<GroundHit> below(const glm::dvec3& from) const noexcept;
    /// The highest of all that is above or below that place.
    std::optional<GroundHit> highest(double x, double z) const noexcept;

  private:
    struct Flat {
        double height;
    };
    struct Slope {
        double rise;  // of a metre
        GroundHit on(double z) const noexcept;
    };
    struct Stairs {
        double height, depth;
    };
    struct Terrain {
        HeightField field;
        std::size_t rows;
        std::optional<GroundHit> at(double x, double z) const noexcept;
    };
    struct Triangle {
        glm::dvec3 a, b, c;
    };
    struct Mesh {
        std::vector<Triangle> triangles;
        double x, z, cell;  // the grid's first corner, and the width of a square
        std::size_t columns, rows;
        std::vector<std::uint32_t> first;   // where a square's triangles begin in `sorted`
        std::vector<std::uint32_t> sorted;  // places in `triangles`
        std::optional<GroundHit> below(const glm::dvec3& from) const noexcept;
        void sort();
        std::size_t square(double at, double origin, std::size_t count) const noexcept;
        template <class Visit>
        void for_squares(const Triangle& triangle, Visit visit) const;
    };
    using Shape = std::variant<std::monostate, Flat, Slope, Stairs, Terrain, Mesh>;
    explicit Ground(Shape shape) : shape_(std::move(shape)) {}

    Shape shape_;
};

}  // namespace tendril::humanoid
