// What filters remember, as JSON: each state says by its name which it is, {"motion": {"value": ...}}.
#include <array>
#include <cmath>
#include <stdexcept>

#include "app/document/json_complete.hpp"
#include "app/labs/signal/filter_json.hpp"

namespace tendril::app {
namespace {

constexpr std::size_t most_entries = 1'000'000;

template <class State>
struct Field {
    const char* name;
    double State::*value;
};

// One row a number; `started` all of them have.
template <class State>
struct Form;

template <>
struct Form<signal::OutputState> {
    static constexpr const char* name = "output";
    static constexpr std::array fields{Field<signal::OutputState>{"value", &signal::OutputState::value}};
};
template <>
struct Form<signal::SpringState<>> {
    using State = signal::SpringState<>;
    static constexpr const char* name = "spring";
    static constexpr std::array fields{Field<State>{"value", &State::value},
                                       Field<State>{"velocity", &State::velocity},
                                       Field<State>{"previous_target", &State::previous_target}};
};
template <>
struct Form<signal::MotionState> {
    using State = signal::MotionState;
    static constexpr const char* name = "motion";
    static constexpr std::array fields{Field<State>{"value", &State::value},
                                       Field<State>{"velocity", &State::velocity}};
};
template <>
struct Form<signal::MovingAverageState> {
    using State = signal::MovingAverageState;
    static constexpr const char* name = "moving_average";
    static constexpr std::array fields{Field<State>{"value", &State::value},
                                       Field<State>{"new_time", &State::new_time},
                                       Field<State>{"new_area", &State::new_area}};
};
template <>
struct Form<signal::InertializeState> {
    using State = signal::InertializeState;
    static constexpr const char* name = "inertialize";
    static constexpr std::array fields{
        Field<State>{"value", &State::value}, Field<State>{"velocity", &State::velocity},
        Field<State>{"input", &State::input}, Field<State>{"offset", &State::offset},
        Field<State>{"offset_velocity", &State::offset_velocity}};
};

/// Unlike other numbers in files these may be as large as outputs get.
double read_number(const Json& json, const std::string& where) {
    const double value = json.is_number() ? json.get<double>() : std::nan("");
    if (std::abs(value) <= signal::max_output) return value;
    throw std::runtime_error(where + ": expected a number of at most 1e30 in magnitude, found " +
                             json_summary(json));
}

Json save_entries(const signal::MovingAverageState& state) {
    Json entries = Json::array();
    for (const auto& entry : state.entries)
        entries.push_back(Json::array({entry.dt, entry.input, entry.time_on, entry.area_on}));
    return entries;
}

void load_entries(signal::MovingAverageState& state, const Json& json, const std::string& where) {
    const Json& list = json_member(json, "entries", where);
    const std::string at = where + ".entries";
    if (!list.is_array() || list.size() > most_entries)
        throw std::runtime_error(at + ": expected a list, found " + json_summary(list));
    for (const Json& each : list) {
        const std::string here = at + "." + std::to_string(state.entries.size());
        if (!each.is_array() || each.size() != 4)
            throw std::runtime_error(here + ": expected four numbers, found " + json_summary(each));
        const auto number = [&](std::size_t i) {
            return read_number(each[i], here + "." + std::to_string(i));
        };
        state.entries.push_back({number(0), number(1), number(2), number(3)});
    }
    state.first = static_cast<std::size_t>(
        json_count(json_member(json, "first", where), where + ".first", state.entries.size()));
    state.split = static_cast<std::size_t>(
        json_count(json_member(json, "split", where), where + ".split", state.entries.size()));
    if (state.split < state.first) throw std::runtime_error(where + ".split: expected at least first");
}

template <class State>
Json save(const State& state) {
    Json json{{"started", state.started}};
    for (const auto& field : Form<State>::fields) json[field.name] = state.*field.value;
    if constexpr (std::is_same_v<State, signal::InertializeState>) json["jumped"] = state.jumped;
    if constexpr (std::is_same_v<State, signal::MovingAverageState>) {
        json["entries"] = save_entries(state);
        json["first"] = state.first;
        json["split"] = state.split;
    }
    return Json{{Form<State>::name, std::move(json)}};
}

template <class State>
bool load(const Json& json, const std::string& where, signal::FilterState& into) {
    if (!json.contains(Form<State>::name)) return false;
    const Json& object = json[Form<State>::name];
    const std::string at = where + "." + Form<State>::name;
    State state;
    state.started = json_bool(json_member(object, "started", at), at + ".started");
    for (const auto& field : Form<State>::fields)
        state.*field.value = read_number(json_member(object, field.name, at), at + "." + field.name);
    if constexpr (std::is_same_v<State, signal::InertializeState>)
        state.jumped = json_bool(json_member(object, "jumped", at), at + ".jumped");
    if constexpr (std::is_same_v<State, signal::MovingAverageState>) load_entries(state, object, at);
    into = std::move(state);
    return true;
}

template <class... States>
bool load_any(const Json& json, const std::string& where, std::variant<States...>& into) {
    return (load<States>(json, where, into) || ...);
}

}  // namespace

Json filter_state_json(const signal::FilterState& state) {
    return std::visit([](const auto& each) { return save(each); }, state);
}

signal::FilterState filter_state_from_json(const Json& json, const std::string& where) {
    signal::FilterState state;
    if (!json.is_object() || !load_any(json, where, state))
        throw std::runtime_error(where + ": expected the state of a filter, found " + json_summary(json));
    return state;
}

}  // namespace tendril::app
