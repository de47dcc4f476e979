#include "app/labs/signal/fit.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <string_view>

#include "tendril/elementary.hpp"

namespace tendril::app {
namespace {

using Scale = Dimension::Scale;

struct Row {
    std::string_view kind;
    const char* field;
    double low, high;
    Scale scale;
    bool stepped = false;
};
}  // namespace

FitFacts::FitFacts(const FitProblem& problem) {
    const auto& samples = problem.samples;
    if (samples.empty() || problem.response.size() != samples.size()) return;
    const auto [low, high] = std::minmax_element(problem.response.begin(), problem.response.end());
    response_low = *low, response_high = *high;
    input_low = input_high = samples.front().input;
    duration = largest_jump = 0.0;
    std::size_t steps = 0;
    for (const signal::Sample& sample : samples)
        if (sample.dt > 0.0) duration += sample.dt, ++steps;
    const double counts = 1e-3 * duration / static_cast<double>(std::max<std::size_t>(steps, 1));
    shortest = duration;
    double squares = 0.0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        input_low = std::min(input_low, samples[i].input);
        input_high = std::max(input_high, samples[i].input);
        const double dt = samples[i].dt;
        if (!(dt > counts)) continue;
        shortest = std::min(shortest, dt);
        if (i == 0) continue;
        const double step = samples[i].input - samples[i - 1].input;
        largest_jump = std::max(largest_jump, std::abs(step));
        squares += step / dt * (step / dt);
    }
    if (duration <= 0.0) shortest = duration = 1.0 / 60.0;
    speed = std::sqrt(squares / static_cast<double>(samples.size()));
}

double FitFacts::span() const {
    return std::max({input_range(), response_range(), 1e-9});
}

double Dimension::value(double at) const {
    const double share = std::clamp(at, 0.0, 1.0);
    switch (scale) {
        case Scale::Even:
            return low + share * (high - low);
        case Scale::Ratio:
            return low * math::exponential(share * math::logarithm(high / low));
        case Scale::Cube:
            return low + share * share * share * (high - low);
        case Scale::Fifth:
            return low + share * share * share * share * share * (high - low);
    }
    return low;
}

double Dimension::at(double value) const {
    if (!(high > low)) return 0.0;
    const auto root = [&](double degree) {
        return math::exponential(math::logarithm(std::max(value - low, 0.0) / (high - low)) / degree);
    };
    double share = 0.0;
    switch (scale) {
        case Scale::Even:
            share = (value - low) / (high - low);
            break;
        case Scale::Ratio:
            share = math::logarithm(std::max(value, low) / low) / math::logarithm(high / low);
            break;
        case Scale::Cube:
            share = root(3.0);
            break;
        case Scale::Fifth:
            share = root(5.0);
            break;
    }
    return std::clamp(share, 0.0, 1.0);
}

Dimension dimension(const signal::Kind& kind, const char* field, double low, double high, Scale scale,
                    bool stepped) {
    const Field* const found = find_field(kind.table(), field);
    if (found == nullptr) throw std::logic_error(std::string(kind.name) + " has no field " + field);
    // Within the field's own range; a logarithmic scale stays clear of 0.
    const double from = std::clamp(low, found->range.low, found->range.high);
    const double to = std::clamp(high, found->range.low, found->range.high);
    const double lowest = scale == Scale::Ratio ? std::max(from, 1e-12) : from;
    return {found, lowest, std::max(to, scale == Scale::Ratio ? 2.0 * lowest : lowest), scale, stepped};
}

std::vector<Dimension> fit_space(const signal::Kind& kind, const FitFacts& facts) {
    const double per_duration = 1.0 / facts.duration, per_shortest = 1.0 / facts.shortest;
    const double span = facts.span(), range = facts.input_range();
    const double span_per_duration = span / facts.duration, span_per_shortest = span / facts.shortest;
    const double farthest = std::max({std::abs(facts.input_low), std::abs(facts.input_high), 1e-9});
    // Thresholds that the input never crosses.
    const double under_input = facts.input_low - 0.1 * range, over_input = facts.input_high + 0.1 * range;
    const double jump = std::max(facts.largest_jump, 1e-9), per_speed = 1.0 / std::max(facts.speed, 1e-9);
    const Row rows[] = {
        {"interp_to", "speed", 0.02 * per_duration, 1.2 * per_shortest, Scale::Ratio},
        {"interp_to_exact", "speed", 0.02 * per_duration, 20.0 * per_shortest, Scale::Ratio},
        {"exponential_decay", "halflife", 0.05 * facts.shortest, 5.0 * facts.duration, Scale::Ratio},
        {"rate_limit", "rise", 1e-3 * span_per_duration, 2.0 * span_per_shortest, Scale::Ratio},
        {"rate_limit", "fall", 1e-3 * span_per_duration, 2.0 * span_per_shortest, Scale::Ratio},
        {"smooth_damp", "smooth_time", 0.25 * facts.shortest, 2.0 * facts.duration, Scale::Ratio},
        {"smooth_damp", "max_speed", 1e-4 * span, 2.0 * span,
         Scale::Ratio},  // multiplied by smooth_time: see fit.cpp
        {"spring_semi_implicit", "strength", 0.05 * per_duration, 0.5 * per_shortest, Scale::Ratio},
        {"spring_semi_implicit", "critical_damping", 0.0, 4.0, Scale::Cube},
        {"spring", "strength", 0.05 * per_duration, 8.0 * per_shortest, Scale::Ratio},
        {"spring", "critical_damping", 0.0, 100.0, Scale::Fifth},
        {"spring", "target_velocity_amount", 0.0, 1.0, Scale::Even},
        {"one_euro", "min_cutoff", 0.02 * per_duration, 10.0 * per_shortest, Scale::Ratio},
        {"one_euro", "beta", 0.0, 100.0 * per_speed, Scale::Cube},
        {"one_euro", "derivative_cutoff", 0.02 * per_duration, 10.0 * per_shortest, Scale::Ratio},
        {"moving_average", "window", facts.shortest, 2.0 * facts.duration, Scale::Ratio},
        {"dead_zone", "width", 0.0, farthest, Scale::Even},
        {"hysteresis", "low", under_input, over_input, Scale::Even, true},
        {"hysteresis", "high", under_input, over_input, Scale::Even, true},
        {"inertialize", "halflife", 0.25 * facts.shortest, facts.duration, Scale::Ratio},
        {"inertialize", "threshold", 0.0, 1.01 * jump, Scale::Cube, true},
    };
    std::vector<Dimension> space;
    for (const Row& row : rows)
        if (row.kind == kind.name)
            space.push_back(dimension(kind, row.field, row.low, row.high, row.scale, row.stepped));
    return space;
}

