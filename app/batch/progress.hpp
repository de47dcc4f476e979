// The progress of a long run, on stderr: updated in place on a terminal, a line every few seconds elsewhere,
// and nothing for short runs.
#pragma once

#include <chrono>

namespace tendril::app {

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

}  // namespace tendril::app
