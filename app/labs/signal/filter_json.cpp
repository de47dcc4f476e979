#include "app/labs/signal/filter_json.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <string_view>

#include "app/fields/fields.hpp"
#include "app/fields/input_json.hpp"
#include "app/io/json_complete.hpp"
#include "app/io/samples.hpp"
#include "app/io/text.hpp"
#include "app/labs/kit/library_json.hpp"
#include "app/labs/signal/signal_part.hpp"

namespace tendril::app {
namespace {

/// Only the filter, without the lab's own members.
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

constexpr FieldText text(const char* name, const char* label, const char* help) {
    return {.name = name, .label = label, .help = help, .decimals = 3};
}
constexpr FieldText rare(const char* name, const char* label, const char* help) {
    return {.name = name, .label = label, .help = help, .decimals = 3, .more = true};
}

constexpr FieldText interp_to[]{
    text("speed", "speed",
         "How fast the output follows: a frame covers this times its seconds of the distance left, so the "
         "result depends on the frame rate. At 0 or less the output jumps to the input.")};
constexpr FieldText interp_to_exact[]{
    text("speed", "speed",
         "How fast the distance to the input shrinks: higher follows faster, the same at any frame rate. At "
         "0 or less the output jumps to the input.")};
constexpr FieldText scale_bias_clamp[]{
    text("map_range", "map range", "First step: maps the in range to the out range, beyond its ends too."),
    text("in_range", "in range", "The range that is mapped. Only with map range."),
    text("out_range", "out range", "The range that it is mapped to. Only with map range."),
    text("scale", "scale", "Second step: the value is multiplied by this, then the bias is added."),
    text("bias", "bias", "Second step: added after the value is multiplied by scale."),
    text("clamp", "clamp", "Third step: keeps the value between clamp min and clamp max."),
    text("clamp_min", "clamp min", "The minimum of the value. Only with clamp; not above clamp max."),
    text("clamp_max", "clamp max", "The maximum of the value. Only with clamp; not below clamp min."),
    text("interp", "interp", "Last step: eases towards the value, as the filter Interp to does."),
    text("speed_increasing", "speed increasing",
         "How fast it eases while the value rises. Only with interp."),
    text("speed_decreasing", "speed decreasing",
         "How fast it eases while the value falls. Only with interp.")};
constexpr FieldText critical_damping = text("critical_damping", "damping",
                                            "How soon swinging stops: 0 swings for ever, 1 is the fastest "
                                            "that does not overshoot, more is sluggish.");
constexpr FieldText spring[]{
    text("strength", "strength",
         "How many times a second the spring would swing without damping. Higher follows faster. At 0 there "
         "is no spring."),
    critical_damping,
    rare("force", "force", "A constant acceleration of the output: shifts where it comes to rest."),
    rare("target_velocity_amount", "target velocity",
         "How much of the input's velocity the spring takes into account: at 1 it follows steady motion "
         "without lag, and jumps overshoot.")};
constexpr FieldText exponential_decay[]{text(
    "halflife", "halflife",
    "How long it takes until half of the distance to the input is left. More is smoother and lags more.")};
constexpr FieldText rate_limit[]{text("rise", "rise", "How fast the output may rise."),
                                 text("fall", "fall", "How fast the output may fall.")};
constexpr FieldText smooth_damp[]{
    text("smooth_time", "smooth time",
         "How smooth the output is: about the time by which it lags. More is smoother."),
    text("max_speed", "max speed",
         "Limits how fast the output moves: the distance to the input counts only up to this times smooth "
         "time.")};
constexpr FieldText spring_semi_implicit[]{
    text("strength", "strength",
         "How many times a second the spring would swing without damping. Higher follows faster; too high "
         "for the frame rate and the output swings ever wider."),
    critical_damping};
constexpr FieldText one_euro[]{
    text("min_cutoff", "min cutoff",
         "The cutoff of the low pass while the input rests. Lower it until a still hand no longer trembles."),
    text("beta", "beta",
         "By how much the cutoff rises with the input's speed. Raise it until fast motion no longer lags."),
    rare("derivative_cutoff", "derivative cutoff",
         "The cutoff of the low pass on the speed itself. Lower it where noise is taken for speed."),
    {.name = "reset_jump",
     .label = "reset jump",
     .help = "Restarts the filter at the input if the two are farther apart than this, as when a tracked "
             "hand is lost and found. 0: never.",
     .decimals = 3,
     .at_zero = "never",
     .more = true}};
constexpr FieldText moving_average[]{
    text("window", "window",
         "The output is the mean of the input over this time. More is smoother and lags more.")};
constexpr FieldText dead_zone[]{
    text("width", "width", "Inputs within this of 0 give 0; others are moved towards 0 by it.")};
constexpr FieldText hysteresis[]{
    text("low", "low", "At this input and below, the output becomes 0. Not above high."),
    text("high", "high",
         "At this input and above, the output becomes 1. Between the two it does not change.")};
constexpr FieldText inertialize[]{
    text("halflife", "halflife", "How long it takes until half of a jump is left."),
    text("threshold", "threshold",
         "A change of the input by more than this in one step counts as a jump, which is smoothed; all else "
         "passes.")};
constexpr FieldText curve[]{
    text("source_min", "source min", "The input that is at the left end of the curve."),
    text("source_max", "source max", "The input that is at the right end of the curve."),
    text("target_min", "target min", "The output where the curve is at 0."),
    text("target_max", "target max", "The output where the curve is at 1.")};

/// In the order of signal::Filter's alternatives.
constexpr std::array<std::span<const FieldText>, std::variant_size_v<signal::Filter>> all{
    interp_to,  interp_to_exact, scale_bias_clamp,     spring,   exponential_decay,
    rate_limit, smooth_damp,     spring_semi_implicit, one_euro, moving_average,
    dead_zone,  hysteresis,      inertialize,          curve};

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

std::span<const FieldText> filter_texts(const signal::Kind& kind) {
    return all[static_cast<std::size_t>(&kind - signal::kinds().data())];
}

}  // namespace tendril::app
