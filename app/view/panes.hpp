// The 3D view divided into panes: what is compared stands side by side, each in a view of its own, all seen by
// one camera. Nearly always there is one.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "app/view/camera.hpp"
#include "app/view/draw_list.hpp"

namespace tendril::app {

/// What is written in a pane's corner.
struct PaneTitle {
    std::string text;
    std::string detail{};  ///< smaller, below it; left out where there is no room
    glm::vec3 colour{1.0f};
};

struct Pane {
    Rect rect;  ///< window coordinates
    DrawList drawn{};

    Camera camera(const CameraPose& pose) const { return {pose, rect}; }
};

inline constexpr float pane_gap = 2.0f;  ///< pixels, at scale 1

/// `count` equal rectangles in rows, from the top left, as nearly square as they come; the last row may have
/// fewer. Between them `gap` pixels, and all on whole pixels. A single one is all of the view.
std::vector<Rect> tiled(const Rect& view, std::size_t count, float gap);

}  // namespace tendril::app
