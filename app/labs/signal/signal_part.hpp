// The Signal lab's share of the document: a chain of filters, what goes into it, and what is wanted of it.
#pragma once

#include <memory>
#include <optional>
#include <tendril/signal/filter.hpp>
#include <vector>

#include "app/document/document.hpp"
#include "app/document/workspace.hpp"
#include "app/labs/signal/fit.hpp"
#include "app/labs/signal/signal_input.hpp"

namespace tendril::app {

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

}  // namespace tendril::app
