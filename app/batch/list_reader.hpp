// A JSON list of any number of values, one value in memory at a time: a million cases cost no more than their
// text.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "app/document/json.hpp"

namespace tendril::app {

class ListReader {
  public:
    /// Reads from `text`, which must outlive it. `name` is what the places in messages begin with: "cases".
    /// Throws ParseError for what is no JSON and std::runtime_error for what is JSON and no list.
    ListReader(std::string_view text, std::string name);

    /// The next value; false after the last. Throws ParseError, told in lines of the whole text.
    bool next(Json& value);

    /// Of the value that next gave last: "cases.3".
    std::string place() const { return name_ + "." + std::to_string(index_); }
    std::size_t index() const { return index_; }
    /// The line in the text where `place` stands, this value or something in it: "cases.3.lengths.0".
    int line_of(std::string_view place) const;
    /// Part of the text that has been read, 0 to 1.
    double progress() const;

  private:
    [[noreturn]] void fail(std::size_t offset, const std::string& why) const;
    void end_of_list();

    std::string_view text_, value_;
    std::string name_;
    std::size_t at_ = 0;     ///< what comes next: a value, or with done_ the end
    std::size_t start_ = 0;  ///< of value_
    std::size_t index_ = 0;
    bool first_ = true, done_ = false;
};

}  // namespace tendril::app
