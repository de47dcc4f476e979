#include "app/labs/rope/rope_time.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <stdexcept>
#include <tendril/chain/segment.hpp>
#include <thread>
#include <utility>

#include "app/io/text.hpp"
#include "app/labs/kit/arguments.hpp"
#include "app/labs/kit/motion.hpp"
#include "app/labs/kit/race.hpp"
#include "app/labs/rope/numbers.hpp"
#include "app/labs/rope/rope_edit.hpp"
#include "app/labs/rope/rope_part.hpp"
#include "tendril/elementary.hpp"

namespace tendril::app {
namespace {

constexpr float still_speed = 1e-4f;  ///< m/s

/// A pseudo-random number from 0 to 1; unlike the standard's distributions, the same on every machine.
double shuffled(std::uint32_t number) {
    std::uint32_t x = number + 0x9e3779b9u;
    x = (x ^ (x >> 16)) * 0x85ebca6bu;
    x = (x ^ (x >> 13)) * 0xc2b2ae35u;
    return static_cast<double>(x ^ (x >> 16)) / 4294967295.0;
}

/// Starts the motion of swinging and walking colliders to their positions at `time`, one tick ahead.
void aim(const RopePart& part, NamedWorld& world, double time) {
    for (const Swing& swing : part.swings)
        world.change(swing.collider, &rope::World::move_collider, swing_point(swing, time),
                     world.world().pending() + tick_seconds);
    if (part.walker.figure) aim_walker(part.walker, world, time - tick_seconds, time);
}

/// The remaining work of a tick, and the solver's reports so far.
struct Tick {
    std::uint64_t work_left = max_lab_work;
    bool begun = false;
    RopeReport report;
    std::vector<ColliderForce> impulses{};
};

void advance(RopePart& part, NamedWorld& world, double seconds, rope::Workspace& workspace, Tick& tick) {
    const std::uint64_t each = std::max(work_of_substep(world), std::uint64_t{1});
    // Always allow one substep: otherwise a world that is too large would silently stop.
    const std::uint64_t most = std::max(tick.work_left / each, std::uint64_t{!tick.begun});
    const rope::Advance done = world.advance(seconds, workspace, most);
    tick.begun = tick.begun || done.substeps > 0;
    tick.work_left -= std::min(tick.work_left, each * static_cast<std::uint64_t>(done.substeps));
    RopeReport& report = tick.report;
    report.inside =
        std::max(report.inside, done.unresolved / static_cast<std::uint64_t>(std::max(done.substeps, 1)));
    report.unconverged += done.fallbacks + done.unconverged;
    report.suspended += done.suspended;
    report.substeps += static_cast<std::uint64_t>(done.substeps);
    report.dropped += done.dropped;
    report.contact_loss += static_cast<float>(done.contact_loss);
    for (const rope::ColliderImpulse& push : done.impulses) {
        const auto found = std::ranges::find(tick.impulses, push.collider, &ColliderForce::collider);
        if (found == tick.impulses.end())
            tick.impulses.push_back({push.collider, push.linear});
        else
            found->newtons += push.linear;
    }
    for (const auto& [id, link] : done.torn) {
        const rope::Body& body = *world.world().find(id);
        const std::string& name = world.name(body);
        if (std::ranges::find(part.tears, name, &RopeTear::body) == part.tears.end())
            part.tears.push_back({name, link.a - body.first, link.tension});
    }
}

/// Advances by a frame. If anything swings or walks, the frame is split at the lab's ticks, where its next
/// motion starts, so that the result does not depend on how time is divided.
void pass_frame(RopePart& part, NamedWorld& world, double seconds, rope::Workspace& workspace, Tick& tick) {
    constexpr double rounding = 1e-6;  // fraction of a tick
    if (part.swings.empty() && !part.walker.figure) {
        advance(part, world, seconds, workspace, tick);
        part.time += seconds;
        return;
    }
    while (seconds > rounding * tick_seconds) {
        const double ticks = part.time / tick_seconds;
        const bool at_tick = std::abs(ticks - std::round(ticks)) < rounding;
        const double next = ((at_tick ? std::round(ticks) : std::floor(ticks)) + 1.0) * tick_seconds;
        if (at_tick) aim(part, world, next);
        const double piece = std::min(seconds, next - part.time);
        advance(part, world, piece, workspace, tick);
        part.time += piece;
        seconds -= piece;
    }
}

std::shared_ptr<const NamedWorld> with_settings(std::shared_ptr<const NamedWorld> world,
                                                rope::Settings settings, rope::Solver solver) {
    settings.solver = solver;
    if (world->settings() == settings) return world;
    auto changed = std::make_shared<NamedWorld>(*world);
    changed->set_settings(settings);
    return changed;
}

/// If a rival has the own world's new solver, the two swap places; the rival gets the solver that it `had`.
void change_places(RopePart& part, rope::Solver had) {
    const rope::Solver now = part.solver();
    for (RopeRacer& rival : part.rivals) {
        if (now == had || rival.solver() != now) continue;
        std::swap<RopeRacer>(part, rival);
        part.forces.reset();
        part.tears.clear();
        rival.world = with_settings(rival.world, rival.world->settings(), had);
    }
}

}  // namespace

RopeRuntime::RopeRuntime() {
    const unsigned cores = std::thread::hardware_concurrency();
    for (rope::Workspace* each : {&workspace, &of_rivals[0], &of_rivals[1]})
        (void)each->use_threads(static_cast<int>(std::clamp(cores, 1u, 4u)));  // in range
}

RopeReport pass_time(RopePart& part, double seconds, rope::Workspace& workspace) {
    constexpr double rounding = 1e-9;  // seconds: four ticks are a frame of 15 Hz
    auto world = std::make_shared<NamedWorld>(*part.world);
    const auto moved = [](const rope::Pin& pin) { return pin.seconds > 0.0; };
    Tick tick;
    if (holds(part) || std::ranges::any_of(world->state().pins, moved)) tick.work_left = max_dragged_work;
    Jitter& jitter = part.jitter;
    if (jitter.dial == 0.0f && jitter.rate == 60.0f) {
        if (jitter.pending > 0.0)
            pass_frame(part, *world, std::exchange(jitter.pending, 0.0), workspace, tick);
        jitter.frame = 0.0;
        pass_frame(part, *world, seconds, workspace, tick);
    } else {
        jitter.pending += seconds;
        if (jitter.frame == 0.0) jitter.frame = jitter_frame(jitter, jitter.frames);
        while (jitter.pending + rounding >= jitter.frame) {
            jitter.pending = std::max(jitter.pending - jitter.frame, 0.0);
            pass_frame(part, *world, jitter.frame, workspace, tick);
            jitter.frame = jitter_frame(jitter, ++jitter.frames);
        }
    }
    if (const std::uint64_t substeps = tick.report.substeps; substeps > 0) {
        part.forces = std::move(tick.impulses);
        for (ColliderForce& each : *part.forces)
            each.newtons /= static_cast<double>(substeps) * world->settings().substep;
    }
    const auto whole = [](const rope::State& of) {
        const auto links = std::ranges::count(of.links, rope::Link::Kind::Stretch, &rope::Link::kind);
        return of.ties.size() + static_cast<std::uint64_t>(links);
    };
    tick.report.torn = whole(part.world->state()) - whole(world->state());
    part_torn(part, *world, *part.world);
    part.world = std::move(world);
    if (tick.report.torn > 0) forget_missing(part);
    return tick.report;
}

namespace {

/// Elimination, which solves a cloth with more than a few ties per side, grows with the cube of its side.
std::uint64_t work_of_tied_cloth(const rope::State& state) {
    double work = 0.0;
    for (const rope::Body& body : state.bodies) {
        const auto holds = [&](const rope::Tie& tie) {
            return tie.a - body.first < body.count || tie.b - body.first < body.count;
        };
        if (body.kind != rope::Body::Kind::Cloth) continue;
        const auto ties =
            static_cast<std::size_t>(std::count_if(state.ties.begin(), state.ties.end(), holds));
        const auto count = static_cast<double>(body.count);
        if (ties * ties > 4 * body.count) work += 100.0 * count * std::sqrt(count);
    }
    return static_cast<std::uint64_t>(work);
}

/// One row for each tick and solver of the last ten seconds.
std::string rope_race_csv(const Workspace& workspace) {
    const RopePart& part = rope_part(workspace);
    if (part.rivals.empty()) throw Refused("no race is open");
    std::string csv = "solver,seconds,length_error,as_solved,energy,microseconds\n";
    for (const RopeRacer& racer : rope_racers(part)) {
        for (std::size_t i = 0; i < racer.samples.size(); ++i) {
            const RopeSample& at = racer.samples[i];
            char line[160];
            std::snprintf(line, sizeof line, "%s,%.4f,%.9g,%.9g,%.9g,%.1f\n",
                          rope_solvers.name(racer.solver()), static_cast<double>(i) * tick_seconds,
                          static_cast<double>(at.error), static_cast<double>(at.stretch),
                          static_cast<double>(at.energy), static_cast<double>(at.cost));
            csv += line;
        }
    }
    return csv;
}

}  // namespace

std::uint64_t work_of_substep(const NamedWorld& world) {
    const rope::State& state = world.state();
    const auto attached = static_cast<std::uint64_t>(
        std::count_if(state.pins.begin(), state.pins.end(),
                      [](const rope::Pin& pin) { return static_cast<bool>(pin.collider); }));
    return state.links.size() * static_cast<std::uint64_t>(state.settings.iterations) +
           state.position.size() + (1 + attached) * state.colliders.size() + work_of_tied_cloth(state);
}

double jitter_frame(const Jitter& jitter, std::uint32_t number) {
    const double even = jitter.rate == 60.0f ? tick_seconds : 1.0 / static_cast<double>(jitter.rate);
    const double where = 2.0 * shuffled(number) - 1.0;
    const double end = where < 0.0 ? min_jitter_frame : max_jitter_frame;
    const double frame = even * math::exponential(std::abs(where) * static_cast<double>(jitter.dial) *
                                                  math::logarithm(end / even));
    return std::clamp(frame, min_jitter_frame, max_jitter_frame);
}

glm::vec3 swing_point(const Swing& swing, double time) {
    return swing.middle + static_cast<float>(math::sine(round_angle(time, swing.period))) * swing.swing;
}

void require(const Swing& swing) {
    check_path(swing.middle, swing.swing, "its swing");
}

bool at_rest(const RopePart& part) {
    const rope::State& state = part.world->state();
    const auto on_its_way = [](const rope::Pin& pin) { return pin.seconds > 0.0; };
    if (part.walker.figure && !part.walker.clip.empty()) return false;
    const auto driven = [](const rope::Collider& each) { return each.drive.any() || each.seconds > 0.0; };
    const auto draws = [](const rope::Tie& tie) { return tie.now != tie.length; };
    if (!part.swings.empty() || std::ranges::any_of(state.colliders, driven) ||
        std::ranges::any_of(state.pins, on_its_way) || std::ranges::any_of(state.ties, draws))
        return false;
    for (std::size_t i = 0; i < part.world->size(); ++i)
        if (glm::length(part.world->velocity(i)) > still_speed) return false;
    return true;
}

bool in_range(const NamedWorld& world) {
    const auto& positions = world.state().position;
    return std::all_of(positions.begin(), positions.end(), [](const glm::dvec3& at) {
        return glm::all(glm::lessThan(glm::abs(at), glm::dvec3(max_magnitude)));
    });
}

RopeSample last_sample(const RopeRacer& racer) {
    return racer.samples.empty() ? sample_of(*racer.world) : racer.samples.back();
}

std::vector<std::reference_wrapper<const RopeRacer>> rope_racers(const RopePart& part) {
    std::vector<std::reference_wrapper<const RopeRacer>> racers{part};
    racers.insert(racers.end(), part.rivals.begin(), part.rivals.end());
    return racers;
}

const RopeRacer& racer_in(const RopePart& part, std::size_t pane) {
    return pane == 0 || pane > part.rivals.size() ? part : part.rivals[pane - 1];
}

void begin_race(RopePart& part) {
    part.samples.clear();
    part.rivals.clear();
    for (const rope::Solver solver : {rope::Solver::Direct, rope::Solver::Xpbd, rope::Solver::Relaxation})
        if (solver != part.solver())
            part.rivals.push_back({with_settings(part.world, part.world->settings(), solver), {}, part.hold});
}

RopePart part_of_rival(const RopePart& part, const RopeRacer& rival) {
    RopePart same = part;
    static_cast<RopeRacer&>(same) = rival;
    same.rivals.clear();
    return same;
}

void change_rivals(RopePart& part, const RopePart& old, const std::function<void(RopePart&)>& change) {
    for (RopeRacer& rival : part.rivals) {
        RopePart same = part_of_rival(old, rival);
        try {
            change(same);
        } catch (const Refused&) {
            continue;
        } catch (const std::logic_error&) {
            continue;
        }
        same.world = with_settings(same.world, same.world->settings(), rival.solver());
        rival = std::move(same);
    }
    change_places(part, old.solver());
}

void take_settings(RopePart& part, const rope::Settings& settings) {
    const rope::Solver had = part.solver();
    part.world = with_settings(part.world, settings, settings.solver);
    for (RopeRacer& rival : part.rivals) rival.world = with_settings(rival.world, settings, rival.solver());
    change_places(part, had);
}

glm::vec3 rope_solver_colour(const Palette& palette, rope::Solver solver) {
    return racer_colour(palette, static_cast<std::size_t>(solver));
}

std::string racer_text(const RopeSample& last) {
    return "length error " + share_text(last.error) + ", " + fixed_text(static_cast<double>(last.energy), 2) +
           " J";
}

std::vector<PaneTitle> rope_panes(const RopePart& part, const Palette& palette, bool cost) {
    std::vector<PaneTitle> titles;
    if (part.rivals.empty()) return titles;
    for (const RopeRacer& racer : rope_racers(part)) {
        const std::string measured = cost ? cost_text(racer.samples) : "";
        const std::string time = measured.empty() ? "" : ", " + measured;
        titles.push_back({rope_solvers.title(racer.solver()), racer_text(last_sample(racer)) + time,
                          rope_solver_colour(palette, racer.solver())});
    }
    return titles;
}

void add_rope_race_commands(CommandTable& table) {
    table.add(part_command<RopePart>(
        rope_lab, "rope.race", "Race the rope solvers",
        {switch_argument("on", "false: ends the race; default: true, again: starts it from here")},
        "Runs the scene by each solver, side by side; drags and commands change all of them",
        [](RopePart& part, const Arguments& given) {
            if (!given.has("on") || given.boolean("on")) {
                begin_race(part);
                part.quiet_ticks = 0;
            } else {
                if (part.rivals.empty()) throw Refused("no race is open");
                part.rivals.clear();
            }
        }));
    add_race_csv_commands(table,
                          {.race = "rope.race",
                           .title = "the rope race as CSV",
                           .holds = "each solver's length error, energy and cost in the last ten seconds",
                           .text = rope_race_csv});
}

}  // namespace tendril::app
