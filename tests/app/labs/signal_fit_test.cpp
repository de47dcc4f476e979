// Fitting filters to responses: responses of each kind of filter are matched, with the original parameters.
#include <numbers>

#include "app/labs/signal/analysis.hpp"
#include "app/labs/signal/fit.hpp"
#include "app/labs/signal/signal_part.hpp"
#include "tests/app/labs/fit_support.hpp"
#include "tests/app/labs/lab_support.hpp"
#include "tests/app/support/panel_text.hpp"
#include "tests/core/random.hpp"

namespace tendril::app {
namespace {

using Samples = std::vector<signal::Sample>;

double between(test::Random& random, double low, double high) {
    return low + (high - low) * (0.5 + 0.5 * static_cast<double>(random.around(1.0f)));
}

/// Jumps of several heights, constant parts, ramps, a sweep and some noise, so that every kind of filter has
/// an effect. `uneven`: frames of uneven length.
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

struct NamedRange {
    const char* name;
    double low, high;
};

/// A filter of a kind, with typical parameters.
signal::Filter some_filter(const signal::Kind& kind, test::Random& random) {
    const auto pick = [&](double low, double high) { return between(random, low, high); };
    signal::Filter filter = kind.blank();
    for (const auto& [name, low, high] :
         {NamedRange{"speed", 2.0, 20.0}, NamedRange{"halflife", 0.05, 0.3}, NamedRange{"rise", 1.0, 6.0},
          NamedRange{"fall", 1.0, 6.0}, NamedRange{"smooth_time", 0.08, 0.5},
          NamedRange{"max_speed", 3.0, 6.0}, NamedRange{"strength", 0.8, 2.5},
          NamedRange{"critical_damping", 0.2, 1.5}, NamedRange{"force", -5.0, 5.0},
          NamedRange{"target_velocity_amount", 0.2, 0.9}, NamedRange{"min_cutoff", 0.6, 3.0},
          NamedRange{"beta", 0.05, 0.5}, NamedRange{"derivative_cutoff", 0.8, 3.0},
          NamedRange{"window", 0.08, 0.4}, NamedRange{"width", 0.1, 0.5}, NamedRange{"threshold", 0.3, 0.7}})
        if (const Field* const field = find_field(kind.table(), name))
            field->set_number(signal::fields_in(filter), pick(low, high));
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

/// Fits the response of `truth` and, with `parameters`, expects the parameters that it depends on. Returns
/// how many were compared.
int expect_found(const signal::Filter& truth, const Samples& samples, bool parameters,
                 double excited = 1e-3) {
    const std::vector<double> response = signal::run({&truth, 1}, samples);
    const FitProblem problem{samples, response};
    const signal::Kind& kind = signal::kind_of(truth);
    const Fit fit = fit_kind(kind, problem);
    EXPECT_LT(fit.residual, 1e-3) << kind.name;
    EXPECT_NEAR(residual_of(fit.filter, problem), fit.residual, 1e-12);
    EXPECT_TRUE(signal::check(fit.filter)) << kind.name;
    int compared = 0;
    if (!parameters) return compared;
    for (const Field& field : kind.table())
        for (int axis = 0; field.count == nullptr && axis < field.size(); ++axis) {
            if (!test::excited(truth, field, axis, problem, excited)) continue;
            const double wanted = field.number(signal::fields_in(truth), axis);
            EXPECT_NEAR(field.number(signal::fields_in(fit.filter), axis), wanted, 0.02 * std::abs(wanted))
                << kind.name << " " << field.name;
            ++compared;
        }
    return compared;
}

struct Case {
    std::size_t kind;
    bool uneven;
};

class FitOfAKind : public testing::TestWithParam<Case> {};

TEST_P(FitOfAKind, MatchesTheResponseByTheParametersThatMadeIt) {
    const signal::Kind& kind = signal::kinds()[GetParam().kind];
    test::Random random(5);
    for (unsigned draw = 0; draw < 3; ++draw) {
        SCOPED_TRACE(draw);
        const Samples samples = rich_input(400, draw + 1, GetParam().uneven);
        const signal::Filter truth = some_filter(kind, random);
        // Only the values of a curve count: different ranges and keys can give the same curve.
        const bool curve = std::holds_alternative<signal::Curve>(truth);
        const int compared = expect_found(truth, samples, !curve, 1e-4);
        // A switch's thresholds are arbitrary between two rows: they have their own test.
        if (curve || std::holds_alternative<signal::Hysteresis>(truth)) continue;
        EXPECT_GT(compared, 0) << kind.name << ": this input says nothing of it";
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

TEST(Fit, FindsThresholdsThatTheInputPassesSlowly) {
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

TEST(Fit, TheFirstRowsTimeDoesNotMatter) {
    const InputRows rows = measuring_rows({.kind = InputKind::Square, .amplitude = 2.0, .period = 1.0}, 60.0);
    const std::vector<double> response(rows.size(), 0.0);
    const FitFacts facts({rows, response});
    EXPECT_NEAR(facts.shortest, 1.0 / 60.0, 1e-12);
    EXPECT_NEAR(facts.duration, 4.0, 1e-6);
    EXPECT_EQ(facts.largest_jump, 4.0);
    EXPECT_EQ(facts.input_range(), 4.0);
}

TEST(Fit, KeepsDefaultsThatTheInputDoesNotDetermine) {
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

TEST(Fit, OfAnUninformativeResponseIsDefined) {
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

TEST(Fit, StartsFromTheGivenFiltersToo) {
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

// The Signal lab must play and fit the same rows.

class SignalFitRows : public LabTest {
  protected:
    SignalFitRows() : LabTest(signal_lab) {}
    const SignalPart& part() const { return signal_part(workspace); }
};

TEST_F(SignalFitRows, AreTheRowsThatAreTicked) {
    std::string samples = "dt,input\n", response = "output\n";
    for (int i = 0; i < 150; ++i)
        samples += "0.016666666666666666," + std::to_string(std::sin(0.21 * i) + (i / 40) % 2) + "\n";
    write("in.csv", samples);
    const Json inputs[] = {{{"kind", "square"}, {"period", 1}},
                           {{"kind", "noise"}, {"period", 1}},
                           {{"kind", "csv"}, {"path", path("in.csv")}}};
    const Json filters[] = {{{"kind", "spring"}, {"strength", 2.3}, {"critical_damping", 0.4}},
                            {{"kind", "rate_limit"}, {"rise", 2.0}, {"fall", 3.5}}};
    for (const Json& input : inputs) {
        for (const Json& filter : filters) {
            run("signal.reset");
            run("signal.clear");
            run("signal.input", input);
            run("signal.filter.add", filter);
            std::vector<double> played, wanted;
            for (int i = 0; i < 150; ++i) {
                wait(1);
                played.push_back(state().at("input").at("value").get<double>());
                wanted.push_back(state().at("output").get<double>());
            }
            run("signal.clear");
            run("signal.fit", {{"to", wanted}});
            ASSERT_EQ(part().fit_input.size(), played.size());
            for (std::size_t i = 0; i < played.size(); ++i)
                ASSERT_NEAR(part().fit_input[i].input, played[i], 1e-12) << input << ", row " << i;
            EXPECT_EQ(signal::kind(part().fits.front().filter), filter.at("kind").get<std::string>())
                << input;
            EXPECT_LT(part().fits.front().residual, 1e-6) << input << filter;
            response = "output\n";
            for (const double value : wanted) response += Json(value).dump() + "\n";
        }
    }
    run("signal.fit", {{"to", write("out.csv", response)}});
    EXPECT_STREQ(signal::kind(part().fits.front().filter), "rate_limit") << "a row of the file for each tick";
    EXPECT_LT(part().fits.front().residual, 1e-6);
    run("signal.fit.use", {{"rank", 0}});
    EXPECT_EQ(state().at("filters")[0].at("kind"), "rate_limit");
}

// Filters with unusual parameters are found too: very slow ones, clamps that cut off most of a line,
// thresholds that the input never crosses.

double by_ratio(test::Random& random, double low, double high) {
    return low * std::pow(high / low, between(random, 0.0, 1.0));
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
            if (i % 37 == 0) level = between(random, -1.5, 1.5);
            level += between(random, -0.02, 0.02);
        }
        samples.push_back({1.0 / 60.0, level});
    }
    return samples;
}

signal::Filter wide_filter(const signal::Kind& kind, test::Random& random) {
    signal::Filter filter = kind.blank();
    const double most_damped = std::holds_alternative<signal::SpringSemiImplicit>(filter) ? 1.5 : 40.0;
    for (const auto& [name, low, high] :
         {NamedRange{"speed", 0.3, 40.0}, NamedRange{"halflife", 0.01, 1.0}, NamedRange{"rise", 0.3, 30.0},
          NamedRange{"fall", 0.3, 30.0}, NamedRange{"smooth_time", 0.02, 1.0},
          NamedRange{"max_speed", 0.3, 8.0}, NamedRange{"strength", 0.3, 5.0},
          NamedRange{"critical_damping", 0.05, most_damped}, NamedRange{"target_velocity_amount", 0.1, 1.0},
          NamedRange{"min_cutoff", 0.1, 10.0}, NamedRange{"beta", 0.01, 3.0},
          NamedRange{"derivative_cutoff", 0.3, 5.0}, NamedRange{"window", 0.03, 1.0},
          NamedRange{"width", 0.05, 0.8}, NamedRange{"threshold", 0.1, 1.0}}) {
        const double value = by_ratio(random, low, high);
        if (const Field* const field = find_field(kind.table(), name))
            field->set_number(signal::fields_in(filter), value);
    }
    if (auto* hysteresis = std::get_if<signal::Hysteresis>(&filter)) {
        hysteresis->low = between(random, -1.6, 0.4);
        hysteresis->high = hysteresis->low + between(random, 0.05, 0.8);
    }
    if (auto* scale = std::get_if<signal::ScaleBiasClamp>(&filter)) {
        const double sign = random.chance(2) ? -1.0 : 1.0;
        scale->scale = sign * by_ratio(random, 0.3, 3.0);
        scale->bias = between(random, -0.5, 0.5);
        scale->clamp = scale->interp = true;
        scale->clamp_min = between(random, -1.0, 0.0);
        scale->clamp_max = scale->clamp_min + between(random, 0.1, 1.5);
        scale->speed_increasing = by_ratio(random, 1.0, 25.0);
        scale->speed_decreasing = by_ratio(random, 1.0, 25.0);
    }
    return filter;
}

class FitOfAWideRange : public testing::TestWithParam<std::size_t> {};

TEST_P(FitOfAWideRange, FindsTheFilterThatMadeTheResponse) {
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

TEST(FitOfExtremes, SmoothDampThatIsLimitedMostOfTheTime) {
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

TEST(FitOfExtremes, SpringsWithThirtyTimesCriticalDamping) {
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

// A fit computed in parts, one per tick, as in the window.

class SignalFitting : public LabTest {
  protected:
    SignalFitting() : LabTest(signal_lab) {
        run("signal.input", {{"kind", "square"}, {"period", 2}});
        run("signal.filter.add", {{"kind", "rate_limit"}, {"rise", 4}});
        draw();
    }
    const SignalPart& part() const { return signal_part(workspace); }
    void draw() {
        run("signal.fit.draw", {{"from", 0.2}, {"from_value", -0.5}, {"to", 0.6}, {"to_value", 0.7}});
    }
    /// Runs up to `most` ticks, or to the end; returns how many there were.
    int work(int most = 10'000) {
        int ticks = 0;
        for (; ticks < most && lab().working(workspace); ++ticks) lab().work(workspace);
        return ticks;
    }
    static void expect_same(const std::vector<Fit>& a, const std::vector<Fit>& b) {
        ASSERT_EQ(a.size(), b.size());
        for (std::size_t i = 0; i < a.size(); ++i) {
            EXPECT_EQ(a[i].filter, b[i].filter) << i;
            EXPECT_EQ(a[i].residual, b[i].residual) << i;
        }
    }
};

TEST_F(SignalFitting, InPartsItEqualsTheFitAtOnce) {
    Workspace other = workspace;
    run("signal.fit");
    EXPECT_FALSE(lab().working(workspace)) << "a script's next line finds it done";
    const std::vector<Fit> at_once = part().fits;
    ASSERT_EQ(at_once.size(), signal::kinds().size());

    workspace = other;
    begin("signal.fit");
    EXPECT_TRUE(lab().working(workspace));
    EXPECT_TRUE(part().fits.empty());
    EXPECT_GT(work(), 2 * static_cast<int>(signal::kinds().size()));
    expect_same(part().fits, at_once);
    EXPECT_FALSE(part().fitting);

    // Discarding the search, or saving and loading it halfway, loses nothing.
    workspace = other;
    begin("signal.fit");
    int ticks = 0;
    for (; lab().working(workspace); ++ticks) {
        if (ticks % 3 == 1) workspace.runtimes.clear();
        if (ticks % 7 == 2) {
            const auto loaded = part().load(part().save(), "labs.signal");
            ASSERT_TRUE(dynamic_cast<const SignalPart&>(*loaded) == part()) << ticks;
            workspace.document.set(signal_lab, loaded);
        }
        lab().work(workspace);
    }
    expect_same(part().fits, at_once);
}

TEST_F(SignalFitting, SearchesBeginWithTheOriginalChain) {
    run("signal.fit");
    const std::vector<Fit> at_once = part().fits;
    begin("signal.fit");
    work(5);
    run("signal.filter.set", {{"at", 1}, {"rise", 900}});
    run("signal.filter.remove", {{"at", 0}});
    work();
    expect_same(part().fits, at_once);
}

TEST_F(SignalFitting, CancellingKeepsTheFittedFilters) {
    expect_refused("signal.fit.cancel", Json::object(), {"no fit is running"});
    begin("signal.fit");
    while (part().fits.size() < 4) lab().work(workspace);
    run("signal.fit.cancel");
    EXPECT_FALSE(lab().working(workspace));
    EXPECT_EQ(part().fits.size(), 4u);
    for (std::size_t i = 1; i < part().fits.size(); ++i)
        EXPECT_LE(part().fits[i - 1].residual, part().fits[i].residual) << "ranked";
    run("signal.fit.use", {{"rank", 0}});
    EXPECT_EQ(part().stages.size(), 1u);
}

TEST_F(SignalFitting, EndsWhenItsResponseChanges) {
    const std::pair<const char*, Json> changes[] = {
        {"signal.fit.draw", {{"from", 0}, {"from_value", 0}, {"to", 0.1}, {"to_value", 1}}},
        {"signal.fit.clear", Json::object()},
        {"signal.fit.record", Json::object()},
        {"signal.preset", {{"name", "spring"}}}};
    for (const auto& [command, arguments] : changes) {
        draw();
        begin("signal.fit");
        work(3);
        ASSERT_TRUE(lab().working(workspace));
        run(command, arguments);
        EXPECT_FALSE(lab().working(workspace)) << command;
        run("undo");
        EXPECT_TRUE(lab().working(workspace)) << command << " is undone, and the fit goes on";
        work();
        EXPECT_EQ(part().fits.size(), signal::kinds().size());
    }
}

TEST_F(SignalFitting, ItsProgressIsReported) {
    test::PanelReader reader;
    begin("signal.fit");
    while (part().fits.size() < 2) lab().work(workspace);
    EXPECT_EQ(state().at("fitting"), true);
    const std::string running = reader.inspector(lab(), workspace);
    EXPECT_TRUE(test::says(running, "2 14"));
    EXPECT_NE(running.find("Cancel"), std::string::npos) << running;
    work();
    EXPECT_EQ(state().at("fitting"), false);
    const std::string done = reader.inspector(lab(), workspace);
    EXPECT_EQ(done.find("kinds of filter fitted"), std::string::npos) << done;
    EXPECT_EQ(done.find("Cancel"), std::string::npos) << done;
}

TEST_F(SignalFitting, FilesThatCannotContinueAreRefused) {
    begin("signal.fit");
    work(3);
    expect_scene_refused("/fit/fitting/shares", -1, "labs.signal.fit.fitting.shares");
    expect_scene_refused("/fit/fitting/shares", 1e6, "labs.signal.fit.fitting.shares");
    expect_scene_refused("/fit/fitting/from", 3, "labs.signal.fit.fitting.from");
    expect_scene_refused("/fit/fitting/from/0/kind", "sponge", "labs.signal.fit.fitting.from.0.kind");
    Json rank = Json::array();
    for (const signal::Kind& kind : signal::kinds())
        rank.push_back({{"filter", {{"kind", kind.name}}}, {"residual", 1}});
    expect_scene_refused("/fit/ranking", rank, "labs.signal.fit.fitting");
}

}  // namespace
}  // namespace tendril::app
