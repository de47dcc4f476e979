// The Signal lab's plots: the ranges of their axes, and measurements that stay readable.
#include <cmath>

#include "app/labs/signal/analysis.hpp"
#include "tests/app/labs/lab_support.hpp"

namespace tendril::app {
namespace {

using Values = std::vector<double>;

Span widened_by(const Span& input, const Values& output) {
    const std::span<const double> all[] = {output};
    return widened(input, all);
}

TEST(SignalSpan, OfAWaveIsItsAmplitudeFromTheStartOn) {
    const SignalInput square{.kind = InputKind::Square, .amplitude = 3.0};
    EXPECT_EQ(span_of(square, {}), (Span{-3.0, 3.0}));
    EXPECT_EQ(span_of(square, Values{3.0, 3.0}), (Span{-3.0, 3.0})) << "before its first jump too";
    EXPECT_EQ(span_of(square, Values{-7.0, 1.0}), (Span{-7.0, 3.0})) << "and what was there before it";
    const SignalInput inverted{.kind = InputKind::Sine, .amplitude = -2.0};
    EXPECT_EQ(span_of(inverted, {}), (Span{-2.0, 2.0}));
}

TEST(SignalSpan, OfAHandIsAUnitEitherWayOrMore) {
    const SignalInput hand{.kind = InputKind::Hand};
    EXPECT_EQ(span_of(hand, {}), (Span{-1.0, 1.0}));
    EXPECT_EQ(span_of(hand, Values{0.01, 0.02}), (Span{-1.0, 1.0}));
    EXPECT_EQ(span_of(hand, Values{-5.0, 0.0, 2.0}), (Span{-5.0, 2.0}));
}

TEST(SignalSpan, OfAFileIsItsRange) {
    const SignalInput file{.kind = InputKind::Csv};
    EXPECT_EQ(span_of(file, Values{100.0, 101.0, 99.0}), (Span{99.0, 101.0}));
    for (const double level : {0.0, 1e-5, 4.0, -1e6}) {
        const Span still = span_of(file, Values{level, level});
        EXPECT_LT(still.low, level);
        EXPECT_GT(still.high, level);
    }
    const SignalInput flat{.kind = InputKind::Square, .amplitude = 0.0};
    EXPECT_LT(span_of(flat, Values{0.0}).low, span_of(flat, Values{0.0}).high);
}

TEST(SignalSpan, GrowsInStepsWithTheOutputAndStopsAtTheInputsRange) {
    const Span input{-1.0, 1.0}, calm = widened_by(input, {});
    EXPECT_NEAR(calm.low, -1.3, 1e-12);
    EXPECT_NEAR(calm.high, 1.3, 1e-12);
    EXPECT_EQ(widened_by(input, {1.0, 1.29, -0.2}), calm) << "the margin holds it";
    const Span over = widened_by(input, {1.31});
    EXPECT_EQ(over.low, calm.low) << "each side on its own";
    EXPECT_NEAR(over.high, 1.8, 1e-12);
    EXPECT_EQ(widened_by(input, {1.79}), over) << "in steps";
    const Span gone = widened_by(input, {1e12, -1e300});
    EXPECT_NEAR(gone.low, -3.3, 1e-12);
    EXPECT_NEAR(gone.high, 3.3, 1e-12);
    EXPECT_EQ(widened_by(input, {4.0, -4.0}), gone) << "the input keeps a third of the plot";
}

TEST(SignalSpan, CurvesOfUnboundedGrowthStayFinite) {
    const Values time{0.0, 1.0, 2.0, 3.0}, values{1.0, 1e300, -1e300, 2.0};
    const Curve curve = curve_of("x", glm::vec3(1.0f), time, values, 1.0, 2.0);
    ASSERT_EQ(curve.points.size(), 2u) << "from 1 to 2";
    EXPECT_TRUE(std::isfinite(curve.points[0].y));
    EXPECT_GT(curve.points[0].y, 1e20f);
    EXPECT_LT(curve.points[1].y, -1e20f);
}

class SignalNumbers : public LabTest {
  protected:
    SignalNumbers() : LabTest(signal_lab) {}
    const SignalPart& part() const { return signal_part(workspace); }
    void wave_of_hand(int ticks) {
        for (int i = 0; i < ticks; ++i) {
            run("signal.hand", {{"value", std::sin(0.1 * i)}});
            lab().step(workspace);
        }
    }
};

TEST_F(SignalNumbers, OfAHandAreComputedFourTimesASecond) {
    wave_of_hand(700);
    SignalRuntime& runtime = signal_runtime(workspace);
    int times = 0;
    std::vector<double> before;
    for (int tick = 0; tick < 120; ++tick) {
        run("signal.hand", {{"value", std::cos(0.3 * tick)}});
        lab().step(workspace);
        const std::vector<double> input = runtime.chain(part()).input;
        times += input != before;
        before = input;
        EXPECT_NEAR(runtime.chain(part()).time.back(), 9.75, 1e-6);
    }
    EXPECT_LE(times, 9) << "in two seconds";
    EXPECT_GE(times, 8);
}

TEST_F(SignalNumbers, OfAHandUseItsLastRows) {
    wave_of_hand(40);  // two quarters of a second, and ten ticks
    const ChainAnalysis& analysis = signal_runtime(workspace).chain(part());
    ASSERT_EQ(analysis.input.size(), 30u);
    for (std::size_t i = 0; i < 30; ++i) EXPECT_EQ(analysis.input[i], std::sin(0.1 * static_cast<int>(i)));
    wave_of_hand(15);
    EXPECT_EQ(signal_runtime(workspace).chain(part()).input.size(), 45u);
    workspace.clock.speed = 0.1f;
    wave_of_hand(1500);
    EXPECT_LE(signal_runtime(workspace).chain(part()).time.back(), 0.751) << "in slow motion too";
    EXPECT_GE(signal_runtime(workspace).chain(part()).time.back(), 0.74);
}

TEST_F(SignalNumbers, RateDifferencesAreEachFiltersOwn) {
    run("signal.clear");
    run("signal.filter.add", {{"kind", "interp_to"}});
    run("signal.filter.add", {{"kind", "interp_to"}});
    run("signal.filter.add", {{"kind", "scale_bias_clamp"}});
    run("signal.filter.enable", {{"at", 1}, {"on", false}});
    const ChainAnalysis& analysis = signal_runtime(workspace).chain(part());
    const signal::Filter first = part().stages[0].filter;
    const signal::Filter both[] = {first, part().stages[2].filter};
    const InputRows rows = measuring_rows(part().input, 60.0);
    EXPECT_GT(analysis.stages[0].rate_difference, 0.01);
    EXPECT_EQ(analysis.stages[0].rate_difference, signal::compare_rates({&first, 1}, rows).difference);
    EXPECT_EQ(analysis.stages[1].rate_difference, 0.0) << "it is off";
    EXPECT_EQ(analysis.stages[2].rate_difference, 0.0)
        << "what reaches it depends on the rate, not what it does";
    EXPECT_EQ(analysis.rates.difference, signal::compare_rates(both, rows).difference);
    EXPECT_EQ(analysis.whole.rate_difference, analysis.rates.difference);
    EXPECT_EQ(analysis.rates.runs[0].output, signal::compare_rates(both, rows).runs[0].output);
    run("signal.filter.enable", {{"at", 0}, {"on", false}});
    run("signal.filter.enable", {{"at", 2}, {"on", false}});
    const ChainAnalysis& off = signal_runtime(workspace).chain(part());
    EXPECT_EQ(off.stages[2].rate_difference, 0.0);
    EXPECT_EQ(off.rates.runs.size(), signal::usual_rates().size()) << "the input alone";
}

TEST_F(SignalNumbers, OfAFilterUseItsOwnInputAndOfTheChainTheSignal) {
    run("signal.clear");
    run("signal.filter.add", {{"kind", "exponential_decay"}, {"halflife", 0.1}});
    run("signal.filter.add", {{"kind", "dead_zone"}, {"width", 0}});
    const ChainAnalysis& analysis = signal_runtime(workspace).chain(part());
    EXPECT_GT(*analysis.stages[0].lag, 0.05);
    EXPECT_NEAR(*analysis.stages[1].lag, 0.0, 1e-6) << "it passes what comes in";
    EXPECT_NEAR(*analysis.stages[1].jitter, 1.0, 1e-9);
    EXPECT_EQ(analysis.whole.lag, analysis.stages[0].lag);
    EXPECT_EQ(analysis.whole.overshoot, analysis.stages[0].overshoot);
    EXPECT_EQ(analysis.whole.settling_time, analysis.stages[0].settling_time);
    EXPECT_EQ(analysis.whole.jitter, analysis.stages[0].jitter);
}

TEST_F(SignalNumbers, OfTheShelfEqualTheChainsForTheSameKind) {
    run("signal.clear");
    run("signal.input", {{"kind", "noise"}});
    run("signal.filter.add", {{"kind", "moving_average"}, {"window", 0.3}});
    run("signal.filter.add", {{"kind", "moving_average"}, {"window", 0.1}});
    const ChainAnalysis& analysis = signal_runtime(workspace).chain(part());
    const std::vector<ShelfPoint>& shelf = signal_runtime(workspace).shelf(part());
    ASSERT_GT(shelf.size(), 5u);
    EXPECT_EQ(shelf[0].stage, std::optional<std::size_t>(0)) << "those of the chain come first";
    EXPECT_EQ(shelf[0].filter, part().stages[0].filter);
    EXPECT_EQ(shelf[0].lag, *analysis.stages[0].lag);
    EXPECT_EQ(shelf[0].jitter, *analysis.stages[0].jitter);
    for (std::size_t i = 1; i < shelf.size(); ++i) {
        EXPECT_FALSE(shelf[i].stage);
        EXPECT_EQ(shelf[i].filter, signal::kind_of(shelf[i].filter).blank()) << "as the kind has it";
    }
}

TEST_F(SignalNumbers, GoBackInTimeWithTheFiltersAsTheyAreSetNow) {
    for (int i = 0; i < 90; ++i) {
        workspace.remember_moment();
        lab().step(workspace);
        ++workspace.clock.tick;
        ++workspace.moment;
    }
    const Json before = state();
    run("signal.filter.set", {{"at", 0}, {"strength", 4}});
    run("signal.plot", {{"name", "shelf"}});
    run("time.seek", {{"ticks_back", 30}});
    EXPECT_NEAR(state().at("seconds").get<double>(), 1.0, 1e-9);
    EXPECT_EQ(state().at("filters")[0].at("strength"), 4);
    EXPECT_EQ(state().at("plot"), "shelf");
    EXPECT_NE(state().at("filters")[0].at("output"), before.at("filters")[0].at("output"));
    run("signal.filter.add", {{"kind", "dead_zone"}});
    run("time.seek", {{"ticks_back", 20}});
    EXPECT_EQ(state().at("filters").size(), 1u) << "another chain comes back whole";
}

}  // namespace
}  // namespace tendril::app
