// Places labels beside their points, inside the viewport, never overlapping. Works on rectangles, without
// drawing or fonts.
//
// Each label tries the positions around its point in a fixed order and takes the first free one; higher ranks
// choose first, and a label without a free position is omitted. Deciding by rank, then by the given order,
// keeps labels from flickering while nothing moves. A grid keeps the cost near linear: 10 000 labels take a
// few milliseconds. (Greedy point-feature labelling; see Christensen, Marks and Shieber, 1995, for better and
// slower methods.)
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "app/view/camera.hpp"

namespace tendril::app {

struct LabelRequest {
    glm::vec2 at{0.0f};       ///< pixel of the point
    glm::vec2 size{0.0f};     ///< the text's, in pixels
    float clearance = 10.0f;  ///< pixels around the point to keep free
    int rank = 0;
};

struct PlacedLabel {
    std::size_t request = 0;  ///< index of the request
    Rect box;                 ///< the text's
};

/// The labels that fit, in the order of placement. `gap` pixels stay free between two labels. Positions that
/// cover none of the `obstacles` are preferred, but a label covers one rather than be omitted. Omits requests
/// that are not finite, have an empty size, or whose point is outside the viewport.
std::vector<PlacedLabel> place_labels(std::span<const LabelRequest> requests, const Rect& viewport,
                                      float gap = 2.0f, std::span<const Rect> obstacles = {});

}  // namespace tendril::app
