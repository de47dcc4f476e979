// Filters: added, set, moved, switched, removed.
#include <algorithm>

#include "app/document/json_complete.hpp"
#include "app/labs/signal/filter_fields.hpp"
#include "app/labs/signal/filter_json.hpp"
#include "app/labs/signal/signal_commands.hpp"

namespace tendril::app {
namespace {

std::vector<std::string> all_kind_names() {
    return names(signal::kinds(), [](const signal::Kind& kind) { return kind.name; });
}

/// Of a filter that is there, by its place.
Argument filter_argument(Argument place) {
    return offering(std::move(place), [](const Workspace& w) {
        return places(w.document.get<SignalPart>(signal_lab).stages.size());
    });
}

/// The fields of all kinds, each name once, with a range that covers every kind that has it.
std::vector<Argument> parameter_arguments() {
    std::vector<Argument> arguments;
    std::vector<std::string> owners;  // of each argument
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
                 .help = "time, value, arrive, leave and piece each"},
                kind);
        for (Argument& each : field_arguments(kind.fields, filter_texts(kind))) add(std::move(each), kind);
    }
    for (std::size_t i = 0; i < arguments.size(); ++i)
        arguments[i].help = "Of " + owners[i] + ": " + arguments[i].help;
    return arguments;
}

/// What is given for a filter must be one of its own.
void check_names(const Arguments& given, const signal::Kind& kind) {
    const std::vector<std::string> own = parameter_names(kind);
    for (const Argument& argument : parameter_arguments()) {
        if (!given.has(argument.name.c_str())) continue;
        if (std::find(own.begin(), own.end(), argument.name) != own.end()) continue;
        std::string list;
        for (const std::string& name : own) list += (list.empty() ? "" : ", ") + name;
        throw Refused(std::string(kind.name) + " has no " + argument.name + "; it has " + list);
    }
}

/// The stage that `name` says; `past_end`: one behind the last is one too.
std::size_t stage_index(const SignalPart& part, const Arguments& given, const char* name,
                        bool past_end = false) {
    const auto index = static_cast<std::size_t>(given.integer(name));
    const std::size_t count = part.stages.size() + (past_end ? 1 : 0);
    if (index < count) return index;
    if (count == 0) throw Refused("there is no filter");
    throw Refused(std::string(name) + " must be 0 to " + std::to_string(count - 1) + ", got " +
                  std::to_string(index));
}

void add(SignalPart& part, const Arguments& given) {
    const signal::Kind& kind = *signal::find_kind(given.text("kind"));
    check_names(given, kind);
    if (part.stages.size() >= max_stages)
        throw Refused("there are " + std::to_string(max_stages) + " filters, as many as there can be");
    SignalStage stage{kind.blank()};
    set_parameters(stage.filter, given.json(), "");
    const std::size_t at = given.has("at") ? stage_index(part, given, "at", true) : part.stages.size();
    part.stages.insert(part.stages.begin() + static_cast<std::ptrdiff_t>(at), std::move(stage));
    part.selected = at;
}

void set(SignalPart& part, const Arguments& given) {
    signal::Filter& filter = part.stages[stage_index(part, given, "at")].filter;
    check_names(given, signal::kind_of(filter));
    set_parameters(filter, given.json(), "");
}

void remove(SignalPart& part, const Arguments& given) {
    const std::size_t at = stage_index(part, given, "at");
    part.stages.erase(part.stages.begin() + static_cast<std::ptrdiff_t>(at));
    if (part.selected && *part.selected > at) --*part.selected;
    if (part.selected && *part.selected >= part.stages.size())
        part.selected = part.stages.empty() ? std::nullopt : std::optional(part.stages.size() - 1);
}

void move(SignalPart& part, const Arguments& given) {
    const std::size_t at = stage_index(part, given, "at"), to = stage_index(part, given, "to");
    const auto begin = part.stages.begin();
    const auto from = begin + static_cast<std::ptrdiff_t>(at), goal = begin + static_cast<std::ptrdiff_t>(to);
    if (from < goal)
        std::rotate(from, from + 1, goal + 1);
    else
        std::rotate(goal, from, from + 1);
    part.selected = to;
}

void enable(SignalPart& part, const Arguments& given) {
    SignalStage& stage = part.stages[stage_index(part, given, "at")];
    const bool on = given.has("on") ? given.boolean("on") : !stage.enabled;
    if (on == stage.enabled) return;
    stage.enabled = on;
    stage.state = {};  // what it remembers is of another time
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
    std::vector<Argument> adding{choice_argument("kind", true, "which kind", all_kind_names())};
    std::vector<Argument> setting{at};
    for (const Argument& parameter : parameter_arguments()) {
        adding.push_back(parameter);
        setting.push_back(parameter);
    }
    adding.push_back(
        index_argument("at", false, "before which filter, from 0; at the end when left out", max_stages + 1));
    table.add(part_command<SignalPart>(signal_lab, "signal.filter.add", "Add a filter", adding,
                                       "Adds a filter to the chain; parameters left out have their defaults",
                                       add));
    table.add(part_command<SignalPart>(signal_lab, "signal.filter.set", "Set a filter's parameters", setting,
                                       "Sets parameters of a filter; those left out stay", set));
    table.add(part_command<SignalPart>(signal_lab, "signal.filter.remove", "Remove a filter", {at},
                                       "Removes a filter", remove));
    table.add(part_command<SignalPart>(signal_lab, "signal.filter.move", "Move a filter in the chain",
                                       {at, index_argument("to", true, "its new place", max_stages)},
                                       "Moves a filter to another place in the chain", move));
    table.add(part_command<SignalPart>(signal_lab, "signal.filter.enable", "Switch a filter on or off",
                                       {at, switch_argument("on", "the other way round when left out")},
                                       "Switches a filter on or off; off, the input passes as it is",
                                       enable));
    table.add(part_command<SignalPart>(signal_lab, "signal.filter.remove_selected", "Delete selection", {},
                                       "Removes the filter that is selected", remove_selected));
    table.add(part_command<SignalPart>(
        signal_lab, "signal.select", "Select a filter",
        {filter_argument(index_argument("at", false, "which filter; none when left out", max_stages))},
        "Selects a filter", select, Effect::Look));
}

}  // namespace tendril::app
