// Finds everything that a user can click, drag or type into, and whether it has a tooltip: moves the mouse to
// each item that a frame drew.
#pragma once

#include <deque>
#include <glm/vec2.hpp>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "app/shell/input.hpp"
#include "app/shell/ui.hpp"
#include "app/view/camera.hpp"
#include "app/window/window.hpp"
#include "tests/app/support/frame_record.hpp"

namespace tendril::test {

/// The result for a part of the picture.
struct TooltipSearch {
    std::set<unsigned> items;                 ///< by ImGui ID
    std::map<unsigned, std::string> lacking;  ///< those without a tooltip, with the nearest text
};

class TooltipFinder {
  public:
    /// In a panel 300 pixels wide, high enough for everything that `draw` writes.
    template <class Draw>
    TooltipSearch search_panel(const Draw& draw) {
        const auto frame = [&](glm::vec2 mouse) {
            begin_panel(mouse);
            draw();
            end_panel();
        };
        // Some sizes are known one frame later; the first frames are laid out as in a panel that is too low.
        for (int i = 0; i < 3; ++i) frame(nowhere);
        fit_panel();
        for (int i = 0; i < 2; ++i) frame(nowhere);
        return search({{0.0f, 0.0f}, {panel_width, panel_height_}}, frame);
    }
    /// In part of a window of its size; `draw` draws the whole window.
    template <class Draw>
    TooltipSearch search_window(const app::Rect& part, const Draw& draw) {
        const auto frame = [&](glm::vec2 mouse) {
            begin(mouse);
            draw();
            end();
        };
        for (int i = 0; i < 3; ++i) frame(nowhere);
        return search(part, frame);
    }
    glm::vec2 window_size() const;
    /// The text that `draw` writes into a panel, and the tooltip under the mouse.
    template <class Draw>
    std::string read(const Draw& draw, glm::vec2 mouse = nowhere) {
        std::string text;
        for (int i = 0; i < 2; ++i) {  // the item under the mouse is known one frame later
            begin_panel(mouse);
            begin_text();
            draw();
            text = end_text();
            end_panel();
        }
        return text;
    }
    /// Presses or releases the left mouse button.
    void press(bool down) {
        const app::Event event = app::MousePress{app::MouseButton::Left, down};
        input_.take(&event);
    }
    /// The same without numbers, so that similar panels are searched once.
    template <class Draw>
    std::string text_of(const Draw& draw) {
        return without_numbers(read(draw));
    }

  private:
    static constexpr glm::vec2 nowhere{-100.0f};
    static constexpr float panel_width = 300.0f;

    template <class Frame>
    TooltipSearch search(const app::Rect& part, const Frame& frame) {
        FrameRecorder recorder;
        frame(nowhere);
        const FrameRecord drawn = recorder.frame();
        std::deque<DrawnItem> items(drawn.items.begin(), drawn.items.end());
        std::set<unsigned> known;
        for (const DrawnItem& item : items) known.insert(item.id);
        TooltipSearch found;
        std::map<unsigned, const DrawnItem*> silent;
        for (std::size_t i = 0; i < items.size(); ++i) {
            for (const glm::vec2 mouse : places_on(items[i], part)) {
                frame(mouse);
                for (const DrawnItem& item : recorder.frame().items)  // some appear only under the mouse
                    if (known.insert(item.id).second) items.push_back(item);
                if (look(items[i], found, silent)) break;
            }
        }
        for (const auto& [id, item] : silent) found.lacking[id] = text_at(drawn, *item);
        return found;
    }

    void begin(glm::vec2 mouse);
    void end() { ui_.end(); }
    void begin_panel(glm::vec2 mouse);
    void end_panel();
    void fit_panel();
    static void begin_text();
    static std::string end_text();
    static std::string without_numbers(std::string text);
    /// Mouse positions to find an item's tooltip: its middle, then all over it, since plots have tooltips
    /// only in places. None if the item is outside `part`.
    static std::vector<glm::vec2> places_on(const DrawnItem& item, const app::Rect& part);
    /// Records the item under the mouse in the last frame. True once `item` is known to have a tooltip.
    static bool look(const DrawnItem& item, TooltipSearch& found,
                     std::map<unsigned, const DrawnItem*>& silent);
    /// The text on an item, or else the nearest one.
    static std::string text_at(const FrameRecord& drawn, const DrawnItem& item);

    std::unique_ptr<app::Window> window_ = app::open_offscreen({1280, 800});
    app::Ui ui_;
    app::Input input_;
    float panel_height_ = 300.0f;
};

}  // namespace tendril::test
