// Ropes, cloth and hair as particles and links. Not installed.
#pragma once

#include <vector>

#include "rope/chain_system.hpp"
#include "rope/geometry.hpp"
#include "tendril/result.hpp"
#include "tendril/rope/state.hpp"

namespace tendril::rope::detail {

/// A body that is not in a state yet: its particles are numbered from 0.
struct Draft {
    Body body;
    std::vector<glm::dvec3> points;  ///< at rest, metres
    double mass = 0.0;               ///< kg per particle; the ends of a rope or strand have half of it
    std::vector<Link> links;
    std::vector<Pin> pins;

    void pin(std::size_t particle);
    void link(std::uint32_t a, std::uint32_t b, double rest, Link::Kind kind, float compliance);
    /// Adds a link with the distance of its particles as rest length.
    void link(std::uint32_t a, std::uint32_t b, Link::Kind kind, float compliance);
};

// Each drafts a body for a state, or refuses and names the value out of range.
Result draft_rope(const State& state, const RopeShape& shape, Draft& draft);
Result draft_cloth(const State& state, const ClothShape& shape, Draft& draft);
Result draft_hair(const State& state, const HairShape& shape, Draft& draft);

/// Adds a draft; refuses one that reaches beyond the edge of the world.
Expected<BodyId> append(State& state, const char* operation, Draft draft);

/// The direction of gravity, a unit vector; -Y without gravity.
glm::dvec3 down(const Settings& settings) noexcept;
/// Gravity plus external acceleration, m/s^2.
glm::dvec3 acceleration(const Settings& settings) noexcept;
/// Whether there is wind or still air.
inline bool has_air(const Settings& settings) noexcept {
    return settings.wind != glm::vec3(0.0f) || settings.still_air;
}
/// Pressure of the wind in a gust on a cloth that faces it, N/m^2.
double wind_pressure(const Settings& settings) noexcept;
/// Moves the gusts along for a substep.
void advect_gusts(State& state) noexcept;
/// The compliance of a link as its solver uses it, m/N.
inline double compliance(const Settings& settings, const Link& link) noexcept {
    if (link.kind != Link::Kind::Stretch) return link.compliance;
    if (settings.solver == Solver::Relaxation) return 0.0;
    return static_cast<double>(settings.compliance) * link.rest + link.compliance;
}

/// Whether a body resists bending. Only the direct solver supports it.
inline bool bends(const State& state, const Body& body) noexcept {
    return body.bending > 0.0f && state.settings.solver == Solver::Direct;
}
/// The bending resistance of a rope between two consecutive links.
ChainBend bend_between(const State& state, const Body& body, const Link& before, const Link& after) noexcept;
/// Whether a link continues a chain. Shear and bend links form none.
inline bool follows(const Link& before, const Link& link) noexcept {
    return link.a == before.b && link.kind == before.kind && link.kind == Link::Kind::Stretch;
}

/// The relative length error of a stretch link, or its length if its rest is 0; 0 for other links.
double length_error(const State& state, const Link& link) noexcept;

/// Coulomb's friction coefficient of a body.
inline double friction(const State& state, const Body& body) noexcept {
    return static_cast<double>(body.friction.value_or(state.settings.friction));
}

/// The distance that a tie keeps in a substep of h seconds, metres.
double enforced_length(const Tie& tie, double h) noexcept;

// Energy in joules, halfway through a substep: Verlet's velocity refers to that time, and a leapfrog step
// conserves that energy.

/// Energy of a particle that moved by `by` in h seconds.
inline double kinetic_energy(double mass, const glm::dvec3& by, double h) noexcept {
    return h > 0.0 ? 0.5 * mass * dot(by, by) / (h * h) : 0.0;
}
/// Energy of a link under `tension`. Its ends are `now` apart, a distance that changed by `by` in the
/// substep. A solver that stops early leaves a link longer than its tension implies; its length halfway is
/// assumed to be off by the same factor. Shear and bend links are so stiff that rotation alone spoils their
/// length halfway, so their energy is taken at the end.
double elastic_energy(const Link& link, double compliance, double tension, const glm::dvec3& now,
                      const glm::dvec3& by) noexcept;
/// Bending energy of a body between consecutive links; `at`: the position of a particle.
template <class At>
double bending_energy(const State& state, const Body& body, const Link& before, const Link& after, At at) {
    const ChainBend bend = bend_between(state, body, before, after);
    const glm::dvec3 curvature = bend.curvature(at(before.a), at(after.a), at(after.b));
    return 0.5 * bend.stiffness * dot(curvature, curvature) /
           (state.settings.substep * state.settings.substep);
}

/// Calls link(a, b, kind) for every link of a body of `rows` rows of `columns` particles, numbered from 0, in
/// the order in which links are built and solved. A rope is a single row, hair a row for each strand.
template <class Visit>
void each_link(Body::Kind of, std::uint32_t columns, std::uint32_t rows, Visit link) {
    const auto at = [&](std::uint32_t c, std::uint32_t r) { return r * columns + c; };
    const auto along = [&](std::uint32_t step, Link::Kind kind) {
        for (std::uint32_t r = 0; r < rows; ++r)
            for (std::uint32_t c = 0; c + step < columns; ++c) link(at(c, r), at(c + step, r), kind);
    };
    const auto down = [&](std::uint32_t step, Link::Kind kind) {
        for (std::uint32_t c = 0; c < columns; ++c)
            for (std::uint32_t r = 0; r + step < rows; ++r) link(at(c, r), at(c, r + step), kind);
    };
    along(1, Link::Kind::Stretch);
    if (of == Body::Kind::Cloth) {
        down(1, Link::Kind::Stretch);
        for (std::uint32_t r = 0; r + 1 < rows; ++r)
            for (std::uint32_t c = 0; c + 1 < columns; ++c) {
                link(at(c, r), at(c + 1, r + 1), Link::Kind::Shear);
                link(at(c + 1, r), at(c, r + 1), Link::Kind::Shear);
            }
    }
    if (of != Body::Kind::Rope) along(2, Link::Kind::Bend);
    if (of == Body::Kind::Cloth) down(2, Link::Kind::Bend);
}

}  // namespace tendril::rope::detail
