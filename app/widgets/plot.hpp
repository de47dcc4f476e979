// Curves over a grid, with axes that say what they are.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

namespace tendril::app {

struct Curve {
    std::string name;
    glm::vec3 colour{1.0f};
    std::vector<glm::vec2> points;  ///< x ascending
};

struct PlotAxes {
    const char* x = "";  ///< what it is: "iterations", "tip to target"
    const char* x_unit = "";
    const char* y = "";
    const char* y_unit = "";
    /// The y axis is logarithmic and begins here; values below lie on its edge. 0: it is even, and goes from
    /// the lowest value to the highest.
    float min_y = 1e-6f;
    float min_x = 1.0f;    ///< the x axis goes from 0 to this at least
    float level = 0.0f;    ///< a dashed line at this y, where it is over 0
    float at_x = -1.0f;    ///< a line at this x, where it is not negative
    bool whole_x = false;  ///< x counts something: marks at whole numbers only
};

/// As wide as there is room, `height` in lines of text. Resting the mouse on it tells the nearest point.
void plot(const char* id, std::span<const Curve> curves, const PlotAxes& axes, float height);

/// A small square of colour before what is written next.
void colour_mark(glm::vec3 colour);

}  // namespace tendril::app
