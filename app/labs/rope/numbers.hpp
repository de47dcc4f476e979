// What is measured of ropes: for the inspector, the curves and the plot of the last ten seconds.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/labs/rope/rope_part.hpp"

namespace tendril::app {

/// Which particles of a world.
using Particles = std::vector<bool>;
/// Those that are selected, or all where none is; empty where what is selected is not in that world.
Particles measured_particles(const NamedWorld& world, const std::optional<RopeSelection>& selection);

/// The strongest pull of a stretch link at any of them, newtons; 0 without links.
float strongest_tension(const NamedWorld& world, const Particles& particles);
/// Of the fastest of them, m/s.
float highest_speed(const NamedWorld& world, const Particles& particles);

/// Of a whole world, after a tick.
RopeSample sample_of(const RopePart& part, const RopeReport& report);
/// Of the last second: sums, and of `inside` what the last tick said.
RopeReport last_second(const std::vector<RopeSample>& samples);

/// A body whose pins are further apart than it is long between them.
struct OverPulled {
    std::string body;
    double apart = 0.0, length = 0.0;  ///< metres
};
std::optional<OverPulled> over_pulled(const NamedWorld& world);

}  // namespace tendril::app
