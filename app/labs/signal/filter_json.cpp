#include "app/labs/signal/filter_json.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <string_view>

#include "app/document/json_complete.hpp"
#include "app/fields/fields.hpp"
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

Json parameters_json(const signal::Filter& filter) {
    const auto* const curve = std::get_if<signal::Curve>(&filter);
    return curve != nullptr ? save_fields(*curve) : save_fields(filter_fields(filter));
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

void set_parameters(signal::Filter& filter, const Json& given, const std::string& where) {
    signal::Filter changed = filter;
    if (auto* curve = std::get_if<signal::Curve>(&changed); curve != nullptr && given.contains("keys"))
        load_known_fields({Json{{"keys", given["keys"]}}, where}, {fields<signal::Curve>().first(1), curve});
    load_fields({given, where}, filter_fields(changed));
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
    set_parameters(filter, json, where);
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

std::vector<std::string> parameter_names(const signal::Kind& kind) {
    std::vector<std::string> names;
    if (std::holds_alternative<signal::Curve>(kind.blank())) names.emplace_back("keys");
    for (const Field& field : kind.fields) names.emplace_back(field.name);
    return names;
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

/// Up to max_output, not 1e9 as other numbers in files.
constexpr FieldRange outputs{-signal::max_output, signal::max_output};

template <class State>
struct Form;

template <>
struct Form<signal::OutputState> {
    using State = signal::OutputState;
    static constexpr const char* name = "output";
    static constexpr std::array fields{field<&State::started>("started"),
                                       field<&State::value>("value", outputs)};
};
template <>
struct Form<signal::SpringState<>> {
    using State = signal::SpringState<>;
    static constexpr const char* name = "spring";
    static constexpr std::array fields{field<&State::started>("started"),
                                       field<&State::value>("value", outputs),
                                       field<&State::velocity>("velocity", outputs),
                                       field<&State::previous_target>("previous_target", outputs)};
};
template <>
struct Form<signal::MotionState> {
    using State = signal::MotionState;
    static constexpr const char* name = "motion";
    static constexpr std::array fields{field<&State::started>("started"),
                                       field<&State::value>("value", outputs),
                                       field<&State::velocity>("velocity", outputs)};
};
template <>
struct Form<signal::MovingAverageState> {
    using State = signal::MovingAverageState;
    static constexpr const char* name = "moving_average";
    static constexpr std::array fields{
        field<&State::started>("started"), field<&State::value>("value", outputs),
        field<&State::new_time>("new_time", outputs), field<&State::new_area>("new_area", outputs)};
};
template <>
struct Form<signal::InertializeState> {
    using State = signal::InertializeState;
    static constexpr const char* name = "inertialize";
    static constexpr std::array fields{field<&State::started>("started"),
                                       field<&State::jumped>("jumped"),
                                       field<&State::value>("value", outputs),
                                       field<&State::velocity>("velocity", outputs),
                                       field<&State::input>("input", outputs),
                                       field<&State::offset>("offset", outputs),
                                       field<&State::offset_velocity>("offset_velocity", outputs)};
};

Json save_entries(const signal::MovingAverageState& state) {
    Json entries = Json::array();
    for (const auto& entry : state.entries)
        entries.push_back(Json::array({entry.dt, entry.input, entry.time_on, entry.area_on}));
    return entries;
}

void load_entries(signal::MovingAverageState& state, const JsonPlace& place) {
    place["entries"].for_each("entries", max_entries, [&](const JsonPlace& each) {
        each.check_size(4, "numbers");
        const auto number = [&](std::size_t i) { return each.element(i).real(outputs.low, outputs.high); };
        state.entries.push_back({number(0), number(1), number(2), number(3)});
    });
    state.first = place["first"].index(state.entries.size());
    state.split = place["split"].index(state.entries.size());
    if (state.split < state.first) place["split"].fail("must not be less than first");
}

template <class State>
Json save(const State& state) {
    Json json = save_fields({Form<State>::fields, &state});
    if constexpr (std::is_same_v<State, signal::MovingAverageState>) {
        json["entries"] = save_entries(state);
        json["first"] = state.first;
        json["split"] = state.split;
    }
    return Json{{Form<State>::name, std::move(json)}};
}

template <class State>
bool load(const JsonPlace& place, signal::FilterState& into) {
    if (!place.has(Form<State>::name)) return false;
    const JsonPlace own = place[Form<State>::name];
    for (const Field& field : Form<State>::fields) own[field.name];  // throws if one is missing
    State state;
    load_fields(own, {Form<State>::fields, &state});
    if constexpr (std::is_same_v<State, signal::MovingAverageState>) load_entries(state, own);
    into = std::move(state);
    return true;
}

template <class... States>
bool load_any(const JsonPlace& place, std::variant<States...>& into) {
    return (load<States>(place, into) || ...);
}

}  // namespace

Json filter_state_json(const signal::FilterState& state) {
    return std::visit([](const auto& each) { return save(each); }, state);
}

signal::FilterState filter_state_from_json(const Json& json, const std::string& where) {
    signal::FilterState state;
    if (!json.is_object() || !load_any({json, where}, state))
        throw std::runtime_error(where + ": expected the state of a filter, found " + json_summary(json));
    return state;
}

}  // namespace tendril::app
