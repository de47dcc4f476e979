// The Signal lab's share of the document: a chain of filters, what goes into it, and what is wanted of it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <tendril/signal/filter.hpp>
#include <tendril/signal/run.hpp>
#include <vector>

#include "app/document/document.hpp"
#include "app/document/names.hpp"
#include "app/document/workspace.hpp"
#include "app/labs/signal/fit.hpp"

namespace tendril::app {

// What goes into the Signal lab's filters: a hand, a wave, a recording.

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

inline constexpr const char* signal_lab = "signal";
inline constexpr std::size_t max_stages = 16;
inline constexpr std::size_t max_past = 600;    ///< ticks of input that are remembered
inline constexpr std::size_t max_wanted = 300;  ///< rows of a response to fit to: more would take too long

/// One filter of the chain.
struct SignalStage {
    signal::Filter filter;
    bool enabled = true;  ///< off: the input passes as it is
    signal::FilterState state{};
    bool operator==(const SignalStage&) const = default;
};

/// What the lower plot shows.
enum class SignalPlot : std::uint8_t { Rates, Shelf, Fit };
inline constexpr EnumNames<SignalPlot, 3> signal_plots{
    "plot",
    {{"rates", "Frame rates", "The whole chain at several frame rates, on the same input."},
     {"shelf", "Lag against jitter",
      "Every kind of filter on this input: those of the chain as they are set."},
     {"fit", "Fit", "The response that is wanted, and the filters that come nearest to it."}}};

/// A response that a hand shows: the input plays from its start, and the output ball goes with the hand.
struct Recording {
    double value = 0.0;    ///< where the hand is
    std::size_t rows = 0;  ///< of the response that are there
    bool begun = false;    ///< the hand has the ball; no tick passes before
    bool operator==(const Recording&) const = default;
};

/// A fit that is being worked out, a share in every tick (fitting.hpp): one kind after the other, in the
/// order of signal::kinds(), of which SignalPart::fits has those that are done.
struct Fitting {
    std::vector<signal::Filter> from;  ///< the chain as it was: searches begin there too
    std::size_t shares = 0;            ///< ticks that the kind at hand has had
    bool operator==(const Fitting&) const = default;
};
inline constexpr double max_residual = 1e9;  ///< of a fit, as a file has it

struct SignalPart final : Part {
    std::vector<SignalStage> stages;
    SignalInput input;
    double time = 0.0;  ///< seconds, of the input
    InputRows past;     ///< what went in during the last ticks, oldest first
    std::optional<std::size_t> selected;
    SignalPlot plot = SignalPlot::Rates;
    /// The response that filters are fitted to, and the input that it is to come from.
    InputRows fit_input;
    std::vector<double> wanted;
    std::optional<Recording> recording;  ///< of `wanted`, which has a row for each of the input's
    std::vector<Fit> fits;               ///< the best first
    std::optional<Fitting> fitting;      ///< what is still to come of them

    std::shared_ptr<Part> clone() const override { return std::make_shared<SignalPart>(*this); }
    Json save() const override;
    std::shared_ptr<Part> load(const Json& json, const std::string& where) const override;
    /// What filters remember goes back in time, how they are set does not.
    std::shared_ptr<const Part> at_moment(std::shared_ptr<const Part> then) const override;
    std::size_t bytes() const override;
    bool operator==(const SignalPart& other) const;
};

/// What the lab starts with.
SignalPart first_signal();

/// The filters that are on, in their order.
std::vector<signal::Filter> enabled_filters(const SignalPart& part);
/// The input that went in last; before the first, the one that will.
double input_of(const SignalPart& part);
/// The last output; the last input where no filter has anything to say yet.
double output_of(const SignalPart& part);
/// The same of one stage.
double output_of(const SignalPart& part, std::size_t stage);

/// Lets `dt` seconds pass.
void pass_signal_time(SignalPart& part, double dt);

inline const SignalPart& signal_part(const Workspace& workspace) {
    return workspace.document.get<SignalPart>(signal_lab);
}

// A response that a person shows with the hand, for filters to be fitted to.

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
