// The ground under a character's feet, queried by vertical rays.
//
//     Expected<Ground> ground = Ground::stairs(0.15, 0.3);
//     if (!ground) return log(ground.message());  // "stairs: step_depth must be from 0.01 to 1e3 m, got 0"
//     if (const auto hit = ground->below(ankle)) foot_height = hit->height;
//
// A plain value. Y is up, metres. Copying a mesh copies its triangles: pass one that many characters share by
// reference.
//
// Cost of a ray: about 10 ns on flat ground, slopes and stairs, 30 on a terrain, 200 on a mesh of any size:
// its triangles are sorted into a grid with about as many squares as triangles. Building it is linear.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
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
    glm::dvec3 normal{0.0, 1.0, 0.0};  ///< unit length, never downwards
    bool operator==(const GroundHit&) const = default;
};

/// Heights at the corners of a grid of squares, bilinear between them. Outside the grid there is no ground.
struct HeightField {
    double x = 0.0, z = 0.0;        ///< the first corner
    double cell = 0.5;              ///< width of a square, 0.001 to 1e6 m
    std::size_t columns = 0;        ///< corners along X, at least 2
    std::vector<double> heights{};  ///< row by row, along Z; at least 2 rows
    bool operator==(const HeightField&) const = default;
};

class Ground {
  public:
    /// No ground: rays hit nothing. A moved-from Ground is the same.
    Ground() = default;
    Ground(const Ground&) = default;
    Ground(Ground&& other) noexcept : shape_(std::exchange(other.shape_, {})) {}
    Ground& operator=(Ground other) noexcept { return shape_.swap(other.shape_), *this; }
    ~Ground() = default;
    /// Level and unbounded.
    static Expected<Ground> flat(double height = 0.0);
    /// Rises along +Z from z = 0 on: max(0, z) * tan(angle). Radians, -1.5 to 1.5.
    static Expected<Ground> slope(double angle);
    /// Rise along +Z: step_height * floor(max(0, z) / step_depth). Metres: height from -100 to 100, depth
    /// from 0.01 to 1e3.
    static Expected<Ground> stairs(double step_height, double step_depth);
    /// Refuses fewer than 2 x 2 corners, more than 1e8, an incomplete row, and heights that are not finite or
    /// over 1e6 m.
    static Expected<Ground> terrain(HeightField field);
    /// Three indices into `vertices` for each triangle, with either winding. Refuses an empty list, more than
    /// 2e7 triangles, an index out of range, and coordinates that are not finite or over 1e6 m. Rays never
    /// hit triangles that are vertical or have no area.
    static Expected<Ground> mesh(std::span<const glm::dvec3> vertices,
                                 std::span<const std::uint32_t> triangles);

    GroundKind kind() const noexcept { return static_cast<GroundKind>(shape_.index()); }

    /// The first hit of a ray straight down. A mesh ignores what is above `from`. The other kinds have one
    /// height per position and return it even if `from` is below it.
    std::optional<GroundHit> below(const glm::dvec3& from) const noexcept;
    /// The highest ground at that position.
    std::optional<GroundHit> highest(double x, double z) const noexcept;

  private:
    struct Flat {
        double height;
    };
    struct Slope {
        double rise;  // per metre
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
        std::vector<std::uint32_t> sorted;  // indices into `triangles`
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
