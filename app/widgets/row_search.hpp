// Finds the rows of a command's arguments in a panel, and the folded sections around them. During a search,
// panels are drawn out of sight with everything unfolded.
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

}  // namespace tendril::app
