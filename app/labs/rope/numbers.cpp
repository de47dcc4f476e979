#include "app/labs/rope/numbers.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

namespace tendril::app {

Particles measured_particles(const NamedWorld& world, const std::optional<RopeSelection>& selection) {
    if (!selection || selection->body.empty()) return Particles(world.size(), true);
    const rope::Body* const body = world.find(selection->body);
    if (body == nullptr) return {};
    Particles measured(world.size(), false);
    bool any = false;
    for (const std::size_t i : selection->particles.all()) {
        if (i >= body->count) continue;
        measured[body->first + i] = any = true;
    }
    return any ? measured : Particles{};
}

float strongest_tension(const NamedWorld& world, const Particles& particles) {
    float strongest = 0.0f;
    for (const rope::Link& link : world.state().links)
        if (link.kind == rope::Link::Kind::Stretch && (particles[link.a] || particles[link.b]))
            strongest = std::max(strongest, link.tension);
    return strongest;
}

float highest_speed(const NamedWorld& world, const Particles& particles) {
    float highest = 0.0f;
    for (std::size_t i = 0; i < particles.size(); ++i)
        if (particles[i]) highest = std::max(highest, glm::length(world.velocity(i)));
    return highest;
}

RopeSample sample_of(const RopePart& part, const RopeReport& report) {
    const NamedWorld& world = *part.world;
    RopeSample sample;
    for (const rope::Body& body : world.state().bodies)
        sample.stretch = std::max(sample.stretch, body.stretch);
    sample.error = static_cast<float>(world.length_error());
    sample.energy = static_cast<float>(world.energy());
    const double frame = part.jitter.dial > 0.0f ? part.jitter.frame : tick_seconds;
    sample.frame = static_cast<float>(1e3 * frame);
    sample.report = report;
    return sample;
}

RopeReport last_second(const std::vector<RopeSample>& samples) {
    constexpr auto ticks = static_cast<std::size_t>(1.0 / tick_seconds + 0.5);
    RopeReport sum;
    for (std::size_t i = samples.size() - std::min(samples.size(), ticks); i < samples.size(); ++i) {
        const RopeReport& tick = samples[i].report;
        sum.inside = tick.inside;
        sum.unconverged += tick.unconverged;
        sum.suspended += tick.suspended;
        sum.contact_loss += tick.contact_loss;
    }
    return sum;
}

}  // namespace tendril::app
