// Cost of reading a character: a long motion capture in BVH, and a skinned GLB. Counter: megabytes per
// second.
#include <benchmark/benchmark.h>

#include "app/document/command.hpp"
#include "app/document/json_complete.hpp"
#include "app/io/character/bvh.hpp"
#include "app/io/character/character.hpp"
#include "app/labs/humanoid/humanoid_part.hpp"
#include "app/labs/labs.hpp"

namespace tendril::app {
namespace {

/// 60 joints for a minute at 120 frames/s, about 11 MB.
std::string long_capture() {
    constexpr int joints = 60, frames = 7200;
    std::string text = "HIERARCHY\nROOT Hips\n{\nOFFSET 0 0 0\nCHANNELS 3 Zrotation Xrotation Yrotation\n";
    for (int i = 1; i < joints; ++i)
        text +=
            "JOINT a" + std::to_string(i) + "\n{\nOFFSET 0 3 0\nCHANNELS 3 Zrotation Xrotation Yrotation\n";
    for (int i = 0; i < joints; ++i) text += "}\n";
    text += "MOTION\nFrames: " + std::to_string(frames) + "\nFrame Time: 0.0083333\n";
    for (int frame = 0; frame < frames; ++frame) {
        for (int i = 0; i < 3 * joints; ++i)
            text += std::to_string(0.01 * ((frame * 7 + i * 13) % 9000) - 45.0) + ' ';
        text += '\n';
    }
    return text;
}

void read_long_bvh(benchmark::State& state) {
    const std::string text = long_capture();
    for (auto _ : state) benchmark::DoNotOptimize(parse_bvh(text, "long.bvh"));
    state.counters["MB/s"] =
        benchmark::Counter(1e-6 * static_cast<double>(text.size()) * static_cast<double>(state.iterations()),
                           benchmark::Counter::kIsRate);
}
BENCHMARK(read_long_bvh)->Unit(benchmark::kMillisecond);

void read_skinned_glb(benchmark::State& state) {
    const std::filesystem::path file =
        std::filesystem::path(TENDRIL_SOURCE_DIR) / "tests/app/golden/body.glb";
    for (auto _ : state) benchmark::DoNotOptimize(read_character(file));
    state.counters["MB/s"] = benchmark::Counter(1e-6 * static_cast<double>(std::filesystem::file_size(file)) *
                                                    static_cast<double>(state.iterations()),
                                                benchmark::Counter::kIsRate);
}
BENCHMARK(read_skinned_glb)->Unit(benchmark::kMillisecond);

// Cost of a tick of the Humanoid lab while the figure walks, alone and with attachments: a cape of default
// size, and also a ponytail and a tail. Counters: particles.

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
