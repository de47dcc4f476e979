// Faults in a window's layout: texts that are cut off, overlaps, and items that cannot be reached.
#pragma once

#include <functional>

#include "app/shell/shell.hpp"
#include "tests/app/support/frame_record.hpp"

namespace tendril::test {

struct LayoutFault {
    std::string what;    ///< "cut at the right"
    std::string window;  ///< a region of the shell, or a sheet by its title
    std::string text;    ///< the text there

    std::string message() const { return window + ": \"" + text + "\" " + what; }
};

/// A part of the shell that nothing else may cover, although it is not exactly one window.
struct ShellPart {
    std::string name;
    app::Rect box;
};

/// "panel", "inspector/content": without the numbers that Dear ImGui adds.
std::string window_name(const ImGuiWindow* window);

/// Texts cut off by their window or by the box around them, or wrapped within a word. Excludes those at the
/// upper or lower edge of a window that scrolls.
std::vector<LayoutFault> cut_texts(const FrameRecord& frame);
/// Texts that end in "..." unless `means_dots` expects that. On buttons and in headings they are faults;
/// `others` receives the rest, which may have tooltips.
std::vector<LayoutFault> elided_texts(const FrameRecord& frame,
                                      const std::function<bool(const std::string&)>& means_dots,
                                      std::vector<const DrawnText*>& others);
/// Texts on texts, items on items, and texts that begin inside an item and end outside it.
std::vector<LayoutFault> overlaps(const FrameRecord& frame);
/// Titles that touch the edge of their button.
std::vector<LayoutFault> tight_buttons(const FrameRecord& frame);
/// Items without a size, or outside their window where scrolling cannot reach; windows beyond the screen;
/// bars that would have to scroll.
std::vector<LayoutFault> out_of_reach(const FrameRecord& frame, glm::vec2 screen);
/// Parts of the shell that cover one another.
std::vector<LayoutFault> covered(const std::vector<ShellPart>& parts);

}  // namespace tendril::test
