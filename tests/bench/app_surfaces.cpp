// Cost of ropes, cloth and boxes in the view: building their surfaces for a camera, and rendering a frame, at
// 1280x720. Counters: triangles, strokes (outlines and shadows), GL draw calls.
#include <benchmark/benchmark.h>
#include <glad/gl.h>

#include <cmath>

#include "app/view/renderer.hpp"
#include "app/view/surfaces.hpp"
#include "app/window/window.hpp"

namespace tendril::app {
namespace {

constexpr glm::ivec2 size{1280, 720};
const Camera camera({.target = {0.0f, 0.9f, 0.0f}, .yaw = 0.3f, .pitch = 0.3f, .distance = 6.0f},
                    {{0.0f, 0.0f}, glm::vec2(size)});

/// Ropes of 64 links hanging in rows.
void ropes(DrawList& list, int count) {
    std::vector<glm::vec3> centres(65);
    for (int k = 0; k < count; ++k) {
        const glm::vec3 from(-2.0f, 1.8f, 2.0f - 4.0f * static_cast<float>(k) / static_cast<float>(count));
        for (std::size_t i = 0; i < centres.size(); ++i) {
            const float t = static_cast<float>(i) / 64.0f;
            centres[i] = from + glm::vec3(4.0f * t, -4.0f * t * (1.0f - t), 0.1f * std::sin(9.0f * t));
        }
        const glm::vec3 colours[]{{0.8f, 0.5f, 0.2f}};
        tube(list, camera, centres, 0.02f, 16, colours);
    }
}

/// A wavy cloth of `side` points along each side.
void cloth(DrawList& list, int side) {
    std::vector<glm::vec3> positions;
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column) {
            const glm::vec2 at = glm::vec2(column, row) / static_cast<float>(side - 1);
            positions.emplace_back(3.0f * at.x - 1.5f, 2.0f - 1.8f * at.y, 0.2f * std::sin(12.0f * at.x));
        }
    cloth_surface(list, camera, {side, side, positions}, glm::vec3(0.3f, 0.6f, 0.8f),
                  glm::vec3(0.6f, 0.3f, 0.5f));
}

template <void (*Fill)(DrawList&, int)>
void build(benchmark::State& state) {
    DrawList list;
    for (auto _ : state) {
        list.clear();
        Fill(list, static_cast<int>(state.range(0)));
    }
    state.counters["triangles"] = static_cast<double>(list.mesh.indices.size() / 3);
    state.counters["strokes"] = static_cast<double>(list.strokes.size());
}
BENCHMARK(build<ropes>)->Arg(1)->Arg(20)->Unit(benchmark::kMicrosecond);
BENCHMARK(build<cloth>)->Arg(24)->Arg(64)->Unit(benchmark::kMicrosecond);

template <void (*Fill)(DrawList&, int)>
void build_and_draw(benchmark::State& state) {
    const std::unique_ptr<Window> window = open_offscreen(size);
    Renderer renderer;
    DrawList list;
    for (auto _ : state) {
        list.clear();
        Fill(list, static_cast<int>(state.range(0)));
        renderer.draw(list, camera, palette(Theme::Dark), {window->framebuffer(), size, 1.0f, true});
        glFinish();
    }
    state.counters["triangles"] = static_cast<double>(list.mesh.indices.size() / 3);
    state.counters["strokes"] = static_cast<double>(list.strokes.size());
    state.counters["draw_calls"] = renderer.draw_calls();
}
BENCHMARK(build_and_draw<ropes>)->Arg(1)->Arg(20)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(build_and_draw<cloth>)->Arg(24)->Arg(64)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace tendril::app
