// The single table of keys and mouse gestures: the shell's rows and every lab's. The handlers, the menu, the
// help overlay, the tooltips and the README's list all come from it.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/labs/kit/shortcut.hpp"
#include "app/labs/labs.hpp"
#include "app/shell/mouse_preset.hpp"
#include "app/window/event.hpp"

namespace tendril::app {

class CommandTable;

class Shortcuts {
  public:
    /// A lab's rows follow the others of their section; its own sections come before the last one, *Help*. A
    /// row without a title gets its command's.
    Shortcuts(const Labs& labs, const CommandTable& commands);

    /// A row with the same title as an earlier one is another key for it.
    const std::vector<Shortcut>& all() const { return rows_; }
    /// The shortcut of that key in a lab; null if there is none.
    const Shortcut* find(const Chord& chord, std::string_view lab) const;
    /// "Ctrl+Z", of the first row with that command; empty if it has no key.
    std::string keys_for(std::string_view command) const;
    /// "Ctrl+Shift+Z, Ctrl+Y": every key that does the same.
    std::string all_keys_for(const Shortcut& wanted) const;
    /// Mouse gestures common to all labs, then those of the named lab; of every lab if the name is empty.
    std::vector<MouseHelp> mouse_help(std::string_view lab = {}, MousePreset preset = MousePreset::Tendril,
                                      Scroll scroll = Scroll::Zoom) const;
    /// Both lists as Markdown tables, for the README.
    std::string markdown() const;

  private:
    void add(Shortcut row);

    struct LabHelp {
        std::string lab;
        std::vector<MouseHelp> rows;
    };
    std::vector<Shortcut> rows_;
    std::vector<LabHelp> mouse_;
};

}  // namespace tendril::app
