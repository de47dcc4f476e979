// Fixed sessions over the library, and the hashes they must give with every compiler and optimisation.
#pragma once

#include <cstdint>

namespace tendril::test {

/// The expected session_hash(). If it changes, saved scenes and recordings play differently.
inline constexpr std::uint64_t golden_session_hash = 0xf7b7c11b0c7f4723u;

/// Runs 20 000 pseudo-random edits and pulls and hashes the bits of every position after each (64-bit
/// FNV-1a). All numbers are integers scaled to exact floats, so that only the library can differ.
std::uint64_t session_hash();

/// The expected solve_hash().
inline constexpr std::uint64_t golden_solve_hash = 0x3f3a3d35f788b568u;

/// Runs 4 000 solves by all methods, with and without pole, limits and the other options, and hashes the bits
/// of every joint and report.
std::uint64_t solve_hash();

/// The expected curve_hash().
inline constexpr std::uint64_t golden_curve_hash = 0x091f8043d68a5fe2u;

/// Places 400 chains along moving curves of both kinds, fitted or not, rolled and half blended, and hashes
/// the bits of every joint and rotation.
std::uint64_t curve_hash();

/// The expected linkage_hash().
inline constexpr std::uint64_t golden_linkage_hash = 0x9f277fbe0ecdff6cu;

/// Drives and drags six linkages 60 times each, and hashes the bits of every joint and point.
std::uint64_t linkage_hash();

/// The expected rope_hash().
inline constexpr std::uint64_t golden_rope_hash = 0xb78bf6bfb9bd31ffu;

/// Runs 60 worlds of ropes, a cloth and hair among colliders of every kind, by all three solvers, with edits,
/// and hashes the bits of every particle and tension.
std::uint64_t rope_hash();

/// The expected rig_hash().
inline constexpr std::uint64_t golden_rig_hash = 0x179dea8ccf0e5998u;

/// Moves the elements of 20 trees by every unit, in both spaces, propagating or not, and hashes the bits of
/// all reads.
std::uint64_t rig_hash();

/// The expected rig_solve_hash().
inline constexpr std::uint64_t golden_rig_solve_hash = 0x96ff544984897dfdu;

/// Solves a rig with every unit forward 200 times and backward once, and hashes the bits of every pose.
std::uint64_t rig_solve_hash();

/// The expected signal_hash().
inline constexpr std::uint64_t golden_signal_hash = 0x7deaff7769b479feu;

/// Runs every kind of filter with many parameters, springs of vectors and rotations, and batches, and hashes
/// the bits of every output and measure.
std::uint64_t signal_hash();

/// The expected humanoid_hash().
inline constexpr std::uint64_t golden_humanoid_hash = 0x9269190ede25ef29u;

/// Solves a body 600 times, free and within limits and capsules, walks it over stairs, gives it an object to
/// hold, bends its spine, and hashes the bits of every pose.
std::uint64_t humanoid_hash();

}  // namespace tendril::test
