// The flat picture of the Signal lab: the signal as it goes by, and below it one of three plots.
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "app/document/units.hpp"
#include "app/labs/signal/panels.hpp"
#include "app/labs/signal/scene.hpp"
#include "app/labs/signal/signal_lab.hpp"
#include "app/labs/signal/span.hpp"
#include "app/widgets/fields.hpp"
#include "app/widgets/fonts.hpp"
#include "app/widgets/plot.hpp"
#include "app/widgets/text.hpp"

namespace tendril::app {
namespace {

constexpr double shown_seconds = 5.0;

/// Those of `values` at times between both.
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
        curves.push_back(curve_of(kind_title(part.stages[i].filter), stage_colour(palette, part, i), time,
                                  stages[i], from));
        outputs.push_back(shown(time, stages[i], from));
    }
    curves.back().width = 1.35f;
    const Span span = widened(span_of(part.input, shown(time, input, from)), outputs);
    plot("signal", curves, time_axes(span, from, to), height);
}

/// From the slowest, reddish, to the fastest; uneven frames stand apart.
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
    // A square wave jumps in the middle of its period; of the hand the last seconds count.
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
    for (const ShelfPoint& point : signal_runtime(workspace).shelf(part)) {
        const float lag = static_cast<float>(1e3 * point.lag);
        const float jitter = static_cast<float>(std::clamp(100.0 * point.jitter, 1.0, 900.0));
        Curve curve{kind_title(point.filter), palette.neutral, {{std::max(lag, 0.0f), jitter}}};
        curve.width = 1.6f;
        curve.strength = 0.75f;
        if (point.stage) {
            curve.colour = stage_colour(palette, part, *point.stage);
            curve.width = 2.6f;
            curve.strength = 1.0f;
        }
        most_lag = std::max(most_lag, 1.15f * lag);
        points.push_back(std::move(curve));
    }
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

/// Which of the lower plots: a row of choices, with what each is for on the right.
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

/// What colours mean, in as many lines as that takes; of very many in three, and how many more there are.
void colour_key(const std::vector<std::pair<std::string, glm::vec3>>& rows) {
    constexpr int max_lines = 3;
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
            key.emplace_back(kind_title(part.stages[i].filter), stage_colour(colours, part, i));
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
    if (part.plot == SignalPlot::Fit && !part.wanted.empty()) {
        lower.emplace_back("wanted", colours.text);
        for (std::size_t i = 0; i < std::min(shown_fits, part.fits.size()); ++i)
            lower.emplace_back(kind_title(part.fits[i].filter), fit_colour(colours, i));
    }
    if (!lower.empty()) colour_key(lower);
    const float rest = std::max(8.0f, ImGui::GetContentRegionAvail().y / line - 0.5f);
    if (part.plot == SignalPlot::Rates) rates_plot(workspace, colours, rest);
    if (part.plot == SignalPlot::Shelf) shelf_plot(workspace, colours, rest);
    if (part.plot == SignalPlot::Fit) fit_plot(part, colours, rest, emit);
}

}  // namespace tendril::app
