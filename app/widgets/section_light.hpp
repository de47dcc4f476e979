// Highlights the heading of the section that a card's step points to.
#pragma once

namespace tendril::app {

/// Records that a section begins at the cursor of the current window; section() calls it.
void note_section(const char* title);
/// Whether the current window has drawn such a section in this frame.
bool has_section(const char* title);
/// Draws a frame around the heading, if there is such a section, or an arrow towards it if it is scrolled out
/// of view. Call it after the section's rows, in the same window.
void light_section(const char* title);

}  // namespace tendril::app
