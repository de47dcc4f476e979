// Building blocks of lab panels: folding sections, presets, verdicts. Sections stay as the user folded them.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/document/incident.hpp"
#include "app/document/workspace.hpp"
#include "app/view/palette.hpp"
#include "app/widgets/emit.hpp"
#include "app/widgets/fields.hpp"
#include "app/widgets/more.hpp"

namespace tendril::app {

/// A heading that folds its section by a click anywhere on it; true if the section is open. Its rows are
/// drawn while this object exists. Saved in the settings, by lab and title.
class [[nodiscard]] FoldingSection {
  public:
    FoldingSection(const Workspace& workspace, const char* title, Emit& emit, bool open_at_first = true);
    explicit operator bool() const& { return open_; }
    explicit operator bool() && = delete;  // a temporary would end before its rows are drawn

  private:
    bool open_;
    IdScope ids_;
};

/// The same with its rows; the rows given to the MoreRows come last, under "More".
void folding_section(const Workspace& workspace, const char* title, Emit& emit, bool open_at_first,
                     const std::function<void(MoreRows&)>& rows);
/// The end of the section `title`: its rows under "More", which starts folded. Saved in the settings like a
/// section.
void more_rows(const Workspace& workspace, const char* title, const MoreRows& more, Emit& emit);

// The section with buttons that open a preset, empty the lab or reset it.

struct PresetButton {
    std::string name;  ///< its argument in the preset command
    std::string title;
    std::string tooltip{};
    int of = 0;  ///< buttons in its row; 0: as in the other rows
};

/// Emits the lab's commands: "chain.preset", "chain.clear", "chain.reset". `clears` is the tooltip of Empty,
/// `of` the number of buttons in a row. Returns whether a preset was opened.
bool preset_rows(const std::string& lab, const std::vector<PresetButton>& presets, const char* clears,
                 Emit& emit, int of = 3);

/// Buttons for the dialogs that write pictures and videos, in an Export section.
void picture_rows(Emit& emit);

// The outcome of a request in a few words: the first and largest text of an inspector.

struct Verdict {
    std::string text;  ///< "Reached", "Out of reach: 0.23 m short", "Lengths off by 1.5 %"
    enum class Kind { Good, Bad, Open } kind = Kind::Open;
    std::string why{};           ///< the consequence, or the next step; a sentence
    std::optional<Cure> cure{};  ///< performs the next step
};

/// Runs a cure: a small button at the right end of a line. `text` is before it, cut to fit; with `whole`,
/// above it and uncut.
void cure_line(const std::string& text, const std::optional<Cure>& cure, Emit& emit, bool whole = false);

/// The maximum lines of a verdict and of the text below it, in a panel of the usual width.
struct VerdictLines {
    int verdict = 2;
    int notes = 2;
    int paragraphs = 1;  ///< in the notes
};
/// Reserves that space, so that the rows below stay in place when the verdict changes. `notes` come after the
/// verdict's own `why` and cure.
void show_verdict(const Verdict& said, const Palette& palette, Emit& emit, VerdictLines room = {},
                  const std::function<void()>& notes = {});

}  // namespace tendril::app
