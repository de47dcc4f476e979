// Lists that open below a field or a button. Each has a line to type into: part of a title filters the rows,
// Enter chooses the highlighted one.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace tendril::app {

/// The text that filters a list, and the index of its highlighted hit; keep it from frame to frame. Typing
/// highlights the first hit, Up and Down move the highlight, Enter chooses it, Escape clears the text.
struct SearchText {
    std::array<char, 64> text{};
    int at = -1;              ///< the highlighted hit; negative: none
    int hits = 0;             ///< the last frame's, or this one's so far
    int rows = 0, found = 0;  ///< in this frame so far: all, and those that contain the text, greyed too
    bool moved = false;       ///< the highlight moved in this frame
    bool entered = false;     ///< Enter was pressed in this frame

    bool empty() const { return text[0] == '\0'; }
};
/// The line to type into; count the rows below it in `hits`. Returns true if Escape cleared the text.
bool search_line(const char* id, const char* hint, SearchText& typed);
/// Whether `text` contains `part`, ignoring case.
bool contains_text(std::string_view text, std::string_view part);

/// The open list or menu: at most one is open.
struct OpenList {
    SearchText typed;
    bool in_field = false;                         ///< opened by a field, not by a button
    glm::vec2 opener_min{0.0f}, opener_max{0.0f};  ///< box of the item that opened it, on the screen
};

/// The size of a list.
struct ListRoom {
    float width = 0.0f;  ///< width of its rows, in pixels; 0: enough for most names
    int rows = 10;
    std::optional<glm::vec3> swatch{};  ///< the colour that the field's choice stands for
};

/// Begins the list of a field. If it returns true, add rows and call end_list(). With `shown`, the field is a
/// named row; otherwise it is a small button beside the next item.
bool begin_list(const char* name, const std::string* shown, ListRoom room = {});
/// The same for the button above, which `pressed` opens.
bool begin_list_of_button(const char* id, bool pressed, ListRoom room = {});
/// Returns true when the row is chosen. With `why_not` it cannot be, and the reason follows its greyed title.
bool list_row(const std::string& title, bool chosen, const char* why_not = nullptr,
              const std::optional<glm::vec3>& swatch = {});
void end_list();
/// A menu, without a line to type into, for the button above. If it returns true, add items and call
/// ImGui::EndPopup().
bool begin_menu(const char* id, bool pressed);

/// One of a few choices, in a list. `why_not`, if given, has one entry per choice: null if it can be chosen,
/// else the reason. `swatches`, if not empty, has the colour that each choice means. Returns true in a frame
/// in which the user changed it.
bool choice_field(const char* name, int& chosen, const char* const* titles, int count,
                  const char* const* why_not = nullptr, std::span<const glm::vec3> swatches = {});

/// Call before a frame in which a mouse button goes down: a press outside the open lists and menus closes
/// them and acts on the item there. The item that opened a list only closes it.
void close_lists_on_press();

}  // namespace tendril::app
