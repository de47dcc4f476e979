// Lights up the heading of a section in a panel, for whoever is told to look there.
#pragma once

namespace tendril::app {

/// Where a section begins, in the window that is being filled; section() says so.
void note_section(const char* title);
/// Whether the window that is being filled has had such a section in this frame.
bool has_section(const char* title);
/// A frame around the heading, if there is such a section, or an arrow that points where it is scrolled to.
/// After its rows, in the same window.
void light_section(const char* title);

}  // namespace tendril::app
