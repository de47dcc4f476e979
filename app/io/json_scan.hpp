// Scans JSON text before it is parsed: helpers, and a reader that takes a list one value at a time.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

#include "app/io/json.hpp"

namespace tendril::app {

/// The line, from 1, that contains `offset`.
inline int line_at(std::string_view text, std::size_t offset) {
    const auto before = text.substr(0, offset);
    return 1 + static_cast<int>(std::count(before.begin(), before.end(), '\n'));
}

/// The end of the string that opens at `at`: past its closing quote, or the end of the text.
inline std::size_t string_end(std::string_view text, std::size_t at) {
    for (++at; at < text.size(); ++at) {
        if (text[at] == '\\')
            ++at;
        else if (text[at] == '"')
            return at + 1;
    }
    return text.size();
}

inline std::size_t skip_space(std::string_view text, std::size_t at) {
    return std::min(text.find_first_not_of(" \t\r\n", at), text.size());
}

/// The end of the value at `at`, by brackets and quotes alone; parsing it finds errors.
inline std::size_t skip_value(std::string_view text, std::size_t at) {
    int depth = 0;
    while (at < text.size()) {
        const char c = text[at];
        if (depth == 0 && (c == ',' || c == ']' || c == '}')) break;
        if (c == '[' || c == '{') ++depth;
        if (c == ']' || c == '}') --depth;
        at = c == '"' ? string_end(text, at) : at + 1;
    }
    return at;
}

/// Reads a JSON list with one value in memory at a time: a million cases need no more memory than their text.
class ListReader {
  public:
    /// Reads from `text`, which must outlive it. JSON paths in messages begin with `name`: "cases". Throws
    /// ParseError if it is not JSON and std::runtime_error if it is not a list.
    ListReader(std::string_view text, std::string name);

    /// Reads the next value; false after the last. Throws ParseError with line numbers of the whole text.
    bool next(Json& value);

    /// JSON path of the value that next() read last: "cases.3".
    std::string place() const { return name_ + "." + std::to_string(index_); }
    std::size_t index() const { return index_; }
    /// The line in the text of `place`, the path of this value or one within it: "cases.3.lengths.0".
    int line_of(std::string_view place) const;
    /// Fraction of the text that has been read, 0 to 1.
    double progress() const;

  private:
    [[noreturn]] void fail(std::size_t offset, const std::string& why) const;
    void end_of_list();

    std::string_view text_, value_;
    std::string name_;
    std::size_t at_ = 0;     ///< offset of the next value or, with done_, of the end
    std::size_t start_ = 0;  ///< offset of value_
    std::size_t index_ = 0;
    bool first_ = true, done_ = false;
};

}  // namespace tendril::app
