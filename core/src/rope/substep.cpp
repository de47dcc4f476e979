// A substep of an island: free particles move, a solver corrects them, and the result becomes the state.
#include "rope/substep.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <optional>
#include <utility>

#include "rope/body_contacts.hpp"
#include "rope/build.hpp"
#include "rope/check_state.hpp"
#include "rope/geometry.hpp"
#include "tendril/elementary.hpp"

namespace tendril::rope {
namespace {

using glm::dvec3;

/// True only if every coordinate is at most `limit`; false for NaN. A single comparison, because it runs for
/// every particle; the others are checked again.
bool is_within_l1(const dvec3& v, double limit) {
    return std::abs(v.x) + std::abs(v.y) + std::abs(v.z) <= limit;
}

/// Clamps a position to the edge of the world, max_magnitude from the origin in each coordinate. If the
/// solver's result is not finite, the particle stays where it was.
dvec3 clamped_to_world(const dvec3& x, const dvec3& was) {
    constexpr double edge = max_magnitude;
    const bool number = std::isfinite(x.x) && std::isfinite(x.y) && std::isfinite(x.z);
    return number ? glm::clamp(x, dvec3(-edge), dvec3(edge)) : was;
}

/// Tension in newtons from a Lagrange multiplier.
float tension_of(double multiplier, double square) {
    constexpr double limit = 1e30;
    const double tension = multiplier / square;
    if (std::abs(tension) <= limit) return static_cast<float>(tension) + 0.0f;
    return std::isfinite(tension) ? static_cast<float>(std::copysign(limit, tension)) : 0.0f;
}

}  // namespace

Substep::Substep(State& state, const Plan& plan, const Plan::Island& island, Scratch& scratch,
                 IslandScratch& local)
    : IslandStep(state, plan, island, scratch, local),
      report_(local.done),
      acceleration_(detail::acceleration(state.settings)),
      has_air_(detail::has_air(state.settings)) {}

Substep::Substep(const Substep& whole, const Plan::Island& part)
    : IslandStep(whole, part),
      report_(whole.report_),
      measures_(whole.measures_),
      before_(whole.before_),
      damping_(whole.damping_),
      acceleration_(whole.acceleration_),
      has_air_(whole.has_air_) {}

void Substep::run(bool measures) {
    measures_ = measures;
    list_members();
    move_particles();
    find_near();
    if (island_.contacts != 0) BodyContacts(*this).find();
    const int passes = state_.settings.solver == Solver::Direct ? direct() : relax();
    report_.passes = std::max(report_.passes, passes);
    shorten_steps();
    depenetrate();
    clamp_to_world();
    if (island_.contacts != 0) BodyContacts(*this).prevent_crossing();
    restore_momentum();
    limit_energy();
    commit();
}

/// The settings' iterations, or fewer if an island would exceed its share, by particles and links, of
/// max_pass_work links and contacts.
int Substep::passes_allowed() const {
    const std::size_t size = island_.particles + island_.links.count;
    const std::size_t whole = state_.position.size() + state_.links.size();
    std::size_t work = island_.links.count + 1;
    for (const IslandScratch::Near& near : local_.near) work += plan_.chunks[near.chunk].count;
    const double share = static_cast<double>(size) / static_cast<double>(whole);
    const auto affordable =
        static_cast<std::size_t>(share * static_cast<double>(max_pass_work) / static_cast<double>(work));
    const auto limit = std::max(static_cast<std::size_t>(unbounded_passes), affordable);
    return static_cast<int>(std::min(static_cast<std::size_t>(state_.settings.iterations), limit));
}

void Substep::move_particles() {
    damping_ = math::decay(static_cast<double>(state_.settings.damping) * h_);
    // Verlet's rule for uneven steps: the previous substep may have had another length.
    const bool before = state_.displaced_in > 0.0;
    const double same = before ? h_ / state_.displaced_in : 0.0;
    if (before) before_ = state_.displaced_in / h_;
    constexpr double limit = detail::max_displacement;  // no two positions are further apart
    const dvec3 fall = (before ? 0.5 * h_ * (h_ + state_.displaced_in) : h_ * h_) * acceleration_;
    each_particle([&](std::size_t i) {
        dvec3& moved = state_.displacement[i];
        moved = same * moved;  // as if the previous substep had been this long
        if (same > 1.0) moved = glm::clamp(moved, dvec3(-limit), dvec3(limit));
        scratch_.base[i] = state_.position[i] + (damping_ * moved + fall);
        scratch_.weight[i] = 1.0 / state_.mass[i];
    });
    local_.attached = false;
    const auto move_pin = [&](Pin& pin) {
        const dvec3 at = state_.position[pin.particle];
        dvec3 goal = pin.goal;
        if (pin.collider) {
            local_.attached = true;
            const std::uint32_t holder = scratch_.collider_at[pin.collider.index];
            goal += dvec3(centre(state_.colliders[holder].shape));
        }
        scratch_.base[pin.particle] = at + detail::part_of(h_, pin.seconds) * (goal - at);
        scratch_.weight[pin.particle] = 0.0;
    };
    for (const std::uint32_t b : Plan::part(plan_.bodies, island_.bodies)) {
        const Body& body = state_.bodies[b];
        scratch_.body_near[b] = Scratch::Nearest::None;
        auto pin = std::lower_bound(state_.pins.begin(), state_.pins.end(), body.first,
                                    [](const Pin& each, std::size_t i) { return each.particle < i; });
        for (; pin != state_.pins.end() && pin->particle < body.first + body.count; ++pin) move_pin(*pin);
    }
    if (has_air_) apply_wind();
    each_particle([&](std::size_t i) { scratch_.x[i] = scratch_.base[i]; });
    for (const std::uint32_t i : Plan::part(plan_.links, island_.links)) {
        scratch_.multiplier[i] = static_cast<double>(state_.links[i].tension) * (h_ * h_);
    }
    for (const std::uint32_t i : Plan::part(plan_.ties, island_.ties)) {
        scratch_.tie_multiplier[i] = static_cast<double>(state_.ties[i].tension) * (h_ * h_);
    }
}

/// Measures how far links are from their rest lengths, by body.
void Substep::measure() {
    if (!measures_) return;
    constexpr double limit = max_magnitude;  // for a rest of nearly 0
    const std::span<const std::uint32_t> bodies = Plan::part(plan_.bodies, island_.bodies);
    for (const std::uint32_t b : bodies) state_.bodies[b].stretch = 0.0f;
    std::size_t b = bodies.front();
    for (const std::uint32_t i : Plan::part(plan_.links, island_.links)) {
        const Link& link = state_.links[i];
        while (link.a < state_.bodies[b].first) --b;  // links of a body are nearly always contiguous
        while (link.a - state_.bodies[b].first >= state_.bodies[b].count) ++b;
        if (link.kind != Link::Kind::Stretch) continue;
        const double length = detail::length(scratch_.x[link.b] - scratch_.x[link.a]);
        const double error = link.rest > 0.0f ? std::abs(length / link.rest - 1.0) : length;
        state_.bodies[b].stretch =
            std::max(state_.bodies[b].stretch, static_cast<float>(std::min(error, limit)));
    }
}

void Substep::clamp_to_world() {
    each_particle([&](std::size_t i) {
        dvec3& x = scratch_.x[i];
        if (is_within_l1(x, 0.5 * max_magnitude)) return;
        x = clamped_to_world(x, state_.position[i]);
        local_.at_edge = true;
    });
    // Ledgers balanced earlier refer to other positions.
    for (Member& each : local_.members)
        if (local_.at_edge) each.slowdown.reset();
}

void Substep::commit() {
    push_touched();
    if (local_.attached && local_.records_pushes) push_attached();
    each_particle([&](std::size_t i) {
        dvec3 &x = scratch_.x[i], &position = state_.position[i], &moved = state_.displacement[i];
        // Coordinate by coordinate: a vector just written as a whole cannot be read at once. Adding 0 removes
        // the sign of zeros, which would depend on how many ropes are solved side by side.
        for (int c = 0; c < 3; ++c) {
            const double to = x[c] + 0.0;
            moved[c] = to - position[c];
            position[c] = to;
        }
    });
    for (const std::uint32_t i : Plan::part(plan_.links, island_.links)) {
        state_.links[i].tension = tension_of(scratch_.multiplier[i], h_ * h_);
    }
    for (const std::uint32_t i : Plan::part(plan_.ties, island_.ties)) {
        Tie& tie = state_.ties[i];
        tie.tension = tension_of(scratch_.tie_multiplier[i], h_ * h_);
        tie.now = static_cast<float>(detail::enforced_length(tie, h_));
    }
    apply_slowdown();
}

}  // namespace tendril::rope
