// Measurements of ropes for the inspector, the curves and the plot of the last ten seconds.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/labs/rope/rope_part.hpp"

namespace tendril::app {

/// Marks particles of a world.
using Particles = std::vector<bool>;
/// The selected particles, or all if none is selected; empty if the selected body is not in that world.
Particles measured_particles(const NamedWorld& world, const std::optional<RopeSelection>& selection);

/// The strongest tension of a stretch link at any of the particles, newtons; 0 without links.
float strongest_tension(const NamedWorld& world, const Particles& particles);
/// The highest speed of the particles, m/s.
float highest_speed(const NamedWorld& world, const Particles& particles);

/// A sample of the whole world, after a tick.
RopeSample sample_of(const RopePart& part, const RopeReport& report);
/// Sums over the last second, except for `inside`, which is that of the last tick.
RopeReport last_second(const std::vector<RopeSample>& samples);

/// A body with pins farther apart than its length between them.
struct OverPulled {
    std::string body;
    double apart = 0.0, length = 0.0;  ///< metres
};
std::optional<OverPulled> over_pulled(const NamedWorld& world);

}  // namespace tendril::app
