// Progress and cancellation of reading a file, shared between threads.
#pragma once

#include <atomic>
#include <stdexcept>

namespace tendril::app {

class LoadProgress {
  public:
    /// Called by the reader: `part` of the file is read, 0 to 1. Throws std::runtime_error if cancelled.
    void at(double part) {
        part_.store(static_cast<float>(part), std::memory_order_relaxed);
        if (cancelled()) throw std::runtime_error("cancelled");
    }
    float part() const { return part_.load(std::memory_order_relaxed); }
    void cancel() { cancelled_.store(true, std::memory_order_relaxed); }
    bool cancelled() const { return cancelled_.load(std::memory_order_relaxed); }

  private:
    std::atomic<float> part_{0.0f};
    std::atomic<bool> cancelled_{false};
};

/// For readers; `progress` may be null.
inline void report(LoadProgress* progress, double part) {
    if (progress) progress->at(part);
}

}  // namespace tendril::app
