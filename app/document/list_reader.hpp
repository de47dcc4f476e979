// Reads a JSON list with one value in memory at a time: a million cases need no more memory than their text.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "app/document/json.hpp"

namespace tendril::app {

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
