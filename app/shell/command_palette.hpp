// Ctrl+K: finds a command by what it does, shows what it takes and what that may be, and runs it as it would
// stand in a script.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "app/shell/command_completion.hpp"
#include "app/shell/command_line.hpp"
#include "app/shell/command_search.hpp"
#include "app/shell/palette_rows.hpp"
#include "app/widgets/emit.hpp"

struct ImGuiInputTextCallbackData;

namespace tendril::app {

struct ShellFrame;

class CommandPalette {
  public:
    void frame(const ShellFrame& frame, Emit& emit);

  private:
    /// What the line leads to.
    struct Offer {
        TypedLine typed{};
        std::vector<const Command*> found{};  ///< where it is a search
        std::vector<CompletionRow> ways{};    ///< where it is a command
        std::size_t size() const { return typed.command == nullptr ? found.size() : ways.size(); }
    };
    Offer offer(const ShellFrame& frame) const;
    void forget();
    /// The line that is typed in; whether Enter ended it.
    bool line_field(const ShellFrame& frame, bool appearing);
    int on_tab(const ShellFrame& frame, ImGuiInputTextCallbackData& data);
    /// The line as Tab completes it.
    std::string tabbed(const ShellFrame& frame) const;
    void move_choice(int count);
    /// What the list shows of the offer.
    std::vector<PaletteRow> rows(const ShellFrame& frame, const Offer& offer) const;
    /// The line below the list: what is wrong, what is missing, or which keys do what.
    void status(const Offer& offer) const;
    void enter(const ShellFrame& frame, const Offer& offer, Emit& emit);
    void choose(const ShellFrame& frame, const Offer& offer, std::size_t row, Emit& emit);
    /// Runs the line as it stands; complains where it cannot be run, and lets it be mended.
    void run(const ShellFrame& frame, Emit& emit);
    void run(const std::string& name, SharedJson arguments, Emit& emit);
    void put(const std::string& line);

    std::array<char, 512> line_{};
    int chosen_ = 0;
    int listed_choice_ = 0;  ///< as the list last showed it
    bool moved_ = false;     ///< a row was chosen by hand since the line was last edited
    bool was_open_ = false;
    bool take_caret_ = false;  ///< the line wants the keyboard, the caret after its last character
    std::string complaint_;
    std::vector<std::string> recent_;  ///< commands that ran from here, the newest first
};

}  // namespace tendril::app
