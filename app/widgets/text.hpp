// Fits text into a width: shortened with "...", or aligned right.
#pragma once

#include <string>

namespace tendril::app {

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

/// Whether Escape was pressed in this frame.
bool escape_pressed();
void close_popup_on_escape();

}  // namespace tendril::app
