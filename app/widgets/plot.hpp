// Curves over a grid with labelled axes, to read and to edit.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <tendril/signal/curve.hpp>
#include <vector>

namespace tendril::app {

struct Curve {
    std::string name;
    glm::vec3 colour{1.0f};
    std::vector<glm::vec2> points;  ///< x ascending
    float width = 1.0f;             ///< factor on the width of the line, or the size of a single point
    float strength = 1.0f;          ///< emphasis, 0 to 1
    bool marks = true;              ///< marks its points, unless there are too many
};

struct PlotAxes {
    const char* x = "";  ///< title: "iterations", "tip to target"
    const char* x_unit = "";
    const char* y = "";
    const char* y_unit = "";
    /// Logarithmic y axis from the power of ten below this; lower values are drawn at its edge, which reads
    /// "0" if a value is 0. 0: a linear axis, from the lowest value to the highest.
    float min_y = 1e-6f;
    float from_x = 0.0f;                ///< start of the x axis
    float min_x = 1.0f;                 ///< the x axis ends here or beyond
    float low_y = 0.0f, high_y = 0.0f;  ///< linear y axis: a range it includes, if low < high
    bool fixed_y = false;               ///< shows exactly that range, with marks where curves leave it
    float level = 0.0f;                 ///< draws a dashed line at this y, if positive
    std::string note{};                 ///< ends the tooltip of the nearest point
    float at_x = -1.0f;                 ///< draws a line at this x, if not negative
    /// Window pixels of the x axis's ends, to align it with another widget; used if left < right. Otherwise
    /// the axis fills the available width.
    float left = 0.0f, right = 0.0f;
    bool whole_x = false;    ///< x is a count: marks at whole numbers only
    bool reads_all = false;  ///< the mouse reads every curve at its x instead of the nearest point
    bool named = false;      ///< writes the names of single-point curves where there is room
    /// For plots that the user draws into: low_y, high_y, from_x and min_x are frozen while the mouse button
    /// is down: otherwise a position would mean a different value in every frame.
    bool keeps_axes = false;
};

/// The value of a curve at x, interpolated linearly; NaN outside its points.
float value_at(const Curve& curve, float x);

/// The mouse's move in one frame with the left button down, in values of both axes.
struct PlotStroke {
    bool drawn = false;
    glm::vec2 from{0.0f}, to{0.0f};
};

/// Fills the available width; `height` is in lines of text. A tooltip shows the nearest point, or all curves
/// at the mouse's x.
PlotStroke plot(const char* id, std::span<const Curve> curves, const PlotAxes& axes, float height);

/// A small square of colour before the next item.
void colour_mark(glm::vec3 colour);

// The marks of an axis: their spacing and their texts.

/// The smallest of ..., 0.1, 0.2, 0.5, 1, 2, 5, ... that is at least `smallest`.
double axis_step(double smallest);
/// All marks have the unit of the largest one, and the decimals that a step needs: "0.5 s" and "2 s" for
/// steps of 0.5 up to 2, "100 ms" for steps of 0.1 up to 0.5.
std::string axis_text(double value, double step, double largest, const char* unit);

// Edits a curve by its keys: drag to move one, double-click to add one, right-click to remove one. The active
// key's tangents are dragged by their ends.

/// True in a frame in which the user changed the curve. Fills the available width; `height` is in lines of
/// text. `input`, in 0 to 1 of the source range, is shown as a point on the curve; values outside are not
/// shown.
bool curve_editor(const char* id, signal::Curve& curve, glm::vec3 colour, float height, double input);

}  // namespace tendril::app
