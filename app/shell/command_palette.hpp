// Ctrl+K: finds a command by its name or help, and runs it with arguments typed as they would be in a script.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <string>

#include "app/shell/shortcuts.hpp"
#include "app/widgets/emit.hpp"

namespace tendril::app {

struct Command;
class CommandTable;

/// Reads `chain.add length=1.5 position=[0,1,0]`: a name, then arguments as JSON, where a bare word is a
/// text.
struct TypedCommand {
    std::string name;
    SharedJson arguments;
};
/// Throws std::runtime_error naming the piece that it cannot read.
TypedCommand read_typed_command(const std::string& line);

/// Commands that match every word of the query, in name or help; those whose name starts with it first.
std::vector<const Command*> search_commands(const CommandTable& table, const std::string& query);

class CommandPalette {
  public:
    void frame(bool open, const CommandTable& table, const Shortcuts& shortcuts, glm::vec2 screen,
               float scale, Emit& emit);

  private:
    using Found = std::vector<const Command*>;
    void forget();
    /// The line that is typed in; whether Enter ended it.
    bool line_field(bool appearing);
    void move_choice(int count);
    /// The list; the row that was clicked, if any.
    const Command* list(const Found& found, const Shortcuts& shortcuts, bool bring_choice_into_view);
    void explain(const Found& found);
    /// Runs what is typed, or `chosen` where only a search is typed.
    void run(const CommandTable& table, const Command* chosen, Emit& emit);
    void run_chosen(const Command& chosen, Emit& emit);

    std::array<char, 512> line_{};
    int chosen_ = 0;
    int listed_choice_ = 0;  ///< as the list last showed it
    bool was_open_ = false;
    bool take_caret_ = false;  ///< the line wants the keyboard, the caret after its last character
    std::string complaint_;
};

}  // namespace tendril::app
