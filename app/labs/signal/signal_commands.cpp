#include "app/labs/signal/signal_lab.hpp"

#include <algorithm>

#include "app/io/json_complete.hpp"
#include "app/io/samples.hpp"
#include "app/labs/signal/filter_json.hpp"
#include "app/labs/signal/signal_part.hpp"

namespace tendril::app {

// Filters: adding, setting, moving, switching and removing them.

namespace {

/// Offers the indices of the present filters.
Argument filter_argument(Argument place) {
    return offering(std::move(place), [](const Workspace& w) {
        return places(w.document.get<SignalPart>(signal_lab).stages.size());
    });
}

/// The fields of all kinds, each name once, with a range that covers every kind with that field.
std::vector<Argument> parameter_arguments() {
    std::vector<Argument> arguments;
    std::vector<std::string> owners;  // the kinds with each argument
    const auto add = [&](Argument argument, const signal::Kind& kind) {
        const auto known = std::ranges::find(arguments, argument.name, &Argument::name);
        if (known == arguments.end()) {
            arguments.push_back(std::move(argument));
            owners.emplace_back(kind.name);
            return;
        }
        known->low = std::min(known->low, argument.low);
        known->high = std::max(known->high, argument.high);
        owners[static_cast<std::size_t>(known - arguments.begin())] += std::string(", ") + kind.name;
    };
    for (const signal::Kind& kind : signal::kinds()) {
        if (std::holds_alternative<signal::Curve>(kind.blank()))
            add({.name = "keys",
                 .type = ArgumentType::List,
                 .required = false,
                 .help = "each with time, value, arrive, leave and piece"},
                kind);
        for (Argument& each : field_arguments(kind.table(), filter_texts(kind))) add(std::move(each), kind);
    }
    for (std::size_t i = 0; i < arguments.size(); ++i)
        arguments[i].help = "Of " + owners[i] + ": " + arguments[i].help;
    return arguments;
}

/// The stage that argument `name` selects; `past_end` also allows one past the last.
std::size_t stage_index(const SignalPart& part, const Arguments& given, const char* name,
                        bool past_end = false) {
    const auto index = static_cast<std::size_t>(given.integer(name));
    const std::size_t count = part.stages.size() + (past_end ? 1 : 0);
    if (index < count) return index;
    if (count == 0) throw Refused("there is no filter");
    throw Refused(std::string(name) + " must be 0 to " + std::to_string(count - 1) + ", got " +
                  std::to_string(index));
}

/// Parameters that are not given keep their values.
void set_parameters(signal::Filter& filter, const Arguments& given) {
    const JsonPlace place(given.json(), "");
    load_known_fields(place, {signal::kind_of(filter).table(), signal::fields_in(filter)},
                      {"kind", "at", "beside"}, MissingField::Kept);
    check_filter(place, filter);
}

void add(SignalPart& part, const Arguments& given) {
    if (part.stages.size() >= max_stages)
        throw Refused("there are " + std::to_string(max_stages) + " filters, which is the maximum");
    SignalStage stage{signal::find_kind(given.text("kind"))->blank()};
    stage.beside = given.has("beside") && given.boolean("beside");
    stage.colour = unused_colour(part);
    set_parameters(stage.filter, given);
    const std::size_t at = given.has("at") ? stage_index(part, given, "at", true) : part.stages.size();
    part.stages.insert(part.stages.begin() + static_cast<std::ptrdiff_t>(at), std::move(stage));
    part.selected = at;
}

void set(SignalPart& part, const Arguments& given) {
    set_parameters(part.stages[stage_index(part, given, "at")].filter, given);
}

void remove(SignalPart& part, const Arguments& given) {
    const std::size_t at = stage_index(part, given, "at");
    if (at + 1 < part.stages.size() && part.stages[at].beside) part.stages[at + 1].beside = true;
    part.stages.erase(part.stages.begin() + static_cast<std::ptrdiff_t>(at));
    if (part.selected && *part.selected > at) --*part.selected;
    if (part.selected && *part.selected >= part.stages.size())
        part.selected = part.stages.empty() ? std::nullopt : std::optional(part.stages.size() - 1);
}

void move(SignalPart& part, const Arguments& given) {
    const std::size_t at = stage_index(part, given, "at"), to = stage_index(part, given, "to");
    const std::vector<SignalStage> before = part.stages;
    const auto begin = part.stages.begin();
    const auto from = begin + static_cast<std::ptrdiff_t>(at), goal = begin + static_cast<std::ptrdiff_t>(to);
    if (from < goal)
        std::rotate(from, from + 1, goal + 1);
    else
        std::rotate(goal, from, from + 1);
    for (std::size_t i = 0; i < before.size(); ++i) part.stages[i].beside = before[i].beside;
    part.selected = to;
}

template <bool SignalStage::*which>
void turn(SignalPart& part, const Arguments& given) {
    SignalStage& stage = part.stages[stage_index(part, given, "at")];
    const bool on = given.has("on") ? given.boolean("on") : !(stage.*which);
    if (on == stage.*which) return;
    stage.*which = on;
    stage.state = {};  // its memory is out of date
}

void select(SignalPart& part, const Arguments& given) {
    part.selected = given.has("at") ? std::optional(stage_index(part, given, "at")) : std::nullopt;
}

void remove_selected(SignalPart& part, const Arguments&) {
    if (!part.selected) throw Refused("no filter is selected");
    const Json at{{"at", *part.selected}};
    remove(part, Arguments(at));
}

}  // namespace

void add_filter_commands(CommandTable& table) {
    const Argument at = filter_argument(index_argument("at", true, "which filter, from 0", max_stages));
    std::vector<Argument> adding{
        choice_argument("kind", true, "which kind", {signal::kind_names.begin(), signal::kind_names.end()})};
    std::vector<Argument> setting{at};
    for (const Argument& parameter : parameter_arguments()) {
        adding.push_back(parameter);
        setting.push_back(parameter);
    }
    adding.push_back(
        index_argument("at", false, "position in the chain, from 0; at the end if omitted", max_stages + 1));
    adding.push_back(switch_argument("beside", "works on the input; if omitted, on the filter above"));
    table.add(part_command<SignalPart>(signal_lab, "signal.filter.add", "Add a filter", adding,
                                       "Adds a filter to the chain; omitted parameters have their defaults",
                                       add));
    table.add(part_command<SignalPart>(signal_lab, "signal.filter.set", "Set a filter's parameters", setting,
                                       "Sets parameters of a filter; omitted ones are kept", set));
    table.add(part_command<SignalPart>(signal_lab, "signal.filter.remove", "Remove a filter", {at},
                                       "Removes a filter", remove));
    table.add(part_command<SignalPart>(signal_lab, "signal.filter.move", "Move a filter in the chain",
                                       {at, index_argument("to", true, "its new position", max_stages)},
                                       "Moves a filter to another position in the chain", move));
    table.add(part_command<SignalPart>(signal_lab, "signal.filter.enable", "Switch a filter on or off",
                                       {at, switch_argument("on", "toggles if omitted")},
                                       "Switches a filter on or off; when off, the input passes unchanged",
                                       turn<&SignalStage::enabled>));
    table.add(part_command<SignalPart>(signal_lab, "signal.filter.beside", "Put a filter beside or after",
                                       {at, switch_argument("on", "toggles if omitted")},
                                       "Lets a filter work on the input, beside those above it, or on the "
                                       "output of the one above",
                                       turn<&SignalStage::beside>));
    table.add(part_command<SignalPart>(signal_lab, "signal.filter.remove_selected", "Delete selection", {},
                                       "Removes the selected filter", remove_selected));
    table.add(part_command<SignalPart>(
        signal_lab, "signal.select", "Select a filter",
        {filter_argument(index_argument("at", false, "which filter; none if omitted", max_stages))},
        "Selects a filter", select, Effect::Look));
}

// Input, presets and the lower plot.

namespace {

void preset(SignalPart& part, const Arguments& given) {
    auto fresh = named(signal_presets(), std::mem_fn(&SignalPreset::name), given.text("name"), "preset").part;
    fresh.input.recording = part.input.recording;  // keeps the user's recorded gesture
    part = std::move(fresh);
}

std::shared_ptr<const InputRows> read_rows(const std::string& path, const ColumnChoice& choice) {
    InputRows rows = read_samples(path, choice).samples;
    if (rows.size() > max_input_rows) {
        throw Refused(path + " has " + std::to_string(rows.size()) + " rows; the maximum is " +
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
        if (wanted.kind != InputKind::Csv) throw Refused("path is only for csv");
        wanted.path = given.text("path");
        wanted.file = read_rows(wanted.path, {text_or_none(given, "time"), text_or_none(given, "value")});
    } else if (given.has("time") || given.has("value")) {
        throw Refused("time and value are columns of the file in path");
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

}  // namespace

void add_input_commands(CommandTable& table) {
    table.add(part_command<SignalPart>(signal_lab, "signal.clear", "Remove all filters", {},
                                       "Removes every filter", [](SignalPart& part, const Arguments&) {
                                           part.stages.clear();
                                           part.selected.reset();
                                       }));
    table.add(part_command<SignalPart>(
        signal_lab, "signal.reset", "Reset the Signal lab", {}, "Resets this lab to its first state",
        [](SignalPart& part, const Arguments&) { part = signal_presets().front().part; }));
    table.add(part_command<SignalPart>(
        signal_lab, "signal.preset", "Open a signal preset",
        {choice_argument("name", true, "which",
                         names(signal_presets(), [](const auto& each) { return each.name; }))},
        "Opens a preset", preset));
    table.add(part_command<SignalPart>(
        signal_lab, "signal.input", "Set the input",
        {choice_argument("kind", false, "the kind of input", input_kinds.names()),
         number_argument("amplitude", "of square, sine and noise", -max_amplitude, max_amplitude),
         number_argument("period", "seconds, of square, sine and noise", min_input_period, max_input_period),
         text_argument("path", false, "of csv: a file with a time and a value in each row"),
         text_argument("time", false, "of csv: its column, by name or number; found by its name if omitted"),
         text_argument("value", false, "of csv: its column, in the same way")},
        "Sets the input of the first filter; omitted settings are kept", set_input));
    table.add(part_command<SignalPart>(
        signal_lab, "signal.hand", "Move the hand",
        {{.name = "value", .help = "where the hand is", .low = -max_amplitude, .high = max_amplitude}},
        "Moves the hand, which becomes the input", move_hand));
    table.add(part_command<SignalPart>(
        signal_lab, "signal.plot", "Choose the lower plot",
        {choice_argument("name", true, "which", signal_plots.names())}, "Chooses the lower plot",
        [](SignalPart& part, const Arguments& given) { part.plot = signal_plots.value(given.text("name")); },
        Effect::Look));
}

}  // namespace tendril::app
