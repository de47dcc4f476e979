#include "app/labs/signal/signal_part.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "app/document/command.hpp"
#include "tendril/elementary.hpp"

namespace tendril::app {

Lane lane_of(const SignalPart& part, std::size_t stage) {
    if (stage >= part.stages.size()) return {};
    Lane lane{stage, stage + 1};
    while (lane.first > 0 && !part.stages[lane.first].beside) --lane.first;
    while (lane.end < part.stages.size() && !part.stages[lane.end].beside) ++lane.end;
    return lane;
}

Lane shown_lane(const SignalPart& part) {
    const auto shown = lane_of(part, part.selected.value_or(0));
    const auto on = std::ranges::find(part.stages, true, &SignalStage::enabled);
    if (on == part.stages.end() || !enabled_filters(part, shown).empty()) return shown;
    return lane_of(part, static_cast<std::size_t>(on - part.stages.begin()));
}

std::optional<std::size_t> shown_stage(const SignalPart& part) {
    const Lane lane = shown_lane(part);
    for (std::size_t i = lane.end; i-- > lane.first;)
        if (part.stages[i].enabled) return i;
    return std::nullopt;
}

int unused_colour(const SignalPart& part) {
    int colour = 0;
    while (std::ranges::find(part.stages, colour, &SignalStage::colour) != part.stages.end()) ++colour;
    return colour;
}

std::vector<signal::Filter> enabled_filters(const SignalPart& part, Lane lane) {
    std::vector<signal::Filter> filters;
    for (std::size_t i = lane.first; i < lane.end; ++i)
        if (part.stages[i].enabled) filters.push_back(part.stages[i].filter);
    return filters;
}

namespace {

template <typename Output>
void step_stages(std::vector<SignalStage>& stages, const signal::Sample& row, const Output& output) {
    double value = row.input;
    for (std::size_t i = 0; i < stages.size(); ++i) {
        if (stages[i].beside) value = row.input;
        if (stages[i].enabled) value = signal::step(stages[i].filter, stages[i].state, value, row.dt);
        output(i, value);
    }
}

}  // namespace

std::vector<std::vector<double>> outputs_for(const SignalPart& part, const InputRows& rows) {
    std::vector<std::vector<double>> outputs(part.stages.size());
    std::vector<SignalStage> stages = part.stages;
    for (SignalStage& stage : stages) stage.state = {};
    for (const signal::Sample& row : rows)
        step_stages(stages, row, [&](std::size_t i, double value) { outputs[i].push_back(value); });
    return outputs;
}

double input_of(const SignalPart& part) {
    return part.past.empty() ? input_at(part.input, part.time) : part.past.back().input;
}

double output_of(const SignalPart& part, Lane lane) {
    for (std::size_t i = lane.end; i-- > lane.first;) {
        const SignalStage& each = part.stages[i];
        if (each.enabled && signal::started(each.state)) return signal::value(each.state);
    }
    return input_of(part);
}

void pass_signal_time(SignalPart& part, double dt) {
    if (part.recording && !part.recording->begun) return;
    part.time += dt;
    const signal::Sample row{dt, input_at(part.input, part.time)};
    step_stages(part.stages, row, [](std::size_t, double) {});
    if (part.past.size() >= max_past) part.past.erase(part.past.begin());
    part.past.push_back(row);
    record(part);
}

/// If the chain had other filters at that moment, restores it completely.
std::shared_ptr<const Part> SignalPart::at_moment(std::shared_ptr<const Part> then) const {
    auto part = std::make_shared<SignalPart>(dynamic_cast<const SignalPart&>(*then));
    const bool same_chain = std::equal(stages.begin(), stages.end(), part->stages.begin(), part->stages.end(),
                                       [](const SignalStage& now, const SignalStage& before) {
                                           return now.filter.index() == before.filter.index() &&
                                                  now.enabled == before.enabled &&
                                                  now.beside == before.beside;
                                       });
    if (same_chain) {
        for (std::size_t i = 0; i < stages.size(); ++i) part->stages[i].filter = stages[i].filter;
        part->selected = selected;
    }
    part->plot = plot;
    part->fit_input = fit_input;
    part->wanted = wanted;
    part->fits = fits;
    part->fitting = fitting;
    part->recording = recording;
    end_recording(*part);  // a recording cannot continue at another time
    return part;
}

std::size_t SignalPart::bytes() const {
    std::size_t all = sizeof(*this) + bytes_in(stages, past, fit_input, wanted, fits);
    if (fitting) all += bytes_in(fitting->from);
    for (const SignalStage& stage : stages)
        if (const auto* average = std::get_if<signal::MovingAverageState>(&stage.state))
            all += bytes_in(average->entries);
    return all;
}

bool SignalPart::operator==(const SignalPart& other) const {
    const auto values = [](const SignalPart& part) {
        return std::tie(part.stages, part.input, part.time, part.past, part.selected, part.plot,
                        part.fit_input, part.wanted, part.recording, part.fitting);
    };
    const auto same_fit = [](const Fit& a, const Fit& b) {
        return a.filter == b.filter && a.residual == b.residual;
    };
    return values(*this) == values(other) &&
           std::equal(fits.begin(), fits.end(), other.fits.begin(), other.fits.end(), same_fit);
}

namespace {

/// Pseudorandom in -1 to 1; the same on every machine.
double shuffled(std::int64_t number) {
    auto x = static_cast<std::uint64_t>(number) + 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return static_cast<double>((x ^ (x >> 31)) >> 11) * 0x1p-52 - 1.0;
}

/// The fraction of the period: greater than 0, at most 1.
double phase(double time, double period) {
    const double periods = time / period - 1e-9;
    return periods - std::floor(periods);
}

/// Interpolates smoothly between random values a quarter of a period apart, and adds an error of about a
/// tenth of that at 60 Hz.
double noise(double time, double period) {
    const double place = 4.0 * time / period;
    const double first = std::floor(place), u = place - first;
    const auto knot = static_cast<std::int64_t>(first);
    const double from = shuffled(2 * knot), to = shuffled(2 * knot + 2);
    const double drift = from + (to - from) * (u * u * (3.0 - 2.0 * u));
    return 0.9 * drift + 0.1 * shuffled(2 * static_cast<std::int64_t>(std::floor(60.0 * time + 1e-6)) + 1);
}

/// The input of a recording at `time`: each row holds for the dt that ends with it. Starts with the first
/// row; each repetition ends with the last.
double played(const InputRows* rows, double time) {
    const double length = length_of(rows);
    if (length <= 0.0) return 0.0;
    double left = time > 0.0 ? phase(time, length) * length : 0.0;
    for (const signal::Sample& row : *rows) {
        left -= std::max(row.dt, 0.0);
        if (left <= 1e-9) return row.input;
    }
    return rows->back().input;
}

}  // namespace

double length_of(const InputRows* rows) {
    double length = 0.0;
    if (rows != nullptr)
        for (const signal::Sample& row : *rows) length += std::max(row.dt, 0.0);
    return length;
}

double input_at(const SignalInput& input, double time) {
    switch (input.kind) {
        case InputKind::Hand:
            return input.hand;
        case InputKind::Square:
            return phase(time, input.period) < 0.5 ? input.amplitude : -input.amplitude;
        case InputKind::Sine:
            return input.amplitude * math::sine(2.0 * std::numbers::pi * phase(time, input.period));
        case InputKind::Noise:
            return input.amplitude * noise(time, input.period);
        case InputKind::Recorded:
            return played(input.recording.get(), time);
        case InputKind::Csv:
            return played(input.file.get(), time);
    }
    return 0.0;
}

InputRows measuring_rows(const SignalInput& input, double rate) {
    double seconds = 0.0;
    if (input.kind == InputKind::Recorded || input.kind == InputKind::Csv)
        seconds = length_of(input.kind == InputKind::Csv ? input.file.get() : input.recording.get());
    else if (input.kind != InputKind::Hand)
        seconds = input.period * std::max(2.0, std::ceil(4.0 / input.period));
    seconds = std::min(seconds, max_measured_seconds);
    InputRows rows;
    if (seconds <= 0.0) return rows;
    rows.push_back({signal::min_dt, input_at(input, 0.0)});
    const auto count = static_cast<std::size_t>(std::floor(seconds * rate + 1e-6));
    for (std::size_t i = 1; i <= count; ++i)
        rows.push_back({1.0 / rate, input_at(input, static_cast<double>(i) / rate)});
    return rows;
}

InputRows rows_to_answer(const SignalPart& part) {
    if (part.input.kind == InputKind::Hand) {
        const auto count = static_cast<std::ptrdiff_t>(std::min(part.past.size(), max_wanted));
        return {part.past.end() - count, part.past.end()};
    }
    InputRows rows = measuring_rows(part.input, 60.0);
    if (!rows.empty()) rows.erase(rows.begin());  // the input at 0 belongs to no tick
    if (rows.size() > max_wanted) rows.resize(max_wanted);
    return rows;
}

std::shared_ptr<const InputRows> gesture_of(const SignalPart& part) {
    InputRows rows = part.past;
    std::size_t still = 0;
    while (still + 1 < rows.size() && rows[still + 1].input == rows[still].input) ++still;
    rows.erase(rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(still));
    if (rows.size() < 2) return nullptr;
    return std::make_shared<const InputRows>(std::move(rows));
}

void begin_recording(SignalPart& part) {
    if (part.input.kind == InputKind::Hand) {
        auto gesture = gesture_of(part);
        if (!gesture) throw Refused("there is no input to respond to yet: drag the orange ball first");
        part.input.recording = std::move(gesture);
        part.input.kind = InputKind::Recorded;
    }
    part.fit_input = rows_to_answer(part);
    if (part.fit_input.size() < 2) throw Refused("there is no input to respond to yet");
    const double start = signal::run(enabled_filters(part), std::span(part.fit_input).first(1)).front();
    const double within = std::clamp(start, -max_amplitude, max_amplitude);
    part.wanted.assign(part.fit_input.size(), within);
    part.recording = Recording{.value = within};
    part.fits.clear();
    part.fitting.reset();
    part.plot = SignalPlot::Fit;
    part.time = 0.0;
    part.past.clear();
    for (SignalStage& stage : part.stages) stage.state = {};
}

void end_recording(SignalPart& part) {
    if (!part.recording) return;
    const std::size_t rows = part.recording->rows < 2 ? 0 : part.recording->rows;
    part.recording.reset();
    part.wanted.resize(rows);
    part.fit_input.resize(rows);
}

void record(SignalPart& part) {
    if (!part.recording) return;
    Recording& recording = *part.recording;
    const std::vector<double> times = signal::times_of(part.fit_input);
    while (recording.rows < times.size() && times[recording.rows] <= part.time + 1e-6)
        part.wanted[recording.rows++] = recording.value;
    // The remaining rows repeat the present value.
    std::fill(part.wanted.begin() + static_cast<std::ptrdiff_t>(recording.rows), part.wanted.end(),
              recording.value);
    if (recording.rows == times.size()) part.recording.reset();
}

}  // namespace tendril::app
