#include "app/labs/signal/recording.hpp"

#include <algorithm>

#include "app/document/command.hpp"

namespace tendril::app {

InputRows rows_to_answer(const SignalPart& part) {
    if (part.input.kind == InputKind::Hand) {
        const auto count = static_cast<std::ptrdiff_t>(std::min(part.past.size(), max_wanted));
        return {part.past.end() - count, part.past.end()};
    }
    InputRows rows = measuring_rows(part.input, 60.0);
    if (!rows.empty()) rows.erase(rows.begin());  // the input at 0, which no tick plays
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
        if (!gesture) throw Refused("there is no input yet to answer: drag the orange ball first");
        part.input.recording = std::move(gesture);
        part.input.kind = InputKind::Recorded;
    }
    part.fit_input = rows_to_answer(part);
    if (part.fit_input.size() < 2) throw Refused("there is no input yet to answer");
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
    // What is to come is as it is now.
    std::fill(part.wanted.begin() + static_cast<std::ptrdiff_t>(recording.rows), part.wanted.end(),
              recording.value);
    if (recording.rows == times.size()) part.recording.reset();
}

}  // namespace tendril::app
