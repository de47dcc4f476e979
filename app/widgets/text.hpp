// Text that is made to fit: cut short with "...", or set flush right.
#pragma once

#include <string>

namespace tendril::app {

/// The text as it is if it fits into `width` pixels, else as much of it as does and "...".
std::string elided(const std::string& text, float width);
/// Cut behind a whole word instead; empty where not even the first one fits.
std::string elided_at_word(const std::string& text, float width);
/// Writes it on one line within `width`, dim or not; what was cut is told when the mouse rests on it.
void text_elided(const std::string& text, float width, bool dim = false);
/// A tooltip beside the mouse, wrapped: so that a long one is whole in a small window with large text.
void tooltip(const std::string& text);
/// Writes it at the right end of the room that is left, so that digits stay under digits.
void text_flush_right(const std::string& text, bool dim = false);

/// Whether Escape went down in this frame. Within a popup: closes it then.
bool escape_pressed();
void close_popup_on_escape();

}  // namespace tendril::app
