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
    float width = 1.0f;             ///< of the line, and of a single point, as a factor
    float strength = 1.0f;          ///< 0 to 1: how much it stands out
    bool marks = true;              ///< its points, where they are not too many
};

struct PlotAxes {
    const char* x = "";  ///< what it is: "iterations", "tip to target"
    const char* x_unit = "";
    const char* y = "";
    const char* y_unit = "";
    /// The y axis is logarithmic and begins here; values below lie on its edge. 0: it is even, and goes from
    /// the lowest value to the highest.
    float min_y = 1e-6f;
    float from_x = 0.0f;                ///< where the x axis begins
    float min_x = 1.0f;                 ///< and where it ends at least
    float low_y = 0.0f, high_y = 0.0f;  ///< of an even y axis: what it shows at least, where low < high
    bool fixed_y = false;  ///< it shows that and no more: a mark says where a curve leaves it, and which
    float level = 0.0f;    ///< a dashed line at this y, where it is over 0
    float at_x = -1.0f;    ///< a line at this x, where it is not negative
    /// Where the x axis begins and ends, pixels of the window: below something that has the same axis. Where
    /// left < right; else it is as long as there is room.
    float left = 0.0f, right = 0.0f;
    bool whole_x = false;    ///< x counts something: marks at whole numbers only
    bool reads_all = false;  ///< the mouse reads every curve at its x, rather than the nearest point
    bool named = false;      ///< curves of one point have their name beside it, as far as there is room
    /// It is drawn into: while the mouse button is down, low_y, high_y, from_x and min_x stay what they were
    /// when it went down. Else a place would mean another value in every frame.
    bool keeps_axes = false;
};

/// The value of a curve at x, between its points in a straight line; NaN outside them.
float value_at(const Curve& curve, float x);

/// Where the mouse went in a frame with its left button down, as values of both axes.
struct PlotStroke {
    bool drawn = false;
    glm::vec2 from{0.0f}, to{0.0f};
};

/// As wide as there is room, `height` in lines of text. Resting the mouse on it tells the nearest point, or
/// all curves at that place.
PlotStroke plot(const char* id, std::span<const Curve> curves, const PlotAxes& axes, float height);

/// A small square of colour before what is written next.
void colour_mark(glm::vec3 colour);

}  // namespace tendril::app
