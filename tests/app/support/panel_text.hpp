// The text of a panel, from Dear ImGui's log.
#pragma once

#include <imgui.h>

#include "app/labs/lab.hpp"
#include "app/shell/input.hpp"
#include "app/shell/ui.hpp"
#include "app/window/window.hpp"

namespace tendril::test {

class PanelReader {
  public:
    /// All text that `draw` writes into a panel 360 pixels wide; one line for each row.
    template <class Draw>
    std::string read(const Draw& draw) {
        std::string text;
        for (int frame = 0; frame < 2; ++frame) {  // some sizes are known one frame later
            ui_.begin({window_->size(), window_->framebuffer_size(), 1.0f}, app::Theme::Dark, input_, nullptr,
                      true);
            ImGui::SetNextWindowPos({0.0f, 0.0f});
            ImGui::SetNextWindowSize({360.0f, 1600.0f});
            ImGui::Begin("panel");
            ImGui::LogToClipboard();
            app::Emit emit;
            draw(emit);
            ImGui::LogFinish();
            text = ImGui::GetClipboardText();
            ImGui::End();
            ui_.end();
        }
        return text;
    }
    std::string inspector(const app::Lab& lab, const app::Workspace& workspace) {
        return read([&](app::Emit& emit) { lab.inspector(workspace, emit); });
    }
    std::string panel(const app::Lab& lab, const app::Workspace& workspace) {
        return read([&](app::Emit& emit) { lab.panel(workspace, emit); });
    }

  private:
    std::unique_ptr<app::Window> window_ = app::open_offscreen({1280, 1700});
    app::Ui ui_;
    app::Input input_;
};

}  // namespace tendril::test
