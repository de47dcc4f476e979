// Fitting filters to responses: responses of each kind of filter are matched, with the original parameters.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "app/labs/signal/fit.hpp"
#include "app/labs/signal/fit_space.hpp"
#include "app/labs/signal/signal_part.hpp"
#include "tests/app/labs/fit_support.hpp"
#include "tests/core/random.hpp"

namespace tendril::app {
namespace {

using Samples = std::vector<signal::Sample>;

double between(test::Random& random, double low, double high) {
    return low + (high - low) * (0.5 + 0.5 * static_cast<double>(random.around(1.0f)));
}

/// Jumps of several heights, constant parts, ramps, a sweep and some noise: every kind of filter has an
/// effect. Uneven frames if `uneven`.
Samples rich_input(std::size_t rows, unsigned seed, bool uneven) {
    test::Random random(seed);
    Samples samples;
    double level = 0.0, time = 0.0;
    for (std::size_t i = 0; i < rows; ++i) {
        const double dt = (uneven && i % 3 == 0   ? 1.0 / 30.0
                           : uneven && i % 3 == 1 ? 1.0 / 144.0
                                                  : 1.0 / 60.0);
        time += dt;
        if (i % 24 == 12) level = between(random, -1.0, 1.0);
        const double share = static_cast<double>(i) / static_cast<double>(rows);
        const double sweep = std::sin(time * (2.0 + 8.0 * share));
        const double noise = between(random, -0.02, 0.02);
        samples.push_back({dt, share < 0.4   ? level
                               : share < 0.8 ? sweep
                                             : 0.5 * level + 0.5 * sweep + noise});
    }
    return samples;
}

/// A filter of a kind, with typical parameters.
signal::Filter some_filter(const signal::Kind& kind, test::Random& random) {
    const auto pick = [&](double low, double high) { return between(random, low, high); };
    signal::Filter filter = kind.blank();
    const auto set = [&](const char* name, double low, double high) {
        if (const Field* const field = find_field(kind.fields, name))
            field->set_number(signal::fields_in(filter), pick(low, high));
    };
    set("speed", 2.0, 20.0);
    set("halflife", 0.05, 0.3);
    set("rise", 1.0, 6.0);
    set("fall", 1.0, 6.0);
    set("smooth_time", 0.08, 0.5);
    set("max_speed", 3.0, 6.0);
    set("strength", 0.8, 2.5);
    set("critical_damping", 0.2, 1.5);
    set("force", -5.0, 5.0);
    set("target_velocity_amount", 0.2, 0.9);
    set("min_cutoff", 0.6, 3.0);
    set("beta", 0.05, 0.5);
    set("derivative_cutoff", 0.8, 3.0);
    set("window", 0.08, 0.4);
    set("width", 0.1, 0.5);
    set("threshold", 0.3, 0.7);
    if (auto* hysteresis = std::get_if<signal::Hysteresis>(&filter)) {
        hysteresis->low = pick(-0.6, -0.1);
        hysteresis->high = pick(0.1, 0.6);
    }
    if (auto* scale = std::get_if<signal::ScaleBiasClamp>(&filter)) {
        scale->scale = pick(0.8, 2.5);
        scale->bias = pick(-0.5, 0.5);
        scale->clamp = scale->interp = true;
        scale->clamp_min = pick(-1.0, -0.7);
        scale->clamp_max = pick(0.7, 1.0);
        scale->speed_increasing = pick(3.0, 15.0);
        scale->speed_decreasing = pick(3.0, 15.0);
    }
    if (auto* curve = std::get_if<signal::Curve>(&filter)) {
        const double middle = pick(0.3, 0.7);
        const double low = pick(-1.0, 0.0), high = pick(0.5, 1.5), last = pick(-0.5, 0.5);
        curve->keys = {
            {.time = 0.0, .value = low, .leave = 1.0, .piece = signal::Piece::Cubic},
            {.time = middle, .value = high, .arrive = 2.0, .leave = -1.0, .piece = signal::Piece::Cubic},
            {.time = 1.0, .value = last, .arrive = 0.5}};
        curve->source_min = -1.2;
        curve->source_max = 1.2;
    }
    return filter;
}

struct Case {
    std::size_t kind;
    bool uneven;
};

class FitOfAKind : public testing::TestWithParam<Case> {};

TEST_P(FitOfAKind, MeetsTheResponseByTheParametersThatMadeIt) {
    const signal::Kind& kind = signal::kinds()[GetParam().kind];
    test::Random random(5);
    for (unsigned draw = 0; draw < 3; ++draw) {
        const Samples samples = rich_input(400, draw + 1, GetParam().uneven);
        const signal::Filter truth = some_filter(kind, random);
        const std::vector<double> response = signal::run({&truth, 1}, samples);
        const FitProblem problem{samples, response};
        const Fit fit = fit_kind(kind, problem);
        EXPECT_LT(fit.residual, 1e-3) << kind.name << ", draw " << draw;
        EXPECT_NEAR(residual_of(fit.filter, problem), fit.residual, 1e-12);
        EXPECT_TRUE(signal::check(fit.filter));
        EXPECT_EQ(fit_kind(kind, problem).filter, fit.filter) << "the same at every run";
        // For a curve only its values count: different ranges and keys can give the same curve.
        if (std::holds_alternative<signal::Curve>(truth)) continue;
        int compared = 0;
        for (const Field& field : kind.fields)
            for (int axis = 0; axis < field.size(); ++axis) {
                if (!test::excited(truth, field, axis, problem, 1e-4)) continue;
                const double wanted = field.number(signal::fields_in(truth), axis);
                EXPECT_NEAR(field.number(signal::fields_in(fit.filter), axis), wanted,
                            0.02 * std::abs(wanted))
                    << kind.name << " " << field.name << ", draw " << draw;
                ++compared;
            }
        // Between two rows a switch's thresholds are arbitrary: they have a test of their own.
        if (!std::holds_alternative<signal::Hysteresis>(truth)) {
            EXPECT_GT(compared, 0) << kind.name << ": this input says nothing of it";
        }
    }
}

std::vector<Case> cases() {
    std::vector<Case> all;
    for (std::size_t i = 0; i < signal::kinds().size(); ++i)
        for (const bool uneven : {false, true}) all.push_back({i, uneven});
    return all;
}
INSTANTIATE_TEST_SUITE_P(EveryKind, FitOfAKind, testing::ValuesIn(cases()), [](const auto& each) {
    return std::string(signal::kinds()[each.param.kind].name) + (each.param.uneven ? "_uneven" : "");
});

class FitRanking : public testing::TestWithParam<std::size_t> {};

TEST_P(FitRanking, PutsTheTrueKindFirstOrWithinNoiseOfIt) {
    const signal::Kind& kind = signal::kinds()[GetParam()];
    test::Random random(9);
    const Samples samples = rich_input(160, 4, true);
    const signal::Filter truth = some_filter(kind, random);
    const std::vector<double> response = signal::run({&truth, 1}, samples);
    const FitProblem problem{samples, response};
    std::vector<Fit> fits;
    for (const signal::Kind& each : signal::kinds()) fits.push_back(fit_kind(each, problem));
    rank(fits);
    ASSERT_EQ(fits.size(), signal::kinds().size());
    for (const Fit& fit : fits) {
        EXPECT_TRUE(std::isfinite(fit.residual));
        if (&signal::kind_of(fit.filter) == &kind) {
            EXPECT_LE(fit.residual, std::max(fits.front().residual, indistinguishable)) << kind.name;
        }
    }
    EXPECT_TRUE(std::is_sorted(fits.begin(), fits.end(), [](const Fit& a, const Fit& b) {
        return std::max(a.residual, indistinguishable) < std::max(b.residual, indistinguishable);
    }));
}
INSTANTIATE_TEST_SUITE_P(EveryKind, FitRanking, testing::Range<std::size_t>(0, signal::kinds().size()),
                         [](const auto& each) { return std::string(signal::kinds()[each.param].name); });

TEST(Fit, FindsThresholdsWhereTheInputPassesThemSlowly) {
    Samples samples;
    for (int i = 0; i < 1500; ++i) samples.push_back({1.0 / 60.0, std::sin(0.01 * i)});
    const signal::Filter truth = signal::Hysteresis{.low = -0.31, .high = 0.47};
    const std::vector<double> response = signal::run({&truth, 1}, samples);
    const Fit fit = fit_kind(signal::kind_of(truth), {samples, response});
    EXPECT_EQ(fit.residual, 0.0);
    EXPECT_NEAR(std::get<signal::Hysteresis>(fit.filter).low, -0.31, 0.02 * 0.31);
    EXPECT_NEAR(std::get<signal::Hysteresis>(fit.filter).high, 0.47, 0.02 * 0.47);
}

TEST(Fit, OfEqualResidualsTheSimplerFilterRanksFirst) {
    const signal::Filter spring = signal::Spring<>{.strength = 3.0, .critical_damping = 0.8},
                         simple = signal::InterpToExact{.speed = 5.0}, worse = signal::DeadZone{};
    signal::Curve curve;
    std::vector<Fit> fits{{worse, 1e-3}, {curve, 0.0}, {spring, 1e-9}, {simple, 5e-7}};
    rank(fits);
    EXPECT_EQ(fits[0].filter, simple) << "both are exact";
    EXPECT_EQ(fits[1].filter, spring);
    EXPECT_EQ(fits[2].filter, signal::Filter(curve)) << "its keys have two numbers each";
    EXPECT_EQ(fits[3].filter, worse);
}

TEST(Fit, OfANoisyLineHasNoMoreStagesThanItNeeds) {
    test::Random random(8);
    const Samples samples = rich_input(200, 3, false);
    std::vector<double> response;
    for (const signal::Sample& sample : samples) {
        const double noise = between(random, -0.05, 0.05);
        response.push_back(2.0 * sample.input + 0.3 + noise);
    }
    const Fit fit = fit_kind(*signal::find_kind("scale_bias_clamp"), {samples, response});
    const auto& line = std::get<signal::ScaleBiasClamp>(fit.filter);
    EXPECT_FALSE(line.clamp);
    EXPECT_FALSE(line.interp);
    EXPECT_NEAR(line.scale, 2.0, 0.04);
    EXPECT_NEAR(line.bias, 0.3, 0.02);
}

TEST(Fit, TheFirstRowOfMeasuringTakesNoTimeThatCounts) {
    const InputRows rows = measuring_rows({.kind = InputKind::Square, .amplitude = 2.0, .period = 1.0}, 60.0);
    const std::vector<double> response(rows.size(), 0.0);
    const FitFacts facts({rows, response});
    EXPECT_NEAR(facts.shortest, 1.0 / 60.0, 1e-12);
    EXPECT_NEAR(facts.duration, 4.0, 1e-6);
    EXPECT_EQ(facts.largest_jump, 4.0);
    EXPECT_EQ(facts.input_range(), 4.0);
}

TEST(Fit, LeavesWhatTheInputSaysNothingOfAtItsDefault) {
    Samples samples;
    for (int i = 0; i < 90; ++i) samples.push_back({1.0 / 60.0, i < 10 ? 0.0 : 1.0});
    const signal::Filter truth = signal::RateLimit{.rise = 3.0, .fall = 77.0};
    const std::vector<double> response = signal::run({&truth, 1}, samples);
    const Fit fit = fit_kind(signal::kind_of(truth), {samples, response});
    EXPECT_LT(fit.residual, 1e-6);
    EXPECT_NEAR(std::get<signal::RateLimit>(fit.filter).rise, 3.0, 0.01);
    EXPECT_EQ(std::get<signal::RateLimit>(fit.filter).fall, signal::RateLimit{}.fall) << "it never falls";
}

TEST(Fit, OfANoisyResponseIsAsGoodAsItsNoise) {
    test::Random random(3);
    const Samples samples = rich_input(400, 2, false);
    const signal::Filter truth = signal::ExponentialDecay{.halflife = 0.12};
    std::vector<double> response = signal::run({&truth, 1}, samples);
    for (double& value : response) value += between(random, -0.02, 0.02);
    const Fit fit = fit_kind(signal::kind_of(truth), {samples, response});
    EXPECT_LT(fit.residual, 0.02);
    EXPECT_NEAR(std::get<signal::ExponentialDecay>(fit.filter).halflife, 0.12, 0.006);
}

TEST(Fit, OfWhatSaysNothingIsDefined) {
    const Samples still(20, {1.0 / 60.0, 0.5}), one{{1.0 / 60.0, 2.0}}, timeless(5, {0.0, 1.0});
    for (const Samples& samples : {still, one, timeless}) {
        const std::vector<double> response(samples.size(), 0.5);
        for (const signal::Kind& kind : signal::kinds()) {
            const Fit fit = fit_kind(kind, {samples, response});
            EXPECT_TRUE(signal::check(fit.filter)) << kind.name;
            EXPECT_TRUE(std::isfinite(fit.residual)) << kind.name;
        }
    }
}

TEST(Fit, BeginsFromWhatItIsGivenToo) {
    const Samples samples = rich_input(200, 6, false);
    const signal::Filter truth = signal::Inertialize{.halflife = 0.2, .threshold = 0.4};
    const std::vector<double> response = signal::run({&truth, 1}, samples);
    const Fit fit = fit_kind(signal::kind_of(truth), {samples, response}, &truth);
    EXPECT_LT(fit.residual, 1e-6);
    EXPECT_LT(fit.evaluations, fit_kind(signal::kind_of(truth), {samples, response}).evaluations)
        << "there is nothing left to improve";
    const signal::Filter other = signal::DeadZone{};  // of another kind: ignored
    EXPECT_EQ(fit_kind(signal::kind_of(truth), {samples, response}, &other).filter,
              fit_kind(signal::kind_of(truth), {samples, response}).filter);
}

}  // namespace
}  // namespace tendril::app
