#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "app/document/units.hpp"
#include "app/labs/signal/analysis.hpp"
#include "app/labs/signal/scene.hpp"
#include "app/labs/signal/signal_lab.hpp"

namespace tendril::app {
namespace {

constexpr float beside = 0.45f, ball_radius = 0.16f;
constexpr float max_ball_distance = 1000.0f;

glm::vec3 place(float x, double value) {
    return {x, ball_level + static_cast<float>(std::clamp(value, -1e3, 1e3)), 0.0f};
}

/// The axis that both balls move along, with a mark at each whole unit near them.
void axis(const View& view, DrawList& list, double highest) {
    const float reach = static_cast<float>(std::clamp(std::ceil(highest), 1.0, 10.0));
    const glm::vec4 colour = faded(view.palette, view.palette.text_dim, 0.5f);
    list.line(place(0.0f, -reach), place(0.0f, reach), 1.5f * view.scale, colour);
    for (float unit = -reach; unit <= reach; unit += 1.0f) {
        const float half = unit == 0.0f ? 0.18f : 0.1f;
        const glm::vec3 at = place(0.0f, unit);
        list.line(at - glm::vec3(half, 0, 0), at + glm::vec3(half, 0, 0), 1.5f * view.scale, colour);
    }
}

}  // namespace

BallPlaces ball_places(const SignalPart& part) {
    const bool hand = part.input.kind == InputKind::Hand;
    return {place(-beside, hand ? part.input.hand : input_of(part)),
            place(beside, part.recording ? part.recording->value : output_of(part))};
}

glm::vec3 input_colour(const Palette& palette) {
    return palette.target;
}

glm::vec3 output_colour(const Palette& palette) {
    return palette.head;
}

glm::vec3 stage_colour(const Palette& palette, const SignalPart& part, std::size_t stage) {
    std::size_t last = part.stages.size();
    for (std::size_t i = 0; i < part.stages.size(); ++i)
        if (part.stages[i].enabled) last = i;
    if (stage == last) return output_colour(palette);
    // Okabe and Ito's others, and then again.
    const bool dark = palette.theme == Theme::Dark;
    const std::array<glm::vec3, 4> others{rgb(0xCC79A7), palette.tail, dark ? rgb(0x8C96FF) : rgb(0x0072B2),
                                          dark ? rgb(0xC9B24A) : rgb(0x8A7400)};
    return others[stage % others.size()];
}

void SignalLab::draw(const View& view, DrawList& list) const {
    const SignalPart& part = signal_part(view.workspace);
    const BallPlaces places = ball_places(part);
    axis(view, list, std::abs(part.input.amplitude));
    const auto ball = [&](glm::vec3 at, glm::vec3 colour, PickId pick) {
        const bool lit = view.hovered == pick || view.dragged == pick;
        if (std::abs(at.y - ball_level) < max_ball_distance) {
            Stroke& sphere = list.sphere(at, ball_radius, Unit::Metres, glm::vec4(colour, 1.0f));
            sphere.pick = pick;
            sphere.shadow = true;
            sphere.rank = pick == 0 ? 2 : 1;
        }
        if (lit) list.ring(at, 22.0f * view.scale, 1.5f * view.scale, glm::vec4(colour, 1.0f));
    };
    // Where the output was at equal times before: the eye sees its speed.
    const auto& recent = signal_runtime(view.workspace).recent(part);
    if (!recent.empty() && !part.recording) {
        const std::vector<double>& output = recent.back();
        for (std::size_t back = 3; back <= 12 && back < output.size(); back += 3) {
            const double value = output[output.size() - 1 - back];
            list.sphere(
                place(beside, value), 0.55f * ball_radius, Unit::Metres,
                faded(view.palette, output_colour(view.palette), 0.55f - 0.03f * static_cast<float>(back)));
        }
    }
    const glm::vec4 stem = faded(view.palette, view.palette.neutral, 0.6f);
    list.line({0, places.input.y, 0}, places.input, 1.0f * view.scale, stem);
    list.line({0, places.output.y, 0}, places.output, 1.0f * view.scale, stem);
    ball(places.input, input_colour(view.palette), 0);
    ball(places.output, output_colour(view.palette), 1);
}

std::vector<LegendRow> SignalLab::legend(const Workspace& workspace) const {
    const Palette& colours = palette(workspace.settings.theme);
    return {{"input", input_colour(colours)}, {"output", output_colour(colours)}};
}

Bounds SignalLab::bounds(const Workspace& workspace, bool) const {
    const SignalPart& part = signal_part(workspace);
    double low = -std::abs(part.input.amplitude), high = -low;
    for (const signal::Sample& row : part.past)
        low = std::min(low, row.input), high = std::max(high, row.input);
    return bounds_of(place(-beside - ball_radius, low - 0.3), place(beside + ball_radius, high + 0.3));
}

}  // namespace tendril::app
