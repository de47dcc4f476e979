// Shared by rope tests: hanging ropes, measurements, and bitwise equality.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "chain_support.hpp"
#include "random.hpp"
#include "rope_named.hpp"
#include "rope_same_bits.hpp"

namespace tendril::test {

inline constexpr rope::Solver all_solvers[] = {rope::Solver::Relaxation, rope::Solver::Xpbd,
                                               rope::Solver::Direct};
inline constexpr double pi = 3.14159265358979323846;

inline World world_with(const rope::Settings& settings) {
    World world;
    world.set_settings(settings);
    return world;
}

/// Advances by more seconds than one call of advance() would accept.
inline void run(World& world, double seconds) {
    const double frame = 0.25;
    const auto frames = static_cast<int>(std::lround(seconds / frame));
    for (int i = 0; i < frames; ++i) world.advance(frame);
}
/// Advances substep by substep, calling `seen` after each.
template <class Seen>
void run_substeps(World& world, int count, Seen seen) {
    for (int i = 0; i < count; ++i) {
        world.advance(world.settings().substep);
        seen();
    }
}

/// Gives each particle a velocity, m/s, by its number. Bodies and colliders get default names.
template <class Velocity>
void throw_all(World& world, Velocity velocity) {
    rope::State state = world.state();
    state.displaced_in = state.settings.substep;
    for (std::size_t i = 0; i < state.displacement.size(); ++i)
        state.displacement[i] = state.displaced_in * velocity(i);
    world = World(state);
}

/// A rope pinned at both ends.
inline rope::RopeShape pinned_rope(glm::vec3 from, glm::vec3 to, int segments,
                                   std::optional<float> length = {}, float radius = 0.02f) {
    rope::RopeShape made{.from = from, .to = to, .segments = segments, .length = length, .radius = radius};
    made.pin_start = made.pin_end = true;
    return made;
}
inline rope::ClothShape square_cloth(glm::vec3 corner, glm::vec3 along, glm::vec3 down, int side,
                                     rope::ClothShape::Pins pins = rope::ClothShape::Pins::None) {
    return {.corner = corner, .along = along, .down = down, .columns = side, .rows = side, .pins = pins};
}

/// Hangs a rope between the origin and (span, 0, 0).
inline void hang_between(World& world, float span, float length, int segments) {
    world.add_rope("rope", pinned_rope({0, 0, 0}, {span, 0, 0}, segments, length));
}

/// The weight of all bodies, newtons.
inline double weight(const World& world) {
    double mass = 0.0;
    for (const double each : world.state().mass) mass += each;
    return 9.81 * mass;
}

inline glm::dvec3 momentum(const World& world) {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < world.size(); ++i) sum += world.state().mass[i] * world.core().velocity(i);
    return sum;
}
/// About the origin.
inline glm::dvec3 angular_momentum(const World& world) {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < world.size(); ++i)
        sum += world.state().mass[i] * glm::cross(world.state().position[i], world.core().velocity(i));
    return sum;
}

/// Speed of the fastest particle, m/s.
inline double top_speed(const World& world) {
    double top = 0.0;
    for (std::size_t i = 0; i < world.size(); ++i)
        top = std::max(top, static_cast<double>(glm::length(world.velocity(i))));
    return top;
}

inline double lowest(const World& world) {
    double y = std::numeric_limits<double>::infinity();
    for (const glm::dvec3& p : world.state().position) y = std::min(y, p.y);
    return y;
}

/// The theoretical sag of a rope of `length` between two points `span` apart.
inline double catenary_sag(double span, double length) {
    double low = 1e-3 * span, high = 1e3 * span;
    for (int i = 0; i < 200; ++i) {
        const double a = std::sqrt(low * high);
        (2.0 * a * std::sinh(0.5 * span / a) > length ? low : high) = a;
    }
    return low * (std::cosh(0.5 * span / low) - 1.0);
}

inline double stretch(const World& world, const char* body = "rope") {
    return world.length_error(*world.find(body));  // as measured, not as reported
}
inline double energy(const World& world, const char* body = "rope") {
    return world.energy(*world.find(body));
}

/// Whether every number in the state of the particles is finite.
inline bool all_finite(const World& world) {
    const auto finite = [](const glm::dvec3& p) {
        return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
    };
    const rope::State& state = world.state();
    return std::all_of(state.position.begin(), state.position.end(), finite) &&
           std::all_of(state.displacement.begin(), state.displacement.end(), finite) &&
           std::all_of(state.links.begin(), state.links.end(),
                       [](const rope::Link& link) { return std::isfinite(link.tension); });
}

/// A moving scene with bodies of every kind.
inline World busy_world(rope::Solver solver) {
    World world = world_with({.solver = solver});
    world.add_rope("rope",
                   {.from = {0, 2, 0}, .to = {1, 2, 0}, .segments = 24, .length = 1.4f, .pin_start = true});
    world.add_cloth("cloth",
                    {.corner = {2, 2, 0}, .columns = 6, .rows = 6, .pins = rope::ClothShape::Pins::Corners});
    world.add_collider("ball", rope::Sphere{{0.6f, 1.4f, 0}, 0.2f});
    world.add_hair("hair", {.roots = {{{0.6f, 1.6f, 0}, {0, 1, 0}}}, .segments = 6}, "ball");
    world.add_collider("ground", rope::Plane{{0, 0, 0}, {0, 1, 0}});
    world.move_collider("ball", {0.2f, 1.3f, 0}, 0.7);
    world.pin(world.particle("rope", 24), {0.5f, 2.2f, 0.1f}, 0.6);
    return world;
}

/// The maximum number of links and contacts that a substep may visit: passes over everything, searches for
/// ways out, and links near thin colliders.
inline std::uint64_t max_work(const rope::World& world) {
    const std::size_t particles = world.size(), links = world.state().links.size();
    const std::size_t pairs = world.state().colliders.size() * (particles + 14 * links);
    const std::size_t passes = 2 * rope::unbounded_passes;
    return passes * (links + pairs) + rope::max_pass_work + 256 * particles * world.state().colliders.size();
}

}  // namespace tendril::test
