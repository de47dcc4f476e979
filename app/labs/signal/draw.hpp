// The balls of the Signal lab, which move by the input and the output: metres, one to a unit of the signal.
#pragma once

#include <glm/vec3.hpp>

#include "app/labs/signal/signal_part.hpp"
#include "app/view/palette.hpp"

namespace tendril::app {

inline constexpr float ball_level = 1.5f;  ///< where a signal of 0 is

struct BallPlaces {
    glm::vec3 input{0.0f}, output{0.0f};
};
/// Within a kilometre: what grows without bound leaves the picture.
BallPlaces ball_places(const SignalPart& part);

/// The colour of a filter's output in every plot; the last one on is that of the output ball.
glm::vec3 stage_colour(const Palette& palette, const SignalPart& part, std::size_t stage);
glm::vec3 input_colour(const Palette& palette);
glm::vec3 output_colour(const Palette& palette);

}  // namespace tendril::app
