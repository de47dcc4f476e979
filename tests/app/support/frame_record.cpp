#include "tests/app/support/frame_record.hpp"

#include <imgui_internal.h>

#include <algorithm>
#include <cstring>
#include <glm/common.hpp>
#include <map>
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

void FrameRecorder::item(const ImVec4& box, unsigned id, int flags) {
    begin();
    if (id == 0) return;
    const ImGuiContext& context = *ImGui::GetCurrentContext();
    for (const ImGuiAxis axis : {ImGuiAxis_X, ImGuiAxis_Y})  // newer versions add scrollbars as items
        if (id == ImGui::GetWindowScrollbarID(context.CurrentWindow, axis)) return;
    record_.items.push_back({context.CurrentWindow,
                             id,
                             {{box.x, box.y}, {box.z, box.w}},
                             ((context.CurrentItemFlags | flags) & ImGuiItemFlags_Disabled) != 0});
}

DrawnItem* FrameRecorder::last_item() {
    const ImGuiID id = ImGui::GetCurrentContext()->LastItemData.ID;
    const auto found = std::find_if(record_.items.rbegin(), record_.items.rend(),
                                    [&](const DrawnItem& each) { return each.id == id; });
    return found != record_.items.rend() ? &*found : nullptr;
}

std::vector<std::string> FrameRecord::alike() const {
    std::vector<std::string> found;
    std::map<unsigned, const DrawnItem*> seen;
    for (const DrawnItem& item : items) {
        const auto [at, is_new] = seen.try_emplace(item.id, &item);
        if (!is_new)
            found.push_back('"' + item.label + "\" in " + item.window->Name + " and \"" + at->second->label +
                            "\" in " + at->second->window->Name);
        if ((item.window->Flags & ImGuiWindowFlags_ChildWindow) != 0 && item.window->BeginCount > 1)
            found.push_back(std::string(item.window->Name) + " is begun twice");
    }
    return found;
}

bool FrameRecord::is_of_a_window(const DrawnItem& item) {
    ImGuiWindow* const window = ImGui::FindWindowByName(item.window->Name);
    return item.id == ImGui::GetWindowScrollbarID(window, ImGuiAxis_X) ||
           item.id == ImGui::GetWindowScrollbarID(window, ImGuiAxis_Y) ||
           item.id == ImGui::GetIDWithSeed("#CLOSE", nullptr, window->ID);
}

const DrawnItem* FrameRecord::find(unsigned id) const {
    const auto found = std::ranges::find(items, id, &DrawnItem::id);
    return found != items.end() ? &*found : nullptr;
}

namespace {

/// Adds to the item that a wrapped function has just created.
void note_item(DrawnItem::Kind kind, const char* label, std::optional<bool> on = {}, const char* shown = "") {
    DrawnItem* const item = active != nullptr ? active->last_item() : nullptr;
    if (item == nullptr) return;
    item->kind = kind;
    item->label = label, item->on = on, item->shown = shown;
}

}  // namespace

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
#define TENDRIL_CHECKBOX "_ZN5ImGui8CheckboxEPKcPb"
#define TENDRIL_SELECTABLE "_ZN5ImGui10SelectableEPKcbiRK6ImVec2"
#define TENDRIL_INVISIBLE_BUTTON "_ZN5ImGui15InvisibleButtonEPKcRK6ImVec2i"
#define TENDRIL_DRAG_SCALAR "_ZN5ImGui10DragScalarEPKciPvfPKvS4_S1_i"
#define TENDRIL_INPUT_TEXT "_ZN5ImGui17InputTextWithHintEPKcS1_PcmiPFiP26ImGuiInputTextCallbackDataEPv"
#define TENDRIL_COMBO "_ZN5ImGui10BeginComboEPKcS1_i"

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
    if (active != nullptr) active->item({box.Min.x, box.Min.y, box.Max.x, box.Max.y}, id, flags);
    return real_item_add(box, id, nav_box, flags);
}

bool real_button(const char*, const ImVec2&) __asm__("__real_" TENDRIL_BUTTON);
bool button(const char*, const ImVec2&) __asm__("__wrap_" TENDRIL_BUTTON);
bool button(const char* label, const ImVec2& size) {
    const bool pressed = real_button(label, size);
    note_item(DrawnItem::Kind::Button, label);
    const ImVec4 *const colours = ImGui::GetStyle().Colors, &own = colours[ImGuiCol_Button],
                        &chosen = colours[ImGuiCol_Header];
    if (DrawnItem* const item = active != nullptr ? active->last_item() : nullptr)
        item->lit = own.x == chosen.x && own.y == chosen.y && own.z == chosen.z && own.w == chosen.w;
    return pressed;
}

