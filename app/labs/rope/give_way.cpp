#include "app/labs/rope/give_way.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "app/labs/rope/rope_time.hpp"

namespace tendril::app {
namespace {

constexpr double substeps = 8.0;  ///< a large move is not made good in one
/// A link of a rope that does not give, further from its length than contacts leave it, gets it back.
constexpr double most_error = 0.05;

bool is_stiff(const rope::Settings& settings) {
    return settings.solver == rope::Solver::Direct && settings.compliance == 0.0f;
}

glm::dvec3 holder_of(const rope::State& state, const rope::Pin& pin) {
    for (const rope::Collider& collider : state.colliders)
        if (collider.name == pin.collider) return glm::dvec3(rope::centre(collider.shape));
    return glm::dvec3(0.0);
}

/// A world in which nothing would happen: no weight, no motion, nothing on its way, every link as long as it
/// is.
rope::State frozen(const rope::State& was) {
    rope::State still = was;
    still.settings = {.damping = rope::max_rate, .gravity = glm::vec3(0.0f)};
    std::fill(still.moved.begin(), still.moved.end(), glm::dvec3(0.0));
    std::fill(still.before.begin(), still.before.end(), glm::dvec3(0.0));
    still.remainder = still.moved_in = 0.0;
    const bool stiff = is_stiff(was.settings);
    for (rope::Link& link : still.links) {
        const double length = glm::distance(was.position[link.a], was.position[link.b]), rest = link.rest;
        const bool kept = stiff && link.kind == rope::Link::Kind::Stretch;
        if (!kept || std::abs(length - rest) <= most_error * rest) link.rest = static_cast<float>(length);
        link.tension = 0.0f;
    }
    for (rope::Body& body : still.bodies) body.tear = 0.0f;
    for (rope::Collider& collider : still.colliders) {
        collider.goal = glm::dvec3(rope::centre(collider.shape));
        collider.seconds = 0.0;
    }
    for (rope::Pin& pin : still.pins) {
        pin.goal = was.position[pin.particle] - holder_of(was, pin);
        pin.seconds = 0.0;
    }
    return still;
}

/// What was not sent anywhere goes on to where it was going.
void send_on(rope::State& now, const rope::State& still, const rope::State& was) {
    for (rope::Pin& pin : now.pins) {
        const auto at = std::find_if(still.pins.begin(), still.pins.end(),
                                     [&](const rope::Pin& other) { return other.particle == pin.particle; });
        pin.seconds = 0.0;
        if (at != still.pins.end() && at->goal == pin.goal && at->collider == pin.collider)
            pin = was.pins[static_cast<std::size_t>(at - still.pins.begin())];
    }
    for (std::size_t i = 0; i < now.colliders.size(); ++i) {
        const rope::Collider& before = still.colliders[i];
        now.colliders[i].seconds = 0.0;
        if (now.colliders[i].goal == before.goal && now.colliders[i].shape == before.shape)
            now.colliders[i] = was.colliders[i];
    }
}

}  // namespace

void give_way(RopePart& part, rope::World& world, const std::function<void(rope::World&, double)>& send) {
    const rope::State was = world.state(), still = frozen(was);
    rope::World moved(still);
    const double seconds = substeps * still.settings.substep;
    send(moved, seconds);
    moved.advance(seconds);

    rope::State now = moved.state();
    send_on(now, still, was);
    for (std::size_t i = 0; i < now.bodies.size(); ++i) {
        now.bodies[i].tear = was.bodies[i].tear;
        if (!is_stiff(was.settings)) now.bodies[i].stretch = was.bodies[i].stretch;
    }
    now.settings = was.settings;
    now.links = was.links;
    now.moved = was.moved, now.before = was.before;
    now.remainder = was.remainder, now.moved_in = was.moved_in;
    now.substeps = was.substeps, now.dropped = was.dropped;
    world = rope::World(std::move(now));
    if (!part.samples.empty()) part.samples.back() = sample_of(world);
}

}  // namespace tendril::app
