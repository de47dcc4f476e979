#include "app/widgets/icons.hpp"

#include <cmath>
#include <initializer_list>

#include "app/widgets/tooltip.hpp"

namespace tendril::app {
namespace {

/// Draws in a unit box, -1 to 1, y down.
struct Pen {
    ImDrawList* list;
    ImVec2 centre;
    float half;
    ImU32 colour;
    float width;

    ImVec2 at(float x, float y) const { return {centre.x + x * half, centre.y + y * half}; }
    void line(float x0, float y0, float x1, float y1) const {
        list->AddLine(at(x0, y0), at(x1, y1), colour, width);
    }
    void arc(float x, float y, float radius, float from, float to) const {
        list->PathArcTo(at(x, y), radius * half, from, to, 24);
        list->PathStroke(colour, 0, width);
    }
    void triangle(ImVec2 a, ImVec2 b, ImVec2 c) const { list->AddTriangleFilled(a, b, c, colour); }
};

/// A hooked arrow; `side` is -1 for one that points back to the left.
void hooked_arrow(const Pen& pen, float side) {
    constexpr float pi = 3.14159265f;
    pen.line(side * 0.75f, -0.25f, -side * 0.2f, -0.25f);
    if (side < 0) {
        pen.arc(0.2f, 0.2f, 0.45f, -0.5f * pi, 0.5f * pi);
    } else {
        pen.arc(-0.2f, 0.2f, 0.45f, 0.5f * pi, 1.5f * pi);
    }
    pen.line(-side * 0.2f, 0.65f, side * 0.25f, 0.65f);
    pen.line(side * 0.8f, -0.25f, side * 0.35f, -0.7f);
    pen.line(side * 0.8f, -0.25f, side * 0.35f, 0.2f);
}

void gear(const Pen& pen) {
    constexpr int teeth = 8;
    pen.list->AddCircle(pen.centre, 0.55f * pen.half, pen.colour, 28, pen.width);
    pen.list->AddCircle(pen.centre, 0.2f * pen.half, pen.colour, 16, pen.width);
    for (int i = 0; i < teeth; ++i) {
        const float angle = 6.2831853f * static_cast<float>(i) / teeth;
        const float c = std::cos(angle), s = std::sin(angle);
        pen.line(0.6f * c, 0.6f * s, 0.86f * c, 0.86f * s);
    }
}

void question(const Pen& pen) {
    pen.list->AddCircle(pen.centre, 0.85f * pen.half, pen.colour, 32, pen.width);
    pen.arc(0.0f, -0.2f, 0.28f, 3.14159265f, 6.8f);
    pen.line(0.21f, -0.02f, 0.0f, 0.16f);
    pen.line(0.0f, 0.14f, 0.0f, 0.26f);
    pen.list->AddCircleFilled(pen.at(0.0f, 0.5f), 0.09f * pen.half, pen.colour, 12);
}

}  // namespace

void draw_icon(ImDrawList* list, Icon icon, ImVec2 centre, float size, ImU32 colour) {
    const Pen pen{list, centre, 0.5f * size, colour, std::fmax(1.2f, size / 11.0f)};
    switch (icon) {
        case Icon::Menu:
            for (const float y : {-0.5f, 0.0f, 0.5f}) pen.line(-0.7f, y, 0.7f, y);
            break;
        case Icon::Undo:
            hooked_arrow(pen, -1.0f);
            break;
        case Icon::Redo:
            hooked_arrow(pen, 1.0f);
            break;
        case Icon::Play:
            pen.triangle(pen.at(-0.5f, -0.7f), pen.at(0.75f, 0.0f), pen.at(-0.5f, 0.7f));
            break;
        case Icon::Pause:
            list->AddRectFilled(pen.at(-0.55f, -0.65f), pen.at(-0.15f, 0.65f), colour, 1.0f);
            list->AddRectFilled(pen.at(0.15f, -0.65f), pen.at(0.55f, 0.65f), colour, 1.0f);
            break;
        case Icon::Step:
            pen.triangle(pen.at(-0.6f, -0.6f), pen.at(0.35f, 0.0f), pen.at(-0.6f, 0.6f));
            list->AddRectFilled(pen.at(0.4f, -0.6f), pen.at(0.65f, 0.6f), colour, 1.0f);
            break;
        case Icon::Help:
            question(pen);
            break;
        case Icon::Gear:
            gear(pen);
            break;
        case Icon::ChevronLeft:
            pen.line(0.25f, -0.5f, -0.25f, 0.0f);
            pen.line(-0.25f, 0.0f, 0.25f, 0.5f);
            break;
        case Icon::ChevronRight:
            pen.line(-0.25f, -0.5f, 0.25f, 0.0f);
            pen.line(0.25f, 0.0f, -0.25f, 0.5f);
            break;
        case Icon::ChevronDown:
            pen.line(-0.5f, -0.25f, 0.0f, 0.25f);
            pen.line(0.0f, 0.25f, 0.5f, -0.25f);
            break;
        case Icon::Close:
            pen.line(-0.5f, -0.5f, 0.5f, 0.5f);
            pen.line(-0.5f, 0.5f, 0.5f, -0.5f);
            break;
        case Icon::Check:
            pen.line(-0.7f, 0.05f, -0.2f, 0.55f);
            pen.line(-0.2f, 0.55f, 0.75f, -0.5f);
            break;
        case Icon::Record:
            list->AddCircleFilled(centre, 0.55f * pen.half, colour, 24);
            break;
    }
}

bool icon_button(const char* id, Icon icon, const char* tooltip, bool enabled, bool active) {
    const float side = ImGui::GetFrameHeight();
    ImGui::BeginDisabled(!enabled);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const bool pressed = ImGui::InvisibleButton(id, {side, side});
    const bool hovered = ImGui::IsItemHovered();
    ImDrawList* list = ImGui::GetWindowDrawList();
    if (hovered || active) {
        const ImU32 fill =
            ImGui::GetColorU32(ImGui::IsItemActive() ? ImGuiCol_ButtonActive : ImGuiCol_ButtonHovered);
        list->AddRectFilled(at, {at.x + side, at.y + side}, fill, ImGui::GetStyle().FrameRounding);
    }
    draw_icon(list, icon, {at.x + 0.5f * side, at.y + 0.5f * side}, 0.56f * side,
              ImGui::GetColorU32(active ? ImGuiCol_CheckMark : ImGuiCol_Text));
    ImGui::EndDisabled();
    if (tooltip != nullptr && ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled))
        app::tooltip(tooltip);
    return pressed;
}

}  // namespace tendril::app
