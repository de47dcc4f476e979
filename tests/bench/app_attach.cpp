// Cost of a tick of the Humanoid lab while the figure walks, alone and with attachments: a cape of default
// size, and also a ponytail and a tail. Counters: particles.
#include <benchmark/benchmark.h>

#include "app/document/command.hpp"
#include "app/document/json_complete.hpp"
#include "app/labs/humanoid/humanoid_part.hpp"
#include "app/labs/labs.hpp"

namespace tendril::app {
namespace {

void walk(benchmark::State& state, const std::vector<std::pair<const char*, const char*>>& hanging) {
    const Labs labs;
    const CommandTable table = make_command_table(labs);
    Workspace workspace = make_blank_workspace(labs);
    table.run(workspace, "lab.open", {{"name", humanoid_lab}});
    for (const auto& [bone, kind] : hanging)
        table.run(workspace, "humanoid.attach", {{"bone", bone}, {"kind", kind}});
    table.run(workspace, "humanoid.clip", {{"name", "walk"}, {"play", true}});
    const Lab& lab = *labs.find(humanoid_lab);
    for (auto _ : state) lab.step(workspace);
    state.counters["particles"] = static_cast<double>(humanoid_part(workspace).attachments.world->size());
}
BENCHMARK_CAPTURE(walk, alone, {})->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(walk, cape, {{"UpperChest", "cloth"}})->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(walk, cape_ponytail_tail, {{"UpperChest", "cloth"}, {"Head", "hair"}, {"Hips", "rope"}})
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace tendril::app
