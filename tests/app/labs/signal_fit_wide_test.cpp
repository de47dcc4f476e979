// Filters with unusual parameters are found too: very slow ones, clamps that cut off most of a line,
// thresholds that the input never crosses.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "app/labs/signal/fit.hpp"
#include "tests/app/labs/fit_support.hpp"
#include "tests/core/random.hpp"

namespace tendril::app {
namespace {

using Samples = std::vector<signal::Sample>;

double even(test::Random& random, double low, double high) {
    return low + (high - low) * (0.5 + 0.5 * static_cast<double>(random.around(1.0f)));
}
double by_ratio(test::Random& random, double low, double high) {
    return low * std::pow(high / low, even(random, 0.0, 1.0));
}

enum class Wave { Square, TwoSines, Jumps };

Samples wide_input(Wave wave, test::Random& random) {
    Samples samples;
    double level = 0.0;
    for (int i = 0; i < 300; ++i) {
        const double time = i / 60.0, turns = 2.0 * std::numbers::pi * time;
        if (wave == Wave::Square) level = (i / 48) % 2;
        if (wave == Wave::TwoSines) level = std::sin(0.7 * turns) + 0.4 * std::sin(2.3 * turns + 1.0);
        if (wave == Wave::Jumps) {
            if (i % 37 == 0) level = even(random, -1.5, 1.5);
            level += even(random, -0.02, 0.02);
        }
        samples.push_back({1.0 / 60.0, level});
    }
    return samples;
}

signal::Filter wide_filter(const signal::Kind& kind, test::Random& random) {
    signal::Filter filter = kind.blank();
    const auto set = [&](const char* name, double low, double high) {
        const double value = by_ratio(random, low, high);
        if (const Field* const field = find_field(kind.fields, name))
            field->set_number(signal::fields_in(filter), value);
    };
    set("speed", 0.3, 40.0);
    set("halflife", 0.01, 1.0);
    set("rise", 0.3, 30.0);
    set("fall", 0.3, 30.0);
    set("smooth_time", 0.02, 1.0);
    set("max_speed", 0.3, 8.0);
    set("strength", 0.3, 5.0);
    const bool semi_implicit = std::holds_alternative<signal::SpringSemiImplicit>(filter);
    set("critical_damping", 0.05, semi_implicit ? 1.5 : 40.0);
    set("target_velocity_amount", 0.1, 1.0);
    set("min_cutoff", 0.1, 10.0);
    set("beta", 0.01, 3.0);
    set("derivative_cutoff", 0.3, 5.0);
    set("window", 0.03, 1.0);
    set("width", 0.05, 0.8);
    set("threshold", 0.1, 1.0);
    if (auto* hysteresis = std::get_if<signal::Hysteresis>(&filter)) {
        hysteresis->low = even(random, -1.6, 0.4);
        hysteresis->high = hysteresis->low + even(random, 0.05, 0.8);
    }
    if (auto* scale = std::get_if<signal::ScaleBiasClamp>(&filter)) {
        const double sign = random.chance(2) ? -1.0 : 1.0;
        scale->scale = sign * by_ratio(random, 0.3, 3.0);
        scale->bias = even(random, -0.5, 0.5);
        scale->clamp = scale->interp = true;
        scale->clamp_min = even(random, -1.0, 0.0);
        scale->clamp_max = scale->clamp_min + even(random, 0.1, 1.5);
        scale->speed_increasing = by_ratio(random, 1.0, 25.0);
        scale->speed_decreasing = by_ratio(random, 1.0, 25.0);
    }
    return filter;
}

void expect_found(const signal::Filter& truth, const Samples& samples, bool parameters) {
    const std::vector<double> response = signal::run({&truth, 1}, samples);
    const FitProblem problem{samples, response};
    const signal::Kind& kind = signal::kind_of(truth);
    const Fit fit = fit_kind(kind, problem);
    EXPECT_LT(fit.residual, 1e-3) << kind.name;
    EXPECT_TRUE(signal::check(fit.filter)) << kind.name;
    if (!parameters) return;
    for (const Field& field : kind.fields)
        for (int axis = 0; axis < field.size(); ++axis) {
            if (!test::excited(truth, field, axis, problem, 1e-3)) continue;
            const double wanted = field.number(signal::fields_in(truth), axis);
            EXPECT_NEAR(field.number(signal::fields_in(fit.filter), axis), wanted, 0.02 * std::abs(wanted))
                << kind.name << " " << field.name;
        }
}

class FitOfAWideRange : public testing::TestWithParam<std::size_t> {};

TEST_P(FitOfAWideRange, FindsWhatMadeTheResponse) {
    const signal::Kind& kind = signal::kinds()[GetParam()];
    test::Random random(31);
    for (int draw = 0; draw < 4; ++draw) {
        for (const Wave wave : {Wave::Square, Wave::TwoSines, Wave::Jumps}) {
            SCOPED_TRACE(testing::Message() << "draw " << draw << ", wave " << static_cast<int>(wave));
            const Samples samples = wide_input(wave, random);
            const signal::Filter truth = wide_filter(kind, random);
            // With two levels, other lines and clamps give the same response.
            const bool line = std::holds_alternative<signal::ScaleBiasClamp>(truth);
            const bool curve = std::holds_alternative<signal::Curve>(truth);
            const bool hysteresis = std::holds_alternative<signal::Hysteresis>(truth);
            expect_found(truth, samples, !curve && !hysteresis && !(line && wave == Wave::Square));
        }
    }
}
INSTANTIATE_TEST_SUITE_P(EveryKind, FitOfAWideRange, testing::Range<std::size_t>(0, signal::kinds().size()),
                         [](const auto& each) { return std::string(signal::kinds()[each.param].name); });

TEST(FitOfExtremes, SmoothDampThatIsHeldBackMostOfTheTime) {
    test::Random random(1);
    for (const double most : {0.5, 0.56, 0.31}) {
        const signal::Filter truth = signal::SmoothDamp{.smooth_time = 0.035, .max_speed = most};
        for (const Wave wave : {Wave::Square, Wave::TwoSines})
            expect_found(truth, wide_input(wave, random), true);
    }
}

TEST(FitOfExtremes, HysteresisThatNeverSwitchesOff) {
    test::Random random(1);
    const Samples square = wide_input(Wave::Square, random);
    expect_found(signal::Hysteresis{.low = -0.05, .high = 0.6}, square, false);
    const Samples sines = wide_input(Wave::TwoSines, random);
    expect_found(signal::Hysteresis{.low = -1.5, .high = 1.2}, sines, false);
}

TEST(FitOfExtremes, ClampsThatLeaveLittleOfALine) {
    test::Random random(1);
    const Samples samples = wide_input(Wave::TwoSines, random);
    signal::ScaleBiasClamp truth;
    truth.clamp = truth.interp = true;
    const auto expect = [&](double scale, double bias, double low, double high, double up, double down) {
        truth.scale = scale, truth.bias = bias;
        truth.clamp_min = low, truth.clamp_max = high;
        truth.speed_increasing = up, truth.speed_decreasing = down;
        expect_found(truth, samples, true);
    };
    expect(1.7, 0.35, -0.9, -0.8, 0.75, 39.0);
    expect(1.68, 0.353, -0.8955, -0.7952, 0.7445, 38.9);
    expect(13.8, 12.4, -0.33, 1.944, 1.17, 5.6);
    expect(-2.0, 0.0, -0.35, 1.9, 1.2, 5.6);
}

TEST(FitOfExtremes, SpringsThatAreDampedThirtyTimesOver) {
    test::Random random(1);
    for (const Wave wave : {Wave::Square, Wave::TwoSines, Wave::Jumps}) {
        const Samples samples = wide_input(wave, random);
        expect_found(signal::Spring<>{.strength = 2.0, .critical_damping = 30.0}, samples, true);
        // A stronger one shows little more than its rate of decay.
        for (const double strength : {8.0, 20.0}) {
            const signal::Filter truth = signal::Spring<>{.strength = strength, .critical_damping = 30.0};
            expect_found(truth, samples, false);
            const std::vector<double> response = signal::run({&truth, 1}, samples);
            const Fit fit = fit_kind(signal::kind_of(truth), {samples, response});
            const auto& found = std::get<signal::Spring<>>(fit.filter);
            EXPECT_NEAR(found.strength / found.critical_damping, strength / 30.0, 0.01 * strength / 30.0);
        }
    }
}

}  // namespace
}  // namespace tendril::app
