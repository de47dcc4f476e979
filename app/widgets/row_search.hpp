// Finds the rows of a command's arguments in a panel, and the folded sections around them; and highlights a
// section. During a search, panels are drawn out of sight with everything unfolded.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tendril::app {

struct RowSearch {
    std::string title;  ///< title of a section to find too; may be empty
    std::string command;
    std::vector<std::string> arguments{};
    std::vector<std::string> inside{};  ///< the folded sections around the row being drawn
    std::vector<std::string> found{};   ///< the folded sections around a row of the command
    /// Every row of a table: its text, and its id for Dear ImGui.
    std::vector<std::pair<const void*, unsigned>> texts{};
};

/// Null unless a search is running.
RowSearch* row_search();
/// Every row of a command calls this.
void note_row_of(std::string_view command, std::string_view argument);
/// Every row of a table calls this; `label` is the row's.
void note_text(const void* text, const char* label);
/// Draws a panel out of sight for a search.
class SearchWindow {
  public:
    explicit SearchWindow(RowSearch& search);
    ~SearchWindow();
    SearchWindow(const SearchWindow&) = delete;
    SearchWindow& operator=(const SearchWindow&) = delete;
};

// Highlights the heading of the section that a card's step points to.

/// Records that a section begins at the cursor of the current window; section() calls it.
void note_section(const char* title);
/// True if the current window has drawn such a section in this frame.
bool has_section(const char* title);
/// Draws a frame around the heading, if there is such a section, or an arrow towards it if it is scrolled out
/// of view. Call it after the section's rows, in the same window.
void light_section(const char* title);

}  // namespace tendril::app
