// Standard output, written in blocks but never long behind, and checked: a full disk is no success.
#pragma once

#include <chrono>
#include <string>
#include <string_view>

#include "app/batch/progress.hpp"

namespace tendril::app {

class Output {
  public:
    /// The progress is taken off the terminal before anything is written there.
    explicit Output(Progress& progress) : progress_(&progress) {}
    void write(std::string_view text);
    /// Throws std::runtime_error where anything did not get out.
    void finish();

  private:
    void flush();

    Progress* progress_;
    std::string waiting_;
    std::chrono::steady_clock::time_point flushed_ = std::chrono::steady_clock::now();
    bool failed_ = false;
};

/// A field of a CSV file as RFC 4180 quotes it.
std::string csv_field(std::string_view text);

/// A text for a column: one line, at most `width` characters, filled up with blanks to exactly that many.
std::string column(std::string_view text, std::size_t width);
/// Characters (not bytes) of a UTF-8 text.
std::size_t width_of(std::string_view text);

}  // namespace tendril::app
