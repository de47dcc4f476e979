// Energy, in joules, as it is halfway through a substep: there a particle has the speed that Verlet's method
// keeps, and what a leapfrog step conserves is conserved. Not installed.
#pragma once

#include <algorithm>

#include "rope/build.hpp"
#include "rope/geometry.hpp"

namespace tendril::rope::detail {

/// Of a particle that moved by `by` in h seconds.
inline double kinetic_energy(double mass, const dvec3& by, double h) noexcept {
    return h > 0.0 ? 0.5 * mass * dot(by, by) / (h * h) : 0.0;
}

/// Of a link of that tension and compliance, whose ends are `now` apart and moved apart by `by`. Where it is
/// longer than that makes it, because a solver fell short, it was so halfway, too. Shear and bend links are
/// too stiff for their length halfway to tell anything: of them it is what is in them now.
inline double elastic_energy(const Link& link, double compliance, double tension, const dvec3& now,
                             const dvec3& by) noexcept {
    if (link.kind != Link::Kind::Stretch) return 0.5 * compliance * tension * tension;
    const double longer = length(now) - link.rest, halfway = 0.5 * (longer + length(now - by) - link.rest);
    if (!(longer * tension > 0.0)) return 0.0;
    const double stiffness = std::min(tension / longer, 1.0 / compliance);
    return 0.5 * stiffness * halfway * halfway;
}

}  // namespace tendril::rope::detail
