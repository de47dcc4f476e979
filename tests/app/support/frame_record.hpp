// What Dear ImGui draws in a frame, as texts and items rather than pixels: each text with its place and with
// what it is clipped to, each item with its box. Its functions are wrapped when the tests are linked (see
// CMakeLists.txt there), so the program that is looked at is the one that people run.
#pragma once

#include <imgui.h>

#include <string>
#include <vector>

#include "app/view/camera.hpp"

struct ImGuiWindow;

namespace tendril::test {

struct DrawnText {
    const ImGuiWindow* window = nullptr;  ///< null where it lies on the scene
    std::string text;
    app::Rect box;   ///< all of it, clipped or not
    app::Rect clip;  ///< what of the screen it may be seen in
    const ImFont* font = nullptr;
    float widest_word = 0.0f;
    float wrap = 0.0f;  ///< 0: it stands on one line
};

struct DrawnItem {
    enum class Kind { Button, Text, Combo, Row, Other };  ///< a row may have items of its own on it
    const ImGuiWindow* window = nullptr;
    unsigned id = 0;
    app::Rect box;
    Kind kind = Kind::Other;
};

struct FrameRecord {
    std::vector<DrawnText> texts;
    std::vector<DrawnItem> items;  ///< those that can be clicked, also where they are scrolled out of sight
};

/// Records while it lives, the last frame only. One at a time.
class FrameRecorder {
  public:
    FrameRecorder();
    ~FrameRecorder();
    FrameRecorder(const FrameRecorder&) = delete;
    FrameRecorder& operator=(const FrameRecorder&) = delete;

    const FrameRecord& frame() const { return record_; }

    // what the wrapped functions say
    void text(const ImDrawList& list, const ImFont* font, float size, const ImVec2& at, const char* begin,
              const char* end, float wrap, const ImVec4* clip);
    void item(const ImVec4& box, unsigned id);
    void last_item_is(DrawnItem::Kind kind);

  private:
    void begin();

    FrameRecord record_;
    int frame_ = -1;
};

}  // namespace tendril::test
