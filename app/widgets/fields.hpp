// The rows of a panel: a dim name on the left, a field on the right (below, if there is no room); numbers
// have fixed width and units. Each field returns true in a frame in which the user changed its value. Names
// are also ids and must be unique in their section. A name that begins with ## is only an id, and its field
// fills the row.
#pragma once

#include <glm/vec3.hpp>
#include <string>

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
/// The height of a verdict of so many lines.
float verdict_height(int lines);
/// Dim text, wrapped.
void note(const std::string& text);
void coloured_note(const std::string& text, glm::vec3 colour);

// Drags are clamped to the range. Typed values take effect when the user finishes (number_entry.hpp). They
// are emitted even if out of range: the command refuses them with a message that gives the value and the
// range.
/// `at_zero`, if given, is shown instead of 0: "never".
bool number_field(const char* name, float& value, float speed, float low, float high, const char* format,
                  const char* at_zero = nullptr);
bool integer_field(const char* name, int& value, int low, int high);
bool integer_slider(const char* name, int& value, int low, int high);
/// A line of text. Typing takes effect on Enter, Tab or a click elsewhere; Escape cancels it. `hint` is shown
/// while the line is empty. `value` always follows what is typed, for a button beside the field.
/// `room`: pixels that stay free on the right.
bool text_field(const char* name, std::string& value, const char* hint, float room = 0.0f);
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
/// click that removes a row must not move the next rows under the mouse. They are at least `min_height`
/// pixels high.
void keep_room(const char* id, float top, float min_height = 0.0f);
/// The height of so many lines of dim text.
float note_height(int lines);
/// A note that appears and disappears, in space for so many lines; empty: no note.
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

}  // namespace tendril::app
