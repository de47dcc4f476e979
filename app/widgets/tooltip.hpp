// Tooltips, placed so that none hides the item under the mouse or the next ones.
//
// A panel's or a bar's tooltip is beside the panel, over the middle of the window; a sheet's or a list's is
// beside the sheet. In the middle of the window it is below or above its item, or in the corner of a plot.
#pragma once

#include <string>

#include "app/view/camera.hpp"

namespace tendril::app {

/// While one exists, everything drawn is in the tooltip of the last item. Text wraps.
class Tooltip {
  public:
    Tooltip();
    explicit Tooltip(const Rect& drawn);  ///< tooltip of an item drawn over the scene there
    ~Tooltip();
    Tooltip(const Tooltip&) = delete;
    Tooltip& operator=(const Tooltip&) = delete;
};

void tooltip(const std::string& text);
/// An error below the last item, drawn over the rows there: the layout does not move.
void tell_below(const std::string& text);

}  // namespace tendril::app
