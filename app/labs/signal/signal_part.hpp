// The Signal lab's part of the document: a chain of filters, its input, and the desired response.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <tendril/signal/filter.hpp>
#include <tendril/signal/run.hpp>
#include <vector>

#include "app/document/document.hpp"
#include "app/document/workspace.hpp"
#include "app/fields/fields.hpp"
#include "app/io/names.hpp"
#include "app/labs/signal/fit.hpp"

namespace tendril::app {

// The input of the filters: the hand, a wave, a recording.

enum class InputKind : std::uint8_t { Hand, Square, Sine, Noise, Recorded, Csv };

inline constexpr EnumNames<InputKind, 6> input_kinds{
    "kind",
    {{"hand", "Hand", "Drag the orange ball up and down: its height is the input."},
     {"square", "Square wave", "Jumps between two values."},
     {"sine", "Sine", "A steady swing."},
     {"noise", "Noise", "A slow drift with sensor noise."},
     {"recorded", "Recorded", "The last motion of the hand, in a loop."},
     {"csv", "CSV", "The rows of a file, in a loop."}}};

inline constexpr double min_input_period = 0.02, max_input_period = 60.0;  ///< seconds
inline constexpr double max_amplitude = 1e6;
inline constexpr std::size_t max_input_rows = 36'000;  ///< of a recording: ten minutes at 60 Hz

using InputRows = std::vector<signal::Sample>;

struct SignalInput {
    InputKind kind = InputKind::Square;
    double amplitude = 1.0;  ///< amplitude of square, sine and noise waves, to either side of 0
    double period = 2.0;     ///< seconds, of the same waves
    double hand = 0.0;
    /// The rows of Recorded and Csv. Shared between copies, and immutable.
    std::shared_ptr<const InputRows> recording{}, file{};
    std::string path{};  ///< the file's path

    /// Compares recordings by pointer.
    bool operator==(const SignalInput&) const = default;
};

/// The input at a time of the lab, seconds from 0. A square wave is low at 0 and high right after, so that
/// frames that begin at 0 see its jumps at the same time at every rate.
double input_at(const SignalInput& input, double time);

/// The length of a recording, seconds; 0 if there is none.
double length_of(const InputRows* rows);

/// Rows of the input from 0 on, long enough to measure: a few periods, or a recording, up to
/// max_measured_seconds. The first row is at 0 with a dt of nearly 0: filters start from it. `rate`: rows per
/// second. Empty for the hand.
InputRows measuring_rows(const SignalInput& input, double rate);
inline constexpr double max_measured_seconds = 10.0;

inline constexpr const char* signal_lab = "signal";
inline constexpr std::size_t max_stages = 16;
inline constexpr std::size_t max_past = 600;    ///< ticks of input that are kept
inline constexpr std::size_t max_wanted = 300;  ///< rows of a response to fit: more would take too long

/// One filter of the chain.
struct SignalStage {
    signal::Filter filter;
    bool enabled = true;  ///< otherwise the input passes through
    bool beside = false;  ///< starts a new lane on the lab's input; always true for the first
    int colour = 0;       ///< colour of its curves, kept wherever it moves
    signal::FilterState state{};
    bool operator==(const SignalStage&) const = default;
};

/// The contents of the lower plot.
enum class SignalPlot : std::uint8_t { Rates, Shelf, Fit };
inline constexpr EnumNames<SignalPlot, 3> signal_plots{
    "plot",
    {{"rates", "Frame rates", "The selected series at several frame rates, on the same input."},
     {"shelf", "Lag against jitter",
      "Every series with its numbers, and every other kind of filter with its defaults."},
     {"fit", "Fit", "The desired response, and the filters that come closest to it."}}};

/// A response that the user performs: the input plays from its start, and the output ball follows the mouse.
struct Recording {
    double value = 0.0;    ///< the value at the mouse
    std::size_t rows = 0;  ///< rows of the response recorded so far
    bool begun = false;    ///< the ball has been grabbed; no tick passes before
    bool operator==(const Recording&) const = default;
};

/// A fit in progress, computed in slices, one per tick (analysis.hpp): one kind after the other, in the order
/// of signal::kinds(). SignalPart::fits has the completed ones.
struct Fitting {
    std::vector<signal::Filter> from;  ///< the chain at the start, as further starting points
    std::size_t shares = 0;            ///< ticks spent on the present kind
    bool operator==(const Fitting&) const = default;
};
inline constexpr double max_residual = 1e9;  ///< limit in files

struct SignalPart final : Part {
    std::vector<SignalStage> stages;
    SignalInput input;
    double time = 0.0;  ///< time of the input, seconds
    InputRows past;     ///< the input of the last ticks, oldest first
    std::optional<std::size_t> selected;
    SignalPlot plot = SignalPlot::Rates;
    /// The response that filters are fitted to, and its input.
    InputRows fit_input;
    std::vector<double> wanted;
    std::optional<Recording> recording;  ///< recording of `wanted`, which has a row for each row of fit_input
    std::vector<Fit> fits;               ///< best first
    std::optional<Fitting> fitting;      ///< the fit in progress

