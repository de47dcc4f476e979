// Shows the Signal lab: rows of its panel, inspector and canvas, and its balls.
#pragma once

#include <glm/vec3.hpp>

#include "app/labs/kit/panel_rows.hpp"
#include "app/labs/signal/analysis.hpp"
#include "app/labs/signal/signal_part.hpp"
#include "app/view/palette.hpp"
#include "app/widgets/emit.hpp"

namespace tendril::app {

/// "spring" as "Spring", "one_euro" as "1 Euro".
std::string kind_title(const signal::Filter& filter);
std::string kind_title(const signal::Kind& kind);

/// Likewise for a stage, numbered if there are several of its kind.
std::string stage_title(const SignalPart& part, std::size_t stage);
/// "600 rows in 10 s, 16.7 ms apart", or "uneven: 4 ms to 31 ms apart".
std::string rows_text(const InputRows& rows);

/// The chain: one row for each filter, and a button that adds one.
void chain_rows(const SignalPart& part, const Palette& palette, Emit& emit);
/// The verdict on how the shown lane follows the input.
Verdict signal_verdict(const SignalPart& part, const signal::Measures& whole);
/// The parameters of the selected filter.
void parameter_rows(const Workspace& workspace, const Palette& palette, Emit& emit);

/// The number of best fits that the plot shows, and their colours.
inline constexpr std::size_t shown_fits = 3;
glm::vec3 fit_colour(const Palette& palette, std::size_t rank);
/// The plot of the desired response, to draw on, with the best fits.
void fit_plot(const SignalPart& part, const Palette& palette, float height, Emit& emit);

// The balls of the Signal lab, moved by the input and the output: one metre per unit of the signal.

inline constexpr float ball_level = 1.5f;  ///< the height of a signal of 0

struct BallPlaces {
    glm::vec3 input{0.0f}, output{0.0f};
};
/// Limited to 1 km: a signal that grows without bound leaves the picture.
BallPlaces ball_places(const SignalPart& part);

/// The colour of a filter's output in every plot.
glm::vec3 stage_colour(const Palette& palette, const SignalStage& stage);
glm::vec3 input_colour(const Palette& palette);

}  // namespace tendril::app
