// Chains in a plane: an option of every method.
//
// The plane goes through the root, with the normal given. The joints are projected onto it, and so is the
// target: Report::off_plane is its distance from the plane, and the residual is measured in the plane. Every
// joint stays in the plane to rounding: 1e-6 of the reach.
//
// Chains are solved as in space, but in the plane's own coordinates: all rotation is about the normal. The
// number of iterations and their cost are the same; coordinates and sides add about 70 ns per bone and solve.
//
// Sides. In a plane a chain has no swivel: it bends to the left or to the right of the line from root to tip,
// seen from the tip of the normal. For several bones, the side is the sign of the sum of the joints' offsets
// from the line, weighted by the adjacent lengths. A solve keeps the side: it first turns the whole chain
// towards the target, and mirrors it if it ends on the wrong side. So if the target passes close by the root,
// the chain swings around it. A straight chain bends to the side it was on. Within limits a chain is mirrored
// only if the mirrored pose is within them too; if it is not, State::side has the actual side.
//
// If the offsets cancel out, as in an S, rounding decides the side: the chain may be mirrored, that is, jump,
// while the target glides. Straight and folded chains do not take such shapes, except with CCD: a chain
// folded with its tip at its root is first placed on an arc.
#pragma once

#include <cstdint>
#include <span>

#include "tendril/fields.hpp"
#include "tendril/vec3.hpp"

namespace tendril::ik {

enum class Side : std::uint8_t {
    Free,  ///< keeps its side; a straight chain that never had one bends to the left
    Left,
    Right
};
/// "left"
const char* name(Side side) noexcept;

/// The direction from which a bone's angle is measured.
enum class AngleFrom : std::uint8_t {
    Bone,  ///< the bone before, 0 if straight; for the first bone the base direction
    Base   ///< base_direction()
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
/// The fault of an invalid limit, as a constant text; null if it is valid.
const char* fault(const AngleLimit& limit) noexcept;

/// The unit vector in a plane from which the first bone's angle is measured: the rest direction of that bone,
/// projected; if that is along the normal, a fixed other one. Neither vector may be zero.
glm::vec3 base_direction(glm::vec3 normal, glm::vec3 rest_direction) noexcept;

struct Plane {
    /// Longer than 1e-6, coordinates at most max_magnitude; need not be a unit vector.
    glm::vec3 normal{0.0f, 0.0f, 1.0f};
    /// The side to bend to. A pole off the line from root to target overrides it.
    Side bend = Side::Free;
    /// One per bone, or empty.
    std::span<const AngleLimit> limits{};
};

}  // namespace tendril::ik

template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::AngleLimit>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::Plane>() noexcept;
