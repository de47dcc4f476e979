#include "app/labs/chain/race.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <glm/geometric.hpp>

namespace tendril::app {
namespace {

constexpr int timings = 5;

Racer run(ik::Method method, const Chain& chain, const ReachSettings& settings, glm::vec3 target) {
    using Clock = std::chrono::steady_clock;
    Racer racer;
    racer.method = method;
    const std::vector<glm::vec3> start = positions(chain);
    std::vector<float> residuals(static_cast<std::size_t>(settings.iterations));
    ik::Solver solver(chain);
    ik::Options options = solver_options(settings, solver.reach());
    options.residuals = residuals;
    for (int i = 0; i < timings; ++i) {
        racer.joints = start;
        ik::State state = make_state(settings, solver.bones());
        const auto from = Clock::now();
        racer.report = solver.solve(method, racer.joints, state, target, options);
        const double took = std::chrono::duration<double, std::micro>(Clock::now() - from).count();
        racer.microseconds = i == 0 ? took : std::min(racer.microseconds, took);
    }
    racer.residuals = {glm::distance(start.back(), target)};
    const auto done = std::min(static_cast<std::size_t>(racer.report.iterations), residuals.size());
    racer.residuals.insert(racer.residuals.end(), residuals.begin(),
                           residuals.begin() + static_cast<std::ptrdiff_t>(done));
    return racer;
}

}  // namespace

Race run_race(const Chain& chain, const ReachSettings& settings, glm::vec3 target, const Racers& racers) {
    Race race;
    race.tolerance = reach_tolerance(settings, chain.reach());
    for (const ik::Method method : ik::all_methods) {
        if (racers[static_cast<std::size_t>(method)])
            race.racers.push_back(run(method, chain, settings, target));
    }
    return race;
}

std::string race_csv(const Race& race) {
    std::string csv = "solver,iteration,residual,microseconds,status\n";
    for (const Racer& racer : race.racers) {
        const auto last = static_cast<double>(std::max<std::size_t>(racer.residuals.size() - 1, 1));
        for (std::size_t i = 0; i < racer.residuals.size(); ++i) {
            char line[160];
            std::snprintf(line, sizeof line, "%s,%zu,%.9g,%.3f,%s\n", ik::name(racer.method), i,
                          static_cast<double>(racer.residuals[i]),
                          racer.microseconds * static_cast<double>(i) / last,
                          i + 1 == racer.residuals.size() ? ik::name(racer.report.status) : "");
            csv += line;
        }
    }
    return csv;
}

}  // namespace tendril::app
