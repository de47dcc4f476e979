// The pieces that the Signal lab's panels and its flat picture are put together from.
#pragma once

#include "app/labs/kit/panel_rows.hpp"
#include "app/labs/signal/analysis.hpp"
#include "app/view/palette.hpp"
#include "app/widgets/emit.hpp"

namespace tendril::app {

/// "spring" as "Spring", "one_euro" as "1 Euro".
std::string kind_title(const signal::Filter& filter);
std::string kind_title(const signal::Kind& kind);

/// The chain: a row for each filter, and buttons that add one.
void chain_rows(const SignalPart& part, const Palette& palette, Emit& emit);
/// How the whole chain follows its input.
Verdict signal_verdict(const SignalPart& part, const signal::Measures& whole);
/// The parameters of the filter that is selected.
void parameter_rows(const SignalPart& part, const Palette& palette, Emit& emit);
/// The ranking of fitted filters.
void fit_rows(const SignalPart& part, Emit& emit);

/// How many of the best fits the plot shows, and in which colours.
inline constexpr std::size_t shown_fits = 3;
glm::vec3 fit_colour(const Palette& palette, std::size_t rank);
/// The plot of a response that is drawn, with the best fits.
void fit_plot(const SignalPart& part, const Palette& palette, float height, Emit& emit);

}  // namespace tendril::app
