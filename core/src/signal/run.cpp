#include "tendril/signal/run.hpp"

#include "signal/stepped.hpp"

namespace tendril::signal {

double step(std::span<const Filter> filters, std::span<FilterState> states, double input, double dt,
            Result* why) noexcept {
    if (why != nullptr) *why = {};
    for (std::size_t i = 0; i < filters.size() && i < states.size(); ++i)
        input = step(filters[i], states[i], input, dt, i == 0 ? why : nullptr);
    return input;
}

double immediate(std::span<const Filter> filters, double input) noexcept {
    for (const Filter& filter : filters) input = immediate(filter, input);
    return input;
}

std::vector<std::vector<double>> run_stages(std::span<const Filter> filters,
                                            std::span<const Sample> samples) {
    std::vector<FilterState> states(filters.size());
    std::vector<std::vector<double>> outputs(filters.size());
    for (std::vector<double>& each : outputs) each.reserve(samples.size());
    for (const Sample& sample : samples) {
        double value = sample.input;
        for (std::size_t i = 0; i < filters.size(); ++i)
            outputs[i].push_back(value = step(filters[i], states[i], value, sample.dt));
    }
    return outputs;
}

std::vector<double> run(std::span<const Filter> filters, std::span<const Sample> samples) {
    std::vector<FilterState> states(filters.size());
    std::vector<double> outputs;
    outputs.reserve(samples.size());
    for (const Sample& sample : samples) outputs.push_back(step(filters, states, sample.input, sample.dt));
    return outputs;
}

std::vector<double> times_of(std::span<const Sample> samples) {
    std::vector<double> times;
    times.reserve(samples.size());
    double time = 0.0;
    for (const Sample& sample : samples) {
        if (is_step(sample.dt)) time += detail::bounded_dt(sample.dt);
        times.push_back(time);
    }
    return times;
}

}  // namespace tendril::signal
