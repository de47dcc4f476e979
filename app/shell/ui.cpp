#include "app/shell/ui.hpp"

#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>
#include <glm/common.hpp>
#include <stdexcept>

#include "app/document/workspace.hpp"
#include "app/shell/imgui_compat.hpp"
#include "app/view/assets.hpp"
#include "app/widgets/fields.hpp"
#include "app/window/gl.hpp"

namespace tendril::app {
namespace {

constexpr float base_text = 15.0f;  ///< pixels at scale 1

// Latin, Greek for maths, the punctuation used in texts, and the replacement character.
constexpr ImWchar glyphs[] = {0x0020, 0x024F, 0x0370, 0x03FF, 0x2010, 0x205E, 0x20A0, 0x20BF,
                              0x2190, 0x2193, 0x2200, 0x2265, 0xFFFD, 0xFFFD, 0};

void add_font(std::span<const std::byte> file, float pixels) {
    ImFontConfig config;
    config.FontDataOwnedByAtlas = false;
    config.OversampleH = 2;
    config.OversampleV = 2;
    config.GlyphRanges = glyphs;
    // ImGui's parameter is not const, but with FontDataOwnedByAtlas false it neither frees nor writes the
    // data.
    void* bytes = const_cast<std::byte*>(file.data());
    ImGui::GetIO().Fonts->AddFontFromMemoryTTF(bytes, static_cast<int>(file.size()), pixels, &config);
}

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

Ui::Ui() {
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.UserData = &numbers_;
    io.LogFilename = nullptr;
    io.ConfigInputTextCursorBlink = false;
    io.ConfigWindowsMoveFromTitleBarOnly = true;
    imgui_setup_keys();
    if (!ImGui_ImplOpenGL3_Init(shader_version))
        throw std::runtime_error("Dear ImGui cannot use this GL context");
}

Ui::~Ui() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui::DestroyContext();
}

void load_fonts(float scale, float pixel_ratio) {
    ImGuiIO& io = ImGui::GetIO();
    io.Fonts->Clear();
    const float pixels = scale * pixel_ratio;  // rasterised in pixels, shown in window coordinates
    // in the order of widgets/fonts.hpp
    add_font(font_regular(), base_text * pixels);
    add_font(font_medium(), base_text * pixels);
    add_font(font_regular(), 0.87f * base_text * pixels);
    add_font(font_medium(), 1.4f * base_text * pixels);
    io.FontGlobalScale = 1.0f / pixel_ratio;
#if IMGUI_VERSION_NUM < 19200
    ImGui_ImplOpenGL3_DestroyFontsTexture();
    ImGui_ImplOpenGL3_CreateFontsTexture();
#endif
}

void Ui::begin(const Surface& surface, Theme theme, const Input& input, const Event* event,
               bool time_passes) {
    ImGuiIO& io = ImGui::GetIO();
    const glm::vec2 size = glm::max(glm::vec2(surface.size), glm::vec2(1.0f));
    const glm::vec2 ratio = glm::vec2(surface.framebuffer_size) / size;
    io.DisplaySize = {size.x, size.y};
    io.DisplayFramebufferScale = {ratio.x, ratio.y};

    if (surface.scale != font_scale_ || ratio.x != font_ratio_) load_fonts(surface.scale, ratio.x);
    if (surface.scale != font_scale_ || theme != theme_ || font_ratio_ == 0.0f)
        apply_theme(theme, surface.scale);
    font_scale_ = surface.scale;
    font_ratio_ = ratio.x;
    theme_ = theme;

    io.DeltaTime = time_passes ? static_cast<float>(tick_seconds) : 1e-9f;  // ImGui does not allow zero
    imgui_feed(input, event != nullptr && std::holds_alternative<TextInput>(*event));
    if (event != nullptr) {
        if (const auto* wheel = std::get_if<MouseWheel>(event)) imgui_feed_wheel(wheel->by, wheel->sideways);
        if (const auto* text = std::get_if<TextInput>(event)) io.AddInputCharactersUTF8(text->utf8.c_str());
    }
    if (const auto* press = event != nullptr ? std::get_if<MousePress>(event) : nullptr; press && press->down)
        close_lists_on_press();
    ImGui_ImplOpenGL3_NewFrame();
    ImGui::NewFrame();
}

void Ui::end() {
    ImGui::Render();
}

void Ui::draw() {
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

bool Ui::wants_mouse() const {
    return ImGui::GetIO().WantCaptureMouse;
}
bool Ui::wants_text() const {
    return ImGui::GetIO().WantTextInput;
}

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
