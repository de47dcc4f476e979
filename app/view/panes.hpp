// The 3D view divided into panes that show things side by side for comparison, all seen by one camera.
// Usually there is one.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "app/view/camera.hpp"
#include "app/view/draw_list.hpp"

namespace tendril::app {

/// The text in a pane's corner.
struct PaneTitle {
    std::string text;
    std::string detail{};  ///< smaller, below it; omitted if there is no room
    glm::vec3 colour{1.0f};
};

struct Pane {
    Rect rect;  ///< window coordinates
    DrawList drawn{};

    Camera camera(const CameraPose& pose) const { return {pose, rect}; }
};

inline constexpr float pane_gap = 2.0f;  ///< pixels, at scale 1

/// `count` equal rectangles in rows, from the top left, as large in their smaller side as possible; the last
/// row may have fewer. They are `gap` pixels apart and on whole pixels. A single one fills the view.
std::vector<Rect> tiled(const Rect& view, std::size_t count, float gap);

}  // namespace tendril::app
