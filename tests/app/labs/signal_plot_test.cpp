// The Signal lab's plots: the ranges of their axes, and measurements that stay readable.
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

TEST_F(SignalNumbers, OfEachSeriesAreItsCurvesAgainstTheInput) {
    run("signal.clear");
    run("signal.input", {{"kind", "noise"}});
    run("signal.filter.add", {{"kind", "exponential_decay"}, {"halflife", 0.1}});
    run("signal.filter.add", {{"kind", "interp_to"}});
    run("signal.filter.add", {{"kind", "moving_average"}, {"beside", true}});
    run("signal.filter.add", {{"kind", "spring"}});
    run("signal.filter.enable", {{"at", 3}, {"on", false}});
    const auto filter = [&](std::size_t i) { return part().stages[i].filter; };
    const std::vector<signal::Filter> series[] = {{filter(0)}, {filter(0), filter(1)}, {filter(2)}};
    const InputRows rows = measuring_rows(part().input, 60.0);
    const std::vector<ShelfPoint> shelf = signal_runtime(workspace).shelf(part());
    for (const std::size_t selected : {0, 2}) {
        run("signal.select", {{"at", selected}});
        const ChainAnalysis& analysis = signal_runtime(workspace).chain(part());
        for (std::size_t i = 0; i < 3; ++i) {
            const signal::Measures& own = analysis.stages[i];
            EXPECT_EQ(analysis.outputs[i], signal::run(series[i], rows)) << i;
            EXPECT_EQ(own.rate_difference, signal::compare_rates(series[i], rows).difference) << i;
            EXPECT_EQ(shelf[i].stage, i);
            EXPECT_EQ(shelf[i].lag, *own.lag) << "as in the plot";
            EXPECT_EQ(shelf[i].jitter, *own.jitter);
        }
        EXPECT_EQ(analysis.whole.lag, analysis.stages[selected == 0 ? 1 : 2].lag) << "of the selected";
        EXPECT_EQ(analysis.whole.rate_difference, analysis.rates.difference);
        EXPECT_EQ(analysis.rates.difference, analysis.stages[selected == 0 ? 1 : 2].rate_difference);
    }
    EXPECT_EQ(std::ranges::count(shelf, 7u, [](const ShelfPoint& each) { return each.filter.index(); }), 1)
        << "the spring is off, so its kind is shown alone";
    for (std::size_t i = 0; i < 3; ++i) run("signal.filter.enable", {{"at", i}, {"on", false}});
    const ChainAnalysis& off = signal_runtime(workspace).chain(part());
    EXPECT_EQ(off.stages[2].rate_difference, 0.0);
    EXPECT_EQ(off.rates.runs.size(), signal::usual_rates().size()) << "the input alone";
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
