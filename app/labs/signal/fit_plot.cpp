// The response that is wanted, drawn with the mouse over the input that it is to answer, and the best fits.
#include <imgui.h>

#include <algorithm>

#include "app/labs/signal/panels.hpp"
#include "app/labs/signal/recording.hpp"
#include "app/labs/signal/scene.hpp"
#include "app/labs/signal/span.hpp"
#include "app/widgets/plot.hpp"

namespace tendril::app {

glm::vec3 fit_colour(const Palette& palette, std::size_t rank) {
    return rank == 0 ? palette.head : rank == 1 ? rgb(0xCC79A7) : palette.tail;
}

void fit_plot(const SignalPart& part, const Palette& palette, float height, Emit& emit) {
    const bool drawn = !part.wanted.empty();
    const InputRows rows = drawn ? part.fit_input : rows_to_answer(part);
    const std::vector<double> time = signal::times_of(rows);
    std::vector<double> input;
    for (const signal::Sample& row : rows) input.push_back(row.input);
    std::vector<Curve> curves{curve_of("input", input_colour(palette), time, input)};
    curves.back().strength = 0.5f;
    for (std::size_t i = 0; i < std::min(shown_fits, part.fits.size()); ++i) {
        const std::vector<double> output = signal::run({&part.fits[i].filter, 1}, rows);
        curves.push_back(curve_of(kind_title(part.fits[i].filter), fit_colour(palette, i), time, output));
    }
    if (drawn) {
        curves.push_back(curve_of("wanted", palette.text, time, part.wanted));
        curves.back().width = 1.4f;
    }
    // There is always room to draw beyond what there is.
    Span span = span_of(part.input, input);
    const double range = span.high - span.low, low = span.low - range, high = span.high + range;
    for (const double value : part.wanted)
        span.low = std::min(span.low, value), span.high = std::max(span.high, value);
    if (!drawn) {  // a stroke begins with what the chain makes of the input
        for (const double value : signal::run(enabled_filters(part), rows)) {
            span.low = std::min(span.low, std::max(value, low));
            span.high = std::max(span.high, std::min(value, high));
        }
    }
    const double margin = 0.25 * (span.high - span.low), end = time.empty() ? 1.0 : time.back();
    PlotAxes axes = time_axes({span.low - margin, span.high + margin}, 0.0, end);
    axes.keeps_axes = true;
    if (part.recording) axes.at_x = static_cast<float>(part.time);
    const PlotStroke stroke = plot("fit", curves, axes, height);
    if (!stroke.drawn) return;
    emit.continuously("signal.fit.draw", {{"from", stroke.from.x},
                                          {"from_value", stroke.from.y},
                                          {"to", stroke.to.x},
                                          {"to_value", stroke.to.y}});
}

}  // namespace tendril::app
