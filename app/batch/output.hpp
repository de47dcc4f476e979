// Standard output in blocks, flushed often, with error checks: a full disk must not look like success.
#pragma once

#include <chrono>
#include <string>
#include <string_view>

#include "app/batch/progress.hpp"

namespace tendril::app {

class Output {
  public:
    /// Clears `progress` from the terminal before writing.
    explicit Output(Progress& progress) : progress_(&progress) {}
    void write(std::string_view text);
    /// Throws std::runtime_error if any write failed.
    void finish();

  private:
    void flush();

    Progress* progress_;
    std::string buffer_;
    std::chrono::steady_clock::time_point flushed_ = std::chrono::steady_clock::now();
    bool failed_ = false;
};

/// A CSV field, quoted as in RFC 4180.
std::string csv_field(std::string_view text);

/// A text for a table column: one line, cut or padded to `width` characters.
std::string column(std::string_view text, std::size_t width);
/// Characters (not bytes) of a UTF-8 text.
std::size_t width_of(std::string_view text);

}  // namespace tendril::app
