// All differences between the versions of Dear ImGui that Tendril builds with (1.86 to 1.92).
#pragma once

#include <imgui.h>

#include <algorithm>

#include "app/shell/input.hpp"

namespace tendril::app {

struct ImGuiKeyPair {
    ImGuiKey imgui;
    Key key;
};

inline constexpr ImGuiKeyPair imgui_keys[] = {
    {ImGuiKey_Tab, Key::Tab},
    {ImGuiKey_LeftArrow, Key::Left},
    {ImGuiKey_RightArrow, Key::Right},
    {ImGuiKey_UpArrow, Key::Up},
    {ImGuiKey_DownArrow, Key::Down},
    {ImGuiKey_PageUp, Key::PageUp},
    {ImGuiKey_PageDown, Key::PageDown},
    {ImGuiKey_Home, Key::Home},
    {ImGuiKey_End, Key::End},
    {ImGuiKey_Insert, Key::Insert},
    {ImGuiKey_Delete, Key::Delete},
    {ImGuiKey_Backspace, Key::Backspace},
    {ImGuiKey_Space, Key::Space},
    {ImGuiKey_Enter, Key::Enter},
    {ImGuiKey_Escape, Key::Escape},
    {ImGuiKey_A, Key::A},
    {ImGuiKey_C, Key::C},
    {ImGuiKey_V, Key::V},
    {ImGuiKey_X, Key::X},
    {ImGuiKey_Y, Key::Y},
    {ImGuiKey_Z, Key::Z},
};

/// Call once, after creating the context.
inline void imgui_setup_keys() {
#if IMGUI_VERSION_NUM < 18700
    for (const auto& pair : imgui_keys) ImGui::GetIO().KeyMap[pair.imgui] = static_cast<int>(pair.key);
#endif
}

/// Sends the held keys and buttons to ImGui; call before every NewFrame, so that only our own input counts.
/// `typing`: this tick has text, which ImGui would treat as a shortcut while Ctrl is held (as when pasting).
inline void imgui_feed(const Input& input, bool typing) {
    ImGuiIO& io = ImGui::GetIO();
    const bool buttons[] = {input.button(MouseButton::Left), input.button(MouseButton::Right),
                            input.button(MouseButton::Middle)};
#if IMGUI_VERSION_NUM < 18700
    io.MousePos = ImVec2(input.mouse().x, input.mouse().y);
    for (int i = 0; i < 3; ++i) io.MouseDown[i] = buttons[i];
    for (std::size_t i = 0; i < static_cast<std::size_t>(Key::Count); ++i) io.KeysDown[i] = input.keys()[i];
    io.KeyCtrl = input.ctrl() && !typing;
    io.KeyShift = input.shift();
    io.KeyAlt = input.alt();
    io.KeySuper = input.held(Key::Super);
#else
    io.ConfigInputTrickleEventQueue = false;  // a tick has at most one event
    io.AddMousePosEvent(input.mouse().x, input.mouse().y);
    for (int i = 0; i < 3; ++i) io.AddMouseButtonEvent(i, buttons[i]);
    for (const auto& pair : imgui_keys) io.AddKeyEvent(pair.imgui, input.held(pair.key));
    io.AddKeyEvent(ImGuiMod_Ctrl, input.ctrl() && !typing);
    io.AddKeyEvent(ImGuiMod_Shift, input.shift());
    io.AddKeyEvent(ImGuiMod_Alt, input.alt());
#endif
}

inline void imgui_feed_wheel(float by, float sideways) {
    by = std::clamp(by, -100.0f, 100.0f);
    sideways = std::clamp(sideways, -100.0f, 100.0f);  // scrolling by more loses precision
#if IMGUI_VERSION_NUM < 18700
    ImGui::GetIO().MouseWheel += by;
    ImGui::GetIO().MouseWheelH += sideways;
#else
    ImGui::GetIO().AddMouseWheelEvent(sideways, by);
#endif
}

}  // namespace tendril::app
