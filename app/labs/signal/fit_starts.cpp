#include "app/labs/signal/fit_starts.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tendril::app {
namespace {

/// `count` values from `low` to `high`, each the same factor over the one before it.
std::vector<double> by_ratio(double low, double high, int count) {
    std::vector<double> values;
    for (int i = 0; i < count; ++i) values.push_back(low * std::pow(high / low, (i + 0.5) / count));
    return values;
}

/// How fast the response moves, row by row where it does, slowest first: 1/s.
std::vector<double> slopes_of(const FitProblem& problem) {
    std::vector<double> slopes;
    for (std::size_t i = 1; i < problem.samples.size(); ++i) {
        const double change = std::abs(problem.response[i] - problem.response[i - 1]);
        if (problem.samples[i].dt > 0.0 && change > 0.0) slopes.push_back(change / problem.samples[i].dt);
    }
    std::sort(slopes.begin(), slopes.end());
    return slopes;
}

/// A response that is held back moves at the largest speed most of the time. Only where it turns does it show
/// how long that takes, so many smoothing times are tried at each speed.
void add_smooth_damps(std::vector<signal::Filter>& guesses, const FitProblem& problem,
                      const FitFacts& facts) {
    const std::vector<double> slopes = slopes_of(problem);
    if (slopes.empty()) return;
    std::vector<double> speeds{1.3 * slopes.back(), 2.0 * slopes.back()};  // where it never gets so fast
    for (const double part : {0.5, 0.8, 0.95, 1.0})
        speeds.push_back(slopes[static_cast<std::size_t>(part * static_cast<double>(slopes.size() - 1))]);
    for (const double speed : speeds) {
        for (const double time : by_ratio(0.25 * facts.shortest, 2.0 * facts.duration, 40))
            guesses.push_back(signal::SmoothDamp{.smooth_time = time, .max_speed = speed});
    }
}

/// An overdamped spring decays at about pi * strength / damping, and shows little more than that: its
/// strength and damping are found together or not at all.
void add_springs(std::vector<signal::Filter>& guesses, const FitFacts& facts) {
    for (const double rate : by_ratio(0.2 / facts.duration, 1.0 / facts.shortest, 12))
        for (const double damping : {3.0, 8.0, 20.0, 50.0})
            for (const double amount : {0.0, 0.5})
                guesses.push_back(signal::Spring<>{.strength = rate * damping / std::numbers::pi,
                                                   .critical_damping = damping,
                                                   .target_velocity_amount = amount});
}

/// A switch is on from `high` on and off from `low` down: what it did at each row says where they cannot be.
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
