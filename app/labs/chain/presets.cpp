#include "app/labs/chain/presets.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "app/document/json_complete.hpp"
#include "app/labs/chain/chain_part.hpp"
#include "app/labs/kit/arguments.hpp"
#include "app/view/assets.hpp"

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::Preset>() noexcept {
    using app::Preset;
    constexpr FieldRange near{-100.0, 100.0};
    static constexpr Field rows[] = {field<&Preset::name>("name").needed(),
                                     field<&Preset::title>("title").needed(),
                                     field<&Preset::count>("count", {1, 1000}),
                                     field<&Preset::of>("of", {0, 4}),
                                     field<&Preset::what>("what"),
                                     field<&Preset::head>("head", near, "m"),
                                     list<&Preset::steps>("steps", near, "m"),
                                     field<&Preset::path>("path"),
                                     field<&Preset::height>("height", {0.0, 100.0}, "m")};
    return rows;
}

namespace tendril::app {
namespace {

using Segments = std::vector<Segment>;

/// Places `count` segments, head first, along the steps that `step(i)` returns; a step's length is its
/// segment's.
template <class Step>
Segments placed(glm::vec3 head, std::size_t count, Step step) {
    Segments segments;
    segments.reserve(count);
    glm::vec3 at = head;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 by = step(i);
        if (i > 0) at += by;
        segments.push_back({at, glm::length(by)});
    }
    return segments;
}

float part_of(std::size_t i, std::size_t count) {
    return count < 2 ? 0.0f : static_cast<float>(i) / static_cast<float>(count - 1);
}

/// Rises from the ground in an S, with bones that get shorter towards the tip.
Segments tentacle(std::size_t count) {
    const float scale = 7.0f / static_cast<float>(count);
    return placed({0, 0, 0}, count, [=](std::size_t i) {
        const float t = part_of(i, count);
        const float lean = 1.1f * std::sin(6.0f * t) * (0.3f + 0.7f * t);
        return scale * (1.5f - 0.9f * t) *
               glm::vec3(std::sin(lean), std::cos(lean), 0.35f * std::sin(4.0f * t));
    });
}

/// A wave on the ground.
Segments wave(std::size_t count) {
    const float step = 9.0f / static_cast<float>(count);
    return placed({-4.5f, 0.1f, 0}, count, [=](std::size_t i) {
        const float lean = 1.0f * std::cos(15.0f * part_of(i, count));
        return step * glm::vec3(std::cos(lean), 0.0f, std::sin(lean));
    });
}

/// A rising coil.
Segments coil(std::size_t count) {
    const float step = 26.0f / static_cast<float>(count);
    return placed({2, 0.1f, 0}, count, [=](std::size_t i) {
        const float turn = 13.0f * part_of(i, count);
        return step * glm::vec3(-std::sin(turn), 0.14f, std::cos(turn));
    });
}

/// Random lengths and directions, the same for the same seed.
Segments random_walk(std::size_t count, std::uint32_t seed) {
    std::mt19937 generator(seed);
    // Own mapping to [-1, 1]: the distributions of the standard library differ between implementations.
    const auto signed_unit = [&] { return static_cast<float>(generator() >> 8) / 8388608.0f - 1.0f; };
    const float scale = 8.0f / std::sqrt(static_cast<float>(count));
    return placed({0, 2.5f, 0}, count, [&](std::size_t) {
        const glm::vec3 direction{signed_unit(), 0.8f * signed_unit(), signed_unit()};
        return scale * 0.6f * (direction + glm::vec3(0.25f, 0.0f, 0.0f));
    });
}

Segments segments_of(const Preset& preset, std::size_t count, std::uint32_t seed) {
    if (preset.path == "tentacle") return tentacle(count);
    if (preset.path == "wave") return wave(count);
    if (preset.path == "coil") return coil(count);
    if (preset.path == "random") return random_walk(count, seed);
    const float rise = count < 2 ? preset.height : preset.height / static_cast<float>(count - 1);
    return placed(preset.head, count, [&](std::size_t i) {
        return preset.steps.empty() ? glm::vec3(0.0f, rise, 0.0f)
                                    : preset.steps[std::min(i, preset.steps.size() - 1)];
    });
}

}  // namespace

bool Preset::curved() const {
    return scene->contains("curve");
}
bool Preset::planar() const {
    return scene->contains("reach") && scene->at("reach").contains("plane");
}

const std::vector<Preset>& presets() {
    static const std::vector<Preset> list = [] {
        std::vector<Preset> read;
        for (const Json& each : parse_json(presets_source(chain_lab))) {
            load_fields({each, "presets"}, read.emplace_back());
            read.back().scene = std::make_shared<const Json>(each);
        }
        return read;
    }();
    return list;
}

const Preset& preset_named(const std::string& name) {
    return named(
        presets(), [](const Preset& each) { return each.name; }, name, "preset");
}

Chain make_preset(const Preset& preset, std::size_t count, std::uint32_t seed) {
    return require_value(Chain::from_segments(segments_of(preset, count, seed)));
}

void take_scene(ChainPart& part, const Preset& preset, ChainRuntime& runtime) {
    const JsonPlace scene(*preset.scene, preset.name);
    if (const auto curve = scene.optional("curve")) {
        part.mode = ChainMode::Curve;
        part.curve = load_curve(*curve);
    }
    if (!scene.has("reach")) return;
    const std::size_t bones = part.chain.size() - 1;
    // As many bones as it lists limits.
    const Json& reach = preset.scene->at("reach");
    const Json& limited = preset.planar() ? reach["plane"] : reach;
    const std::size_t listed = limited.contains("limits") ? limited["limits"].size() : 0;
    part.mode = ChainMode::Reach;
    part.reach = load_reach(scene["reach"], make_preset(preset_named("start"), listed + 1));
    const auto fit = [&](auto& limits) {
        if (limits.empty()) return;
        const auto last = limits.back();
        limits.resize(bones, last);
    };
    if (preset.planar()) fit(part.reach.plane->limits);
    bones < 2 ? part.reach.limits.clear() : fit(part.reach.limits);  // a hinge needs two
    const auto target = scene.optional("target");
    reach_for(part, target ? target->point() : part.chain.position(bones) + scene["target_from_tip"].point(),
              runtime);
}

}  // namespace tendril::app
