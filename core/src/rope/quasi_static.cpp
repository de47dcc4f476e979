#include "tendril/rope/quasi_static.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "math/checks.hpp"
#include "rope/geometry.hpp"
#include "tendril/magnitude.hpp"

namespace tendril::rope {
namespace {

constexpr double substeps = 8.0;  ///< a single substep cannot absorb a large move
/// A stiff link with a larger length error, more than contacts leave, returns to its rest length.
constexpr double max_error = 0.05;

bool is_stiff(const Settings& settings) {
    return settings.solver == Solver::Direct && settings.compliance == 0.0f;
}

/// A world at rest: no weight, no motion, no moves in progress, every link at its current length.
State frozen(const World& world) {
    const State& was = world.state();
    State still = was;
    still.settings = {.damping = max_rate, .gravity = glm::vec3(0.0f)};
    std::fill(still.displacement.begin(), still.displacement.end(), glm::dvec3(0.0));
    still.remainder = still.displaced_in = 0.0;
    const bool stiff = is_stiff(was.settings);
    for (Link& link : still.links) {
        const double length = detail::length(was.position[link.b] - was.position[link.a]), rest = link.rest;
        const bool kept = stiff && link.kind == Link::Kind::Stretch;
        if (!kept || std::abs(length - rest) <= max_error * rest)
            link.rest = static_cast<float>(std::min(length, static_cast<double>(max_magnitude)));
        link.tension = 0.0f;
    }
    for (Body& body : still.bodies) body.tear = body.bending = 0.0f;
    for (Tie& tie : still.ties) tie.strength = 0.0f;
    for (Collider& collider : still.colliders) {
        collider.goal = glm::dvec3(centre(collider.shape));
        collider.seconds = 0.0;
        collider.half_goal.reset();
    }
    for (Pin& pin : still.pins) {
        const Collider* holder = world.find(pin.collider);
        pin.goal = was.position[pin.particle];
        if (holder != nullptr) pin.goal -= glm::dvec3(centre(holder->shape));
        pin.seconds = 0.0;
    }
    return still;
}

/// Pins and colliders that were not dragged resume their moves.
void resume_moves(State& now, const State& still, const State& was) {
    for (Pin& pin : now.pins) {
        const auto at =
            std::lower_bound(still.pins.begin(), still.pins.end(), pin.particle,
                             [](const Pin& other, std::size_t number) { return other.particle < number; });
        pin.seconds = 0.0;
        if (at != still.pins.end() && at->particle == pin.particle && at->goal == pin.goal &&
            at->collider == pin.collider)
            pin = was.pins[static_cast<std::size_t>(at - still.pins.begin())];
    }
    for (std::size_t i = 0; i < now.colliders.size(); ++i) {
        const Collider& before = still.colliders[i];
        now.colliders[i].seconds = 0.0;
        if (now.colliders[i].goal == before.goal && now.colliders[i].shape == before.shape)
            now.colliders[i] = was.colliders[i];
    }
}

/// `start_move` moves the dragged pins or colliders of a world within the given seconds.
template <class StartMove>
Result drag(World& world, Workspace& workspace, StartMove start_move) {
    const State& was = world.state();
    const State still = frozen(world);
    Expected<World> moved = World::from_state(still);
    if (!moved) return moved.error();
    const double seconds = substeps * still.settings.substep;
    if (const Result refused = start_move(*moved, seconds); !refused) return refused;
    moved->advance(seconds, workspace);

    State now = moved->state();
    resume_moves(now, still, was);
    for (std::size_t i = 0; i < now.bodies.size(); ++i) {
        now.bodies[i].tear = was.bodies[i].tear;
        now.bodies[i].bending = was.bodies[i].bending;
        if (!is_stiff(was.settings)) now.bodies[i].stretch = was.bodies[i].stretch;
    }
    now.settings = was.settings;
    now.links = was.links;
    now.ties = was.ties;
    now.displacement = was.displacement;
    now.remainder = was.remainder, now.displaced_in = was.displaced_in;
    now.substeps = was.substeps, now.dropped = was.dropped, now.drift = was.drift;
    Expected<World> after = World::from_state(std::move(now));
    if (!after) return after.error();
    world = std::move(*after);
    return {};
}

}  // namespace

Result drag_pins(World& world, Workspace& workspace, std::span<const PinPlace> pins) {
    if (pins.empty()) return {};
    std::vector<std::size_t> particles;
    for (const PinPlace& each : pins) particles.push_back(each.particle);
    std::sort(particles.begin(), particles.end());
    const auto twice = std::adjacent_find(particles.begin(), particles.end());
    if (twice != particles.end())
        return tendril::detail::refused("drag_pins", "pins", "different particles", *twice);
    return drag(world, workspace, [&](World& moved, double seconds) -> Result {
        for (const PinPlace& each : pins)
            if (const Result refused = moved.pin(each.particle, each.to, seconds); !refused) return refused;
        return {};
    });
}

Result drag_pin(World& world, Workspace& workspace, std::size_t particle, const glm::dvec3& to) {
    const PinPlace pin{particle, to};
    return drag_pins(world, workspace, {&pin, 1});
}

Result drag_collider(World& world, Workspace& workspace, ColliderId collider, const glm::vec3& to) {
    return drag(world, workspace,
                [&](World& moved, double seconds) { return moved.move_collider(collider, to, seconds); });
}

Result drag_collider(World& world, Workspace& workspace, ColliderId collider, const Shape& shape) {
    return drag(world, workspace, [&](World& moved, double) { return moved.set_collider(collider, shape); });
}

}  // namespace tendril::rope
