// Cost of drawing a skin of 50 000 vertices at 1280x720 in a new pose each frame, against the same triangles
// as a static mesh: the difference is the skinning. Counters: triangles, GL draw calls.
#include <benchmark/benchmark.h>
#include <glad/gl.h>

#include <cmath>

#include "app/view/renderer.hpp"
#include "app/window/window.hpp"

namespace tendril::app {
namespace {

constexpr glm::ivec2 size{1280, 720};
constexpr std::uint32_t rings = 250, around = 200, joints = 60;
const Camera camera({.target = {0.0f, 0.9f, 0.0f}, .yaw = 0.3f, .pitch = 0.3f, .distance = 4.0f},
                    {{0.0f, 0.0f}, glm::vec2(size)});

/// A vertical tube; each ring is between two of the joints along it.
SkinnedMesh tube() {
    SkinnedMesh mesh{.joints = joints};
    for (std::uint32_t r = 0; r < rings; ++r) {
        const float up = static_cast<float>(r) / (rings - 1), along = up * (joints - 1.001f);
        const auto below = static_cast<std::uint16_t>(along);
        const float part = along - static_cast<float>(below);
        for (std::uint32_t k = 0; k < around; ++k) {
            const float angle = 6.2831853f * static_cast<float>(k) / around;
            const glm::vec3 out(std::cos(angle), 0.0f, std::sin(angle));
            mesh.positions.push_back(0.3f * out + glm::vec3(0.0f, 1.8f * up, 0.0f));
            mesh.normals.push_back(out);
            const auto above = static_cast<std::uint16_t>(below + 1);
            mesh.weights.push_back({{below, above, 0, 0}, {1.0f - part, part, 0.0f, 0.0f}});
            if (r + 1 == rings) continue;
            const std::uint32_t a = r * around + k, b = r * around + (k + 1) % around;
            mesh.indices.insert(mesh.indices.end(), {a, a + around, b, b, a + around, b + around});
        }
    }
    mesh.parts = {{.first = 0, .count = static_cast<std::uint32_t>(mesh.indices.size())}};
    return mesh;
}

void draw(benchmark::State& state, const auto& fill) {
    const std::unique_ptr<Window> window = open_offscreen(size);
    Renderer renderer;
    DrawList list;
    float time = 0.0f;
    for (auto _ : state) {
        list.clear();
        fill(list, time += 0.1f);
        renderer.draw(list, camera, palette(Theme::Dark), {window->framebuffer(), size, 1.0f, true});
        glFinish();
    }
    state.counters["triangles"] = 2.0 * (rings - 1) * around;
    state.counters["draw_calls"] = renderer.draw_calls();
}

void skinned_tube(benchmark::State& state, float opacity) {
    const auto mesh = std::make_shared<const SkinnedMesh>(tube());
    draw(state, [&](DrawList& list, float time) {
        SkinDraw& skin = list.skins.emplace_back();
        skin.mesh = mesh;
        skin.opacity = opacity;
        for (std::uint32_t i = 0; i < joints; ++i) {
            const float sway = 0.02f * std::sin(time + 0.2f * static_cast<float>(i));
            skin.matrices.push_back(
                {{{1.0f, 0.0f, 0.0f, sway}, {0.0f, 1.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 1.0f, 0.0f}}});
        }
    });
}

void plain_tube(benchmark::State& state) {
    const SkinnedMesh mesh = tube();
    Mesh plain;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        plain.vertices.push_back({mesh.positions[i], mesh.normals[i], glm::vec3(0.8f), glm::vec3(0.8f)});
    plain.indices = mesh.indices;
    draw(state, [&](DrawList& list, float) { list.mesh = plain; });
}
BENCHMARK(plain_tube)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(skinned_tube, solid, 1.0f)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(skinned_tube, seen_through, 0.4f)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace tendril::app
