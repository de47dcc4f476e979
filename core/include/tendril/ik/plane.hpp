// Chains in a plane: an option of every method.
//
// The plane goes through the root, with the normal given. The joints are projected onto it, and so is the
// target: Report::off_plane is how far off it was, and the residual is measured in the plane. Every joint
// stays in the plane to rounding: 1e-6 of the reach.
//
// A solve is the one for solid chains, in the plane's own coordinates: all rotation is about the normal.
// So it takes as many iterations, and an iteration costs the same; coordinates and sides cost about
// 70 ns per bone and solve besides.
//
// Sides. In a plane a chain has no swivel: it bends to the left or to the right of the line from root to tip,
// seen from the tip of the normal. A chain of several bones is on the side on which the sum of its joints'
// offsets from the line is, each weighted by the adjacent lengths. A solve keeps the side: it first turns the
// whole chain towards the target, and mirrors it if it ends on the wrong side. So if the target passes close
// by the root, the chain swings around it. A straight chain bends to the side. Within limits a chain is
// mirrored only if the mirrored pose is within them too; if it is not, State::side says where it went.
//
// Of a shape whose offsets cancel out, such as an S, rounding decides the side: while the target glides it
// may be mirrored, that is, jump. From straight and folded chains no such shapes come about, except by CCD: a
// chain that is folded up, its tip at its root, is first placed on an arc.
#pragma once

#include <cstdint>
#include <span>

#include "tendril/fields.hpp"
#include "tendril/vec3.hpp"

namespace tendril::ik {

enum class Side : std::uint8_t {
    Free,  ///< as it is; a straight chain that never had a side bends to the left
    Left,
    Right
};
/// "left"
const char* name(Side side) noexcept;

/// What the angle of a bone is measured from.
enum class AngleFrom : std::uint8_t {
    Bone,  ///< from the bone before, 0 if straight; that of the first bone from the base direction
    Base   ///< from base_direction()
};
/// "base"
const char* name(AngleFrom from) noexcept;

/// The range of a bone's angle: radians, positive to the left. -pi <= min <= max <= pi; a full turn is no
/// limit.
struct AngleLimit {
    float min = -3.14159265f, max = 3.14159265f;
    AngleFrom from = AngleFrom::Bone;
    bool operator==(const AngleLimit&) const = default;
};
/// What is wrong with it, as a constant text. Null if it is valid.
const char* fault(const AngleLimit& limit) noexcept;

/// The unit vector in a plane from which the first bone's angle is measured: the rest direction of that bone,
/// projected; if that is along the normal, another one, always the same. Neither vector may be zero.
glm::vec3 base_direction(glm::vec3 normal, glm::vec3 rest_direction) noexcept;

struct Plane {
    /// Longer than 1e-6, coordinates at most max_magnitude; need not be a unit vector.
    glm::vec3 normal{0.0f, 0.0f, 1.0f};
    /// The side to be on. A pole that is off the line from root to target chooses it instead.
    Side bend = Side::Free;
    /// One per bone, or empty.
    std::span<const AngleLimit> limits{};
};

}  // namespace tendril::ik

template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::AngleLimit>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::Plane>() noexcept;
