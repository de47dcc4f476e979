// What the rope's tests share: ropes that hang, how they swing, and equality down to the bit.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <string>

#include "chain_support.hpp"
#include "random.hpp"
#include "rope_named.hpp"

namespace tendril::test {

inline constexpr rope::Solver all_solvers[] = {rope::Solver::Relaxation, rope::Solver::Xpbd,
                                               rope::Solver::Direct};
inline constexpr double pi = 3.14159265358979323846;

inline World world_with(const rope::Settings& settings) {
    World world;
    world.set_settings(settings);
    return world;
}

/// Lets seconds pass that one call of advance() would drop.
inline void run(World& world, double seconds) {
    const double frame = 0.25;
    const auto frames = static_cast<int>(std::lround(seconds / frame));
    for (int i = 0; i < frames; ++i) world.advance(frame);
}
/// Lets that many substeps pass, one by one, so that what happens in between can be seen.
template <class Seen>
void run_substeps(World& world, int count, Seen seen) {
    for (int i = 0; i < count; ++i) {
        world.advance(world.settings().substep);
        seen();
    }
}

/// Hung between the origin and (span, 0, 0).
inline void hang_between(World& world, float span, float length, int segments) {
    world.add_rope("rope", {.from = {0, 0, 0},
                            .to = {span, 0, 0},
                            .segments = segments,
                            .length = length,
                            .pin_start = true,
                            .pin_end = true});
}

inline double lowest(const World& world) {
    double y = std::numeric_limits<double>::infinity();
    for (const glm::dvec3& p : world.state().position) y = std::min(y, p.y);
    return y;
}

/// How far a rope of that length sags between two points that far apart, in theory.
inline double catenary_sag(double span, double length) {
    double low = 1e-3 * span, high = 1e3 * span;
    for (int i = 0; i < 200; ++i) {
        const double a = std::sqrt(low * high);
        (2.0 * a * std::sinh(0.5 * span / a) > length ? low : high) = a;
    }
    return low * (std::cosh(0.5 * span / low) - 1.0);
}

inline double stretch(const World& world, const char* body = "rope") {
    return world.length_error(*world.find(body));  // measured, not said
}
inline double energy(const World& world, const char* body = "rope") {
    return world.energy(*world.find(body));
}

/// Every number that a world remembers of its particles is finite.
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

template <class T>
bool same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

/// Whether two worlds are in the same state to the last bit.
inline bool same_bits(const rope::State& a, const rope::State& b) {
    const auto same_body = [](const rope::Body& x, const rope::Body& y) {
        return x.kind == y.kind && x.first == y.first && x.count == y.count && x.row == y.row &&
               x.radius == y.radius && x.tear == y.tear;
    };
    const auto same_link = [](const rope::Link& x, const rope::Link& y) {
        return x.a == y.a && x.b == y.b && x.rest == y.rest && x.kind == y.kind &&
               x.compliance == y.compliance && std::memcmp(&x.tension, &y.tension, sizeof x.tension) == 0;
    };
    const auto same_pin = [](const rope::Pin& x, const rope::Pin& y) {
        return x.particle == y.particle && x.goal == y.goal && x.seconds == y.seconds &&
               static_cast<bool>(x.collider) == static_cast<bool>(y.collider);
    };
    const auto same_collider = [](const rope::Collider& x, const rope::Collider& y) {
        return x.shape.index() == y.shape.index() && centre(x.shape) == centre(y.shape) &&
               size(x.shape) == size(y.shape) && x.goal == y.goal && x.seconds == y.seconds;
    };
    return a.settings == b.settings && same_bytes(a.position, b.position) &&
           same_bytes(a.displacement, b.displacement) && same_bytes(a.earlier, b.earlier) &&
           same_bytes(a.mass, b.mass) && a.remainder == b.remainder && a.displaced_in == b.displaced_in &&
           a.substeps == b.substeps && a.dropped == b.dropped &&
           std::equal(a.bodies.begin(), a.bodies.end(), b.bodies.begin(), b.bodies.end(), same_body) &&
           std::equal(a.links.begin(), a.links.end(), b.links.begin(), b.links.end(), same_link) &&
           std::equal(a.pins.begin(), a.pins.end(), b.pins.begin(), b.pins.end(), same_pin) &&
           std::equal(a.colliders.begin(), a.colliders.end(), b.colliders.begin(), b.colliders.end(),
                      same_collider);
}

}  // namespace tendril::test
