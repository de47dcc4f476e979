// What filters remember, as JSON: each state says by its name which it is, {"motion": {"value": ...}}.
#include <array>
#include <stdexcept>

#include "app/document/json_complete.hpp"
#include "app/fields/fields.hpp"
#include "app/labs/signal/filter_json.hpp"

namespace tendril::app {
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
    if (state.split < state.first) place["split"].fail("expected at least first");
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
