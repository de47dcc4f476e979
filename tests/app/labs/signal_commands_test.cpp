// The Signal lab's commands: effects, --state, and refusals.
#include "app/labs/signal/analysis.hpp"
#include "app/labs/signal/panel.hpp"
#include "app/labs/signal/signal_lab.hpp"
#include "app/labs/signal/signal_part.hpp"
#include "tests/app/labs/lab_support.hpp"
#include "tests/app/support/panel_text.hpp"

namespace tendril::app {
namespace {

class SignalCommands : public LabTest {
  protected:
    SignalCommands() : LabTest(signal_lab) {}
    const SignalPart& part() const { return signal_part(workspace); }
};

TEST_F(SignalCommands, TheOutputIsTheLibrarys) {
    run("signal.clear");
    run("signal.filter.add", {{"kind", "rate_limit"}, {"rise", 6}, {"fall", 3}});
    run("signal.filter.add", {{"kind", "exponential_decay"}, {"halflife", 0.1}});
    run("signal.input", {{"kind", "sine"}, {"amplitude", 2}, {"period", 0.5}});
    const signal::Filter filters[] = {signal::RateLimit{6.0, 3.0}, signal::ExponentialDecay{0.1}};
    signal::FilterState states[2];
    for (int i = 1; i <= 90; ++i) {
        wait(1);
        const double input = input_at(part().input, part().time);
        const double first = signal::step(filters[0], states[0], input, tick_seconds);
        const double second = signal::step(filters[1], states[1], first, tick_seconds);
        ASSERT_EQ(state().at("filters")[0].at("output").get<double>(), first);
        ASSERT_EQ(state().at("filters")[1].at("output").get<double>(), second);
    }
}

/// Moved, switched and saved: a filter's colour goes with it; whether it works on the input goes with its
/// place.
TEST_F(SignalCommands, SeriesAreSideBySideAndKeepTheirColours) {
    const auto colours = [&] {
        std::string text;
        for (const SignalStage& stage : part().stages)
            text += (stage.beside ? "|" : " ") + std::to_string(stage.colour);
        return text;
    };
    run("signal.clear");
    for (const bool beside : {true, false, true, false})
        run("signal.filter.add", {{"kind", "spring"}, {"beside", beside}});
    EXPECT_EQ(colours(), "|0 1|2 3");
    run("signal.filter.move", {{"at", 3}, {"to", 0}});
    EXPECT_EQ(colours(), "|3 0|1 2");
    run("signal.filter.remove", {{"at", 2}});
    EXPECT_EQ(colours(), "|3 0|2") << "what followed it works on the input in its place";
    run("signal.filter.add", {{"kind", "dead_zone"}, {"width", 5}});
    EXPECT_EQ(colours(), "|3 0|2 1");
    run("signal.filter.beside", {{"at", 1}, {"on", true}});
    EXPECT_EQ(colours(), "|3|0|2 1");
    EXPECT_EQ(stage_title(part(), 2), "Spring 3");
    wait(20);
    const Json now = state();
    for (const std::size_t at : {1, 2}) {
        run("signal.select", {{"at", at}});
        EXPECT_EQ(state().at("output"), now.at("filters")[at == 1 ? 1 : 3].at("output")) << "of its series";
    }
    EXPECT_NE(now.at("filters")[1].at("output"), 0.0);
    EXPECT_EQ(now.at("filters")[3].at("output"), 0.0);
    const auto loaded = std::dynamic_pointer_cast<SignalPart>(part().load(part().save(), "labs.signal"));
    EXPECT_EQ(loaded->stages, part().stages);
}

TEST_F(SignalCommands, DisabledFiltersPassTheInputThrough) {
    run("signal.clear");
    run("signal.filter.add", {{"kind", "dead_zone"}, {"width", 5}});
    wait(3);
    EXPECT_EQ(state().at("output"), 0.0);
    run("signal.filter.enable", {{"at", 0}});
    wait(1);
    EXPECT_EQ(state().at("output"), state().at("input").at("value"));
    run("signal.filter.enable", {{"at", 0}});
    EXPECT_EQ(part().stages[0].state, signal::FilterState()) << "switched on again, it starts anew";
}

TEST_F(SignalCommands, ARemovedFilterSelectsTheNext) {
    run("signal.clear");
    for (const char* kind : {"spring", "dead_zone", "interp_to"}) run("signal.filter.add", {{"kind", kind}});
    run("signal.select", {{"at", 1}});
    run("signal.filter.remove", {{"at", 1}});
    EXPECT_EQ(part().selected, 1u);
    run("signal.filter.remove", {{"at", 0}});
    EXPECT_EQ(part().selected, 0u);
}

TEST_F(SignalCommands, NewKeysOfACurveKeepNothingOfTheOld) {
    run("signal.clear");
    run("signal.filter.add",
        {{"kind", "curve"},
         {"keys", {{{"time", 0}, {"value", 0}, {"leave", 2}}, {{"time", 1}, {"value", 1}}}}});
    run("signal.filter.set",
        {{"at", 0}, {"keys", {{{"time", 0}, {"value", 0}}, {{"time", 1}, {"value", 1}}}}});
    EXPECT_EQ(std::get<signal::Curve>(part().stages[0].filter).keys[0].leave, 0.0);
}

TEST_F(SignalCommands, TheHandReplacesTheInputAndIsRecorded) {
    run("signal.hand", {{"value", 0.25}});
    EXPECT_EQ(state().at("input").at("kind"), "hand");
    wait(1);
    EXPECT_EQ(state().at("input").at("value"), 0.25);
    for (int i = 0; i < 40; ++i) {
        run("signal.hand", {{"value", std::sin(0.2 * i)}});
        wait(1);
    }
    run("signal.input", {{"kind", "recorded"}});
    double most = 0.0;
    for (int i = 0; i < 60; ++i) {
        wait(1);
        most = std::max(most, state().at("input").at("value").get<double>());
    }
    EXPECT_NEAR(most, 1.0, 0.02);
}

TEST_F(SignalCommands, AResponseIsDrawnOverTheFiltersOutput) {
    run("signal.fit.draw", {{"from", 0.5}, {"from_value", 2.0}, {"to", 0.7}, {"to_value", 3.0}});
    ASSERT_FALSE(part().wanted.empty());
    EXPECT_EQ(part().wanted.size(), part().fit_input.size());
    const std::vector<double> times = signal::times_of(part().fit_input);
    for (std::size_t i = 0; i < times.size(); ++i) {
        if (times[i] > 0.5 && times[i] < 0.7) {
            EXPECT_NEAR(part().wanted[i], 2.0 + 5.0 * (times[i] - 0.5), 1e-9);
        }
    }
    run("signal.fit.clear");
    EXPECT_TRUE(part().wanted.empty());
    expect_refused("signal.fit", Json::object(), {"no response"});
}

TEST_F(SignalCommands, AResponseIsRecordedByHand) {
    run("signal.input", {{"kind", "square"}, {"period", 4}});
    wait(77);
    run("signal.fit.record");
    EXPECT_TRUE(state().at("recording").get<bool>());
    EXPECT_TRUE(workspace.clock.playing);
    EXPECT_FALSE(lab().moving(workspace)) << "it begins with the hand";
    wait(10);
    EXPECT_EQ(state().at("seconds"), 0.0);
    run("signal.fit.hand", {{"value", -0.5}});
    EXPECT_TRUE(lab().moving(workspace));
    wait(30);
    EXPECT_EQ(state().at("input").at("value"), 1.0) << "the input plays from its start";
    run("signal.fit.hand", {{"value", 0.75}});
    wait(15);
    EXPECT_EQ(state().at("wanted"), 45);
    run("signal.fit.stop");
    EXPECT_FALSE(state().at("recording").get<bool>());
    ASSERT_EQ(part().wanted.size(), 45u);
    ASSERT_EQ(part().fit_input.size(), 45u);
    for (std::size_t i = 0; i < 45; ++i) EXPECT_EQ(part().wanted[i], i < 30 ? -0.5 : 0.75) << i;
    run("signal.fit");
    EXPECT_EQ(part().fits.size(), signal::kinds().size());
}

TEST_F(SignalCommands, ARecordedResponseEndsWithItsInput) {
    run("signal.input", {{"kind", "square"}, {"period", 2}});
    run("signal.fit.record");
    run("signal.fit.hand", {{"value", 0.25}});
    wait(239);
    EXPECT_TRUE(state().at("recording").get<bool>());
    wait(1);
    EXPECT_FALSE(state().at("recording").get<bool>());
    EXPECT_EQ(part().wanted, std::vector<double>(240, 0.25));
    EXPECT_EQ(part().fit_input.size(), 240u);
    refuses("signal.fit.hand", {{"value", 0}}, "no response");
    expect_refused("signal.fit.stop", Json::object(), {"no response"});
}

TEST_F(SignalCommands, AGestureIsTheInputForARecordedResponse) {
    run("signal.hand", {{"value", 0}});
    expect_refused("signal.fit.record", Json::object(), {"drag the orange ball"});
    for (int i = 0; i < 50; ++i) {
        run("signal.hand", {{"value", 0.1 * i}});
        wait(1);
    }
    run("signal.fit.record");
    EXPECT_EQ(state().at("input").at("kind"), "recorded");
    run("signal.fit.hand", {{"value", 1}});
    wait(20);
    EXPECT_GT(state().at("input").at("value").get<double>(), 1.0) << "it is played";
    run("signal.fit.stop");
    EXPECT_EQ(part().wanted.size(), 20u);
}

TEST_F(SignalCommands, ARecordingStartsFreshAndIsNoLongerThanAFitTakes) {
    run("signal.input", {{"kind", "sine"}, {"period", 9}});
    wait(50);
    run("signal.fit.record");
    EXPECT_TRUE(part().past.empty());
    EXPECT_EQ(part().wanted.size(), max_wanted);
    EXPECT_FALSE(signal::started(part().stages[0].state)) << "filters remember nothing";
    for (int i = 0; i < 400; ++i) {
        run("signal.hand", {{"value", 0.01 * i}});
        wait(1);
    }
    run("signal.fit.draw", {{"from", 0}, {"from_value", 0}, {"to", 0.1}, {"to_value", 1}});
    ASSERT_EQ(part().wanted.size(), max_wanted);
    EXPECT_EQ(part().fit_input.back().input, part().past.back().input) << "of a hand the last rows";
}

TEST_F(SignalCommands, ChangesOfTheInputEndARecording) {
    const auto recording = [&] {
        run("signal.fit.record");
        run("signal.fit.hand", {{"value", 0.25}});
        wait(10);
    };
    const std::pair<const char*, Json> changes[] = {
        {"signal.input", {{"kind", "sine"}}},
        {"signal.hand", {{"value", 1}}},
        {"signal.preset", {{"name", "spring"}}},
        {"signal.fit.clear", Json::object()},
        {"signal.fit", Json::object()},
        {"signal.fit.draw", {{"from", 0}, {"from_value", 0}, {"to", 0.1}, {"to_value", 1}}}};
    for (const auto& [command, arguments] : changes) {
        run("signal.reset");
        recording();
        run(command, arguments);
        EXPECT_FALSE(state().at("recording").get<bool>()) << command;
        EXPECT_EQ(part().wanted.size(), part().fit_input.size()) << command;
        wait(5);
    }
    run("signal.reset");
    run("signal.fit.record");
    run("signal.fit.stop");
    EXPECT_TRUE(part().wanted.empty()) << "less than two rows are nothing";
}

TEST_F(SignalCommands, ADivergingFilterIsReportedAsUnstable) {
    run("signal.preset", {{"name", "spring_that_explodes"}});
    Json filter = state().at("filters")[0];
    EXPECT_EQ(filter.at("following"), "unstable");
    for (const char* key : {"lag_ms", "overshoot_percent", "settling_ms", "jitter_percent"})
        EXPECT_TRUE(filter.at(key).is_null()) << key;
    filter = state().at("filters")[1];
    EXPECT_EQ(filter.at("following"), "follows");
    EXPECT_TRUE(filter.at("lag_ms").is_number());
    EXPECT_TRUE(test::says(test::PanelReader().inspector(lab(), workspace), "rate difference 0.000 huge"));
}

TEST_F(SignalCommands, EveryPresetMakesItsPoint) {
    for (const SignalPreset& preset : signal_presets()) {
        run("signal.preset", {{"name", preset.name}});
        EXPECT_FALSE(part().stages.empty()) << preset.name;
        wait(120);
    }
    run("signal.preset", {{"name", "engine_against_exact"}});
    const double engine = state().at("filters")[0].at("rate_difference").get<double>();
    const double exact = state().at("filters")[1].at("rate_difference").get<double>();
    EXPECT_GT(engine, 0.1);
    EXPECT_LT(exact, 0.2 * engine);
    run("signal.preset", {{"name", "spring_that_explodes"}});
    EXPECT_GT(state().at("filters")[0].at("rate_difference").get<double>(), 1e6);
    run("signal.preset", {{"name", "faster_but_no_bouncier"}});
    const double bouncy = state().at("filters")[0].at("overshoot_percent").get<double>();
    run("signal.filter.set", {{"at", 0}, {"strength", 3.0}});
    EXPECT_NEAR(state().at("filters")[0].at("overshoot_percent").get<double>(), bouncy, 1.0);
    run("signal.preset", {{"name", "spring"}});
    // exp(-pi z / sqrt(1 - z^2)) at z = 0.35
    EXPECT_NEAR(state().at("filters")[0].at("overshoot_percent").get<double>(), 30.9, 1.0);
}

TEST_F(SignalCommands, BadInputIsRefusedAndChangesNothing) {
    struct Bad {
        const char* command;
        Json arguments;
        const char* says;
    };
    const Bad all[] = {
        {"signal.filter.add",
         {{"kind", "spring"}, {"halflife", 1}},
         "unknown member \"halflife\"; it takes: strength"},
        {"signal.filter.add", {{"kind", "spring"}, {"at", 5}}, "at must be 0 to 1"},
        {"signal.filter.add",
         {{"kind", "curve"}, {"keys", {{{"time", 0}, {"value", 0}, {"arive", 1}}}}},
         "keys.0: unknown member \"arive\""},
        {"signal.filter.add", {{"kind", "hysteresis"}, {"low", 1}, {"high", 0}}, "low"},
        {"signal.filter.set", {{"at", 1}, {"strength", 1}}, "at must be 0 to 0"},
        {"signal.filter.set", {{"at", 0}, {"window", 1}}, "unknown member \"window\"; it takes: strength"},
        {"signal.filter.move", {{"at", 0}, {"to", 3}}, "to must be"},
        {"signal.input", {{"kind", "csv"}}, "path is missing"},
        {"signal.input", {{"kind", "csv"}, {"path", "/no/such.csv"}}, "/no/such.csv"},
        {"signal.input", {{"kind", "sine"}, {"path", "x.csv"}}, "only for csv"},
        {"signal.input", {{"kind", "recorded"}}, "nothing is recorded"},
        {"signal.fit", {{"to", {1, "two"}}}, "to.1"},
        {"signal.fit", {{"to", {1}}}, "2 to"},
        {"signal.fit.use", {{"rank", 0}}, "no fit"},
    };
    for (const Bad& bad : all) {
        const std::string said = refused(bad.command, bad.arguments);
        EXPECT_NE(said.find(bad.says), said.npos) << bad.command << " " << bad.arguments << ": " << said;
    }
    for (std::size_t i = part().stages.size(); i < max_stages; ++i)
        run("signal.filter.add", {{"kind", "interp_to"}});
    refused("signal.filter.add", {{"kind", "interp_to"}});
}

// The Signal lab's plots: the ranges of their axes, and measurements that stay readable.

using Values = std::vector<double>;

Span widened_by(const Span& input, const Values& output) {
    const std::span<const double> all[] = {output};
    return widened(input, all);
}

TEST(SignalSpan, IsAWavesAmplitudeAHandsUnitOrAFilesRange) {
    const SignalInput square{.kind = InputKind::Square, .amplitude = 3.0};
    EXPECT_EQ(span_of(square, {}), (Span{-3.0, 3.0}));
    EXPECT_EQ(span_of(square, Values{3.0, 3.0}), (Span{-3.0, 3.0})) << "before its first jump too";
    EXPECT_EQ(span_of(square, Values{-7.0, 1.0}), (Span{-7.0, 3.0})) << "and what was there before it";
    const SignalInput inverted{.kind = InputKind::Sine, .amplitude = -2.0};
    EXPECT_EQ(span_of(inverted, {}), (Span{-2.0, 2.0}));
    const SignalInput hand{.kind = InputKind::Hand};
    EXPECT_EQ(span_of(hand, {}), (Span{-1.0, 1.0}));
    EXPECT_EQ(span_of(hand, Values{0.01, 0.02}), (Span{-1.0, 1.0}));
    EXPECT_EQ(span_of(hand, Values{-5.0, 0.0, 2.0}), (Span{-5.0, 2.0}));
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
