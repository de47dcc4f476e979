// Turns a transform so that one of its axes points at a target, then rolls it about that axis so that a
// second axis points at a second target as nearly as the first allows.
//
//     rig::AimOptions look;
//     look.primary = {.axis = {0, 0, 1}, .target = ball};
//     look.secondary = {.axis = {0, 1, 0}, .target = {0, 1, 0}, .kind = rig::AimTarget::Direction};
//     const rig::AimResult aimed = rig::aim(tree.get(head, rig::Space::Global), look, seconds);
//     if (aimed.primary != rig::AimWarning::None) warn(rig::name(aimed.primary));
//
// The primary part turns by the shortest arc. The secondary part only rolls: both its axis and its target are
// projected on the plane at right angles to the primary axis, as that points by then. A part of weight t < 1
// first blends its axis towards its target, along the chord, and turns to that; t is the part's weight times
// the whole's. Where axis and target are opposite, the primary part turns about some axis at right angles,
// always the same for the same input, the secondary by half a turn about the primary axis.
//
// A part that has nothing to go by is skipped with a warning; the other one still takes place. At weight 1
// aiming twice changes nothing. Only the rotation changes; scales, negative ones too, do not matter. O(1),
// some 300 ns.
#pragma once

#include <cstdint>
#include <limits>

#include "tendril/result.hpp"
#include "tendril/rig/transform.hpp"

namespace tendril::rig {

enum class AimTarget : std::uint8_t {
    Location,  ///< a point in global space; the way there from the transform is what counts
    Direction  ///< in global space, of any length but 0
};

struct AimPart {
    glm::dvec3 axis{1.0, 0.0, 0.0};  ///< in the transform's own space, of any length but 0
    glm::dvec3 target{0.0, 0.0, 0.0};
    AimTarget kind = AimTarget::Location;
    double weight = 1.0;  ///< 0 to 1, what is outside is clamped; 0: the part is left out, without a warning
};

struct AimOptions {
    AimPart primary{};
    AimPart secondary{.axis = {0.0, 1.0, 0.0}, .weight = 0.0};
    double weight = 1.0;  ///< of both; 0: the transform comes back to the bit
    /// Radians a second that the rotation changes by at most; 0: it does not turn. (Of a rig's unit, where it
    /// is in degrees, 0 means no limit.)
    double max_speed = std::numeric_limits<double>::infinity();
};

/// Why a part was skipped.
enum class AimWarning : std::uint8_t {
    None,
    ZeroAxis,      ///< shorter than 1e-9
    TargetAtItem,  ///< a location nearer than 1e-9 m, a direction shorter than that
    TargetOnAxis,  ///< secondary only: its target is on the primary axis, to 1e-6 radians
    AxesParallel   ///< secondary only: its axis is the primary one or its opposite, to 1e-6 radians
};
/// A sentence for people: "the second target is on the primary axis"; empty of None.
const char* name(AimWarning warning) noexcept;

struct AimResult {
    Transform transform{};
    AimWarning primary = AimWarning::None, secondary = AimWarning::None;
};

/// Fine where all numbers are finite and in range, axes are not zero, weights 0 to 1 and max_speed is at
/// least 0: for what comes in from outside. aim() itself takes what it is given.
Result check(const AimOptions& options, std::string_view operation = "aim") noexcept;

/// `item` is a global transform. `dt` in seconds is for max_speed: 0, less or NaN means that no time passes,
/// and where the speed is limited nothing turns.
AimResult aim(const Transform& item, const AimOptions& options, double dt = 0.0) noexcept;

}  // namespace tendril::rig