    std::shared_ptr<Part> clone() const override { return std::make_shared<SignalPart>(*this); }
    Json save() const override;
    std::shared_ptr<Part> load(const Json& json, const std::string& where) const override;
    /// Restores the filters' states but keeps their present parameters.
    std::shared_ptr<const Part> at_moment(std::shared_ptr<const Part> then) const override;
    std::size_t bytes() const override;
    bool operator==(const SignalPart& other) const;
};

/// The stages from a filter on the lab's input to the next such filter: each works on the output of the one
/// before.
struct Lane {
    std::size_t first = 0, end = 0;
};
Lane lane_of(const SignalPart& part, std::size_t stage);
/// The lane of the selected filter, or the first lane; if all its filters are off, the first lane with one
/// on. Its output is shown, exported and fitted.
Lane shown_lane(const SignalPart& part);
/// Its last stage that is on, whose output is shown.
std::optional<std::size_t> shown_stage(const SignalPart& part);
/// The lowest colour that no stage has.
int unused_colour(const SignalPart& part);

/// The enabled filters of a lane, in order.
std::vector<signal::Filter> enabled_filters(const SignalPart& part, Lane lane);
inline std::vector<signal::Filter> enabled_filters(const SignalPart& part) {
    return enabled_filters(part, shown_lane(part));
}
/// The output of every stage for these rows, from fresh states; a disabled stage passes its input through.
std::vector<std::vector<double>> outputs_for(const SignalPart& part, const InputRows& rows);
/// The last input; before the first tick, the next one.
double input_of(const SignalPart& part);
/// The last output of the lane; the last input if none of its stages has run yet.
double output_of(const SignalPart& part, Lane lane);
inline double output_of(const SignalPart& part) {
    return output_of(part, shown_lane(part));
}

/// Advances by `dt` seconds.
void pass_signal_time(SignalPart& part, double dt);

inline const SignalPart& signal_part(const Workspace& workspace) {
    return workspace.document.get<SignalPart>(signal_lab);
}

// Records a response by hand, to which filters are then fitted.

/// The input of the response: the rows that the lab plays from its start, one per tick, or the last input of
/// the hand.
InputRows rows_to_answer(const SignalPart& part);

/// The last input of the hand from its first movement on; null if it did not move.
std::shared_ptr<const InputRows> gesture_of(const SignalPart& part);

/// Restarts the input, with the filters' states reset. The hand's gesture becomes a recorded input. Throws
/// Refused if there is no input.
void begin_recording(SignalPart& part);
/// Keeps the recorded rows, or nothing if there are fewer than two.
void end_recording(SignalPart& part);
/// Records rows up to the part's time.
void record(SignalPart& part);

}  // namespace tendril::app

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::SignalInput>() noexcept;  ///< not its rows
template <>
std::span<const tendril::Field> tendril::fields<tendril::app::SignalStage>() noexcept;  ///< not its state
