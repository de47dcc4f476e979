#include "tests/app/support/frame_record.hpp"

#include <imgui_internal.h>

#include <algorithm>
#include <cstring>
#include <glm/common.hpp>
#include <utility>

namespace tendril::test {
namespace {

FrameRecorder* active = nullptr;  // the wrapped functions have no other way to find it

const ImGuiWindow* window_of(const ImDrawList& list) {
    const ImGuiContext& context = *ImGui::GetCurrentContext();
    if (context.CurrentWindow != nullptr && context.CurrentWindow->DrawList == &list)
        return context.CurrentWindow;
    for (const ImGuiWindow* window : context.Windows)
        if (window->DrawList == &list) return window;
    return nullptr;
}

float widest_word(const ImFont& font, float size, const char* begin, const char* end) {
    float widest = 0.0f;
    while (begin < end) {
        const char* const stop = std::find_if(begin, end, [](char c) { return c == ' ' || c == '\n'; });
        widest = std::max(widest, font.CalcTextSizeA(size, FLT_MAX, 0.0f, begin, stop).x);
        begin = stop + (stop < end ? 1 : 0);
    }
    return widest;
}

}  // namespace

FrameRecorder::FrameRecorder() {
    active = this;
}
FrameRecorder::~FrameRecorder() {
    active = nullptr;
}

void FrameRecorder::begin() {
    if (std::exchange(frame_, ImGui::GetFrameCount()) == ImGui::GetFrameCount()) return;
    record_.texts.clear();
    record_.items.clear();
}

void FrameRecorder::text(const ImDrawList& list, const ImFont* font, float size, const ImVec2& at,
                         const char* begin, const char* end, float wrap, const ImVec4* clip) {
    this->begin();
    if (end == nullptr) end = begin + std::strlen(begin);
    if (begin == end) return;
    if (font == nullptr) font = ImGui::GetFont();
    if (size == 0.0f) size = ImGui::GetFontSize();
    const ImVec2 extent = font->CalcTextSizeA(size, FLT_MAX, wrap, begin, end);
    const ImVec4& window = list._CmdHeader.ClipRect;
    app::Rect seen{{window.x, window.y}, {window.z, window.w}};
    if (clip != nullptr)
        seen = {glm::max(seen.min, glm::vec2(clip->x, clip->y)),
                glm::min(seen.max, glm::vec2(clip->z, clip->w))};
    record_.texts.push_back({window_of(list),
                             std::string(begin, end),
                             {{at.x, at.y}, {at.x + extent.x, at.y + extent.y}},
                             seen,
                             font,
                             wrap > 0.0f ? widest_word(*font, size, begin, end) : 0.0f,
                             wrap});
}

void FrameRecorder::item(const ImVec4& box, unsigned id) {
    begin();
    if (id == 0) return;
    record_.items.push_back(
        {ImGui::GetCurrentContext()->CurrentWindow, id, {{box.x, box.y}, {box.z, box.w}}});
}

void FrameRecorder::last_item_is(DrawnItem::Kind kind) {
    const ImGuiID id = ImGui::GetCurrentContext()->LastItemData.ID;
    for (auto each = record_.items.rbegin(); each != record_.items.rend(); ++each) {
        if (each->id != id) continue;
        each->kind = kind;
        return;
    }
}

}  // namespace tendril::test

// The linker redirects calls of Dear ImGui's functions to __wrap_..., and calls of __real_... to the function
// itself. A member function takes its object as first argument.
#if IMGUI_VERSION_NUM < 19200
#define TENDRIL_ADD_TEXT "_ZN10ImDrawList7AddTextEPK6ImFontfRK6ImVec2jPKcS7_fPK6ImVec4"
#else
#define TENDRIL_ADD_TEXT "_ZN10ImDrawList7AddTextEP6ImFontfRK6ImVec2jPKcS6_fPK6ImVec4"
#endif
#define TENDRIL_ADD_PLAIN_TEXT "_ZN10ImDrawList7AddTextERK6ImVec2jPKcS4_"
#define TENDRIL_ITEM_ADD "_ZN5ImGui7ItemAddERK6ImRectjPS1_i"
#define TENDRIL_BUTTON "_ZN5ImGui6ButtonEPKcRK6ImVec2"
#define TENDRIL_SMALL_BUTTON "_ZN5ImGui11SmallButtonEPKc"
#define TENDRIL_RADIO_BUTTON "_ZN5ImGui11RadioButtonEPKcb"
#define TENDRIL_INPUT_TEXT "_ZN5ImGui17InputTextWithHintEPKcS1_PcmiPFiP26ImGuiInputTextCallbackDataEPv"
#define TENDRIL_COMBO "_ZN5ImGui10BeginComboEPKcS1_i"
#define TENDRIL_OVERLAP "_ZN5ImGui19SetItemAllowOverlapEv"

