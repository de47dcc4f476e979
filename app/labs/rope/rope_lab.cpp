#include "app/labs/rope/rope_lab.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "app/document/runtime.hpp"
#include "app/io/text.hpp"
#include "app/labs/kit/arguments.hpp"
#include "app/labs/kit/past.hpp"
#include "app/labs/rope/body_commands.hpp"
#include "app/labs/rope/numbers.hpp"
#include "app/labs/rope/panel.hpp"
#include "app/labs/rope/rope_time.hpp"

namespace tendril::app {
namespace {

constexpr int resting_ticks = 60;  ///< the lab stops after this many ticks at rest

/// A tick of a world, and its sample. Off-screen images and states contain no timings: those are measured in
/// live windows, and in a race for its CSV.
void pass_tick(RopePart& part, const Clock& clock, bool measured, rope::Workspace& workspace) {
    using Time = std::chrono::steady_clock;
    const Time::time_point start = measured ? Time::now() : Time::time_point();
    const RopeReport report = pass_time(part, tick_seconds * static_cast<double>(clock.speed), workspace);
    if (!in_range(*part.world)) throw std::out_of_range("something would move farther than 1e9 m");
    RopeSample sample = sample_of(part, report);
    if (measured) sample.cost = std::chrono::duration<float, std::micro>(Time::now() - start).count();
    if (part.samples.size() >= max_rope_samples) part.samples.erase(part.samples.begin());
    part.samples.push_back(sample);
}

std::optional<Bounds> selection_bounds(const RopePart& part) {
    if (!part.selection) return std::nullopt;
    const NamedWorld& world = *part.world;
    if (const rope::Collider* collider = world.find_collider(part.selection->collider))
        return Bounds{rope::centre(collider->shape), std::max(2.0f * rope::size(collider->shape), 0.2f)};
    if (const rope::Tie* tie = world.find_tie(part.selection->tie)) {
        const glm::vec3 a = world.position(tie->a), b = world.position(tie->b);
        return bounds_of(glm::min(a, b), glm::max(a, b), 0.3f);
    }
    const rope::Body* body = world.find(part.selection->body);
    if (body == nullptr) return std::nullopt;
    glm::vec3 low(1e30f), high(-1e30f);
    for (const std::size_t i : part.selection->particles.all()) {
        low = glm::min(low, world.position(body->first + i));
        high = glm::max(high, world.position(body->first + i));
    }
    return bounds_of(low, high, 0.3f);
}

}  // namespace

void include_shape(const rope::Shape& shape, glm::vec3& low, glm::vec3& high) {
    const auto take = [&](glm::vec3 centre, glm::vec3 extent) {
        low = glm::min(low, centre - extent);
        high = glm::max(high, centre + extent);
    };
    if (const auto* sphere = std::get_if<rope::Sphere>(&shape)) {
        take(sphere->centre, glm::vec3(sphere->radius));
    } else if (const auto* capsule = std::get_if<rope::Capsule>(&shape)) {
        take(capsule->a, glm::vec3(capsule->radius));
        take(capsule->b, glm::vec3(capsule->radius));
    } else if (const auto* box = std::get_if<rope::Box>(&shape)) {
        take(box->centre, glm::vec3(glm::length(box->half_extents)));
    }
}

std::shared_ptr<Part> RopeLab::blank() const {
    return std::make_shared<RopePart>(make_rope_scene(rope_scenes().front()));
}

CameraPose RopeLab::first_view() const {
    return rope_scenes().front().view;
}

void RopeLab::add_commands(CommandTable& table) const {
    add_world_commands(table);
    add_body_commands(table);
    add_collider_commands(table);
    add_tie_commands(table);
    add_collision_commands(table);
    add_look_commands(table);
    add_walker_commands(table);
    add_rope_race_commands(table);
}

bool RopeLab::moving(const Workspace& workspace) const {
    return rope_part(workspace).quiet_ticks < resting_ticks;
}

void RopeLab::step(Workspace& workspace) const {
    const bool modified = workspace.modified();
    const Clock& clock = workspace.clock;
    auto& runtime = workspace.runtimes.of<RopeRuntime>(rope_lab);
    const auto before = workspace.document.parts().at(rope_lab);
    const auto stopped = guarded_step<RopePart>(workspace, rope_lab, [&](RopePart& part) {
        if (!part.start) part.start = before;
        const std::uint64_t substeps = part.world->state().substeps;
        const bool measured = clock.measured || !part.rivals.empty();
        bool rests = true;
        for (std::size_t i = 0; i < part.rivals.size(); ++i) {
            RopePart same = part_of_rival(part, part.rivals[i]);
            pass_tick(same, clock, measured, runtime.of_rivals[i]);
            rests = rests && at_rest(same);
            part.rivals[i] = std::move(same);
        }
        pass_tick(part, clock, measured, runtime.workspace);
        // A tick without a substep does not show whether the ropes rest.
        const bool moved_on = part.world->state().substeps != substeps;
        part.quiet_ticks = !rests || !at_rest(part) ? 0 : part.quiet_ticks + (moved_on ? 1 : 0);
    });
    if (stopped) {
        workspace.clock.playing = false;
        workspace.toast("The simulation is paused: " + *stopped, ToastKind::Refusal);
    } else if (!modified) {
        workspace.saved = workspace.document;  // playing does not modify the scene
    }
}

std::uint64_t RopeLab::tick_work(const Workspace& workspace) const {
    const RopePart& part = rope_part(workspace);
    const double substeps =
        tick_seconds * static_cast<double>(workspace.clock.speed) / part.world->settings().substep;
    return work_of_substep(*part.world) * (1 + part.rivals.size()) *
           static_cast<std::uint64_t>(std::ceil(substeps));
}

std::vector<PaneTitle> RopeLab::panes(const Workspace& workspace) const {
    return rope_panes(rope_part(workspace), palette(workspace.settings.theme), workspace.clock.measured);
}

std::vector<Shortcut> RopeLab::shortcuts() const {
    return {delete_shortcut("rope.remove_selected")};
}

std::vector<MouseHelp> RopeLab::mouse_help() const {
    return {
        {"Left click", "selects, pins or unpins, cuts or ties, as the panel says"},
        {"Left drag with Cut", "cuts the ropes and cloths that it crosses"},
        {"Double-click on a rope", "selects all of it; its arrows then move it with its pins"},
        {"Shift+click on a rope", "adds a particle to the selection, or takes it out"},
        {"Ctrl+drag on nothing", "draws a box that selects particles of one rope; with Shift it adds them"}};
}

/// The opening: a ball swings through the ropes lying on it.
std::vector<CommandCall> RopeLab::opening() const {
    return {
        {"rope.collider.swing", {{"name", "ball"}, {"by", glm::vec3(0.0f, 0.12f, 0.3f)}, {"period", 4.0f}}}};
}

std::vector<CommandCall> RopeLab::calm() const {
    return {{"rope.collider.swing", {{"name", "ball"}, {"by", glm::vec3(0.0f)}}}};
}

Bounds RopeLab::bounds(const Workspace& workspace, bool selection_only) const {
    const RopePart& part = rope_part(workspace);
    if (selection_only) {
        if (const auto chosen = selection_bounds(part)) return *chosen;
    }
    constexpr float none = 1e30f;
    glm::vec3 low(none), high(-none);
    for (const RopeRacer& racer : rope_racers(part)) {
        for (const glm::vec3& at : racer.world->positions()) {
            low = glm::min(low, at);
            high = glm::max(high, at);
        }
    }
    for (const rope::Collider& collider : part.world->state().colliders)
        include_shape(collider.shape, low, high);
    if (low.x > high.x) return {{0.0f, 1.0f, 0.0f}, 1.5f};
    return bounds_of(low, high, 0.2f);
}

namespace {

/// True if links are meant to stretch.
bool stretches(const NamedWorld& world) {
    if (world.settings().compliance > 0.0f) return true;
    return std::ranges::any_of(world.state().links, [](const rope::Link& link) {
        return link.kind == rope::Link::Kind::Stretch && link.compliance > 0.0f;
    });
}

/// The body with the largest length error.
const rope::Body& worst_body(const NamedWorld& world) {
    const auto error = [&](const rope::Body& body) { return world.length_error(body); };
    return *std::ranges::max_element(world.state().bodies, {}, error);
}

/// True if a body's link with the largest strain is compressed.
bool squeezed(const rope::State& state, const rope::Body& body) {
    double worst = 0.0;  // strain
    for (const rope::Link& each : state.links) {
        if (each.kind != rope::Link::Kind::Stretch || each.a - body.first >= body.count || each.rest <= 0.0f)
            continue;
        const double strain = glm::distance(state.position[each.a], state.position[each.b]) / each.rest - 1.0;
        if (std::abs(strain) > std::abs(worst)) worst = strain;
    }
    return worst < 0.0;
}

constexpr const char* halve_substep = "Halve the substep";

/// None at the minimum, where a tick already drops substeps, nor for work that it would drop.
std::optional<Cure> shorter_substeps(const RopePart& part) {
    const bool drops = last_second(part.samples).dropped > 0;
    const double now = part.world->settings().substep, half = std::max(0.5 * now, rope::min_substep);
    const auto work = 2.0 * tick_seconds / now * static_cast<double>(work_of_substep(*part.world));
    if (!(half < now) || drops || work > static_cast<double>(max_lab_work)) return std::nullopt;
    return Cure{halve_substep,
                "Runs rope.settings: " + fixed_text(1.0 / half, 0) +
                    " substeps a second, for twice the time to compute",
                {{"rope.settings", {{"substep", half}}}}};
}

constexpr double slow_share = 1.0 - max_stall;  ///< a single stall does not take the rate below this
constexpr const char* real_time = " % of real time";
std::string at_pace(double kept) {
    return ", at " + fixed_text(5.0 * std::round(20.0 * kept), 0) + real_time;
}

/// True if the pins are the two ends of a tie.
bool is_a_tie(const OverPulled& pulled, const rope::State& state) {
    return pulled.way.size() == 2 && std::ranges::any_of(state.ties, [&](const rope::Tie& tie) {
               return std::ranges::count(pulled.way, tie.a) == 1 &&
                      std::ranges::count(pulled.way, tie.b) == 1;
           });
}

}  // namespace

Cure restart_cure() {
    return {"Restart",
            "Returns everything to its state after the last change; undo returns here",
            {{"rope.restart", {}}}};
}

std::optional<Cure> restart_of_torn(const RopePart& part) {
    const auto joints = [](const RopePart& at) {
        return at.world->state().links.size() + at.world->state().ties.size();
    };
    if (!part.start || joints(dynamic_cast<const RopePart&>(*part.start)) <= joints(part))
        return std::nullopt;
    return restart_cure();
}

Verdict rope_verdict(const RopePart& part) {
    constexpr double seen = 0.01;  // fraction of its length: visibly too long
    if (part.world->state().bodies.empty())
        return {"No ropes", Verdict::Kind::Open, "Add a rope, cloth or hair, or open a preset."};
    // An opened scene is judged as it is before its first tick.
    const RopeSample last = part.samples.empty() ? sample_of(part, {}) : part.samples.back();
    const RopeReport report = last_second(part.samples);
    const auto error = static_cast<double>(last.error), before = static_cast<double>(last.stretch);
    if (report.inside > 0)
        return {"Inside a collider", Verdict::Kind::Bad,
                std::to_string(report.inside) + " particles cannot get out. Move the body or a collider."};
    const std::string percent =
        error < 1e-4 ? "under 0.01 %" : fixed_text(100.0 * error, error < 0.1 ? 2 : 0) + " %";
    const std::string off = "Lengths off by " + percent;
    // Report this however small it is: no solver can fix it, so other advice would mislead.
    if (const std::vector<OverPulled> pulled = over_pulled(*part.world); !pulled.empty()) {
        const OverPulled& worst = pulled.front();
        const int decimals = worst.apart - worst.length < 0.01 ? 3 : 2;
        const bool one = worst.from == worst.to;
        if (is_a_tie(worst, part.world->state()))
            return {"A tie cannot close", Verdict::Kind::Bad,
                    "It joins pins " + fixed_text(worst.apart, decimals) + " m apart and is " +
                        fixed_text(worst.length, decimals) + " m long. Unpin one of them."};
        return {off, Verdict::Kind::Bad,
                (holds(part) ? "The pins and the drag of " : "The pins of ") + worst.from +
                    (one ? "" : " and " + worst.to) + " are " + fixed_text(worst.apart, decimals) +
                    " m apart; " + (one ? "between them it is " : "tied, the two reach ") +
                    fixed_text(worst.length, decimals) + (one ? " m long." : " m.")};
    }
    std::uint64_t torn = 0;
    for (const RopeSample& each : part.samples) torn += each.report.torn;
    if (torn > 0)
        return {"Torn", Verdict::Kind::Open,
                count_text(torn, "link") + " tore in the last ten seconds: drag the timeline back to see it.",
                restart_of_torn(part)};
    if (error >= seen) {
        if (before < 0.5 * error)
            return {off, Verdict::Kind::Bad, "Contact displaced links after the solve."};
        if (stretches(*part.world)) {
            const rope::Body& worst = worst_body(*part.world);
            const bool slack = squeezed(part.world->state(), worst);
            return {
                (slack ? "Squeezed by " : "Stretched by ") + percent, Verdict::Kind::Open,
                part.world->name(worst) +
                    (slack ? " is shorter than its rest length; it lengthens once it moves."
                           : " may stretch: its own stretch, or the compliance under Solver, is above 0.")};
        }
        return {off, Verdict::Kind::Bad, "The solver did not hold them: use more iterations or substeps.",
                shorter_substeps(part)};
    }
    if (last.report.suspended > 0)
        return {"Neither held nor falling", Verdict::Kind::Bad,
                "Nothing holds or touches it, and it does not fall: it is at the edge of the world."};
    if (report.unconverged > 0)
        return {"Did not converge", Verdict::Kind::Open,
                count_text(report.unconverged, "step") +
                    " of the last second: shorter substeps help, and cost more.",
                shorter_substeps(part)};
    const bool passes = std::ranges::any_of(part.world->state().bodies, [&](const rope::Body& body) {
        const std::string& name = part.world->name(body);
        return body.kind == rope::Body::Kind::Cloth && !part.world->collides(name, name);
    });
    if (const double all = static_cast<double>(report.substeps + report.dropped); report.dropped > 0) {
        const double kept = static_cast<double>(report.substeps) / all;
        const auto longest = 1e3 * static_cast<double>(part.world->settings().longest_frame);
        if (kept < slow_share)
            return {"Lengths hold" + at_pace(kept), Verdict::Kind::Open,
                    holds(part)
                        ? "While you drag, so large a scene takes fewer substeps, to keep up with the mouse."
                        : "Frames are longer than the longest frame, " + fixed_text(longest, 1) +
                              " ms, or too much work for a tick: some of their time is dropped."};
    }
    return {
        "Lengths hold", Verdict::Kind::Good,
        "The worst link is off by " + percent + "." + (passes ? " Cloth does not collide with itself." : "")};
}

Verdict paced_verdict(Verdict said, const Workspace& workspace) {
    const double kept = pace_of(workspace.runtimes).kept;
    if (!workspace.clock.playing || kept >= slow_share || said.text.ends_with(real_time)) return said;
    said.text += at_pace(kept);
    if (said.cure && said.cure->title == halve_substep) said.cure.reset();  // would be slower still
    if (said.kind != Verdict::Kind::Good) return said;
    said.kind = Verdict::Kind::Open;
    // If ropes take less than half of a tick, something else is slow.
    const double cost = cost_of_tick(rope_part(workspace).samples);
    said.why = cost > 0.5 * tick_seconds
                   ? "A tick takes " + si_text(cost, "s") +
                         " of its 16.7 ms: fewer particles or substeps are faster."
                   : "Ropes take " + si_text(cost, "s") +
                         " of a tick's 16.7 ms: drawing, or another program, takes the time.";
    return said;
}

}  // namespace tendril::app
