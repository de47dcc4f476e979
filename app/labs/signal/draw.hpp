// The balls of the Signal lab, moved by the input and the output: one metre per unit of the signal.
#pragma once

#include <glm/vec3.hpp>

#include "app/labs/signal/signal_part.hpp"
#include "app/view/palette.hpp"

namespace tendril::app {

inline constexpr float ball_level = 1.5f;  ///< the height of a signal of 0

struct BallPlaces {
    glm::vec3 input{0.0f}, output{0.0f};
};
/// Limited to 1 km: a signal that grows without bound leaves the picture.
BallPlaces ball_places(const SignalPart& part);

/// The colour of a filter's output in every plot.
glm::vec3 stage_colour(const Palette& palette, const SignalStage& stage);
glm::vec3 input_colour(const Palette& palette);
/// The ball's: blue while a response is recorded, else the shown output's.
glm::vec3 output_colour(const Palette& palette, const SignalPart& part);

}  // namespace tendril::app
