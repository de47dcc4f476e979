// Soft reach: in a zone before full reach the chain follows its target less and less, and never quite snaps
// straight. Not installed.
//
// With z the zone's width, a = R - z its start and x = (D - a) / z for a target at distance D > a, the chain
// goes out to a + z x / sqrt(1 + x^2): that joins the part before the zone with the same slope and the same
// curvature, and comes near to R without reaching it.
#pragma once

#include <algorithm>
#include <cmath>

namespace tendril::ik::detail {

/// How far out the chain goes for a target at `distance`, at least `nearest` (below which it cannot fold).
/// `zone` is part of the reach, over 0.
inline float eased_distance(float distance, float reach, float nearest, float zone) noexcept {
    const double width = static_cast<double>(zone) * static_cast<double>(reach);
    const double start = static_cast<double>(reach) - width, beyond = static_cast<double>(distance) - start;
    if (!(beyond > 0.0) || !(width > 0.0)) return distance;
    const double part = beyond / width;
    const auto eased = static_cast<float>(start + beyond / std::sqrt(1.0 + part * part));
    return std::max(eased, std::min(distance, nearest));
}

}  // namespace tendril::ik::detail
