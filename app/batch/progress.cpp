#include "app/batch/progress.hpp"

#include <cstdio>

#include "app/system/environment.hpp"

namespace tendril::app {
namespace {

using namespace std::chrono_literals;

constexpr auto first_delay = 1000ms;    // before the first report
constexpr auto terminal_pause = 100ms;  // between two reports on a terminal
constexpr auto line_pause = 5000ms;     // between two lines

}  // namespace

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
