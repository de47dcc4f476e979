// The table of Aristidou and Lasenby 2011, measured as `tendril paper` does: the time is that of one solve.
#include <benchmark/benchmark.h>

#include <string>

#include "app/batch/paper.hpp"

namespace {

using namespace tendril;

void show(benchmark::State& state, const std::string& name, const app::PaperTargets& targets,
          const app::PaperSolve& solve) {
    for ([[maybe_unused]] auto once : state) {
        const auto row = app::measure(targets, solve, [](double) { return true; });
        state.SetIterationTime(row->microseconds * 1e-6);
        state.counters["solved"] = row->solved;
        state.counters["mean_its"] = row->mean_iterations;
        state.counters["median_its"] = row->median_iterations;
        state.counters["ns_per_it"] = row->nanoseconds.value_or(0.0);
    }
    state.SetLabel(std::string(targets.name) + ", " + name);
}

void paper(benchmark::State& state) {
    const auto method = app::paper_methods()[static_cast<std::size_t>(state.range(1))];
    show(state, ik::name(method), state.range(0) == 0 ? app::reachable_targets() : app::unreachable_targets(),
         app::paper_solver(method));
}
BENCHMARK(paper)
    ->ArgsProduct({{0, 1}, benchmark::CreateDenseRange(0, 5, 1)})
    ->ArgNames({"unreachable", "solver"})
    ->Iterations(1)
    ->UseManualTime()
    ->Unit(benchmark::kMicrosecond);

}  // namespace
