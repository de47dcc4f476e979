#include "app/labs/signal/filter_json.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <string_view>

#include "app/document/json_complete.hpp"
#include "app/fields/fields.hpp"
#include "app/fields/input_json.hpp"
#include "app/io/samples.hpp"
#include "app/labs/signal/filter_fields.hpp"

namespace tendril::app {
namespace {

[[noreturn]] void fail(const std::string& where, const std::string& what) {
    throw std::runtime_error(where.empty() ? what : where + ": " + what);
}

std::string place(const std::string& where, std::string_view key) {
    return where.empty() ? std::string(key) : where + "." + std::string(key);
}

}  // namespace

namespace {

/// Includes a curve's keys.
FieldsIn file_fields(signal::Filter& filter) {
    if (auto* const curve = std::get_if<signal::Curve>(&filter)) return *curve;
    return filter_fields(filter);
}

}  // namespace

Json parameters_json(const signal::Filter& filter) {
    if (const auto* curve = std::get_if<signal::Curve>(&filter)) return save_fields(*curve);
    return save_fields(filter_fields(filter));
}

Json filter_json(const signal::Filter& filter) {
    Json json{{"kind", signal::kind(filter)}};
    json.update(parameters_json(filter));
    return json;
}

namespace {

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

void set_parameters(signal::Filter& filter, const Json& given, const std::string& where,
                    const std::vector<std::string_view>& others) {
    signal::Filter changed = filter;
    load_known_fields({given, where}, file_fields(changed), others, MissingField::Kept);
    if (const auto* curve = std::get_if<signal::Curve>(&changed); curve != nullptr && curve->keys.empty())
        fail(place(where, "keys"), "expected at least one key, found none");
    if (const Result result = signal::check(changed); !result)
        fail(where, result.message() + other_end(changed));
    filter = std::move(changed);
}

signal::Filter filter_from_json(const Json& json, const std::string& where) {
    if (!json.is_object())
        fail(where, "expected a filter, an object with its kind, found " + json_summary(json));
    const std::string at = place(where, "kind");
    const std::string name = json_text(json_member(json, "kind", where), at);
    const signal::Kind* kind = signal::find_kind(name);
    if (kind == nullptr)
        fail(at, "expected one of " + kind_names() + ", found " + json_summary(json["kind"]));
    signal::Filter filter = kind->blank();
    std::vector<std::string_view> any;
    for (const auto& [member, value] : json.items()) any.push_back(member);
    set_parameters(filter, json, where, any);
    return filter;
}

std::vector<signal::Filter> filters_from_json(const Json& json, const std::string& where, std::size_t most) {
    if (!json.is_array()) return {filter_from_json(json, where)};
    if (json.size() > most) {
        fail(where,
             "has " + std::to_string(json.size()) + " filters; the maximum is " + std::to_string(most));
    }
    std::vector<signal::Filter> filters;
    for (const Json& each : json)
        filters.push_back(filter_from_json(each, place(where, std::to_string(filters.size()))));
    return filters;
}

std::string kind_names() {
    std::string names;
    for (const signal::Kind& kind : signal::kinds())
        names += (names.empty() ? "" : ", ") + std::string(kind.name);
    return names;
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

/// A spring may reach max_output, which the library's own table does not allow.
std::span<const Field> state_table(const Held& of) {
    using Spring = signal::SpringState<>;
    constexpr FieldRange outputs{-signal::max_output, signal::max_output};
    static constexpr Field spring[] = {field<&Spring::started>("started").needed(),
                                       field<&Spring::value>("value", outputs).needed(),
                                       field<&Spring::velocity>("velocity", outputs).needed(),
                                       field<&Spring::previous_target>("previous_target", outputs).needed()};
    return std::holds_alternative<Spring>(of.state) ? spring : held.kind(&of).table();
}

}  // namespace

Json filter_state_json(const signal::FilterState& state) {
    const Held of{state};
    Json json = save_fields({state_table(of), held.address(&of, 0)});
    if (const auto* average = std::get_if<signal::MovingAverageState>(&state))
        json["entries"] = save_entries(*average);
    return Json{{state_names[state.index()], std::move(json)}};
}

signal::FilterState filter_state_from_json(const Json& json, const std::string& where) {
    const JsonPlace place(json, where);
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
