#include "app/labs/rope/numbers.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

namespace tendril::app {
namespace {

constexpr std::size_t max_pins = 32;  ///< per body, that are compared with one another

/// How far apart its links let two particles of a body be, along rows and columns.
class Reach {
  public:
    Reach(const rope::State& state, const rope::Body& body)
        : row_(body.row > 0 ? body.row : body.count), strands_(body.kind == rope::Body::Kind::Hair) {
        along_.assign(body.count, no_link);
        down_.assign(body.count, no_link);
        for (const rope::Link& link : state.links) {
            if (link.kind != rope::Link::Kind::Stretch || link.a - body.first >= body.count) continue;
            const std::size_t from = std::min(link.a, link.b) - body.first,
                              step = std::max(link.a, link.b) - body.first - from;
            if (step == 1) along_[from] = link.rest;
            if (step == row_) down_[from] = link.rest;
        }
    }
    double between(std::size_t a, std::size_t b) const {
        if (strands_ && a / row_ != b / row_) return no_link;
        const std::size_t left = std::min(a % row_, b % row_), right = std::max(a % row_, b % row_);
        double length = 0.0;
        for (std::size_t i = left; i < right; ++i) length += along_[a - a % row_ + i];
        for (std::size_t i = a; i / row_ < b / row_; i += row_) length += down_[i];
        return length;
    }

  private:
    static constexpr double no_link = std::numeric_limits<double>::infinity();
    std::size_t row_;
    bool strands_;
    std::vector<double> along_, down_;  ///< rest lengths of the links from each particle
};

}  // namespace

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

std::optional<OverPulled> over_pulled(const NamedWorld& world) {
    const rope::State& state = world.state();
    std::optional<OverPulled> worst;
    for (const rope::Body& body : state.bodies) {
        const Reach reach(state, body);
        const auto in_body = [&](const rope::Pin& pin) { return pin.particle - body.first < body.count; };
        std::vector<std::size_t> pinned;
        for (const rope::Pin& pin : state.pins)
            if (in_body(pin) && pinned.size() < max_pins) pinned.push_back(pin.particle);
        for (auto a = pinned.begin(); a != pinned.end(); ++a) {
            for (auto b = a + 1; b != pinned.end(); ++b) {
                const double apart = glm::distance(state.position[*a], state.position[*b]);
                const double length = reach.between(*a - body.first, *b - body.first);
                if (!(apart > 1.001 * length) || (worst && worst->apart - worst->length >= apart - length))
                    continue;
                worst = OverPulled{world.name(body), apart, length};
            }
        }
    }
    return worst;
}

}  // namespace tendril::app