bool real_small_button(const char*) __asm__("__real_" TENDRIL_SMALL_BUTTON);
bool small_button(const char*) __asm__("__wrap_" TENDRIL_SMALL_BUTTON);
bool small_button(const char* label) {
    const bool pressed = real_small_button(label);
    note_item(DrawnItem::Kind::Button, label);
    return pressed;
}

bool real_radio_button(const char*, bool) __asm__("__real_" TENDRIL_RADIO_BUTTON);
bool radio_button(const char*, bool) __asm__("__wrap_" TENDRIL_RADIO_BUTTON);
bool radio_button(const char* label, bool on) {
    const bool pressed = real_radio_button(label, on);
    note_item(DrawnItem::Kind::Button, label, on);
    return pressed;
}

bool real_checkbox(const char*, bool*) __asm__("__real_" TENDRIL_CHECKBOX);
bool checkbox(const char*, bool*) __asm__("__wrap_" TENDRIL_CHECKBOX);
bool checkbox(const char* label, bool* on) {
    const bool was = *on, pressed = real_checkbox(label, on);
    note_item(DrawnItem::Kind::Check, label, was);
    return pressed;
}

bool real_selectable(const char*, bool, ImGuiSelectableFlags,
                     const ImVec2&) __asm__("__real_" TENDRIL_SELECTABLE);
bool selectable(const char*, bool, ImGuiSelectableFlags, const ImVec2&) __asm__("__wrap_" TENDRIL_SELECTABLE);
bool selectable(const char* label, bool chosen, ImGuiSelectableFlags flags, const ImVec2& size) {
    const bool pressed = real_selectable(label, chosen, flags, size);
    const bool holds_others = (flags & ImGuiSelectableFlags_AllowItemOverlap) != 0;
    note_item(holds_others ? DrawnItem::Kind::Row : DrawnItem::Kind::Other, label);
    return pressed;
}

bool real_invisible_button(const char*, const ImVec2&,
                           ImGuiButtonFlags) __asm__("__real_" TENDRIL_INVISIBLE_BUTTON);
bool invisible_button(const char*, const ImVec2&,
                      ImGuiButtonFlags) __asm__("__wrap_" TENDRIL_INVISIBLE_BUTTON);
bool invisible_button(const char* label, const ImVec2& size, ImGuiButtonFlags flags) {
    const bool pressed = real_invisible_button(label, size, flags);
    note_item(DrawnItem::Kind::Other, label);
    return pressed;
}

bool real_drag_scalar(const char*, ImGuiDataType, void*, float, const void*, const void*, const char*,
                      ImGuiSliderFlags) __asm__("__real_" TENDRIL_DRAG_SCALAR);
bool drag_scalar(const char*, ImGuiDataType, void*, float, const void*, const void*, const char*,
                 ImGuiSliderFlags) __asm__("__wrap_" TENDRIL_DRAG_SCALAR);
bool drag_scalar(const char* label, ImGuiDataType type, void* value, float speed, const void* low,
                 const void* high, const char* format, ImGuiSliderFlags flags) {
    const bool changed = real_drag_scalar(label, type, value, speed, low, high, format, flags);
    note_item(DrawnItem::Kind::Number, label);
    return changed;
}

bool real_input_text(const char*, const char*, char*, std::size_t, ImGuiInputTextFlags,
                     ImGuiInputTextCallback, void*) __asm__("__real_" TENDRIL_INPUT_TEXT);
bool input_text(const char*, const char*, char*, std::size_t, ImGuiInputTextFlags, ImGuiInputTextCallback,
                void*) __asm__("__wrap_" TENDRIL_INPUT_TEXT);
bool input_text(const char* label, const char* hint, char* text, std::size_t size, ImGuiInputTextFlags flags,
                ImGuiInputTextCallback callback, void* data) {
    const bool entered = real_input_text(label, hint, text, size, flags, callback, data);
    note_item(DrawnItem::Kind::Text, label);
    return entered;
}

bool real_begin_combo(const char*, const char*, ImGuiComboFlags) __asm__("__real_" TENDRIL_COMBO);
bool begin_combo(const char*, const char*, ImGuiComboFlags) __asm__("__wrap_" TENDRIL_COMBO);
bool begin_combo(const char* label, const char* preview, ImGuiComboFlags flags) {
    const bool open = real_begin_combo(label, preview, flags);
    if (!open) note_item(DrawnItem::Kind::Combo, label, {}, preview);
    return open;
}

}  // namespace tendril::test
