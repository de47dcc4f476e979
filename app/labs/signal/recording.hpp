// A response that a person shows with the hand, for filters to be fitted to.
#pragma once

#include "app/labs/signal/signal_part.hpp"

namespace tendril::app {

/// The input that a response answers: the rows that the lab plays from its beginning on, a tick each, or
/// what the hand did last.
InputRows rows_to_answer(const SignalPart& part);

/// What the hand did last, from where it first moved on; null where it did not.
std::shared_ptr<const InputRows> gesture_of(const SignalPart& part);

/// Puts the input back to its start, with filters that remember nothing. A hand's gesture becomes a recorded
/// input. Throws Refused where there is no input to answer.
void begin_recording(SignalPart& part);
/// Keeps what is there; less than two rows are nothing.
void end_recording(SignalPart& part);
/// The rows up to the part's time.
void record(SignalPart& part);

}  // namespace tendril::app
