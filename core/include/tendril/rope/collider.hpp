// Colliders: solid shapes that ropes, cloth and hair cannot enter.
#pragma once

#include <optional>
#include <variant>

#include "tendril/fields.hpp"
#include "tendril/quat.hpp"
#include "tendril/result.hpp"
#include "tendril/rope/handle.hpp"
#include "tendril/vec3.hpp"

namespace tendril::rope {

struct Sphere {
    glm::vec3 centre{0.0f};
    float radius = 0.5f;  ///< metres, 0 or more
    bool operator==(const Sphere&) const = default;
};
/// All points within `radius` of the segment from a to b.
struct Capsule {
    glm::vec3 a{0.0f}, b{0.0f, 1.0f, 0.0f};
    float radius = 0.25f;
    bool operator==(const Capsule&) const = default;
};
/// The half space behind a plane.
struct Plane {
    glm::vec3 point{0.0f};
    glm::vec3 normal{0.0f, 1.0f, 0.0f};  ///< any length but 0
    bool operator==(const Plane&) const = default;
};
struct Box {
    glm::vec3 centre{0.0f};
    glm::vec3 half_extents{0.5f};  ///< metres, each 0 or more
    glm::quat rotation{1.0f, 0.0f, 0.0f, 0.0f};
    bool operator==(const Box&) const = default;
};
using Shape = std::variant<Sphere, Capsule, Plane, Box>;
/// The names of a shape's kinds, in order.
inline constexpr const char* shape_kinds[] = {"sphere", "capsule", "plane", "box"};

/// Signed distance from a point to a surface, with the normal there.
struct SurfaceDistance {
    double distance = 0.0;             ///< metres, below zero inside
    glm::dvec3 normal{0.0, 1.0, 0.0};  ///< unit, outward; arbitrary but fixed at a centre or on an axis
};
/// Never NaN, for any point and any shape that check() accepts.
SurfaceDistance surface_distance(const Shape& shape, const glm::dvec3& point) noexcept;

/// The reference point of a shape: the centre of a sphere or box, the middle of a capsule, a plane's point.
glm::vec3 centre(const Shape& shape) noexcept;
/// The same shape with its reference point at `centre`.
Shape moved(const Shape& shape, const glm::vec3& centre) noexcept;
inline const char* kind(const Shape& shape) noexcept {
    return shape_kinds[shape.index()];
}
/// Half of the smallest extent, metres: the radius of a sphere or capsule, a box's smallest half extent; 1
/// for a plane, which has none.
float size(const Shape& shape) noexcept;

/// Refuses a number that is not finite or over max_magnitude, a negative size, and a normal or rotation of
/// length 0. The message names `operation`, the member and its value.
Result check(const char* operation, const Shape& shape) noexcept;

/// A collider's steady motion. It carries bodies along by friction and pushes those in its way.
struct Drive {
    glm::vec3 velocity{0.0f};          ///< m/s
    glm::vec3 axis{0.0f, 1.0f, 0.0f};  ///< through the centre, any length; (0, 0, 0): upright
    float spin = 0.0f;                 ///< rad/s about the axis
    bool any() const noexcept { return velocity != glm::vec3(0.0f) || spin != 0.0f; }
    bool operator==(const Drive&) const = default;
};
inline constexpr float max_drive = 1e4f, max_spin = 1e3f;  ///< m/s along each axis, rad/s

struct Collider {
    ColliderId id;
    Shape shape;           ///< current
    glm::dvec3 goal{0.0};  ///< destination of the centre
    double seconds = 0.0;  ///< simulated time until it arrives; 0: within the next substep
    /// For a capsule that turns as it moves: half the vector from `a` to `b` at its goal.
    std::optional<glm::dvec3> half_goal{};
    Drive drive{};
    bool operator==(const Collider&) const = default;
};

}  // namespace tendril::rope

template <>
std::span<const tendril::Field> tendril::fields<tendril::rope::Sphere>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::rope::Capsule>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::rope::Plane>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::rope::Box>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::rope::Drive>() noexcept;
/// All fields but `id`; `shape` is its kind and that kind's fields.
template <>
std::span<const tendril::Field> tendril::fields<tendril::rope::Collider>() noexcept;