namespace tendril::test {

void real_add_text(ImDrawList*, const ImFont*, float, const ImVec2&, ImU32, const char*, const char*, float,
                   const ImVec4*) __asm__("__real_" TENDRIL_ADD_TEXT);
void add_text(ImDrawList*, const ImFont*, float, const ImVec2&, ImU32, const char*, const char*, float,
              const ImVec4*) __asm__("__wrap_" TENDRIL_ADD_TEXT);
void add_text(ImDrawList* list, const ImFont* font, float size, const ImVec2& at, ImU32 colour,
              const char* begin, const char* end, float wrap, const ImVec4* clip) {
    if (active != nullptr) active->text(*list, font, size, at, begin, end, wrap, clip);
    real_add_text(list, font, size, at, colour, begin, end, wrap, clip);
}

void real_add_plain_text(ImDrawList*, const ImVec2&, ImU32, const char*,
                         const char*) __asm__("__real_" TENDRIL_ADD_PLAIN_TEXT);
void add_plain_text(ImDrawList*, const ImVec2&, ImU32, const char*,
                    const char*) __asm__("__wrap_" TENDRIL_ADD_PLAIN_TEXT);
void add_plain_text(ImDrawList* list, const ImVec2& at, ImU32 colour, const char* begin, const char* end) {
    if (active != nullptr) active->text(*list, nullptr, 0.0f, at, begin, end, 0.0f, nullptr);
    real_add_plain_text(list, at, colour, begin, end);
}

bool real_item_add(const ImRect&, ImGuiID, const ImRect*, ImGuiItemFlags) __asm__("__real_" TENDRIL_ITEM_ADD);
bool item_add(const ImRect&, ImGuiID, const ImRect*, ImGuiItemFlags) __asm__("__wrap_" TENDRIL_ITEM_ADD);
bool item_add(const ImRect& box, ImGuiID id, const ImRect* nav_box, ImGuiItemFlags flags) {
    if (active != nullptr) active->item({box.Min.x, box.Min.y, box.Max.x, box.Max.y}, id);
    return real_item_add(box, id, nav_box, flags);
}

bool real_button(const char*, const ImVec2&) __asm__("__real_" TENDRIL_BUTTON);
bool button(const char*, const ImVec2&) __asm__("__wrap_" TENDRIL_BUTTON);
bool button(const char* label, const ImVec2& size) {
    const bool pressed = real_button(label, size);
    if (active != nullptr) active->last_item_is(DrawnItem::Kind::Button);
    return pressed;
}

bool real_small_button(const char*) __asm__("__real_" TENDRIL_SMALL_BUTTON);
bool small_button(const char*) __asm__("__wrap_" TENDRIL_SMALL_BUTTON);
bool small_button(const char* label) {
    const bool pressed = real_small_button(label);
    if (active != nullptr) active->last_item_is(DrawnItem::Kind::Button);
    return pressed;
}

bool real_radio_button(const char*, bool) __asm__("__real_" TENDRIL_RADIO_BUTTON);
bool radio_button(const char*, bool) __asm__("__wrap_" TENDRIL_RADIO_BUTTON);
bool radio_button(const char* label, bool on) {
    const bool pressed = real_radio_button(label, on);
    if (active != nullptr) active->last_item_is(DrawnItem::Kind::Button);
    return pressed;
}

bool real_input_text(const char*, const char*, char*, std::size_t, ImGuiInputTextFlags,
                     ImGuiInputTextCallback, void*) __asm__("__real_" TENDRIL_INPUT_TEXT);
bool input_text(const char*, const char*, char*, std::size_t, ImGuiInputTextFlags, ImGuiInputTextCallback,
                void*) __asm__("__wrap_" TENDRIL_INPUT_TEXT);
bool input_text(const char* label, const char* hint, char* text, std::size_t size, ImGuiInputTextFlags flags,
                ImGuiInputTextCallback callback, void* data) {
    const bool entered = real_input_text(label, hint, text, size, flags, callback, data);
    if (active != nullptr) active->last_item_is(DrawnItem::Kind::Text);
    return entered;
}

bool real_begin_combo(const char*, const char*, ImGuiComboFlags) __asm__("__real_" TENDRIL_COMBO);
bool begin_combo(const char*, const char*, ImGuiComboFlags) __asm__("__wrap_" TENDRIL_COMBO);
bool begin_combo(const char* label, const char* preview, ImGuiComboFlags flags) {
    const bool open = real_begin_combo(label, preview, flags);
    if (active != nullptr && !open) active->last_item_is(DrawnItem::Kind::Combo);
    return open;
}

#if IMGUI_VERSION_NUM < 18970  // later versions set a flag when the item is created
void real_allow_overlap() __asm__("__real_" TENDRIL_OVERLAP);
void allow_overlap() __asm__("__wrap_" TENDRIL_OVERLAP);
void allow_overlap() {
    if (active != nullptr) active->last_item_is(DrawnItem::Kind::Row);
    real_allow_overlap();
}
#endif

}  // namespace tendril::test
