// Fits every kind of filter to the desired response, a slice in every tick, so that the window stays
// responsive. The progress is stored in the part and depends on the number of ticks, never on the clock.
#pragma once

#include <memory>

#include "app/labs/signal/signal_part.hpp"

namespace tendril::app {

/// The search in progress. It is a function of the part: if lost, it is redone up to the part's progress.
class FitWork {
  public:
    /// Computes one slice, some 2 to 15 ms; the last slice of a kind adds its fit to the part.
    void advance(SignalPart& part);

  private:
    /// The search of one kind, with its rows.
    struct Task {
        Task(const SignalPart& part);
        bool of(const SignalPart& part) const;
        void advance();

        InputRows rows;
        std::vector<double> wanted;
        std::vector<signal::Filter> from;
        std::size_t kind;
        FitProblem problem;
        std::unique_ptr<FitTask> task;
        std::size_t shares = 0;
        bool more = true;
    };
    std::unique_ptr<Task> task_;
};

}  // namespace tendril::app
