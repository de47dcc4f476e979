// Ctrl+K: finds a command by its title and help, completes its arguments and their values, and runs it as in
// a script.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/shell/command_line.hpp"
#include "app/widgets/emit.hpp"

struct ImGuiInputTextCallbackData;

namespace tendril::app {

struct ShellFrame;

/// The list of the command palette: titles, followed by the script syntax. In a window too narrow for both,
/// the syntax is below the title; words are never cut.
struct PaletteRow {
    std::string title;   ///< "Add a joint at the tip"
    std::string where;   ///< its lab, if not the open one
    std::string syntax;  ///< "chain.add length [position]"
    std::string keys;    ///< "Ctrl+Z"
    std::string help;
    bool done = false;  ///< already given: nothing to choose
};

/// The preferred height for these rows, in pixels.
float palette_list_height(const std::vector<PaletteRow>& rows, float width);

/// Fills the remaining height, except for `below` pixels, with whole rows. Returns the clicked row.
std::optional<std::size_t> palette_list(const std::vector<PaletteRow>& rows, int chosen,
                                        bool bring_choice_into_view, float below);

class CommandPalette {
  public:
    void frame(const ShellFrame& frame, Emit& emit);
    /// The command that was run since the last call.
    std::optional<Emitted> take_run() { return std::exchange(ran_, std::nullopt); }

  private:
    std::optional<Emitted> ran_;
    /// The rows that the list offers for the line.
    struct Offer {
        TypedLine typed{};
        std::vector<const Command*> found{};       ///< if the line is a search
        std::vector<CompletionRow> completions{};  ///< if it is a command
        std::size_t size() const { return typed.command == nullptr ? found.size() : completions.size(); }
    };
    Offer offer(const ShellFrame& frame) const;
    void reset();
    /// Draws the input line; returns whether Enter was pressed.
    bool line_field(const ShellFrame& frame, bool appearing);
    int on_tab(const ShellFrame& frame, ImGuiInputTextCallbackData& data);
    /// The line after Tab.
    std::string tabbed(const ShellFrame& frame) const;
    void move_choice(int count);
    /// The offer as rows of the list.
    std::vector<PaletteRow> rows(const ShellFrame& frame, const Offer& offer) const;
    /// The line below the list: a mistake, a missing argument, or the available keys.
    void status(const Offer& offer) const;
    void enter(const ShellFrame& frame, const Offer& offer, Emit& emit);
    void choose(const ShellFrame& frame, const Offer& offer, std::size_t row, Emit& emit);
    /// Runs the line; if it is invalid, shows why and keeps it for editing.
    void run(const ShellFrame& frame, Emit& emit);
    /// Opens the command's lab first, if that is another one.
    void run(const ShellFrame& frame, const Command& command, SharedJson arguments, Emit& emit);
    void set_line(const std::string& line);

    std::array<char, 512> line_{};
    int chosen_ = 0;
    int listed_choice_ = 0;  ///< the choice when the list was last drawn
    bool moved_ = false;     ///< the user moved the choice since last editing the line
    bool was_open_ = false;
    bool focus_line_ = false;  ///< give the line the focus, with the caret at its end
    std::string error_;
    std::vector<std::string> recent_;  ///< commands run from the palette, newest first
};

}  // namespace tendril::app
