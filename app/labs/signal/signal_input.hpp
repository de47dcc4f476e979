// What goes into the Signal lab's filters: a hand, a wave, a recording.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <tendril/signal/run.hpp>
#include <vector>

#include "app/document/names.hpp"

namespace tendril::app {

enum class InputKind : std::uint8_t { Hand, Square, Sine, Noise, Recorded, Csv };

inline constexpr EnumNames<InputKind, 6> input_kinds{
    "kind",
    {{"hand", "Hand", "Drag the orange ball up and down: its height is the input."},
     {"square", "Square wave", "Jumps between two values."},
     {"sine", "Sine", "A steady swing."},
     {"noise", "Noise", "A slow drift that a sensor has made unsteady."},
     {"recorded", "Recorded", "What the hand did last, over and over."},
     {"csv", "CSV", "The rows of a file, over and over."}}};

inline constexpr double min_input_period = 0.02, max_input_period = 60.0;  ///< seconds
inline constexpr double max_amplitude = 1e6;
inline constexpr std::size_t max_input_rows = 36'000;  ///< of a recording: ten minutes at 60 Hz

using InputRows = std::vector<signal::Sample>;

struct SignalInput {
    InputKind kind = InputKind::Square;
    double amplitude = 1.0;  ///< of square, sine and noise, either way of 0
    double period = 2.0;     ///< seconds, of these
    double hand = 0.0;
    /// What recorded and csv play. Shared between copies, and never changed.
    std::shared_ptr<const InputRows> recording{}, file{};
    std::string path{};  ///< of the file

    /// The same rows, and not merely equal ones.
    bool operator==(const SignalInput&) const = default;
};

/// The input at a time of the lab, seconds from 0. A square wave is up right after 0, and down at 0: so
/// frames of every rate that begin at 0 see its jumps at the same time.
double input_at(const SignalInput& input, double time);

/// How long a recording is, seconds; 0 where there is none.
double length_of(const InputRows* rows);

/// Rows of what the input is from 0 on, long enough to measure by: some periods, or all of a recording up to
/// `most_seconds`. The first row is at 0, and takes next to no
/// time: it is what filters start from. `rate`: rows a second. Of the hand there are none.
InputRows measuring_rows(const SignalInput& input, double rate);
inline constexpr double max_measured_seconds = 10.0;

}  // namespace tendril::app
