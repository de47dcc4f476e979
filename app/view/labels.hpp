// Where labels go: beside their points, inside the viewport, never on top of one another. No drawing and no
// fonts in it, only rectangles.
//
// Each label tries the places around its point in a fixed order and takes the first that is free, those of
// higher rank choosing first; one that finds none is left out. Deciding by rank alone, and by the order given
// where ranks are equal, keeps a label from flickering while nothing moves. A grid of cells keeps the cost
// near linear: 10 000 labels take a few milliseconds. (Greedy point-feature labelling; see Christensen, Marks
// and Shieber, 1995, for better and slower ones.)
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "app/view/camera.hpp"

namespace tendril::app {

struct LabelRequest {
    glm::vec2 at{0.0f};       ///< pixel of the point
    glm::vec2 size{0.0f};     ///< of the text, in pixels
    float clearance = 10.0f;  ///< pixels around the point to keep free
    int rank = 0;
};

struct PlacedLabel {
    std::size_t request = 0;  ///< index of the request
    Rect box;                 ///< where the text goes
};

/// The labels that fit, in the order in which they were placed. `gap` pixels stay free between two labels. A
/// place that covers none of the `obstacles` is preferred; where there is none, a label covers one rather
/// than be left out. Requests that are not finite, are empty, or whose point lies outside the viewport are
/// left out.
std::vector<PlacedLabel> place_labels(std::span<const LabelRequest> requests, const Rect& viewport,
                                      float gap = 2.0f, std::span<const Rect> obstacles = {});

}  // namespace tendril::app
