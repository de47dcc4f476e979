// Ties hold two particles of a rope world, of any bodies, together or at a distance: the hangers of a bridge,
// a rope sewn to a cloth, a net.
#pragma once

#include <cstdint>

#include "tendril/fields.hpp"
#include "tendril/rope/handle.hpp"

namespace tendril::rope {

/// Length and strength of a tie.
struct TieShape {
    float length = 0.0f;    ///< metres; 0: the particles coincide
    float strength = 0.0f;  ///< newtons; a tie that pulls harder tears. 0: never
};

/// Keeps two particles at a distance, as a rod without mass: it pulls and pushes. Bodies joined by ties are
/// solved together, as one system (see Settings). Two pinned particles are not moved.
struct Tie {
    TieId id;
    std::uint32_t a = 0, b = 0;  ///< particles
    float length = 0.0f;         ///< metres; 0: the particles coincide
    float strength = 0.0f;       ///< newtons at which it tears; 0: never
    /// The distance currently enforced, metres. A tie made between particles too far apart, or too close,
    /// draws them to its length at tie_speed.
    float now = 0.0f;
    /// Newtons, from the last solve; negative in compression, never if length is 0. Until `now` is `length`
    /// it is not a load, but the force that moves the ends at tie_speed.
    float tension = 0.0f;
    bool operator==(const Tie&) const = default;
};

inline constexpr float tie_speed = 2.0f;  ///< m/s

}  // namespace tendril::rope

template <>
std::span<const tendril::Field> tendril::fields<tendril::rope::TieShape>() noexcept;
/// All fields but `id`.
template <>
std::span<const tendril::Field> tendril::fields<tendril::rope::Tie>() noexcept;
