// What is wrong with how a window is laid out: texts that are cut, things that lie on each other, and what
// cannot be reached.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/shell/layout.hpp"
#include "tests/app/support/frame_record.hpp"

namespace tendril::test {

struct LayoutFault {
    std::string what;    ///< "cut at the right"
    std::string window;  ///< a region of the shell, or a sheet by its title
    std::string text;    ///< what is there

    std::string message() const { return window + ": \"" + text + "\" " + what; }
};

/// A part of the shell that nothing else may cover, though it is no window or more than one.
struct ShellPart {
    std::string name;
    app::Rect box;
};

/// "panel", "inspector/content": without the numbers that Dear ImGui adds.
std::string window_name(const ImGuiWindow* window);

/// Texts that are cut, whether by their window or by the box of what they stand in, or that wrap within a
/// word. What a window that scrolls has cut at its upper or lower edge can be scrolled to.
std::vector<LayoutFault> cut_texts(const FrameRecord& frame);
/// Texts that end in "..." although `means_dots` does not know them. On buttons and in headings that is a
/// fault; of the others `others` gets the places, since they may have tooltips.
std::vector<LayoutFault> elided_texts(const FrameRecord& frame,
                                      const std::function<bool(const std::string&)>& means_dots,
                                      std::vector<const DrawnText*>& others);
/// Texts on texts, items on items, and texts that begin in an item and end out of it.
std::vector<LayoutFault> overlaps(const FrameRecord& frame);
/// Items without a size, or out of their window where no scrolling brings them in; windows beyond the screen;
/// bars that would have to scroll.
std::vector<LayoutFault> out_of_reach(const FrameRecord& frame, glm::vec2 screen);
/// Parts of the shell that cover each other.
std::vector<LayoutFault> covered(const std::vector<ShellPart>& parts);

}  // namespace tendril::test
