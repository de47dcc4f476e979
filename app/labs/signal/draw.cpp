
#include <imgui.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "app/io/text.hpp"
#include "app/labs/signal/analysis.hpp"
#include "app/labs/signal/panel.hpp"
#include "app/labs/signal/signal_lab.hpp"
#include "app/widgets/fields.hpp"
#include "app/widgets/fonts.hpp"
#include "app/widgets/plot.hpp"
#include "app/widgets/tooltip.hpp"

namespace tendril::app {
namespace {

constexpr float beside = 0.45f, ball_radius = 0.16f;
constexpr float max_ball_distance = 1000.0f;

glm::vec3 place(float x, double value) {
    return {x, ball_level + static_cast<float>(std::clamp(value, -1e3, 1e3)), 0.0f};
}

/// The axis of both balls, with a mark at each whole unit near them.
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

/// The ball's colour: blue while a response is recorded, otherwise the shown output's.
glm::vec3 output_colour(const Palette& palette, const SignalPart& part) {
    const std::optional<std::size_t> last = shown_stage(part);
    return last && !part.recording ? stage_colour(palette, part.stages[*last]) : palette.head;
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

glm::vec3 stage_colour(const Palette& palette, const SignalStage& stage) {
    // Colours of Okabe and Ito, repeated.
    const bool dark = palette.theme == Theme::Dark;
    const std::array<glm::vec3, 5> colours{palette.head, rgb(0xCC79A7), palette.tail,
                                           dark ? rgb(0x8C96FF) : rgb(0x0072B2),
                                           dark ? rgb(0xC9B24A) : rgb(0x8A7400)};
    return colours[static_cast<std::size_t>(stage.colour) % colours.size()];
}

void SignalLab::draw(const View& view, DrawList& list) const {
    const SignalPart& part = signal_part(view.workspace);
    const BallPlaces places = ball_places(part);
    axis(view, list, std::abs(part.input.amplitude));
    const auto ball = [&](glm::vec3 at, glm::vec3 of, PickId pick) {
        const bool lit = view.hovered == pick || view.dragged == pick;
        if (std::abs(at.y - ball_level) < max_ball_distance) {
            Stroke& sphere = list.sphere(at, ball_radius, Unit::Metres, glm::vec4(of, 1.0f));
            sphere.pick = pick;
            sphere.shadow = true;
            sphere.rank = pick == 0 ? 2 : 1;
        }
        if (lit) list.ring(at, 22.0f * view.scale, 1.5f * view.scale, glm::vec4(of, 1.0f));
    };
    // Earlier outputs at equal intervals show its speed.
    const auto& recent = signal_runtime(view.workspace).recent(part);
    const glm::vec3 colour = output_colour(view.palette, part);
    if (const std::size_t end = shown_lane(part).end; end > 0 && !part.recording) {
        const std::vector<double>& output = recent[end - 1];
        for (std::size_t back = 3; back <= 12 && back < output.size(); back += 3) {
            const double value = output[output.size() - 1 - back];
            list.sphere(place(beside, value), 0.55f * ball_radius, Unit::Metres,
                        faded(view.palette, colour, 0.55f - 0.03f * static_cast<float>(back)));
        }
    }
    const glm::vec4 stem = faded(view.palette, view.palette.neutral, 0.6f);
    list.line({0, places.input.y, 0}, places.input, 1.0f * view.scale, stem);
    list.line({0, places.output.y, 0}, places.output, 1.0f * view.scale, stem);
    ball(places.input, input_colour(view.palette), 0);
    ball(places.output, colour, 1);
}

std::vector<LegendRow> SignalLab::legend(const Workspace& workspace) const {
    const Palette& colours = palette(workspace.settings.theme);
    return {{"input", input_colour(colours)}, {"output", output_colour(colours, signal_part(workspace))}};
}

Bounds SignalLab::bounds(const Workspace& workspace, bool) const {
    const SignalPart& part = signal_part(workspace);
    double low = -std::abs(part.input.amplitude), high = -low;
    for (const signal::Sample& row : part.past)
        low = std::min(low, row.input), high = std::max(high, row.input);
    return bounds_of(place(-beside - ball_radius, low - 0.3), place(beside + ball_radius, high + 0.3));
}

// The Signal lab's canvas: the scrolling signal, and below it one of three plots.

namespace {

constexpr double shown_seconds = 5.0;

/// The values at times from `from` to `to`.
std::span<const double> shown(const std::vector<double>& time, const std::vector<double>& values, double from,
                              double to = 1e9) {
    const auto first = std::lower_bound(time.begin(), time.end(), from) - time.begin();
    const auto end = std::upper_bound(time.begin(), time.end(), to) - time.begin();
    const auto count = static_cast<std::size_t>(std::max<std::ptrdiff_t>(end - first, 0));
    return std::span(values).subspan(std::min(static_cast<std::size_t>(first), values.size())).first(count);
}

void scrolling_plot(const Workspace& workspace, const Palette& palette, float height) {
    const SignalPart& part = signal_part(workspace);
    std::vector<double> time = signal::times_of(part.past), input;
    const double shift = part.time - (time.empty() ? 0.0 : time.back());
    for (double& each : time) each += shift;
    for (const signal::Sample& row : part.past) input.push_back(row.input);
    const double to = std::max(part.time, shown_seconds), from = to - shown_seconds;
    std::vector<Curve> curves{curve_of("input", input_colour(palette), time, input, from)};
    std::vector<std::span<const double>> outputs;
    const auto& stages = signal_runtime(workspace).recent(part);
    for (std::size_t i = 0; i < part.stages.size(); ++i) {
        if (!part.stages[i].enabled) continue;
        curves.push_back(
            curve_of(stage_title(part, i), stage_colour(palette, part.stages[i]), time, stages[i], from));
        if (shown_stage(part) == i) curves.back().width = 1.35f;
        outputs.push_back(shown(time, stages[i], from));
    }
    const Span span = widened(span_of(part.input, shown(time, input, from)), outputs);
    plot("signal", curves, time_axes(span, from, to), height);
}

/// From reddish for the slowest rate to the fastest; uneven frames have their own colour.
glm::vec3 rate_colour(const Palette& palette, const signal::FrameRate& rate) {
    if (rate.jittered) return palette.selection;
    if (rate.hz < 20.0) return palette.limit;
    if (rate.hz < 40.0) return rgb(0xCC79A7);
    if (rate.hz < 100.0) return palette.tail;
    return palette.head;
}

std::string rate_name(const signal::FrameRate& rate) {
    return fixed_text(rate.hz, 0) + " Hz" + (rate.jittered ? ", uneven" : "");
}

void rates_plot(const Workspace& workspace, const Palette& palette, float height) {
    constexpr double longest = 4.0;
    const SignalPart& part = signal_part(workspace);
    const ChainAnalysis& analysis = signal_runtime(workspace).chain(part);
    const double end = analysis.time.empty() ? 1.0 : analysis.time.back();
    const bool hand = part.input.kind == InputKind::Hand;
    const bool wave = part.input.kind == InputKind::Square || part.input.kind == InputKind::Sine;
    const double to = hand ? end : std::min(end, wave ? part.input.period : longest);
    // A square wave jumps in the middle of its period; the hand shows its last seconds.
    const double from = hand                                   ? std::max(0.0, end - longest)
                        : part.input.kind == InputKind::Square ? 0.45 * part.input.period
                                                               : 0.0;
    std::vector<Curve> curves{
        curve_of("input", input_colour(palette), analysis.time, analysis.input, from, to)};
    curves.back().strength = 0.5f;
    std::vector<std::span<const double>> outputs;
    for (const signal::RateRun& run : analysis.rates.runs) {
        curves.push_back(
            curve_of(rate_name(run.rate), rate_colour(palette, run.rate), run.time, run.output, from, to));
        outputs.push_back(shown(run.time, run.output, from, to));
    }
    for (Curve& curve : curves)
        curve.marks = curve.points.size() > 1 && curve.points[1].x - curve.points[0].x > 0.05f;
    const Span span = widened(span_of(part.input, analysis.input), outputs);
    plot("rates", curves, time_axes(span, from, to), height);
}

void shelf_plot(const Workspace& workspace, const Palette& palette, float height) {
    const SignalPart& part = signal_part(workspace);
    std::vector<Curve> points;
    float most_lag = 20.0f;
    const auto add = [&](std::string name, double seconds, double left, std::optional<glm::vec3> colour) {
        const float lag = static_cast<float>(1e3 * seconds);
        const float jitter = static_cast<float>(std::clamp(100.0 * left, 1.0, 900.0));
        Curve curve{std::move(name), colour.value_or(palette.neutral), {{std::max(lag, 0.0f), jitter}}};
        curve.width = colour ? 2.6f : 1.6f;
        curve.strength = colour ? 1.0f : 0.75f;
        most_lag = std::max(most_lag, 1.15f * lag);
        points.push_back(std::move(curve));
    };
    for (const ShelfPoint& point : signal_runtime(workspace).shelf(part))
        if (point.stage)
            add(stage_title(part, *point.stage), point.lag, point.jitter,
                stage_colour(palette, part.stages[*point.stage]));
        else
            add(kind_title(point.filter), point.lag, point.jitter, std::nullopt);
    plot("shelf", points,
         {.x = "lag, ms",
          .y = "jitter left",
          .y_unit = "%",
          .min_y = 1.0f,
          .from_x = -0.05f * most_lag,
          .min_x = most_lag,
          .named = true},
         height);
}

/// A row of buttons that choose the lower plot, each with a tooltip.
void plot_choice(const SignalPart& part, Emit& emit) {
    for (const SignalPlot each : signal_plots.values()) {
        if (each != SignalPlot::Rates) ImGui::SameLine();
        const float width =
            ImGui::CalcTextSize(signal_plots.title(each)).x + 2.0f * ImGui::GetStyle().FramePadding.x;
        if (width > ImGui::GetContentRegionAvail().x) ImGui::NewLine();
        const bool chosen = part.plot == each;
        ImGui::PushStyleColor(ImGuiCol_Button,
                              ImGui::GetStyleColorVec4(chosen ? ImGuiCol_Header : ImGuiCol_ChildBg));
        if (ImGui::Button(signal_plots.title(each))) emit("signal.plot", {{"name", signal_plots.name(each)}});
        ImGui::PopStyleColor();
        if (ImGui::IsItemHovered()) tooltip(signal_plots.help(each));
    }
}

/// The colour key; entries that do not fit are counted.
void colour_key(const std::vector<std::pair<std::string, glm::vec3>>& rows, int max_lines = 3) {
    ImGui::PushFont(small_font());
    int lines = 1;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const auto& [name, colour] = rows[i];
        if (i > 0) {
            ImGui::SameLine(0.0f, ImGui::GetFontSize());
            const float more = lines == max_lines ? ImGui::CalcTextSize("and 99 more").x : 0.0f;
            const float needed = ImGui::CalcTextSize(name.c_str()).x + 1.4f * ImGui::GetFontSize() + more;
            if (ImGui::GetContentRegionAvail().x < needed) {
                if (++lines > max_lines) {
                    if (ImGui::GetContentRegionAvail().x < more) ImGui::NewLine();
                    ImGui::AlignTextToFramePadding();
                    ImGui::TextDisabled("and %zu more", rows.size() - i);
                    break;
                }
                ImGui::NewLine();
            }
        }
        colour_mark(colour);
        ImGui::AlignTextToFramePadding();
        ImGui::TextDisabled("%s", name.c_str());
    }
    ImGui::PopFont();
}

}  // namespace

void SignalLab::canvas(const Workspace& workspace, Emit& emit) const {
    const SignalPart& part = signal_part(workspace);
    const Palette& colours = palette(workspace.settings.theme);
    std::vector<std::pair<std::string, glm::vec3>> key{{"input", input_colour(colours)}};
    for (std::size_t i = 0; i < part.stages.size(); ++i)
        if (part.stages[i].enabled)
            key.emplace_back(stage_title(part, i), stage_colour(colours, part.stages[i]));
    colour_key(key);
    ImGui::PushFont(small_font());
    const float line = ImGui::GetFontSize();
    ImGui::PopFont();
    const float frame = ImGui::GetFrameHeightWithSpacing();
    const float room = std::max(0.0f, ImGui::GetContentRegionAvail().y - 2.0f * frame) / line;
    scrolling_plot(workspace, colours, std::max(8.0f, 0.5f * room - 1.0f));
    plot_choice(part, emit);
    std::vector<std::pair<std::string, glm::vec3>> lower;
    if (part.plot == SignalPlot::Rates) {
        for (const signal::FrameRate& rate : signal::usual_rates())
            lower.emplace_back(rate_name(rate), rate_colour(colours, rate));
    }
    const bool fit = part.plot == SignalPlot::Fit;
    if (fit) {
        lower.emplace_back("wanted", colours.text);
        for (std::size_t i = 0; i < std::min(shown_fits, part.fits.size()); ++i)
            lower.emplace_back(kind_title(part.fits[i].filter), fit_colour(colours, i));
    }
    // The key keeps its height while a response is drawn: otherwise the plot would move away from the mouse.
    if (!lower.empty()) colour_key(lower, fit ? 1 : 3);
    const float rest = std::max(8.0f, ImGui::GetContentRegionAvail().y / line - 0.5f);
    if (part.plot == SignalPlot::Rates) rates_plot(workspace, colours, rest);
    if (part.plot == SignalPlot::Shelf) shelf_plot(workspace, colours, rest);
    if (fit) fit_plot(part, colours, rest, emit);
}

}  // namespace tendril::app
