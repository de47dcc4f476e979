#include "app/batch/output.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <stdexcept>
#include <system_error>

#include "app/io/text.hpp"
#include "app/system/environment.hpp"

namespace tendril::app {
namespace {

bool begins_character(char c) {
    return (static_cast<unsigned char>(c) & 0xc0) != 0x80;
}

/// The first `count` UTF-8 characters.
std::string_view head(std::string_view text, std::size_t count) {
    std::size_t at = 0;
    for (; at < text.size(); ++at)
        if (begins_character(text[at]) && count-- == 0) break;
    return text.substr(0, at);
}

using namespace std::chrono_literals;

constexpr auto first_delay = 1000ms;    // before the first report
constexpr auto terminal_pause = 100ms;  // between reports on a terminal
constexpr auto line_pause = 5000ms;     // between lines elsewhere

}  // namespace

void Output::write(std::string_view text) {
    constexpr std::size_t block = 1 << 16;
    constexpr auto max_wait = std::chrono::milliseconds(200);
    buffer_ += text;
    if (buffer_.size() >= block || std::chrono::steady_clock::now() - flushed_ > max_wait) flush();
}

void Output::flush() {
    progress_->clear();
    const bool written =
        std::fwrite(buffer_.data(), 1, buffer_.size(), stdout) == buffer_.size() && std::fflush(stdout) == 0;
    if (!written && !failed_) {
        failed_ = true;
        throw std::runtime_error("cannot write the output: " + std::generic_category().message(errno));
    }
    buffer_.clear();
    flushed_ = std::chrono::steady_clock::now();
}

void Output::finish() {
    flush();
}

std::string csv_field(std::string_view text) {
    const bool plain =
        text.find_first_of(",\"\r\n") == text.npos && !text.starts_with(' ') && !text.ends_with(' ');
    if (plain) return std::string(text);
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
    return quoted + '"';
}

std::size_t width_of(std::string_view text) {
    return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), begins_character));
}

std::string column(std::string_view text, std::size_t width) {
    std::string shown = printable(text);
    if (width_of(shown) > width) shown = std::string(head(shown, width - 3)) + "...";
    shown.append(width - width_of(shown), ' ');
    return shown;
}

Progress::Progress() : terminal_(errors_on_terminal()), next_(Clock::now() + first_delay) {}

void Progress::show(const char* what, double done) {
    const auto now = Clock::now();
    if (now < next_) return;
    next_ = now + (terminal_ ? terminal_pause : line_pause);
    shown_ = true;
    std::fprintf(stderr, terminal_ ? "\r%s: %3.0f %%" : "tendril: %s: %.0f %%\n", what, 100.0 * done);
    std::fflush(stderr);
}

void Progress::clear() {
    if (shown_ && terminal_) std::fputs("\r\x1b[K", stderr);
    shown_ = false;
}

}  // namespace tendril::app
