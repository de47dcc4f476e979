// Output of the subcommands: rows on standard output, and the progress of a long run on stderr.
#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace tendril::app {

/// The progress of a long run, on stderr: updated in place on a terminal, a line every few seconds elsewhere,
/// and nothing for short runs.
class Progress {
  public:
    Progress();
    ~Progress() { clear(); }
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// "solving", 0 to 1. Cheap enough to call for every case.
    void show(const char* what, double done);
    /// Removes the line from the terminal, before something else is written there.
    void clear();

  private:
    using Clock = std::chrono::steady_clock;
    bool terminal_;
    bool shown_ = false;
    Clock::time_point next_;
};

/// Standard output in blocks, flushed often, with error checks: a full disk must not look like success.
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
