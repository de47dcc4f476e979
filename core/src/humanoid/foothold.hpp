// Where a foot can stand with its whole sole on the ground. Not installed.
#pragma once

#include "humanoid/foot.hpp"

namespace tendril::humanoid::detail {

/// Height differences up to this are no step, metres.
inline constexpr double step_over_plane = 0.02;

inline double height_of_plane(const GroundHit& hit, double x, double z) noexcept {
    return hit.height - (hit.normal.x * x + hit.normal.z * z) / hit.normal.y;
}

/// Why no foot can stand on what a ray found; No if one can.
FootAlone judge(const std::optional<GroundHit>& hit, const FootContext& context) noexcept;

/// The shift, horizontal, that takes a sole from where the clip puts it down to where it stands: whole on
/// ground without a step in it, or, where treads are too short for that, with one end over the edge of the
/// highest. 0 if it stands so already, or nowhere within reach. The shortest shift wins, but one near to
/// `before` is preferred.
glm::dvec3 find_foothold(const glm::dvec3& heel, const glm::dvec3& toe, double from, const glm::dvec3& before,
                         const FootContext& context) noexcept;

}  // namespace tendril::humanoid::detail
