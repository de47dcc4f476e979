#include "app/labs/signal/filter_json.hpp"

#include <algorithm>
#include <iterator>
#include <string_view>

#include "app/document/json_complete.hpp"
#include "app/document/text.hpp"
#include "app/fields/fields.hpp"
#include "app/fields/input_json.hpp"
#include "app/io/samples.hpp"
#include "app/labs/kit/library_json.hpp"
#include "app/labs/signal/signal_part.hpp"

namespace tendril::app {
namespace {

/// The filter alone, without what the lab has beside it.
std::span<const Field> filter_row() {
    return fields<SignalStage>().first(1);
}

/// The value that an out-of-order parameter conflicts with.
std::string other_end(const signal::Filter& filter) {
    if (const auto* scale = std::get_if<signal::ScaleBiasClamp>(&filter))
        if (scale->clamp_min > scale->clamp_max) return "; clamp_max is " + decimal(scale->clamp_max);
    if (const auto* hysteresis = std::get_if<signal::Hysteresis>(&filter))
        if (hysteresis->low > hysteresis->high) return "; high is " + decimal(hysteresis->high);
    if (const auto* curve = std::get_if<signal::Curve>(&filter))
        for (std::size_t i = 1; i < curve->keys.size(); ++i)
            if (!(curve->keys[i].time > curve->keys[i - 1].time))
                return "; that is " + decimal(curve->keys[i - 1].time);
    return {};
}

}  // namespace

Json filter_json(const signal::Filter& filter) {
    const SignalStage stage{filter};
    return save_fields({filter_row(), &stage});
}

void check_filter(const JsonPlace& place, const signal::Filter& filter) {
    if (const Result bad = signal::check(filter); !bad) place.fail(bad.message() + other_end(filter));
}

signal::Filter filter_from_json(const JsonPlace& place) {
    SignalStage stage;
    load_fields(place, {filter_row(), &stage});
    check_filter(place, stage.filter);
    return std::move(stage.filter);
}

std::vector<signal::Filter> filters_from_json(const JsonPlace& place, std::size_t most) {
    if (!place.json().is_array()) return {filter_from_json(place)};
    std::vector<signal::Filter> filters;
    place.for_each("filters", most,
                   [&](const JsonPlace& each) { filters.push_back(filter_from_json(each)); });
    return filters;
}

std::string kind_names() {
    return comma_list(signal::kind_names);
}

std::string with_line(const std::string& text, const std::string& where, const std::string& error) {
    std::string path = error.substr(0, error.find(": "));
    if (!path.starts_with(where)) return error;
    path.erase(0, std::min(path.size(), where.size() + 1));
    const int line = path.empty() ? 1 : json_line(text, path);
    return "line " + std::to_string(std::max(1, line)) + ": " + error;
}

// Filter states as JSON, under the name of their type: {"motion": {"value": ...}}.

namespace {

constexpr std::size_t max_entries = 1'000'000;

Json save_entries(const signal::MovingAverageState& state) {
    Json entries = Json::array();
    for (const auto& entry : state.entries)
        entries.push_back(Json::array({entry.dt, entry.input, entry.time_on, entry.area_on}));
    return entries;
}

void load_entries(signal::MovingAverageState& state, const JsonPlace& place) {
    place["entries"].for_each("entries", max_entries, [&](const JsonPlace& each) {
        each.check_size(4, "numbers");
        const auto number = [&](std::size_t i) {
            return each.element(i).real(-signal::max_output, signal::max_output);
        };
        state.entries.push_back({number(0), number(1), number(2), number(3)});
    });
    for (const auto& [name, at] : {std::pair("first", state.first), std::pair("split", state.split)})
        if (at > state.entries.size())
            place[name].fail("there are only " + std::to_string(state.entries.size()) + " entries");
    if (state.split < state.first) place["split"].fail("must not be less than first");
}

struct Held {
    signal::FilterState state;
};
constexpr const char* state_names[] = {"output", "spring", "motion", "moving_average", "inertialize"};
constexpr Field held = kinds<&Held::state>("state", state_names);

std::span<const Field> state_table(const Held& of) {
    return std::holds_alternative<signal::SpringState<>>(of.state) ? spring_fields<double>()
                                                                   : held.kind(&of).table();
}

}  // namespace

Json filter_state_json(const signal::FilterState& state) {
    const Held of{state};
    Json json = save_fields({state_table(of), held.address(&of, 0)});
    if (const auto* average = std::get_if<signal::MovingAverageState>(&state))
        json["entries"] = save_entries(*average);
    return Json{{state_names[state.index()], std::move(json)}};
}

signal::FilterState filter_state_from_json(const JsonPlace& place) {
    const Json& json = place.json();
    if (!json.is_object() || json.size() != 1)
        place.fail("expected the state of a filter, found " + json_summary(json));
    const auto name = std::ranges::find(state_names, json.begin().key());
    if (name == std::end(state_names)) check_members(place, {std::begin(state_names), std::end(state_names)});
    Held of;
    held.set(&of, {static_cast<double>(name - state_names)});
    const JsonPlace own = place[*name];
    auto* const average = std::get_if<signal::MovingAverageState>(&of.state);
    std::vector<std::string_view> besides;
    if (average != nullptr) besides.emplace_back("entries");
    load_known_fields(own, {state_table(of), held.address_in(&of)}, besides);
    if (average != nullptr) load_entries(*average, own);
    return of.state;
}

}  // namespace tendril::app
