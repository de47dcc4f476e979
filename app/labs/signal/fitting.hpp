// Fitting every kind of filter to the response that is wanted, a share in every tick, so that the window
// stays responsive; how far it is stands in the part, and follows from the number of ticks, never from the
// clock.
#pragma once

#include <memory>

#include "app/labs/signal/signal_part.hpp"

namespace tendril::app {

/// Throws Refused where no response is wanted.
void start_fitting(SignalPart& part);
/// What is fitted so far stays, ranked.
void cancel_fitting(SignalPart& part);

/// The search that goes on from tick to tick. It follows from the part: one that was thrown away is made
/// again, as far as the part says that it is.
class FitWork {
  public:
    /// A share of the fit, some 2 to 15 ms; the last of a kind puts that kind among the part's fits.
    void advance(SignalPart& part);

  private:
    /// The search of one kind, with the rows that it is about.
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
