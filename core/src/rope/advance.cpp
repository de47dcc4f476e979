// How time passes: fixed substeps, each of which moves what is free on and lets a solver put it right.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "rope/build.hpp"
#include "rope/check_state.hpp"
#include "rope/contact_shape.hpp"
#include "rope/geometry.hpp"
#include "rope/substep.hpp"

namespace tendril::rope {
namespace {

using glm::dvec3;

/// The part of the way to a goal that is done in `h`, of the `seconds` that are left for it.
double part_of(double h, double& seconds) {
    const double part = seconds > h * (1.0 + 1e-6) ? h / seconds : 1.0;
    seconds = part < 1.0 ? seconds - h : 0.0;
    return part;
}

/// Removes the links that are over their body's tear strain; whether there were any.
bool tear(State& state) {
    std::size_t b = 0;  // links of a body lie together, nearly always
    const auto torn = [&](const Link& link) {
        while (link.a < state.bodies[b].first) --b;
        while (link.a - state.bodies[b].first >= state.bodies[b].count) ++b;
        const float limit = state.bodies[b].tear;
        if (limit <= 0.0f) return false;
        // A cell that is pulled askew makes its diagonal longer without anything being overstretched.
        const double longest = static_cast<double>(limit) + (link.kind == Link::Kind::Stretch ? 0.0 : 0.5);
        const double length = detail::length(state.position[link.b] - state.position[link.a]);
        return length > link.rest * (1.0 + longest);
    };
    return std::erase_if(state.links, torn) > 0;
}

/// True only where every coordinate is at most `limit`, false where one is no number: a single comparison for
/// what runs for every particle. What is beyond it is looked at again.
bool surely_within(const dvec3& v, double limit) {
    return std::abs(v.x) + std::abs(v.y) + std::abs(v.z) <= limit;
}

/// The world has an edge, max_magnitude from the origin each way, where what flies further stops. Where the
/// solver found no number, a particle stays where it was.
dvec3 within_the_world(const dvec3& place, const dvec3& was) {
    constexpr double edge = max_magnitude;
    const bool number = std::isfinite(place.x) && std::isfinite(place.y) && std::isfinite(place.z);
    return number ? glm::clamp(place, dvec3(-edge), dvec3(edge)) : was;
}

/// Newtons, of a Lagrange multiplier over h^2.
float tension_of(double multiplier, double square) {
    constexpr double limit = 1e30;
    const double tension = multiplier / square;
    if (std::abs(tension) <= limit) return static_cast<float>(tension) + 0.0f;
    return std::isfinite(tension) ? static_cast<float>(std::copysign(limit, tension)) : 0.0f;
}

}  // namespace

Substep::Substep(State& state, const Plan& plan, Scratch& scratch, Advance& report)
    : state_(state),
      plan_(plan),
      scratch_(scratch),
      report_(report),
      h_(state.settings.substep),
      acceleration_(detail::acceleration(state.settings)) {}

void Substep::run() {
    move_colliders();
    move_particles();
    find_near();
    const Solver solver = state_.settings.solver;
    report_.passes += solver == Solver::Direct ? direct() : relax(solver == Solver::Xpbd);
    depenetrate();
    commit();
    ++report_.substeps;
    ++state_.substeps;
}

/// The settings' iterations, or fewer where they would take more than max_pass_work links and contacts.
int Substep::passes_allowed() const {
    std::size_t work = state_.links.size() + 1;
    for (const Scratch::Near& near : scratch_.near) work += plan_.chunks[near.chunk].count;
    const auto limit = std::max(static_cast<std::size_t>(unbounded_passes), max_pass_work / work);
    return static_cast<int>(std::min(static_cast<std::size_t>(state_.settings.iterations), limit));
}

void Substep::move_colliders() {
    for (std::size_t i = 0; i < state_.colliders.size(); ++i) {
        Collider& collider = state_.colliders[i];
        Scratch::Moving& moving = scratch_.colliders[i];
        const glm::vec3 was = centre(collider.shape);
        const double part = part_of(h_, collider.seconds);
        const dvec3 from(was), to = from + part * (collider.goal - from);
        if (glm::vec3(to) != was) collider.shape = detail::kept_in(moved(collider.shape, glm::vec3(to)));
        moving.shape = &collider.shape;
        moving.by = dvec3(centre(collider.shape)) - from;
        moving.size = size(collider.shape);
        detail::bounds(collider.shape, moving.by, moving.low, moving.high);
    }
}

void Substep::move_particles() {
    const double damping = std::exp(-static_cast<double>(state_.settings.damping) * h_);
    // Where the step before was not as long as this one, Verlet's rule for uneven steps.
    const bool before = state_.displaced_in > 0.0;
    const double same = before ? h_ / state_.displaced_in : 0.0;
    constexpr double limit = detail::max_displacement;  // no two places are further apart
    const dvec3 fall = (before ? 0.5 * h_ * (h_ + state_.displaced_in) : h_ * h_) * acceleration_;
    for (std::size_t i = 0; i < state_.position.size(); ++i) {
        dvec3& moved = state_.displacement[i];
        moved = same * moved;  // had the substep before been as long as this one
        if (same > 1.0) moved = glm::clamp(moved, dvec3(-limit), dvec3(limit));
        scratch_.base[i] = state_.position[i] + (damping * moved + fall);
        scratch_.weight[i] = 1.0 / state_.mass[i];
    }
    for (Pin& pin : state_.pins) {
        const dvec3 at = state_.position[pin.particle];
        dvec3 goal = pin.goal;
        if (pin.collider) {
            const std::uint32_t holder = scratch_.collider_at[pin.collider.index];
            goal += dvec3(centre(state_.colliders[holder].shape));
        }
        scratch_.base[pin.particle] = at + part_of(h_, pin.seconds) * (goal - at);
        scratch_.weight[pin.particle] = 0.0;
    }
    scratch_.place = scratch_.base;
    for (std::size_t i = 0; i < state_.links.size(); ++i) {
        scratch_.multiplier[i] = static_cast<double>(state_.links[i].tension) * (h_ * h_);
    }
}

/// How far links are from their rest lengths now, by body.
void Substep::measure() {
    if (!measures) return;
    constexpr double limit = max_magnitude;  // where a rest is next to nothing
    for (Body& body : state_.bodies) body.stretch = 0.0f;
    std::size_t b = 0;
    for (const Link& link : state_.links) {
        while (link.a < state_.bodies[b].first) --b;  // links of a body lie together, nearly always
        while (link.a - state_.bodies[b].first >= state_.bodies[b].count) ++b;
        if (link.kind != Link::Kind::Stretch) continue;
        const double length = detail::length(scratch_.place[link.b] - scratch_.place[link.a]);
        const double error = link.rest > 0.0f ? std::abs(length / link.rest - 1.0) : length;
        state_.bodies[b].stretch =
            std::max(state_.bodies[b].stretch, static_cast<float>(std::min(error, limit)));
    }
}

void Substep::commit() {
    for (std::size_t i = 0; i < state_.position.size(); ++i) {
        dvec3 &place = scratch_.place[i], &position = state_.position[i], &moved = state_.displacement[i];
        if (!surely_within(place, max_magnitude)) place = within_the_world(place, position);
        state_.earlier[i] = moved;
        // Coordinate by coordinate: a whole vector just written cannot be read at once. Zeros lose their
        // sign, which would depend on how many ropes were solved side by side.
        for (int c = 0; c < 3; ++c) {
            const double to = place[c] + 0.0;
            moved[c] = to - position[c];
            position[c] = to;
        }
    }
    for (std::size_t r = 0; r < plan_.chains.size(); ++r) {
        if (scratch_.chain_scale[r] == 1.0) continue;
        const Plan::Chain& chain = plan_.chains[r];
        for (std::uint32_t k = 0; k <= chain.links; ++k) {
            dvec3& by = state_.displacement[plan_.nodes[chain.first_node + k]];
            by = scratch_.chain_scale[r] * by;
        }
        scratch_.chain_scale[r] = 1.0;
    }
    for (std::size_t i = 0; i < state_.links.size(); ++i) {
        state_.links[i].tension = tension_of(scratch_.multiplier[i], h_ * h_);
    }
    for (const std::uint32_t i : scratch_.touched) scratch_.touch[i] = Touch{};
    scratch_.touched.clear();
    state_.displaced_in = h_;
}

Advance World::advance(double seconds, Workspace& workspace, const AdvanceOptions& options) {
    Advance done;
    done.refused = !(seconds >= 0.0 && seconds <= 1e9);
    if (done.refused) return done;
    const double substep = state_.settings.substep;
    // Only whole substeps are dropped: what is less is not lost, or it would never be counted.
    constexpr double rounding = 1e-6;  // of a substep
    const double over = std::max(0.0, seconds - static_cast<double>(state_.settings.longest_frame));
    done.dropped = static_cast<std::uint64_t>(over / substep + rounding);
    state_.remainder += std::max(0.0, seconds - static_cast<double>(done.dropped) * substep);
    const auto due = static_cast<std::uint64_t>(state_.remainder / substep + rounding);
    if (due > options.max_substeps) {
        const std::uint64_t more = due - options.max_substeps;
        state_.remainder = std::max(0.0, state_.remainder - static_cast<double>(more) * substep);
        done.dropped += more;
    }
    constexpr auto countable = std::uint64_t{1} << 53;  // by a file's numbers
    state_.dropped = std::min(state_.dropped + done.dropped, countable);
    const auto is_due = [&] { return state_.remainder >= substep * (1.0 - rounding); };
    if (!is_due()) return done;

    Workspace::Parts& parts = *workspace.parts_;
    parts.prepare(state_);
    while (is_due()) {
        state_.remainder = std::max(0.0, state_.remainder - substep);
        Substep step(state_, parts.plan, parts.scratch, done);
        step.measures = !is_due();
        step.run();
        if (parts.plan.tears && tear(state_)) parts.replan(state_);
    }
    return done;
}

}  // namespace tendril::rope
