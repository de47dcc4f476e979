// Rows of the Signal lab's panel, inspector and canvas.
#pragma once

#include "app/labs/kit/panel_rows.hpp"
#include "app/labs/signal/analysis.hpp"
#include "app/view/palette.hpp"
#include "app/widgets/emit.hpp"

namespace tendril::app {

/// "spring" as "Spring", "one_euro" as "1 Euro".
std::string kind_title(const signal::Filter& filter);
std::string kind_title(const signal::Kind& kind);

/// The same of a stage, numbered if there are several of its kind.
std::string stage_title(const SignalPart& part, std::size_t stage);
/// "600 rows in 10 s, 16.7 ms apart", or "uneven: 4 ms to 31 ms apart".
std::string rows_text(const InputRows& rows);

/// The chain: one row for each filter, and a button that adds one.
void chain_rows(const SignalPart& part, const Palette& palette, Emit& emit);
/// The verdict on how the shown lane follows the input.
Verdict signal_verdict(const SignalPart& part, const signal::Measures& whole);
/// The parameters of the selected filter.
void parameter_rows(const Workspace& workspace, const Palette& palette, Emit& emit);
/// The ranking of fitted filters.
void fit_rows(const SignalPart& part, Emit& emit);

/// The number of best fits that the plot shows, and their colours.
inline constexpr std::size_t shown_fits = 3;
glm::vec3 fit_colour(const Palette& palette, std::size_t rank);
/// The plot of the desired response, to draw on, with the best fits.
void fit_plot(const SignalPart& part, const Palette& palette, float height, Emit& emit);

}  // namespace tendril::app
