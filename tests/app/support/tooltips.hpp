// The text of a part of the interface in a panel, and its tooltips, without the window around it.
#pragma once

#include "app/shell/input.hpp"
#include "app/shell/ui.hpp"
#include "app/window/window.hpp"

namespace tendril::test {

class TooltipFinder {
  public:
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

  private:
    static constexpr glm::vec2 nowhere{-100.0f};
    static constexpr float panel_width = 300.0f;

    void begin_panel(glm::vec2 mouse);
    void end_panel();
    static void begin_text();
    static std::string end_text();

    std::unique_ptr<app::Window> window_ = app::open_offscreen({1280, 800});
    app::Ui ui_;
    app::Input input_;
};

}  // namespace tendril::test
