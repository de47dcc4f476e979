// What goes in, and whole scenes.
#include "app/io/samples.hpp"
#include "app/labs/signal/presets.hpp"
#include "app/labs/signal/recording.hpp"
#include "app/labs/signal/signal_commands.hpp"

namespace tendril::app {
namespace {

void clear(SignalPart& part, const Arguments&) {
    part.stages.clear();
    part.selected.reset();
}

void take(SignalPart& part, SignalPart fresh) {
    fresh.input.recording = part.input.recording;  // a gesture that was recorded is not lost
    part = std::move(fresh);
}

void preset(SignalPart& part, const Arguments& given) {
    const SignalPreset& chosen = named(
        signal_presets(), [](const SignalPreset& each) { return each.name; }, given.text("name"), "preset");
    take(part, chosen.make());
}

void reset(SignalPart& part, const Arguments&) {
    part = first_signal();
}

std::shared_ptr<const InputRows> read_rows(const std::string& path) {
    InputRows rows = read_samples(path);
    if (rows.size() > max_input_rows) {
        throw Refused(path + " has " + std::to_string(rows.size()) + " rows; the most is " +
                      std::to_string(max_input_rows));
    }
    if (length_of(&rows) <= 0.0) throw Refused(path + ": no time passes in its rows");
    return std::make_shared<const InputRows>(std::move(rows));
}

void set_input(SignalPart& part, const Arguments& given) {
    SignalInput wanted = part.input;
    if (given.has("kind")) wanted.kind = input_kinds.value(given.text("kind"));
    if (given.has("amplitude")) wanted.amplitude = given.real("amplitude");
    if (given.has("period")) wanted.period = given.real("period");
    if (given.has("path")) {
        if (wanted.kind != InputKind::Csv) throw Refused("only csv has a path");
        wanted.path = given.text("path");
        wanted.file = read_rows(wanted.path);
    }
    if (wanted.kind == InputKind::Csv && !wanted.file) throw Refused("path is missing (a CSV file)");
    if (wanted.kind == InputKind::Recorded) {
        if (part.input.kind == InputKind::Hand)
            if (auto gesture = gesture_of(part)) wanted.recording = std::move(gesture);
        if (!wanted.recording)
            throw Refused("nothing is recorded yet: drag the orange ball, then choose recorded");
    }
    if (wanted.kind == InputKind::Hand && part.input.kind != InputKind::Hand && !part.past.empty())
        wanted.hand = part.past.back().input;  // the ball stays where it is
    part.input = std::move(wanted);
    end_recording(part);
}

void move_hand(SignalPart& part, const Arguments& given) {
    end_recording(part);
    part.input.kind = InputKind::Hand;
    part.input.hand = given.real("value");
}

void choose_plot(SignalPart& part, const Arguments& given) {
    part.plot = signal_plots.value(given.text("name"));
}

}  // namespace

void add_input_commands(CommandTable& table) {
    table.add(part_command<SignalPart>(signal_lab, "signal.clear", "Remove all filters", {},
                                       "Removes every filter", clear));
    table.add(part_command<SignalPart>(signal_lab, "signal.reset", "Reset the Signal lab", {},
                                       "Resets this lab to its first state", reset));
    table.add(part_command<SignalPart>(
        signal_lab, "signal.preset", "Open a signal preset",
        {choice_argument("name", true, "which",
                         names(signal_presets(), [](const auto& each) { return each.name; }))},
        "Opens a preset", preset));
    table.add(part_command<SignalPart>(
        signal_lab, "signal.input", "Set the input",
        {choice_argument("kind", false, "what goes in", input_kinds.names()),
         number_argument("amplitude", "of square, sine and noise", -max_amplitude, max_amplitude),
         number_argument("period", "seconds, of square, sine and noise", min_input_period, max_input_period),
         text_argument("path", false, "of csv: rows of dt,input")},
        "Sets what goes into the first filter; what is left out stays", set_input));
    table.add(part_command<SignalPart>(
        signal_lab, "signal.hand", "Move the hand",
        {{.name = "value", .help = "where the hand is", .low = -max_amplitude, .high = max_amplitude}},
        "Moves the hand, which takes the input over", move_hand));
    table.add(part_command<SignalPart>(signal_lab, "signal.plot", "Choose the lower plot",
                                       {choice_argument("name", true, "which", signal_plots.names())},
                                       "Chooses the lower plot", choose_plot, Effect::Look));
}

}  // namespace tendril::app
