// The rows of a panel, and the lists that open below them: a dim name on the left, a field on the right
// (below, if there is no room); numbers have fixed width and units. Each field returns true in a frame in
// which the user changed its value. Names are also ids and must be unique in their section. A name that
// begins with ## is only an id, and its field fills the row.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace tendril::app {

class Emit;

/// A scope for ids: rows drawn while it exists may reuse names of rows in other sections.
class [[nodiscard]] IdScope {
  public:
    explicit IdScope(const char* name);
    ~IdScope();
    IdScope(const IdScope&) = delete;
    IdScope& operator=(const IdScope&) = delete;
};

/// A heading, with space above it, for the rows drawn while it exists.
struct [[nodiscard]] PanelSection {
    explicit PanelSection(const char* title);
    IdScope ids;
};
/// A heading with a mark that shows whether its section is open; true in a frame in which it is clicked.
bool section_button(const char* title, bool open);
/// The panel's main message, wrapped, in the largest text.
void verdict(const std::string& text, glm::vec3 colour);
/// The height of a verdict with that many lines.
float verdict_height(int lines);
/// Dim text, wrapped.
void note(const std::string& text);
void coloured_note(const std::string& text, glm::vec3 colour);

// Drags are clamped to the range. Typed values take effect when the user finishes (number_entry.hpp), even
// out of range: the command then refuses them with a message that gives the value and the range. `at_zero`,
// if given, is shown instead of 0: "never".
bool number_field(const char* name, float& value, float speed, float low, float high, const char* format,
                  const char* at_zero = nullptr);
bool integer_field(const char* name, int& value, int low, int high);
bool integer_slider(const char* name, int& value, int low, int high);
/// A line of text. Typing takes effect on Enter, Tab or a click elsewhere; Escape cancels it. `hint` is shown
/// while the line is empty. `value` always follows what is typed, for a button beside the field.
/// `room`: pixels that stay free on the right.
bool text_field(const char* name, std::string& value, const char* hint, float room = 0.0f);
/// The room that a button takes at the end of a field's row, and the button.
float field_button_width(const char* title);
bool field_button(const char* title, const char* name);
/// A path, with a button that opens the file dialog for the command `by`.
bool path_field(const char* name, std::string& value, const char* hint, const char* by, Emit& emit);
/// Call before an ImGui::InputText() of that id and text. Text that is too wide for the next item and is not
/// being edited is shown here instead, cut in the middle, until it is clicked; a tooltip shows all of it.
/// Returns true if it is shown, so that there is nothing to edit in this frame.
bool shows_cut_text(const char* id, const std::string& text);
bool point_field(const char* name, glm::vec3& value, float speed, float most = 1e9f,
                 const char* format = "%.3f m");
/// The name on its own line, with three fields side by side below it.
bool vector_field(const char* name, glm::vec3& value, float speed, glm::vec3 low, glm::vec3 high,
                  const char* format);
/// Keeps the height of the rows below `top`, a cursor position in the window, while the mouse is over them: a
/// click that removes a row must not move the next rows under the mouse. Reserves at least `min_height`
/// pixels.
void keep_room(const char* id, float top, float min_height = 0.0f);
/// The height of `lines` lines of dim text.
float note_height(int lines);
/// A note that comes and goes, in space reserved for `lines` lines. Empty text: no note.
void kept_note(const char* id, const std::string& text, int lines);
/// A radio button: one of several exclusive options.
bool option_button(const char* title, bool chosen, const char* tooltip = nullptr);

/// A read-only row.
void reading(const char* name, const char* format, ...)
#if defined(__GNUC__)
    __attribute__((format(printf, 2, 3)))
#endif
    ;

/// Writes a row's name and leaves the cursor at its field, beside the name or, if there is no room, below it.
/// Returns the field's id.
std::string begin_row(const char* name);
/// A wrapped tooltip for the last item, even if it is disabled.
void tooltip_of_button(const std::string& text);

/// A tooltip for the row above. A number's unit and range are appended automatically. After point_field() or
/// vector_field() it covers all three fields.
void explain(const char* text);

/// A button in a row of `of` equal buttons, or fewer if they would be too small. A long tooltip is wrapped.
bool row_button(const char* title, int of, bool enabled = true, const char* tooltip = nullptr);
/// One of a row of buttons; the chosen one is lit.
bool row_option(const char* title, int of, bool chosen, const char* tooltip = nullptr);

/// Ends a row of buttons that is not full.
void end_row();

// Lists that open below a field or a button. Each has a line to type into: part of a title filters the rows,
// Enter chooses the highlighted one.

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
/// True if `text` contains `part`, ignoring case.
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
    float after = 0.0f;                 ///< free pixels after the field
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
