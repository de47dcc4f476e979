// Measurements of ropes for the inspector, the curves and the plot of the last ten seconds.
#pragma once

#include <cstdint>
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

/// A sample of the whole world; after a tick, with its report and the length of its frame.
RopeSample sample_of(const NamedWorld& world);
RopeSample sample_of(const RopePart& part, const RopeReport& report);
/// Sums over the last second, except for `inside`, which is the last tick's.
RopeReport last_second(const std::vector<RopeSample>& samples);

/// Seconds to simulate a tick, the mean of the last second; 0 if nothing was measured.
double cost_of_tick(const std::vector<RopeSample>& samples);
/// The same: "310 µs", "16.6 ms"; or "".
std::string cost_text(const std::vector<RopeSample>& samples);
/// "< 0.01 %", "1.25 %"
std::string share_text(float share);

/// Two pins farther apart than the length between them: of rope, of cloth along its threads, and of ties.
struct OverPulled {
    std::string from, to;              ///< the pinned bodies, possibly the same
    double apart = 0.0, length = 0.0;  ///< metres
    std::vector<std::uint32_t> way;    ///< the path between the pins: particles at pins and tie ends
};
/// The worst for each pin, the worst of all first. Elastic links count as long enough.
std::vector<OverPulled> over_pulled(const NamedWorld& world);

/// "12.34 N", or "25.2 MN" where hundredths are meaningless.
std::string force_text(float newtons);
/// The tension of a tie, or at the selected particles: "5.50 N". Text without a number while a tie still
/// pulls its ends together, and where pins pull inextensible links, since that force is unbounded.
std::string tension_text(const NamedWorld& world, const rope::Tie& tie);
std::string tension_text(const NamedWorld& world, const RopeSelection& selection);
/// The force at which a rope tears: "100.00 N", or "only by its pins". Empty if it never tears, and for other
/// bodies.
std::string tearing_text(const NamedWorld& world, const rope::Body& body);
/// "rope tore at particle 12 at 100.00 N; so did 2 others"; at least one.
std::string torn_text(const std::vector<RopeTear>& tears);
/// The tension of a tie, if it is a number.
std::optional<float> measured_tension(const rope::Tie& tie, const std::vector<OverPulled>& pulled);

}  // namespace tendril::app
