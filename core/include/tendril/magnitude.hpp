// The limit of every coordinate and length that the library accepts.
#pragma once

namespace tendril {

/// The largest accepted coordinate and length, in metres. Results are accurate within 1e3 m of the origin.
/// Further out floats are too coarse (64 m apart at this limit), and only finiteness is promised.
inline constexpr float max_magnitude = 1e9f;

}  // namespace tendril
