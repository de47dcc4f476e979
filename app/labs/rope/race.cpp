#include "app/labs/rope/race.hpp"

#include <algorithm>
#include <cstdio>
#include <stdexcept>
#include <utility>

#include "app/document/units.hpp"
#include "app/labs/kit/arguments.hpp"
#include "app/labs/kit/race.hpp"
#include "app/labs/rope/numbers.hpp"
#include "app/labs/rope/rope_edit.hpp"

namespace tendril::app {
namespace {

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
