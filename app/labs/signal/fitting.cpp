
#include <algorithm>

#include "app/document/refused.hpp"
#include "app/io/json_complete.hpp"
#include "app/io/samples.hpp"
#include "app/labs/signal/analysis.hpp"
#include "app/labs/signal/signal_lab.hpp"
#include "app/labs/signal/signal_part.hpp"

namespace tendril::app {
namespace {

constexpr std::size_t share_rows = 200'000;  ///< rows processed by filters per tick

const signal::Filter* of_kind(const std::vector<signal::Filter>& filters, const signal::Kind& kind) {
    const auto found = std::ranges::find_if(
        filters, [&](const signal::Filter& filter) { return &signal::kind_of(filter) == &kind; });
    return found == filters.end() ? nullptr : &*found;
}

void start_fitting(SignalPart& part) {
    if (part.wanted.empty())
        throw Refused("there is no response to fit to yet: draw one in the plot Fit, or give one with to");
    part.fits.clear();
    part.fitting.emplace();
    for (const SignalStage& stage : part.stages) part.fitting->from.push_back(stage.filter);
    part.plot = SignalPlot::Fit;
}

}  // namespace

FitWork::Task::Task(const SignalPart& part)
    : rows(part.fit_input),
      wanted(part.wanted),
      from(part.fitting->from),
      kind(part.fits.size()),
      problem{rows, wanted},
      task(begin_fit(signal::kinds()[kind], problem, of_kind(from, signal::kinds()[kind]))) {}

bool FitWork::Task::of(const SignalPart& part) const {
    return kind == part.fits.size() && shares == part.fitting->shares && from == part.fitting->from &&
           rows == part.fit_input && wanted == part.wanted;
}

void FitWork::Task::advance() {
    const auto share = static_cast<int>(share_rows / std::max<std::size_t>(rows.size(), 1));
    const int until = task->evaluations() + share;
    while (more && task->evaluations() < until) more = task->advance();
    ++shares;
}

void FitWork::advance(SignalPart& part) {
    if (!part.fitting) return;
    if (!task_ || !task_->of(part)) {
        task_ = std::make_unique<Task>(part);
        while (task_->more && task_->shares < part.fitting->shares) task_->advance();
    }
    task_->advance();
    part.fitting->shares = task_->shares;
    if (task_->more) return;
    part.fits.push_back(task_->task->fit());
    part.fits.back().residual = std::min(part.fits.back().residual, max_residual);
    rank(part.fits);
    part.fitting->shares = 0;
    if (part.fits.size() == signal::kinds().size()) part.fitting.reset();
    task_.reset();
}

// Commands for the desired response, drawn or given as numbers or a file, and for fits to it.

namespace {

/// Draws a stroke into the desired response, which is initially the chain's output.
void draw(SignalPart& part, const Arguments& given) {
    end_recording(part);
    if (part.wanted.empty()) {
        part.fit_input = rows_to_answer(part);
        if (part.fit_input.size() < 2) throw Refused("there is no input to respond to yet");
        part.wanted = signal::run(enabled_filters(part), part.fit_input);
        for (double& value : part.wanted) value = std::clamp(value, -max_amplitude, max_amplitude);
    }
    double from = given.real("from"), to = given.real("to");
    double from_value = given.real("from_value"), to_value = given.real("to_value");
    if (from > to) std::swap(from, to), std::swap(from_value, to_value);
    const std::vector<double> times = signal::times_of(part.fit_input);
    const double half = 0.5 / 60.0;
    for (std::size_t i = 0; i < times.size(); ++i) {
        if (times[i] < from - half || times[i] > to + half) continue;
        const double share = to > from ? std::clamp((times[i] - from) / (to - from), 0.0, 1.0) : 1.0;
        part.wanted[i] = from_value + share * (to_value - from_value);
    }
    part.fits.clear();
    part.fitting.reset();
    part.plot = SignalPlot::Fit;
}

void take_numbers(SignalPart& part, const Json& list) {
    std::vector<double> wanted;
    for (const Json& each : list) wanted.push_back(json_real(each, "to." + std::to_string(wanted.size())));
    InputRows rows = rows_to_answer(part);
    if (wanted.size() < 2 || wanted.size() > rows.size()) {
        throw Refused("to must have 2 to " + std::to_string(rows.size()) +
                      " samples, no more than the input has, got " + std::to_string(wanted.size()));
    }
    rows.resize(wanted.size());
    part.fit_input = std::move(rows);
    part.wanted = std::move(wanted);
}

/// A file with its own input replaces the input; otherwise it needs one row for each row of the lab's input.
void take_file(SignalPart& part, const std::string& path) {
    const std::string text = read_text_file(path);
    InputRows rows;
    try {
        rows = parse_samples(text, path, {.time = {}, .value = "input"}).samples;
    } catch (const std::runtime_error&) {
        rows = rows_to_answer(part);
    }
    std::vector<double> wanted = parse_response(text, path, rows.size());
    if (wanted.size() < 2 || wanted.size() > max_wanted)
        throw Refused(path + " has " + std::to_string(wanted.size()) + " rows, expected 2 to " +
                      std::to_string(max_wanted));
    part.fit_input = std::move(rows);
    part.wanted = std::move(wanted);
}

void fit(SignalPart& part, const Arguments& given) {
    end_recording(part);
    if (given.has("to")) {
        const Json& to = given.json("to");
        to.is_string() ? take_file(part, to.get<std::string>()) : take_numbers(part, to);
    }
    start_fitting(part);
}

/// Finishes for callers without ticks.
void finish_fit(Workspace& workspace) {
    SignalPart& part = workspace.document.edit<SignalPart>(signal_lab);
    for (FitWork work; part.fitting;) work.advance(part);
}

void cancel(SignalPart& part, const Arguments&) {
    if (!part.fitting) throw Refused("no fit is running");
    part.fitting.reset();
}

void use_fit(SignalPart& part, const Arguments& given) {
    const auto rank = static_cast<std::size_t>(given.integer("rank"));
    if (rank >= part.fits.size()) throw Refused("there is no fit of rank " + std::to_string(rank));
    part.stages = {{part.fits[rank].filter}};
    part.selected = 0;
}

void forget(SignalPart& part, const Arguments&) {
    part.recording.reset();
    part.wanted.clear();
    part.fit_input.clear();
    part.fits.clear();
    part.fitting.reset();
}

/// Recording needs the simulation to run.
void begin(Workspace& workspace, const Arguments&) {
    change_part<SignalPart>(workspace, signal_lab,
                            [](SignalPart& part, const SignalPart&) { begin_recording(part); });
    workspace.clock.playing = true;
}

void show(SignalPart& part, const Arguments& given) {
    if (!part.recording) throw Refused("no response is being recorded: signal.fit.record starts one");
    part.recording->value = given.real("value");
    part.recording->begun = true;
}

void stop(SignalPart& part, const Arguments&) {
    if (!part.recording) throw Refused("no response is being recorded");
    end_recording(part);
}

std::string csv_of(const SignalPart& part) {
    std::string text = "time,input";
    const std::vector<double> times = signal::times_of(part.past);
    for (std::size_t i = 0; i < part.stages.size(); ++i)
        text.append(",").append(std::to_string(i)).append("_").append(signal::kind(part.stages[i].filter));
    text += '\n';
    const std::vector<std::vector<double>> outputs = outputs_for(part, part.past);
    for (std::size_t row = 0; row < part.past.size(); ++row) {
        text.append(decimal(times[row])).append(",").append(decimal(part.past[row].input));
        for (const std::vector<double>& output : outputs) text.append(",").append(decimal(output[row]));
        text += '\n';
    }
    return text;
}

void copy(Workspace& workspace, const Arguments& given) {
    const bool cpp = given.text("as") == "cpp";
    workspace.ui.copied = cpp ? SignalLab().code(workspace) : csv_of(signal_part(workspace));
    workspace.toast(cpp ? "The filters are on the clipboard as C++"
                        : "The last ten seconds are on the clipboard as CSV");
}

Argument number(const char* name, const char* help, double most) {
    return {.name = name, .help = help, .low = -most, .high = most};
}

}  // namespace

void add_fit_commands(CommandTable& table) {
    Command fitting = part_command<SignalPart>(
        signal_lab, "signal.fit", "Fit filters to a response",
        {{.name = "to",
          .type = ArgumentType::ListOrText,
          .required = false,
          .help = "the response: samples at 60 Hz, or a CSV file; default: what was drawn"}},
        "Fits every kind of filter to a response, and ranks them", fit);
    fitting.finish = finish_fit;
    table.add(std::move(fitting));
    table.add(part_command<SignalPart>(signal_lab, "signal.fit.cancel", "Stop the fit", {},
                                       "Stops a running fit; filters fitted so far are kept", cancel));
    table.add(part_command<SignalPart>(
        signal_lab, "signal.fit.draw", "Draw the desired response",
        {number("from", "seconds", 1e3), number("from_value", "the response there", max_amplitude),
         number("to", "seconds", 1e3), number("to_value", "the response there", max_amplitude)},
        "Draws a stroke of the desired response", draw));
    table.add("signal.fit.record", "Record the desired response", {},
              "Plays the input from its start, once the output ball is dragged, and records the "
              "drag as the desired response",
              Effect::Edit, begin);
    table.add(part_command<SignalPart>(signal_lab, "signal.fit.hand", "Move the recorded output",
                                       {number("value", "where the output should be now", max_amplitude)},
                                       "Moves the output while a response is being recorded", show));
    table.add(part_command<SignalPart>(signal_lab, "signal.fit.stop", "Stop recording the response", {},
                                       "Stops recording a response; what was recorded is kept", stop));
    table.add(part_command<SignalPart>(
        signal_lab, "signal.fit.use", "Use a fitted filter",
        {{.name = "rank", .type = ArgumentType::Integer, .help = "0: the best", .low = 0, .high = 1000}},
        "Replaces the chain with a fitted filter", use_fit));
    table.add(part_command<SignalPart>(signal_lab, "signal.fit.clear", "Forget the desired response", {},
                                       "Forgets the desired response", forget));
    table.add("signal.copy", "Copy filters or recent samples",
              {choice_argument("as", true, "what", {"cpp", "csv"})},
              "Puts the filters on the clipboard as C++, or the last ten seconds as CSV", Effect::Look, copy);
}

}  // namespace tendril::app
