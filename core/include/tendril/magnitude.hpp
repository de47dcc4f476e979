// The range of every coordinate and length that may come into the library.
#pragma once

namespace tendril {

/// The largest coordinate and the largest length that are accepted, in metres. Results are accurate within
/// 1e3 m of the origin: further out, floats stand too far apart (64 m at this limit), and only finiteness is
/// promised.
inline constexpr float max_magnitude = 1e9f;

}  // namespace tendril
