// Draws the view's labels, titles and legend into a picture, with the functions that draw them in the window
// and fonts rasterised for the picture.
#pragma once

#include <array>
#include <functional>
#include <glm/vec2.hpp>
#include <optional>
#include <span>

#include "app/labs/lab.hpp"
#include "app/view/palette.hpp"
#include "app/view/panes.hpp"

struct ImGuiContext;

namespace tendril::app {

class PictureText {
  public:
    /// For pictures of `size` pixels. Needs a current GL context, now and whenever it draws or is destroyed;
    /// leaves the window's Dear ImGui alone.
    explicit PictureText(glm::ivec2 size);
    ~PictureText();
    PictureText(const PictureText&) = delete;
    PictureText& operator=(const PictureText&) = delete;

    /// Counts the strokes that the legend would cover in each corner, so that draw() uses the corner that is
    /// emptiest over all pictures of a video. Without this call, draw() chooses by its first picture.
    void look_at(std::span<const Pane> panes, const CameraPose& pose, std::span<const LegendRow> legend);
    /// Draws over the scene, into the bound framebuffer. The panes were drawn with that camera and palette.
    /// The plot is drawn in the corner opposite the legend, unless it would hide much or there are several
    /// panes.
    void draw(std::span<const Pane> panes, const CameraPose& pose, std::span<const PaneTitle> titles,
              std::span<const LegendRow> legend, const Palette& palette, const std::function<void()>& plot);

  private:
    void count_covered(std::span<const Pane> panes, const CameraPose& pose,
                       std::span<const LegendRow> legend);

    glm::ivec2 size_;
    float scale_;
    ImGuiContext* context_;
    std::array<int, 4> covered_{};     ///< strokes under the legend in each corner, over all pictures so far
    std::optional<glm::vec2> corner_;  ///< the legend's corner, for all pictures
};

}  // namespace tendril::app
