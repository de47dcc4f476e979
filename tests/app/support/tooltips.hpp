// Finds what a person can click, drag or type into, and whether it has a tooltip: by moving the mouse over
// all of it.
#pragma once

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

namespace tendril::test {

/// What was found in a part of the picture.
struct TooltipSearch {
    std::set<unsigned> items;                 ///< by ImGui's ids
    std::map<unsigned, std::string> lacking;  ///< those without a tooltip, with the text nearest to each
};

class TooltipFinder {
  public:
    /// In a panel 300 pixels wide, high enough for all that `draw` writes into it.
    template <class Draw>
    TooltipSearch search_panel(const Draw& draw) {
        const auto frame = [&](glm::vec2 mouse) {
            begin_panel(mouse);
            draw();
            end_panel();
        };
        // Some sizes are known a frame later; what is above all lies as it does in a panel that is too low.
        for (int i = 0; i < 3; ++i) frame(nowhere);
        fit_panel();
        for (int i = 0; i < 2; ++i) frame(nowhere);
        return search({{0.0f, 0.0f}, {panel_width, panel_height_}}, frame);
    }
    /// In a part of a window of its size; `draw` draws all of that.
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
    /// The text that `draw` writes into a panel, and with the mouse on something its tooltip.
    template <class Draw>
    std::string read(const Draw& draw, glm::vec2 mouse = nowhere) {
        std::string text;
        for (int i = 0; i < 2; ++i) {  // what the mouse is on is known a frame later
            begin_panel(mouse);
            begin_text();
            draw();
            text = end_text();
            end_panel();
        }
        return text;
    }
    /// The same without numbers: what looks alike is searched once.
    template <class Draw>
    std::string text_of(const Draw& draw) {
        return without_numbers(read(draw));
    }

  private:
    static constexpr glm::vec2 nowhere{-100.0f};
    static constexpr float panel_width = 300.0f;

    template <class Frame>
    TooltipSearch search(const app::Rect& part, const Frame& frame) {
        // Nothing that can be clicked is lower than this, or narrower.
        constexpr glm::vec2 step{14.0f, 8.0f};
        TooltipSearch found;
        std::vector<Silent> silent;
        for (float y = part.min.y + 4.0f; y < part.max.y; y += step.y) {
            for (float x = part.min.x + 4.0f; x < part.max.x; x += step.x) {
                frame({x, y});
                look({x, y}, found, silent);
            }
        }
        name(found, silent, [&] { frame(nowhere); });
        return found;
    }
    struct Silent {
        unsigned id = 0;
        glm::vec2 at{0.0f};
    };

    void begin(glm::vec2 mouse);
    void end() { ui_.end(); }
    void begin_panel(glm::vec2 mouse);
    void end_panel();
    void fit_panel();
    static void begin_text();
    static std::string end_text();
    static std::string without_numbers(std::string text);
    /// What the mouse is on in the frame that has ended.
    static void look(glm::vec2 at, TooltipSearch& found, std::vector<Silent>& silent);
    template <class Frame>
    static void name(TooltipSearch& found, const std::vector<Silent>& silent, const Frame& frame) {
        if (!silent.empty()) frame();
        for (const Silent& each : silent) found.lacking[each.id] = text_at(each.at);
    }
    /// What stands in the picture about where an item begins.
    static std::string text_at(glm::vec2 at);

    std::unique_ptr<app::Window> window_ = app::open_offscreen({1280, 800});
    app::Ui ui_;
    app::Input input_;
    float panel_height_ = 300.0f;
};

}  // namespace tendril::test
