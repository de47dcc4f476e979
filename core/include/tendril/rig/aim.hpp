// Turns a transform so that one of its axes points at a target, then rolls it about that axis so that a
// second axis points at a second target as closely as the first allows.
//
//     rig::AimOptions look;
//     look.primary = {.axis = {0, 0, 1}, .target = ball};
//     look.secondary = {.axis = {0, 1, 0}, .target = {0, 1, 0}, .kind = rig::AimTarget::Direction};
//     const rig::AimResult aimed = rig::aim(tree.get(head, rig::Space::Global), look, seconds);
//     if (aimed.primary != rig::AimWarning::None) warn(rig::name(aimed.primary));
//
// The primary part turns by the shortest arc. The secondary part only rolls: its axis and its target are
// projected onto the plane perpendicular to the turned primary axis. A part of weight t < 1 first blends its
// axis towards its target along the chord, and turns to the blended direction; t is the part's weight times
// the overall weight. If axis and target are opposite, the primary part turns about some perpendicular axis,
// always the same for the same input; the secondary rolls half a turn.
//
// A part whose direction is undefined is skipped with a warning; the other part still applies. At weight 1
// aiming is idempotent. Only the rotation changes; scales do not matter, not even negative ones. O(1), about
// 300 ns.
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "tendril/fields.hpp"
#include "tendril/result.hpp"
#include "tendril/rig/transform.hpp"

namespace tendril::rig {

enum class AimTarget : std::uint8_t {
    Location,  ///< a point in global space, seen from the transform
    Direction  ///< in global space, of any length but 0
};

struct AimPart {
    glm::dvec3 axis{1.0, 0.0, 0.0};  ///< in the transform's own space, of any length but 0
    glm::dvec3 target{0.0, 0.0, 0.0};
    AimTarget kind = AimTarget::Location;
    double weight = 1.0;  ///< 0 to 1, clamped; 0: the part is skipped without a warning
};

struct AimOptions {
    AimPart primary{};
    AimPart secondary{.axis = {0.0, 1.0, 0.0}, .weight = 0.0};
    double weight = 1.0;  ///< for both parts; 0: returns the input transform, bit for bit
    /// Maximum turn in radians per second; 0: no turn. (In a rig's Aim unit, where it is in degrees, 0 means
    /// no limit.)
    double max_speed = std::numeric_limits<double>::infinity();
};

/// Why a part was skipped.
enum class AimWarning : std::uint8_t {
    None,
    ZeroAxis,      ///< shorter than 1e-9
    TargetAtItem,  ///< a location nearer than 1e-9 m, or a direction shorter than that
    TargetOnAxis,  ///< secondary only: its target is on the primary axis, within 1e-6 radians
    AxesParallel   ///< secondary only: its axis is parallel to the primary one, within 1e-6 radians
};
/// Text for users: "the second target is on the primary axis"; empty for None.
const char* name(AimWarning warning) noexcept;

struct AimResult {
    Transform transform{};
    AimWarning primary = AimWarning::None, secondary = AimWarning::None;
};

/// Checks options from untrusted input. Refuses numbers that are not finite or over max_magnitude, zero axes,
/// weights outside 0 to 1, and a negative max_speed. aim() itself checks nothing.
Result check(const AimOptions& options, const char* operation = "aim") noexcept;

/// `item` is a global transform. `dt` in seconds matters only with max_speed: if it is not over 0, no time
/// passes, and a limited rotation does not turn.
AimResult aim(const Transform& item, const AimOptions& options, double dt = 0.0) noexcept;

}  // namespace tendril::rig

template <>
std::span<const tendril::Field> tendril::fields<tendril::rig::AimPart>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::rig::AimOptions>() noexcept;
