// Advances time in fixed substeps. Each substep moves the colliders, then solves the islands.
#include <algorithm>
#include <atomic>
#include <glm/common.hpp>
#include <vector>

#include "math/fork_join.hpp"
#include "math/rotation.hpp"
#include "math/tasks.hpp"
#include "rope/build.hpp"
#include "rope/contact_shape.hpp"
#include "rope/geometry.hpp"
#include "rope/slots.hpp"
#include "rope/substep.hpp"

namespace tendril::rope {
namespace {

using glm::dvec3;

/// Removes links beyond their body's tear strain and lists them in `torn`; returns whether any tore. A rope
/// loses only its most strained link: that relieves the others.
bool tear_links(State& state, std::vector<TornLink>& torn) {
    const std::size_t first = torn.size();
    std::size_t b = 0;  // links of a body are nearly always contiguous
    const auto excess = [&](const Link& link) {
        while (link.a < state.bodies[b].first) --b;
        while (link.a - state.bodies[b].first >= state.bodies[b].count) ++b;
        const float limit = state.bodies[b].tear;
        if (limit <= 0.0f) return 0.0;
        // Shear lengthens a cell's diagonals without overstretching its threads.
        const double longest = static_cast<double>(limit) + (link.kind == Link::Kind::Stretch ? 1.0 : 1.5);
        const double length = detail::length(state.position[link.b] - state.position[link.a]);
        return std::max(0.0, length / std::max(static_cast<double>(link.rest), 1e-9) - longest);
    };
    double most = 0.0;
    for (const Link& link : state.links) {
        const double over = excess(link);
        if (!(over > 0.0)) continue;
        const Body& body = state.bodies[b];
        const bool another =
            body.kind != Body::Kind::Rope || torn.size() == first || torn.back().body != body.id;
        if (another)
            torn.push_back({body.id, link});
        else if (over > most)
            torn.back().link = link;
        most = another ? over : std::max(most, over);
    }
    auto next = torn.begin() + static_cast<std::ptrdiff_t>(first);
    std::erase_if(state.links, [&](const Link& link) {
        const bool tears = next != torn.end() && next->link == link;
        next += tears ? 1 : 0;
        return tears;
    });
    torn.erase(next, torn.end());
    return torn.size() > first;
}

/// Removes ties that pull harder than their strength, except those still drawing their particles together;
/// returns whether any tore.
bool tear_ties(State& state) {
    return detail::erase_ties(state, [](const Tie& tie) {
               return tie.strength > 0.0f && tie.now == tie.length && tie.tension > tie.strength;
           }) > 0;
}

/// Moves both ends of a capsule, each along a line.
void move_ends(Collider& collider, double part, Scratch::Moving& moving) {
    auto& capsule = std::get<Capsule>(collider.shape);
    const Capsule was = capsule;
    detail::bounds(was, dvec3(0.0), moving.low, moving.high);
    const dvec3 low = moving.low, high = moving.high;
    collider.shape = detail::interpolated(collider, part);
    moving.by = detail::middle_of(capsule) - detail::middle_of(was);
    moving.turn = detail::half_of(capsule) - detail::half_of(was);
    detail::bounds(capsule, dvec3(0.0), moving.low, moving.high);
    moving.low = glm::min(moving.low, low);
    moving.high = glm::max(moving.high, high);
    if (collider.seconds != 0.0) return;
    // It has arrived, up to rounding, and stays.
    collider.half_goal.reset();
    collider.goal = dvec3(centre(collider.shape));
}

/// Moves a collider without turning it.
void translate(Collider& collider, double part, Scratch::Moving& moving) {
    const glm::vec3 was = centre(collider.shape);
    const dvec3 from(was), to = from + part * (collider.goal - from);
    if (glm::vec3(to) != was) collider.shape = detail::clamped_to_world(moved(collider.shape, glm::vec3(to)));
    moving.by = dvec3(centre(collider.shape)) - from;
    moving.turn = dvec3(0.0);
    detail::bounds(collider.shape, moving.by, moving.low, moving.high);
}

/// Adds a drive's motion in the substep. A spinning body gets the bounds of the ball that it sweeps.
void apply_drive(State& state, Collider& collider, Scratch::Moving& moving) {
    const double h = state.settings.substep;
    const dvec3 was(centre(collider.shape));
    collider.shape = detail::driven(collider.shape, collider.drive, h);
    moving.spins = collider.drive.spin != 0.0f;
    moving.inverse_spin = math::conjugate(detail::rotation_after(collider.drive, h));
    moving.middle = dvec3(centre(collider.shape));
    if (const auto* const plane = std::get_if<Plane>(&collider.shape)) {
        const dvec3 normal = detail::unit(dvec3(plane->normal)), by = h * dvec3(collider.drive.velocity);
        moving.by += by - detail::dot(by, normal) * normal;
        return;
    }
    moving.by += moving.middle - was;
    constexpr double edge = max_magnitude;
    collider.goal = glm::clamp(collider.goal + (moving.middle - was), dvec3(-edge), dvec3(edge));
    if (moving.spins) {
        const glm::dquat rotation = math::conjugate(moving.inverse_spin);
        if (collider.half_goal) collider.half_goal = math::rotated(rotation, *collider.half_goal);
        for (Pin& pin : state.pins)
            if (pin.collider == collider.id) pin.goal = math::rotated(rotation, pin.goal);
    }
    double reach = static_cast<double>(size(collider.shape));
    if (const auto* const box = std::get_if<Box>(&collider.shape))
        reach = detail::length(dvec3(box->half_extents));
    if (const auto* const capsule = std::get_if<Capsule>(&collider.shape))
        reach += detail::length(detail::half_of(*capsule));
    const dvec3 first = moving.middle - moving.by;
    moving.low = glm::min(moving.low, glm::min(first, moving.middle) - dvec3(reach));
    moving.high = glm::max(moving.high, glm::max(first, moving.middle) + dvec3(reach));
}

void move_colliders(State& state, Scratch& scratch) {
    for (std::size_t i = 0; i < state.colliders.size(); ++i) {
        Collider& collider = state.colliders[i];
        Scratch::Moving& moving = scratch.colliders[i];
        const double part = detail::part_of(state.settings.substep, collider.seconds);
        (collider.half_goal ? move_ends : translate)(collider, part, moving);
        moving.shape = &collider.shape;
        moving.size = size(collider.shape);
        moving.spins = false;
        if (collider.drive.any()) apply_drive(state, collider, moving);
    }
}

/// Less work than this, about 60 µs on one thread, is not worth another thread.
constexpr std::size_t min_links_per_thread = 1024;
/// Whether the island has a cloth large enough for idle threads to help with.
bool is_shared(const Plan& plan, const Plan::Island& island) {
    const auto is_large = [&](const Plan::Island& part) {
        if (part.grid == 0) return false;
        const Plan::Grid& grid = plan.grids[part.grid - 1];
        return std::size_t{grid.columns} * grid.rows >= detail::min_shared_cells;
    };
    return is_large(island) || std::ranges::any_of(plan.parts_of(island), is_large);
}

/// The number of threads that have work.
std::size_t useful_threads(const State& state, const Plan& plan) {
    std::size_t useful = plan.islands.size();
    for (const Plan::Island& island : plan.islands)
        if (is_shared(plan, island)) useful += island.particles / detail::min_shared_cells;
    return std::min(useful, state.links.size() / min_links_per_thread);
}

}  // namespace

void Workspace::Parts::solve_islands(State& state, bool measures) {
    const std::vector<Plan::Island>& islands = plan.islands;
    const std::size_t useful = useful_threads(state, plan);
    const auto count = static_cast<std::uint32_t>(std::clamp<std::size_t>(useful, 1, threads.size()));
    std::atomic<std::size_t> next{0}, shared_left{0};
    if (count > 1)
        for (const Plan::Island& island : islands) shared_left += is_shared(plan, island) ? 1 : 0;
    const auto solve = [&](std::uint32_t index) noexcept {
        IslandScratch& local = threads[index];
        for (std::size_t i; (i = next.fetch_add(1)) < islands.size();) {
            const bool shared = count > 1 && is_shared(plan, islands[i]);
            if (shared) local.loops.begin();
            local.island = static_cast<std::uint32_t>(i);
            Substep(state, plan, islands[i], scratch, local).run(measures);
            if (!shared) continue;
            local.loops.end();
            shared_left.fetch_sub(1, std::memory_order_release);
        }
        for (std::uint32_t polls = 0; shared_left.load(std::memory_order_acquire) > 0; ++polls) {
            for (std::uint32_t other = 0; other < count; ++other)
                if (threads[other].loops.help()) polls = 0;
            tendril::detail::pause(polls);
        }
    };
    tendril::detail::run_pieces(tasks, count, count, solve);
}

void Workspace::Parts::sum_reports(Advance& done) {
    int passes = 0, shortened = 0;
    for (IslandScratch& thread : threads) {
        passes = std::max(passes, thread.done.passes);
        shortened = std::max(shortened, thread.done.shortened);
        done.work += thread.done.work;
        done.unresolved += thread.done.unresolved;
        done.unconverged += thread.done.unconverged;
        done.fallbacks += thread.done.fallbacks;
        done.suspended += thread.done.suspended;
        done.held_back += thread.done.held_back;
        done.contact_loss += thread.done.contact_loss;
        thread.done = {};
    }
    done.passes += passes;
    done.shortened += shortened;
}

/// Stores the contacts of the substep in the state.
void Workspace::Parts::store_contacts(State& state) {
    if (plan.colliding == 0 && state.contacts.empty()) return;
    std::size_t count = 0;
    for (const BodyContactScratch& island : scratch.body_contacts) count += island.contacts.size();
    state.contacts.reserve(count);
    state.contacts.clear();
    const double per_square = 1.0 / (state.settings.substep * state.settings.substep);
    for (const BodyContactScratch& island : scratch.body_contacts)
        for (const BodyContactScratch::Contact& each : island.contacts)
            if (each.force != dvec3(0.0))
                state.contacts.push_back(
                    {state.links[each.a].a, state.links[each.b].a, per_square * each.force});
    std::sort(state.contacts.begin(), state.contacts.end(),
              [](const BodyContact& p, const BodyContact& q) { return p.a != q.a ? p.a < q.a : p.b < q.b; });
}

Advance World::advance(double seconds, Workspace& workspace, const AdvanceOptions& options) {
    Advance done;
    if (!workspace.parts_) done.accepted = tendril::detail::moved_from("advance", "workspace");
    if (!(seconds >= 0.0 && seconds <= 1e9))
        done.accepted = tendril::detail::refused("advance", "seconds", "0 to 1e9", seconds);
    if (!done.accepted) return done;
    workspace.parts_->torn.clear();
    workspace.parts_->begin_impulses(state_, options.impulses);
    const double substep = state_.settings.substep;
    // Drops whole substeps only: a dropped remainder would not be counted.
    constexpr double rounding = 1e-6;  // relative to a substep
    const double over = std::max(0.0, seconds - static_cast<double>(state_.settings.longest_frame));
    done.dropped = static_cast<std::uint64_t>(over / substep + rounding);
    double left = state_.remainder + std::max(0.0, seconds - static_cast<double>(done.dropped) * substep);
    const auto due = static_cast<std::uint64_t>(left / substep + rounding);
    if (due > options.max_substeps) {
        const std::uint64_t more = due - options.max_substeps;
        left = std::max(0.0, left - static_cast<double>(more) * substep);
        done.dropped += more;
    }
    const auto is_due = [&] { return left >= substep * (1.0 - rounding); };
    Workspace::Parts& parts = *workspace.parts_;
    const bool steps = is_due();
    if (steps) parts.prepare(state_);                   // allocates, so this comes before any change
    constexpr auto countable = std::uint64_t{1} << 53;  // exactly representable in a file's numbers
    state_.dropped = std::min(state_.dropped + done.dropped, countable);
    const auto store_remainder = [&] { state_.remainder = std::min(left, substep); };
    store_remainder();
    while (is_due()) {
        left = std::max(0.0, left - substep);
        move_colliders(state_, parts.scratch);
        parts.solve_islands(state_, !is_due());
        parts.sum_reports(done);
        ++done.substeps;
        ++state_.substeps;
        store_remainder();
        detail::advect_gusts(state_);
        state_.displaced_in = substep;
        parts.store_contacts(state_);
        parts.add_impulses(state_);
        const bool torn = parts.plan.tears && tear_links(state_, parts.torn), untied = tear_ties(state_);
        if (torn || untied) parts.replan(state_);
    }
    if (steps) parts.prepared = true;
    done.torn = parts.torn;
    done.impulses = parts.reported_impulses();
    return done;
}

}  // namespace tendril::rope
