#include "app/shell/theme.hpp"

#include <glm/common.hpp>

namespace tendril::app {
namespace {

void apply_sizes(ImGuiStyle& style) {
    style.WindowPadding = {14, 12};
    style.FramePadding = {9, 5};
    style.ItemSpacing = {8, 7};
    style.ItemInnerSpacing = {7, 5};
    style.CellPadding = {6, 3};
    style.ScrollbarSize = 11;
    style.GrabMinSize = 11;
    style.WindowRounding = 0;
    style.ChildRounding = 5;
    style.PopupRounding = 7;
    style.FrameRounding = 5;
    style.GrabRounding = 4;
    style.ScrollbarRounding = 6;
    style.WindowBorderSize = 0;
    style.PopupBorderSize = 1;
    style.WindowTitleAlign = {0.5f, 0.5f};
    style.DisabledAlpha = 0.42f;
}

}  // namespace

void apply_theme(Theme theme, float scale) {
    ImGuiStyle& style = ImGui::GetStyle();
    style = ImGuiStyle();
    apply_sizes(style);
    style.FrameBorderSize = theme == Theme::Light ? 1.0f : 0.0f;  // white on near-white needs an outline
    style.ScaleAllSizes(scale);

    const Palette& p = palette(theme);
    const auto set = [&](ImGuiCol which, glm::vec3 colour, float alpha = 1.0f) {
        style.Colors[which] = imgui_colour(colour, alpha);
    };
    // Hover and press move a field towards the text's colour: brighter on dark, darker on light.
    const auto towards_text = [&](glm::vec3 colour, float by) { return glm::mix(colour, p.text, by); };
    for (int i = 0; i < ImGuiCol_COUNT; ++i) style.Colors[i] = imgui_colour(p.panel);

    set(ImGuiCol_Text, p.text);
    set(ImGuiCol_TextDisabled, p.text_dim);
    set(ImGuiCol_TextSelectedBg, p.accent, 0.35f);
    set(ImGuiCol_WindowBg, p.panel);
    set(ImGuiCol_ChildBg, p.panel, 0.0f);
    set(ImGuiCol_PopupBg, towards_text(p.panel, 0.02f));
    set(ImGuiCol_Border, p.border);
    set(ImGuiCol_BorderShadow, p.border, 0.0f);
    set(ImGuiCol_Separator, p.border);
    set(ImGuiCol_SeparatorHovered, p.accent);
    set(ImGuiCol_SeparatorActive, p.accent);
    set(ImGuiCol_FrameBg, p.field);
    set(ImGuiCol_FrameBgHovered, towards_text(p.field, 0.07f));
    set(ImGuiCol_FrameBgActive, towards_text(p.field, 0.12f));
    set(ImGuiCol_Button, p.field);
    set(ImGuiCol_ButtonHovered, towards_text(p.field, 0.10f));
    set(ImGuiCol_ButtonActive, towards_text(p.field, 0.18f));
    set(ImGuiCol_Header, p.accent, 0.22f);
    set(ImGuiCol_HeaderHovered, p.accent, 0.14f);
    set(ImGuiCol_HeaderActive, p.accent, 0.32f);
    set(ImGuiCol_CheckMark, p.accent);
    set(ImGuiCol_SliderGrab, p.accent, 0.85f);
    set(ImGuiCol_SliderGrabActive, p.accent);
    const float grab = theme == Theme::Light ? 0.22f : 0.08f;  // a field is already white in the light theme
    set(ImGuiCol_ScrollbarBg, p.panel, 0.0f);
    set(ImGuiCol_ScrollbarGrab, towards_text(p.field, grab));
    set(ImGuiCol_ScrollbarGrabHovered, towards_text(p.field, grab + 0.10f));
    set(ImGuiCol_ScrollbarGrabActive, towards_text(p.field, grab + 0.20f));
    set(ImGuiCol_TableHeaderBg, p.panel);
    set(ImGuiCol_TableBorderLight, p.border);
    set(ImGuiCol_TableBorderStrong, p.border);
    set(ImGuiCol_TableRowBg, p.panel, 0.0f);
    set(ImGuiCol_TableRowBgAlt, p.text, 0.025f);
    set(ImGuiCol_NavHighlight, p.accent);
    set(ImGuiCol_ModalWindowDimBg, p.background_bottom, 0.6f);
}

}  // namespace tendril::app
