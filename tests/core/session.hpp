// Fixed sessions over the library, each with its hash. hash_main.cpp has those that every compiler and
// optimisation must give.
#pragma once

#include <cstdint>

namespace tendril::test {

/// Runs 20 000 pseudo-random edits and pulls and hashes the bits of every position after each (64-bit
/// FNV-1a). All numbers are integers scaled to exact floats, so that only the library can differ.
std::uint64_t session_hash();

/// Runs 4 000 solves by all methods, with and without pole, limits and the other options, and hashes the bits
/// of every joint and report.
std::uint64_t solve_hash();

/// Places 400 chains along moving curves of both kinds, fitted or not, rolled and half blended, and hashes
/// the bits of every joint and rotation.
std::uint64_t curve_hash();

/// Drives and drags six linkages 60 times each, and hashes the bits of every joint and point.
std::uint64_t linkage_hash();

/// Runs 60 worlds of ropes, a cloth and hair among colliders of every kind, by all three solvers, with edits,
/// and hashes the bits of every particle and tension.
std::uint64_t rope_hash();

/// Moves the elements of 20 trees by every unit, in both spaces, propagating or not, and hashes the bits of
/// all reads.
std::uint64_t rig_hash();

/// Solves a rig with every unit forward 200 times and backward once, and hashes the bits of every pose.
std::uint64_t rig_solve_hash();

/// Runs every kind of filter with many parameters, springs of vectors and rotations, and batches, and hashes
/// the bits of every output and measure.
std::uint64_t signal_hash();

/// Solves a body 600 times, free and within limits and capsules, walks it over stairs, gives it an object to
/// hold, bends its spine, and hashes the bits of every pose.
std::uint64_t humanoid_hash();

}  // namespace tendril::test
