#include "app/shell/picture_text.hpp"

#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <limits>

#include "app/shell/labels_view.hpp"
#include "app/shell/ui.hpp"
#include "app/window/gl.hpp"

namespace tendril::app {
namespace {

/// Makes a context current for as long as it lives.
class CurrentContext {
  public:
    explicit CurrentContext(ImGuiContext* context) : before_(ImGui::GetCurrentContext()) {
        ImGui::SetCurrentContext(context);
    }
    ~CurrentContext() { ImGui::SetCurrentContext(before_); }
    CurrentContext(const CurrentContext&) = delete;
    CurrentContext& operator=(const CurrentContext&) = delete;

  private:
    ImGuiContext* before_;
};

/// Depends only on the picture's size: as in a window with a view of that size, and legible at 1280 x 720.
float text_scale(glm::ivec2 size) {
    return std::max(0.7f, std::min(static_cast<float>(size.x) / 800.0f, static_cast<float>(size.y) / 600.0f));
}

/// The amount of the scene's solid strokes in a rectangle.
int covered_by(const Rect& box, const DrawList& drawn, const Camera& camera) {
    constexpr int samples = 6;
    int count = 0;
    for (const Stroke& stroke : drawn.strokes) {
        if (!stroke.shadow) continue;
        for (int i = 0; i <= samples; ++i) {
            const glm::vec3 at = glm::mix(stroke.a, stroke.b, static_cast<float>(i) / samples);
            const auto pixel = camera.project(at);
            count += pixel && box.contains(*pixel) ? 1 : 0;
        }
    }
    return count;
}

/// In order of preference; titles are at the top. Corners i and 3 - i are opposite.
const std::array<ViewCorner, 4> corners{lower_left, ViewCorner(0.0f, 0.0f), ViewCorner(1.0f, 1.0f),
                                        ViewCorner(1.0f, 0.0f)};

}  // namespace

PictureText::PictureText(glm::ivec2 size)
    : size_(size), scale_(text_scale(size)), context_(ImGui::CreateContext()) {
    constexpr float max_raster = 2.0f;  // larger text is stretched: the glyphs would not fit a texture
    const CurrentContext current(context_);
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.LogFilename = nullptr;
    io.DisplaySize = {static_cast<float>(size.x), static_cast<float>(size.y)};
    ImGui_ImplOpenGL3_Init(shader_version);
    load_fonts(scale_, std::min(scale_, max_raster) / scale_);
}

PictureText::~PictureText() {
    {
        const CurrentContext current(context_);
        ImGui_ImplOpenGL3_Shutdown();
    }
    ImGui::DestroyContext(context_);
}

void PictureText::look_at(std::span<const Pane> panes, const CameraPose& pose,
                          std::span<const LegendRow> legend) {
    const CurrentContext current(context_);
    ImGui_ImplOpenGL3_NewFrame();
    ImGui::NewFrame();
    count_covered(panes, pose, legend);
    ImGui::EndFrame();
}

/// Needs an ImGui frame, to measure texts.
void PictureText::count_covered(std::span<const Pane> panes, const CameraPose& pose,
                                std::span<const LegendRow> legend) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Rect box = legend_box(legend, {{0.0f, 0.0f}, glm::vec2(size_)}, scale_, corners[i]);
        for (const Pane& pane : panes) covered_[i] += covered_by(box, pane.drawn, pane.camera(pose));
        if (panes.size() > 1 && corners[i].y == 0.0f) covered_[i] = std::numeric_limits<int>::max() / 2;
    }
}

void PictureText::draw(std::span<const Pane> panes, const CameraPose& pose, std::span<const PaneTitle> titles,
                       std::span<const LegendRow> legend, const Palette& palette,
                       const std::function<void()>& plot) {
    const CurrentContext current(context_);
    apply_theme(palette.theme, scale_);
    ImGui_ImplOpenGL3_NewFrame();
    ImGui::NewFrame();
    const Rect view{{0.0f, 0.0f}, glm::vec2(size_)};
    if (!corner_) {
        count_covered(panes, pose, legend);
        corner_ = corners[static_cast<std::size_t>(std::ranges::min_element(covered_) - covered_.begin())];
    }
    const Rect covered = show_legend(legend, view, palette, scale_, *corner_);
    for (const Pane& pane : panes)
        show_labels(pane.drawn, pane.camera(pose), palette, scale_, std::span(&covered, 1));
    show_pane_titles(panes, titles, palette, scale_, false);
    const glm::vec2 box = scale_ * glm::vec2(300.0f, 210.0f);  // scale 1 is a picture of 800 x 600
    constexpr float most = 0.45f;                              // of each side; the scene takes precedence
    if (plot && panes.size() == 1 && box.x <= most * view.size().x && box.y <= most * view.size().y) {
        const glm::vec2 at = 1.0f - *corner_, to = at * glm::vec2(size_);  // opposite the legend
        ImGui::SetNextWindowPos({to.x, to.y}, ImGuiCond_Always, {at.x, at.y});
        ImGui::SetNextWindowSize({box.x, box.y});
        ImGui::SetNextWindowBgAlpha(0.8f);
        ImGui::Begin("plot", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs);
        plot();
        ImGui::End();
    }
    ImGui::Render();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

}  // namespace tendril::app
