#include "app/shell/gizmo_view.hpp"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <string>

#include "app/shell/ui.hpp"
#include "app/view/camera.hpp"
#include "app/widgets/fonts.hpp"
#include "app/widgets/tooltip.hpp"

namespace tendril::app {
namespace {

struct Axis {
    glm::vec3 direction;
    const char* letter;  ///< empty for negative axes
    const char* view;    ///< argument of camera.view for the view from there
    const char* title;
};

constexpr std::array axes{Axis{{1, 0, 0}, "X", "side", "Right"},    Axis{{0, 1, 0}, "Y", "top", "Top"},
                          Axis{{0, 0, 1}, "Z", "front", "Front"},   Axis{{-1, 0, 0}, "", "left", "Left"},
                          Axis{{0, -1, 0}, "", "bottom", "Bottom"}, Axis{{0, 0, -1}, "", "back", "Back"}};

/// One of the six ends: its position on the screen, and its depth.
struct End {
    std::size_t axis = 0;
    ImVec2 at{};
    float depth = 0.0f;  ///< -1 to 1, far to near
};

glm::vec3 colour_of_axis(const Palette& colours, std::size_t axis) {
    const glm::vec3 all[] = {colours.axis_x, colours.axis_y, colours.axis_z};
    return all[axis % 3];
}

/// Uses a small window of its own, so that the mouse around it still reaches the view.
bool end_button(const End& end, float radius, bool& hovered) {
    const Axis& axis = axes[end.axis];
    ImGui::SetNextWindowPos({end.at.x - radius, end.at.y - radius});
    ImGui::SetNextWindowSize({2.0f * radius, 2.0f * radius});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1, 1));
    ImGui::Begin((std::string("axis ") + axis.view).c_str(), nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing |
                     ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoNav);
    ImGui::PopStyleVar(2);
    const bool clicked = ImGui::InvisibleButton(axis.view, {2.0f * radius, 2.0f * radius});
    hovered = ImGui::IsItemHovered();
    ImGui::End();
    return clicked;
}

/// "Front" if the view is straight along an axis, else the projection's name.
std::string view_name(const CameraPose& pose, const std::array<End, 6>& ends) {
    const char* const title = ends.back().depth > 0.99999f ? axes[ends.back().axis].title : nullptr;
    if (title != nullptr) return title;
    return pose.orthographic ? "Orthographic" : "Perspective";
}

}  // namespace

float axis_gizmo_width(glm::vec2 pane, float scale) {
    if (pane.x < 330.0f * scale || pane.y < 220.0f * scale) return 0.0f;
    return 100.0f * scale;
}

Rect show_axis_gizmo(const ShellFrame& frame, Emit& emit) {
    const Rect& view = frame.layout.view;
    const float scale = frame.layout.scale, reach = 27.0f * scale, radius = 8.5f * scale;
    if (axis_gizmo_width(frame.workspace.ui.view_size, scale) <= 0.0f) return {view.min, view.min};
    const glm::vec2 centre{view.max.x - reach - 2.0f * radius, view.min.y + reach + 2.0f * radius};
    const Camera camera(frame.workspace.camera, view);
    std::array<End, 6> ends;
    for (std::size_t i = 0; i < axes.size(); ++i) {
        const glm::vec3 to = axes[i].direction;
        ends[i] = {
            i,
            {centre.x + reach * glm::dot(to, camera.right()), centre.y - reach * glm::dot(to, camera.up())},
            -glm::dot(to, camera.forward())};
    }
    std::sort(ends.begin(), ends.end(), [](const End& a, const End& b) { return a.depth < b.depth; });
    const Palette& colours = frame.colours();
    ImDrawList* const list = ImGui::GetBackgroundDrawList();
    ImGui::PushFont(small_font());
    const char* told = nullptr;
    for (const End& end : ends) {
        const Axis& axis = axes[end.axis];
        bool hovered = false;
        // The nearer end takes the click.
        const bool hidden = std::any_of(ends.begin(), ends.end(), [&](const End& other) {
            return other.depth > end.depth &&
                   glm::distance(glm::vec2(other.at.x, other.at.y), glm::vec2(end.at.x, end.at.y)) < radius;
        });
        if (!hidden && end_button(end, radius, hovered)) emit("camera.view", {{"name", axis.view}});
        if (hovered) {
            list->AddCircleFilled({centre.x, centre.y}, reach + 1.7f * radius, imgui_u32(colours.text, 0.05f),
                                  48);
            told = axis.title;
        }
        const bool positive = axis.letter[0] != '\0';
        // Ends at the back are fainter.
        const glm::vec3 colour =
            glm::mix(colours.background_top, colour_of_axis(colours, end.axis), 0.75f + 0.25f * end.depth);
        if (positive) {
            list->AddLine({centre.x, centre.y}, end.at, imgui_u32(colour), 2.0f * scale);
            list->AddCircleFilled(end.at, radius, imgui_u32(hovered ? colours.text : colour), 24);
            const ImVec2 size = ImGui::CalcTextSize(axis.letter);
            list->AddText({end.at.x - 0.5f * size.x, end.at.y - 0.5f * size.y}, imgui_u32(colours.bar),
                          axis.letter);
        } else {
            list->AddCircleFilled(end.at, 0.75f * radius,
                                  imgui_u32(glm::mix(colours.background_top, colour, 0.35f)), 24);
            list->AddCircle(end.at, 0.75f * radius, imgui_u32(hovered ? colours.text : colour), 24,
                            1.3f * scale);
        }
    }
    const std::string name = view_name(frame.workspace.camera, ends);
    const ImVec2 size = ImGui::CalcTextSize(name.c_str());
    list->AddText({centre.x - 0.5f * size.x, centre.y + reach + 1.6f * radius}, imgui_u32(colours.text_dim),
                  name.c_str());
    const float around = reach + radius;
    const Rect whole{centre - around, {centre.x + around, centre.y + reach + 1.6f * radius + size.y}};
    if (told != nullptr) {
        const Tooltip opened(whole);
        ImGui::Text("%s view", told);
    }
    ImGui::PopFont();
    return whole;
}

}  // namespace tendril::app
