// Dear ImGui's output of a frame as texts and items instead of pixels: each text with its position and clip
// rectangle, each item with its box. Its functions are wrapped when the tests are linked (see
// CMakeLists.txt), so the program under test is the real one.
#pragma once

#include <imgui.h>

#include <string>
#include <vector>

#include "app/view/camera.hpp"

struct ImGuiWindow;

namespace tendril::test {

struct DrawnText {
    const ImGuiWindow* window = nullptr;  ///< null on the scene
    std::string text;
    app::Rect box;   ///< unclipped
    app::Rect clip;  ///< the visible part of the screen
    const ImFont* font = nullptr;
    float widest_word = 0.0f;
    float wrap = 0.0f;  ///< 0: a single line
};

struct DrawnItem {
    enum class Kind { Button, Check, Text, Number, Combo, Row, Other };  ///< a row may contain other items
    const ImGuiWindow* window = nullptr;
    unsigned id = 0;
    app::Rect box;
    bool greyed = false, lit = false;  ///< lit: a button in the colour of the chosen one
    Kind kind = Kind::Other;
    std::string label{};       ///< as given to Dear ImGui; empty if its function is not wrapped
    std::string shown{};       ///< a combo's present choice
    std::optional<bool> on{};  ///< state of a radio button or a checkbox
};

struct FrameRecord {
    std::vector<DrawnText> texts;
    std::vector<DrawnItem> items;  ///< items that can be clicked, including those scrolled out of view

    /// Whether it is a scroll bar or a close button, which mean the same everywhere.
    static bool is_of_a_window(const DrawnItem& item);
    /// Items with the id of another item, or in a child window that was begun twice: a click on one may act
    /// on the other.
    std::vector<std::string> alike() const;
    const DrawnItem* find(unsigned id) const;
};

/// Records while it exists; keeps the last frame. One at a time.
class FrameRecorder {
  public:
    FrameRecorder();
    ~FrameRecorder();
    FrameRecorder(const FrameRecorder&) = delete;
    FrameRecorder& operator=(const FrameRecorder&) = delete;

    const FrameRecord& frame() const { return record_; }

    // called by the wrapped functions
    void text(const ImDrawList& list, const ImFont* font, float size, const ImVec2& at, const char* begin,
              const char* end, float wrap, const ImVec4* clip);
    void item(const ImVec4& box, unsigned id, int flags);
    /// The latest item with the present id; null if it is not recorded.
    DrawnItem* last_item();

  private:
    void begin();

    FrameRecord record_;
    int frame_ = -1;
};

}  // namespace tendril::test
