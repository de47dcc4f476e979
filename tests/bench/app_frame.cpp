// Cost of a frame of the Chain lab offscreen, and the time to the first picture.
//
// A frame is what the window does for a mouse move in mid-drag: one tick (input, commands, chain, panels,
// draw list) and one picture, at 1280x720. Counters: frames per second, GL draw calls, and the cost relative
// to ten segments, measured in the same run.
//
// The openings of the labs move by themselves until the first change: a frame of each, and its cost relative
// to the Chain lab's.
#include <benchmark/benchmark.h>
#include <glad/gl.h>

#include "app/app.hpp"
#include "app/io/json_complete.hpp"
#include "app/session.hpp"

namespace tendril::app {
namespace {

constexpr glm::ivec2 size{1280, 720};

/// The program with a coil of that many segments, with the mouse dragging its target.
struct DraggedCoil {
    std::unique_ptr<Window> window = open_offscreen(size);
    App app{*window};
    glm::vec2 from{0.0f};
    int step = 0;

    explicit DraggedCoil(int segments) {
        app.run({.name = "chain.preset", .arguments = Json{{"name", "coil"}, {"count", segments}}});
        app.run({.name = "camera.frame", .arguments = Json{{"what", "all"}}});
        const Json state = app.state();
        const Json pixel = state.at("handles").at(0).at("pixel");
        from = {pixel[0].get<float>(), pixel[1].get<float>()};
        tick(MouseMove{from});
        tick(MousePress{});
    }
    void tick(const Event& event) { app.tick(&event); }
    void frame() {
        const float way = static_cast<float>(++step % 40);
        tick(MouseMove{from + glm::vec2(way - 60.0f, way)});
        app.draw();
        glFinish();  // the rasteriser's threads continue after the call
    }
};

double seconds_a_frame(DraggedCoil& coil, int frames) {
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < frames; ++i) coil.frame();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() / frames;
}

void drag_frame(benchmark::State& state) {
    const double baseline = [] {  // one program at a time: GL and Dear ImGui have one current context
        DraggedCoil ten(10);
        seconds_a_frame(ten, 3);
        return seconds_a_frame(ten, 20);
    }();
    DraggedCoil coil(static_cast<int>(state.range(0)));
    coil.frame();
    for (auto _ : state) coil.frame();
    state.counters["fps"] =
        benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
    state.counters["draw_calls"] = coil.app.draw_calls();
    // inverted rate of seconds per frame over the baseline's: the cost relative to a frame of ten segments
    state.counters["times_ten"] =
        benchmark::Counter(static_cast<double>(state.iterations()) * baseline,
                           benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK(drag_frame)->Arg(10)->Arg(1000)->Arg(10000)->Unit(benchmark::kMillisecond)->UseRealTime();

/// The program on the opening of that lab.
struct Opening {
    std::unique_ptr<Window> window = open_offscreen(size);
    App app{*window};

    explicit Opening(const char* lab) {
        open_alive(app);
        app.run({.name = "lab.open", .arguments = Json{{"name", lab}}});
    }
    void frame() {
        app.tick(nullptr);
        app.draw();
        glFinish();
    }
};

void opening_frame(benchmark::State& state, const char* lab) {
    const double baseline = [] {
        Opening chain("chain");
        chain.frame();
        const auto start = std::chrono::steady_clock::now();
        for (int i = 0; i < 60; ++i) chain.frame();
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() / 60;
    }();
    Opening opening(lab);
    opening.frame();
    for (auto _ : state) opening.frame();
    state.counters["fps"] =
        benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
    state.counters["draw_calls"] = opening.app.draw_calls();
    state.counters["times_chain"] =
        benchmark::Counter(static_cast<double>(state.iterations()) * baseline,
                           benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK_CAPTURE(opening_frame, chain, "chain")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(opening_frame, rope, "rope")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(opening_frame, signal, "signal")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(opening_frame, rig, "rig")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(opening_frame, humanoid, "humanoid")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(opening_frame, linkage, "linkage")->Unit(benchmark::kMillisecond)->UseRealTime();

void start_to_first_picture(benchmark::State& state) {
    for (auto _ : state) {
        const auto window = open_offscreen(size);
        App app(*window);
        benchmark::DoNotOptimize(app.screenshot().rgba.data());
    }
}
BENCHMARK(start_to_first_picture)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace tendril::app
