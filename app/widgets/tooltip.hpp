// Tooltips, placed so that they hide neither the item under the mouse nor the next ones; and text cut to a
// width, which a tooltip shows in full.
//
// The tooltip of a panel or bar is beside the panel, over the middle of the window; that of a sheet or list
// is beside the sheet. In the middle of the window it is below or above its item, or in the corner of a plot.
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

// Fits text into a width: shortened with "...", or aligned right.

/// The text if it fits into `width` pixels, else as much of it as fits and "...".
std::string elided(const std::string& text, float width);
/// Cuts in the middle instead, and keeps more of the end, where a path has the file's name.
std::string elided_in_middle(const std::string& text, float width);
/// Cuts after a whole word instead; empty if not even the first word fits.
std::string elided_at_word(const std::string& text, float width);
/// Writes one line within `width`; a tooltip shows the full text if it was cut.
void text_elided(const std::string& text, float width, bool dim = false);
/// Writes the text right-aligned in the remaining width, so that digits line up.
void text_flush_right(const std::string& text, bool dim = false);

/// True if Escape was pressed in this frame.
bool escape_pressed();
void close_popup_on_escape();

}  // namespace tendril::app
