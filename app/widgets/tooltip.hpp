// Tooltips, placed so that none hides what the mouse is over or goes to next.
//
// That of a panel or a bar stands beside it, over the middle of the window; that of a sheet or a list stands
// beside it. In the middle of the window it stands below or above its item, or in the corner of a plot.
#pragma once

#include <string>

#include "app/view/camera.hpp"

namespace tendril::app {

/// What ImGui draws while one exists is in the tooltip of the last item. Text wraps.
class Tooltip {
  public:
    Tooltip();
    explicit Tooltip(const Rect& drawn);  ///< of what is drawn over the scene there
    ~Tooltip();
    Tooltip(const Tooltip&) = delete;
    Tooltip& operator=(const Tooltip&) = delete;
};

void tooltip(const std::string& text);
/// An error below the last item, which it is about, over what is there: the layout does not move.
void tell_below(const std::string& text);

}  // namespace tendril::app
