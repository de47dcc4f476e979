#include "app/labs/rope/numbers.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <span>

#include "app/document/units.hpp"

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

RopeSample sample_of(const NamedWorld& world) {
    RopeSample sample;
    for (const rope::Body& body : world.state().bodies)
        sample.stretch = std::max(sample.stretch, body.stretch);
    sample.error = static_cast<float>(world.length_error());
    sample.energy = static_cast<float>(world.energy());
    return sample;
}

RopeSample sample_of(const RopePart& part, const RopeReport& report) {
    RopeSample sample = sample_of(*part.world);
    const double frame = part.jitter.frame > 0.0 ? part.jitter.frame : tick_seconds;
    sample.frame = static_cast<float>(1e3 * frame);
    sample.report = report;
    return sample;
}

namespace {

std::span<const RopeSample> of_last_second(const std::vector<RopeSample>& samples) {
    constexpr auto ticks = static_cast<std::size_t>(1.0 / tick_seconds + 0.5);
    return std::span(samples).last(std::min(samples.size(), ticks));
}

}  // namespace

RopeReport last_second(const std::vector<RopeSample>& samples) {
    RopeReport sum;
    for (const RopeSample& each : of_last_second(samples)) {
        const RopeReport& tick = each.report;
        sum.inside = tick.inside;
        sum.unconverged += tick.unconverged;
        sum.suspended += tick.suspended;
        sum.substeps += tick.substeps;
        sum.dropped += tick.dropped;
        sum.torn += tick.torn;
        sum.contact_loss += tick.contact_loss;
    }
    return sum;
}

double cost_of_tick(const std::vector<RopeSample>& samples) {
    double sum = 0.0, measured = 0.0;
    for (const RopeSample& each : of_last_second(samples)) {
        if (each.cost <= 0.0f) continue;
        sum += static_cast<double>(each.cost);
        ++measured;
    }
    return 1e-6 * sum / std::max(measured, 1.0);
}

std::string cost_text(const std::vector<RopeSample>& samples) {
    const double cost = cost_of_tick(samples);
    return cost > 0.0 ? si_text(cost, "s") : "";
}

std::string share_text(float share) {
    const double percent = 100.0 * static_cast<double>(share);
    return percent < 0.01 ? "< 0.01 %" : fixed_text(percent, 2) + " %";
}

}  // namespace tendril::app