namespace {

/// `count` values from `low` to `high` in geometric progression.
std::vector<double> by_ratio(double low, double high, int count) {
    std::vector<double> values;
    for (int i = 0; i < count; ++i)
        values.push_back(low * math::exponential((i + 0.5) / count * math::logarithm(high / low)));
    return values;
}

/// Speeds of the response in the rows where it moves, ascending: 1/s.
std::vector<double> slopes_of(const FitProblem& problem) {
    std::vector<double> slopes;
    for (std::size_t i = 1; i < problem.samples.size(); ++i) {
        const double change = std::abs(problem.response[i] - problem.response[i - 1]);
        if (problem.samples[i].dt > 0.0 && change > 0.0) slopes.push_back(change / problem.samples[i].dt);
    }
    std::sort(slopes.begin(), slopes.end());
    return slopes;
}

/// A speed-limited response moves at its maximum speed most of the time. Only its turns show the smoothing
/// time, so many smoothing times are tried at each speed.
void add_smooth_damps(std::vector<signal::Filter>& guesses, const FitProblem& problem,
                      const FitFacts& facts) {
    const std::vector<double> slopes = slopes_of(problem);
    if (slopes.empty()) return;
    std::vector<double> speeds{1.3 * slopes.back(), 2.0 * slopes.back()};  // in case it never moves that fast
    for (const double part : {0.5, 0.8, 0.95, 1.0})
        speeds.push_back(slopes[static_cast<std::size_t>(part * static_cast<double>(slopes.size() - 1))]);
    for (const double speed : speeds) {
        for (const double time : by_ratio(0.25 * facts.shortest, 2.0 * facts.duration, 40))
            guesses.push_back(signal::SmoothDamp{.smooth_time = time, .max_speed = speed});
    }
}

/// An overdamped spring decays at about pi * strength / damping and shows little else, so search strength and
/// damping together.
void add_springs(std::vector<signal::Filter>& guesses, const FitFacts& facts) {
    for (const double rate : by_ratio(0.2 / facts.duration, 1.0 / facts.shortest, 12))
        for (const double damping : {3.0, 8.0, 20.0, 50.0})
            for (const double amount : {0.0, 0.5})
                guesses.push_back(signal::Spring<>{.strength = rate * damping / std::numbers::pi,
                                                   .critical_damping = damping,
                                                   .target_velocity_amount = amount});
}

/// The switch turns on at or above `high`, and off at or below `low`: each row bounds both.
void add_hysteresis(std::vector<signal::Filter>& guesses, const FitProblem& problem, const FitFacts& facts) {
    const double margin = 0.05 * facts.input_range();
    const double middle = 0.5 * (facts.response_low + facts.response_high);
    double high_over = facts.input_low - margin, high_until = facts.input_high + margin;
    double low_from = high_over, low_under = high_until;
    bool on = false;
    for (std::size_t i = 0; i < problem.samples.size(); ++i) {
        const double input = problem.samples[i].input;
        const bool now =
            facts.response_range() > 0.0 ? problem.response[i] > middle : problem.response[i] > 0.5;
        if (!on && now) high_until = std::min(high_until, input);
        if (!on && !now) high_over = std::max(high_over, input);
        if (on && !now) low_from = std::max(low_from, input);
        if (on && now) low_under = std::min(low_under, input);
        on = now;
    }
    const double low = 0.5 * (low_from + low_under), high = 0.5 * (high_over + high_until);
    guesses.push_back(signal::Hysteresis{.low = std::min(low, high), .high = high});
}

}  // namespace

std::vector<signal::Filter> first_guesses(const signal::Kind& kind, const FitProblem& problem,
                                          const FitFacts& facts) {
    std::vector<signal::Filter> guesses;
    if (problem.samples.empty() || problem.response.size() != problem.samples.size()) return guesses;
    const signal::Filter blank = kind.blank();
    if (std::holds_alternative<signal::SmoothDamp>(blank)) add_smooth_damps(guesses, problem, facts);
    if (std::holds_alternative<signal::Spring<>>(blank)) add_springs(guesses, facts);
    if (std::holds_alternative<signal::Hysteresis>(blank)) add_hysteresis(guesses, problem, facts);
    return guesses;
}

}  // namespace tendril::app
