// Sets up Dear ImGui: context, fonts, look, backend, and our input as its only input. No ini file, a fixed
// time step and no blinking cursor, so that the same events give the same pixels.
#pragma once

#include <glm/vec2.hpp>

#include "app/document/settings.hpp"
#include "app/shell/input.hpp"
#include "app/view/palette.hpp"
#include "app/widgets/icons.hpp"
#include "app/widgets/number_entry.hpp"

namespace tendril::app {

/// Loads the fonts of widgets/fonts.hpp into the current context: rasterised at scale times ratio, shown at
/// scale.
void load_fonts(float scale, float pixel_ratio);

class Ui {
  public:
    /// Needs a current GL context.
    Ui();
    ~Ui();
    Ui(const Ui&) = delete;
    Ui& operator=(const Ui&) = delete;

    struct Surface {
        glm::ivec2 size{0};              ///< window coordinates
        glm::ivec2 framebuffer_size{0};  ///< pixels
        float scale = 1.0f;              ///< scale of text and widgets, in window coordinates
    };

    /// Starts a frame with `event`, which may be null. If no time passes, widgets do not advance either.
    void begin(const Surface& surface, Theme theme, const Input& input, const Event* event, bool time_passes);
    /// Ends the frame; draw() may follow, now or later.
    void end();
    void draw();

    /// True if the mouse (the keyboard) belongs to a panel instead of the scene.
    bool wants_mouse() const;
    bool wants_text() const;
    /// The number being typed, for the program to handle.
    NumberEditing& numbers() { return numbers_; }

  private:
    NumberEditing numbers_;
    float font_scale_ = 0.0f;
    float font_ratio_ = 0.0f;
    Theme theme_ = Theme::Dark;
};

// The look of the panels: Dear ImGui's style from the palette, and the fonts.

void apply_theme(Theme theme, float scale);

}  // namespace tendril::app
