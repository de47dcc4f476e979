// The rows of a panel: a dim name on the left, a field on the right (below, where there is no room beside
// it); numbers of fixed width, with their units. Each field returns true in a frame in which a person changed
// its value. The names are ids too: unique in a panel. A name that begins with ## is only an id, and its
// field takes the whole row.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace tendril::app {

/// A heading over a group of rows, with some air above it.
void section(const char* title);
/// One with a mark that says whether what follows is shown; true in a frame in which it is clicked.
bool section_button(const char* title, bool open);
/// What the panel is about, in one short line, or wrapped: the largest text of all.
void verdict(const std::string& text, glm::vec3 colour);
/// Dim text, wrapped.
void note(const std::string& text);

/// One of several texts, with room for the longest: what comes below keeps still when another is shown.
void note_of(const std::vector<std::string>& all, std::size_t shown);

// A drag ends at the range. What is typed counts when the person is done (number_entry.hpp). Beyond the range
// it is passed on: the command that takes it refuses it, and says the value and the range.
bool number_field(const char* name, float& value, float speed, float low, float high, const char* format);
bool integer_field(const char* name, int& value, int low, int high);
bool integer_slider(const char* name, int& value, int low, int high);
/// A line of text. What is typed counts with Enter only; `hint` stands there while it is empty.
bool text_field(const char* name, std::string& value, const char* hint);
bool point_field(const char* name, glm::vec3& value, float speed, float most = 1e9f,
                 const char* format = "%.3f m");
/// Its name on a line of its own, and below it three fields side by side.
bool vector_field(const char* name, glm::vec3& value, float speed, glm::vec3 low, glm::vec3 high,
                  const char* format);
/// `why_not`, where given: one for each choice, null for one that can be chosen; else it is grey and the
/// reason stands beside it.
bool choice_field(const char* name, int& chosen, const char* const* titles, int count,
                  const char* const* why_not = nullptr);
/// A choice among many, which a person finds by typing a part of it; `typed` is kept from frame to frame. Its
/// rows come between both calls, where the first says true; a row says true when it is chosen. With `shown`
/// the field stands in the row of its name, without it is a small button beside what follows.
using SearchText = std::array<char, 64>;
bool begin_search(const char* name, const std::string* shown, SearchText& typed);
bool search_row(const std::string& title, bool chosen, const SearchText& typed);
void end_search();
/// Whether `part` is in `text`, in whatever case.
bool contains_text(std::string_view text, std::string_view part);

/// One of several that exclude each other.
bool option_button(const char* title, bool chosen, const char* tooltip = nullptr);

/// A row that is only read.
void reading(const char* name, const char* format, ...)
#if defined(__GNUC__)
    __attribute__((format(printf, 2, 3)))
#endif
    ;

/// What the row above means, while the mouse rests on it. A number's unit and range follow by themselves.
/// After point_field() or vector_field() it is about all three.
void explain(const char* text);

/// A button as wide as its share of the row: `of` buttons to a row, or fewer where they would be too small. A
/// long tooltip is wrapped.
bool row_button(const char* title, int of, bool enabled = true, const char* tooltip = nullptr);

/// What comes next begins below, though the row of buttons is not full.
void end_row();

}  // namespace tendril::app
