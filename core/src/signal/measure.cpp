#include "tendril/signal/measure.hpp"

#include <algorithm>
#include <cmath>

namespace tendril::signal {
namespace {

constexpr double settled = 0.02;  ///< relative to the step

bool usable(const Response& response, std::size_t rows) {
    return response.time.size() >= rows && response.wanted.size() == response.time.size() &&
           response.output.size() == response.time.size();
}

double span_of(std::span<const double> values) {
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    return *high - *low;
}

/// The height of the step; negative for a step down.
double size_of(const Step& step) {
    return step.to - step.from;
}

}  // namespace

bool unstable(const Response& response) {
    constexpr double far = 10.0, diverged_spans = 1e6, grows = 1.1;
    if (!usable(response, 3)) return false;
    const auto& [time, wanted, output] = response;
    const auto [low, high] = std::minmax_element(wanted.begin(), wanted.end());
    const double span = *high - *low;
    if (!(span > 0.0)) return false;
    const double half = 0.5 * (time.back() - time.front()), begin = time.back() - half;
    double most = 0.0, before = 0.0, last = 0.0;
    for (std::size_t i = 0; i < time.size(); ++i) {
        if (!std::isfinite(output[i])) return true;
        const double outside = std::max({0.0, *low - output[i], output[i] - *high});
        most = std::max(most, outside);
        if (time[i] < begin) continue;
        double& quarter = time[i] < begin + 0.5 * half ? before : last;
        quarter = std::max(quarter, outside);
    }
    if (most > diverged_spans * span) return true;
    return last > far * span && last > grows * before;
}

std::vector<Step> steps_of(const Response& response) {
    std::vector<Step> steps;
    if (!usable(response, 4)) return steps;
    const auto& wanted = response.wanted;
    const double span = span_of(wanted);
    if (!(span > 0.0)) return steps;
    for (std::size_t i = 1; i < wanted.size(); ++i) {
        if (std::abs(wanted[i] - wanted[i - 1]) < 0.25 * span) continue;
        Step step{i, i + 1, response.output[i - 1], wanted[i]};
        while (step.end < wanted.size() && std::abs(wanted[step.end] - step.to) <= 1e-3 * span) ++step.end;
        if (step.end - step.first >= 3 && std::abs(size_of(step)) > 1e-6 * span) steps.push_back(step);
    }
    return steps;
}

std::optional<double> overshoot(const Response& response) {
    const std::vector<Step> steps = steps_of(response);
    if (steps.empty()) return std::nullopt;
    double most = 0.0;
    for (const Step& step : steps)
        for (std::size_t i = step.first; i < step.end; ++i)
            most = std::max(most, (response.output[i] - step.to) / size_of(step));
    return most;
}

std::optional<double> settling_time(const Response& response) {
    const std::vector<Step> steps = steps_of(response);
    if (steps.empty()) return std::nullopt;
    double longest = 0.0;
    for (const Step& step : steps) {
        const auto left = [&](std::size_t i) {
            return std::abs((response.output[i] - step.to) / size_of(step));
        };
        std::size_t i = step.end;  // one past the last row that is not settled
        while (i > step.first && left(i - 1) <= settled) --i;
        if (i == step.end) return std::nullopt;
        if (i == step.first) continue;
        // Linear between that row and the next.
        const double part = (left(i - 1) - settled) / (left(i - 1) - left(i));
        const double at = response.time[i - 1] + part * (response.time[i] - response.time[i - 1]);
        longest = std::max(longest, at - response.time[step.first]);
    }
    return longest;
}

std::optional<double> jitter(std::span<const double> time, std::span<const double> input,
                             std::span<const double> output) {
    if (time.size() != input.size() || time.size() != output.size()) return std::nullopt;
    double before = 0.0, after = 0.0;
    for (std::size_t i = 2; i < time.size(); ++i) {
        const double first = time[i - 1] - time[i - 2], second = time[i] - time[i - 1];
        if (!(first > 0.0 && second > 0.0)) continue;
        const auto bend = [&](std::span<const double> x) {
            return (x[i] - x[i - 1]) / second - (x[i - 1] - x[i - 2]) / first;
        };
        before += bend(input) * bend(input);
        after += bend(output) * bend(output);
    }
    if (!(before > 0.0)) return std::nullopt;
    return std::sqrt(after / before);
}

Measures measure(const Response& response, std::span<const double> input) {
    Measures measures;
    if (unstable(response)) {
        measures.following = Following::Unstable;
        return measures;
    }
    measures.lag = lag(response);
    if (measures.lag)
        measures.following = Following::Follows;
    else if (usable(response, 3) && span_of(response.wanted) > 0.0)
        measures.following = Following::DoesNotFollow;
    measures.overshoot = overshoot(response);
    measures.settling_time = settling_time(response);
    measures.jitter = jitter(response.time, input, response.output);
    return measures;
}

Measures measure(std::span<const Filter> filters, std::span<const Sample> samples) {
    const std::vector<double> time = times_of(samples), output = run(filters, samples);
    std::vector<double> input, wanted;
    for (const Sample& sample : samples) {
        const bool refused = !is_input(sample.input);
        input.push_back(!refused ? sample.input : input.empty() ? 0.0 : input.back());
        wanted.push_back(!refused ? immediate(filters, sample.input) : wanted.empty() ? 0.0 : wanted.back());
    }
    const Response response{time, wanted, output};
    Measures measures = measure(response, input);
    measures.rate_difference = compare_rates(filters, samples).difference;
    return measures;
}

}  // namespace tendril::signal
