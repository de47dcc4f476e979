#include "app/labs/signal/signal_part.hpp"

#include <algorithm>
#include <tuple>

#include "app/labs/signal/recording.hpp"

namespace tendril::app {

SignalPart first_signal() {
    SignalPart part;
    part.stages.push_back({signal::Spring<>{.strength = 2.0, .critical_damping = 0.35}});
    part.selected = 0;
    return part;
}

std::vector<signal::Filter> enabled_filters(const SignalPart& part) {
    std::vector<signal::Filter> filters;
    for (const SignalStage& stage : part.stages)
        if (stage.enabled) filters.push_back(stage.filter);
    return filters;
}

double input_of(const SignalPart& part) {
    return part.past.empty() ? input_at(part.input, part.time) : part.past.back().input;
}

double output_of(const SignalPart& part, std::size_t stage) {
    for (std::size_t i = std::min(stage + 1, part.stages.size()); i-- > 0;) {
        const SignalStage& each = part.stages[i];
        if (each.enabled && signal::started(each.state)) return signal::value(each.state);
    }
    return input_of(part);
}

double output_of(const SignalPart& part) {
    return output_of(part, part.stages.size());
}

void pass_signal_time(SignalPart& part, double dt) {
    if (part.recording && !part.recording->begun) return;
    part.time += dt;
    const double input = input_at(part.input, part.time);
    double value = input;
    for (SignalStage& stage : part.stages)
        if (stage.enabled) value = signal::step(stage.filter, stage.state, value, dt);
    if (part.past.size() >= max_past) part.past.erase(part.past.begin());
    part.past.push_back({dt, input});
    record(part);
}

/// A chain of other filters than then comes back whole.
std::shared_ptr<const Part> SignalPart::at_moment(std::shared_ptr<const Part> then) const {
    auto part = std::make_shared<SignalPart>(dynamic_cast<const SignalPart&>(*then));
    const bool same_chain =
        std::equal(stages.begin(), stages.end(), part->stages.begin(), part->stages.end(),
                   [](const SignalStage& now, const SignalStage& before) {
                       return now.filter.index() == before.filter.index() && now.enabled == before.enabled;
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
    end_recording(*part);  // nobody goes on with it at another time
    return part;
}

std::size_t SignalPart::bytes() const {
    std::size_t bytes = sizeof(*this) + stages.size() * sizeof(SignalStage) +
                        (past.size() + fit_input.size()) * sizeof(signal::Sample) +
                        wanted.size() * sizeof(double) + fits.size() * sizeof(Fit) +
                        (fitting ? fitting->from.size() * sizeof(signal::Filter) : 0);
    for (const SignalStage& stage : stages)
        if (const auto* average = std::get_if<signal::MovingAverageState>(&stage.state))
            bytes += average->entries.size() * sizeof(signal::MovingAverageState::Entry);
    return bytes;
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

}  // namespace tendril::app
