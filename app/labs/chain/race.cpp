#include "app/labs/chain/race.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <glm/geometric.hpp>
#include <tendril/ik/solver.hpp>

#include "app/document/units.hpp"
#include "app/labs/chain/chain_runtime.hpp"

namespace tendril::app {
namespace {

constexpr int timings = 5;

/// Sees what the microscope sees: the same curve, and whether the best pose came back in the end.
class Watch final : public ik::Observer {
  public:
    explicit Watch(Racer& racer) : racer_(racer) {}
    void step(const ik::Step& step) noexcept override {
        if (step.phase == ik::Phase::RestoreBest) racer_.restored = true;
    }
    void iteration_done(int, float residual) noexcept override {
        racer_.residuals.push_back(residual);
        racer_.restored = false;  // what came back before goes on
    }

  private:
    Racer& racer_;
};

Racer run(ik::Method method, const Chain& chain, const ReachSettings& settings, glm::vec3 target,
          ChainRuntime& runtime) {
    using Clock = std::chrono::steady_clock;
    Racer racer;
    racer.method = method;
    const std::vector<glm::vec3> start = positions(chain);
    ik::Solver& solver = runtime.solver(chain);
    ReachSettings each = settings;
    const ik::State begin = state_for(each, solver.bones());
    const ik::Options options = solver_options(each, solver.reach());
    Watch watch(racer);
    const auto solve = [&](ik::Observer* observer) {
        racer.joints = start;
        each.state = begin;
        racer.report = solver.solve(method, racer.joints, each.state, target, options, observer);
    };
    solve(&watch);
    if (racer.residuals.empty()) racer.residuals = {glm::distance(start.back(), target)};
    for (int i = 0; i < timings; ++i) {
        const auto from = Clock::now();
        solve(nullptr);
        const double took = std::chrono::duration<double, std::micro>(Clock::now() - from).count();
        racer.microseconds = i == 0 ? took : std::min(racer.microseconds, took);
    }
    return racer;
}

}  // namespace

Race run_race(const Chain& chain, const ReachSettings& settings, glm::vec3 target, const Racers& racers,
              ChainRuntime& runtime) {
    Race race;
    race.within_limits = !settings.limits.empty();
    race.tolerance = reach_tolerance(settings, chain.reach());
    for (const ik::Method method : ik::all_methods) {
        if (racers[static_cast<std::size_t>(method)])
            race.racers.push_back(run(method, chain, settings, target, runtime));
    }
    return race;
}

std::string end_text(const Racer& racer) {
    return std::string(ik::name(racer.report.status)) + ", " +
           si_text(static_cast<double>(racer.residuals.back()), "m") + " from the target";
}

std::string restored_text(const Racer& racer) {
    if (!racer.restored) return {};
    return "best pose restored: " + si_text(static_cast<double>(racer.report.residual), "m");
}

std::string race_csv(const Race& race) {
    std::string csv = "solver,iteration,residual,microseconds,status,ran,restored\n";
    for (const Racer& racer : race.racers) {
        const auto last = static_cast<double>(std::max<std::size_t>(racer.residuals.size() - 1, 1));
        for (std::size_t i = 0; i < racer.residuals.size(); ++i) {
            char line[160];
            std::snprintf(line, sizeof line, "%s,%zu,%.9g,%.3f,", ik::name(racer.method), i,
                          static_cast<double>(racer.residuals[i]),
                          racer.microseconds * static_cast<double>(i) / last);
            csv += line;
            if (i + 1 < racer.residuals.size()) {
                csv += ",,\n";
                continue;
            }
            char restored[32] = "";
            if (racer.restored) {
                std::snprintf(restored, sizeof restored, "%.9g", static_cast<double>(racer.report.residual));
            }
            csv += std::string(ik::name(racer.report.status)) + ",\"" +
                   ran_text(racer.method, racer.report, race.within_limits) + "\"," + restored + "\n";
        }
    }
    return csv;
}

}  // namespace tendril::app
