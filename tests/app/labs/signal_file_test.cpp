// The Signal lab in scene files, and its measurements, which do not depend on how they were triggered.
#include <cmath>
#include <tuple>

#include "app/labs/signal/analysis.hpp"
#include "app/labs/signal/filter_json.hpp"
#include "app/labs/signal/signal_part.hpp"
#include "tests/app/labs/lab_support.hpp"
#include "tests/core/random.hpp"

namespace tendril::app {
namespace {

class SignalFile : public LabTest {
  protected:
    SignalFile() : LabTest(signal_lab) {}
    const SignalPart& part() const { return signal_part(workspace); }
    void every_kind() {
        run("signal.clear");
        for (const signal::Kind& kind : signal::kinds()) run("signal.filter.add", {{"kind", kind.name}});
        run("signal.filter.enable", {{"at", 3}, {"on", false}});
        run("signal.input", {{"kind", "noise"}});
    }
};

TEST_F(SignalFile, ABrokenFileIsRefusedWithItsPlace) {
    every_kind();
    run("signal.fit.record");
    run("signal.fit.hand", {{"value", 0.5}});
    wait(5);
    const std::tuple<const char*, Json, const char*> all[] = {
        {"/filters/4/kind", "sponge", "labs.signal.filters.4.kind"},
        {"/filters/4/state", 7, "labs.signal.filters.4.state"},
        {"/filters/4/state/output/value", "x", "labs.signal.filters.4.state.output.value"},
        {"/filters/9/state/moving_average/first", 99, "labs.signal.filters.9.state.moving_average.first"},
        {"/filters/4/enabled", 1, "labs.signal.filters.4.enabled"},
        {"/input/kind", "sponge", "labs.signal.input.kind"},
        {"/input/kind", "csv", "labs.signal.input.kind"},
        {"/input/period", 0, "labs.signal.input.period"},
        {"/time", -1, "labs.signal.time"},
        {"/past/2", Json::array({1}), "labs.signal.past.2"},
        {"/selected", 99, "labs.signal.selected"},
        {"/plot", "sponge", "labs.signal.plot"},
        {"/fit/wanted", Json::array({1, 2}), "labs.signal.fit"},
        {"/fit/recording/rows", 9999, "labs.signal.fit.recording.rows"},
        {"/fit/recording/value", 1e8, "labs.signal.fit.recording.value"},
        {"/fit/recording/begun", 1, "labs.signal.fit.recording.begun"},
        {"/filters", 3, "labs.signal.filters"},
    };
    for (const auto& [pointer, value, place] : all) expect_scene_refused(pointer, value, place);
}

TEST_F(SignalFile, ResultsDoNotDependOnEarlierState) {
    every_kind();
    wait(50);
    const Json first = state();
    EXPECT_EQ(state(), first) << "from the runtime's memory";
    workspace.runtimes.clear();
    EXPECT_EQ(state(), first) << "and without it";
    run("signal.filter.set", {{"at", 4}, {"halflife", 0.3}});
    const Json changed = state();
    EXPECT_NE(changed.at("filters")[4].at("lag_ms"), first.at("filters")[4].at("lag_ms"));
    workspace.runtimes.clear();
    EXPECT_EQ(state(), changed);
}

TEST_F(SignalFile, NumbersAreRecomputedOnlyAfterChanges) {
    SignalRuntime& runtime = signal_runtime(workspace);
    const double* const before = runtime.chain(part()).time.data();
    wait(10);
    EXPECT_EQ(runtime.chain(part()).time.data(), before) << "time alone changes nothing for a wave";
    run("signal.select");
    EXPECT_EQ(runtime.chain(part()).time.data(), before);
    const double lag = *runtime.chain(part()).stages[0].lag;
    run("signal.filter.set", {{"at", 0}, {"strength", 5}});
    EXPECT_NE(*runtime.chain(part()).stages[0].lag, lag);
}

/// Its parameters do by the test over all tables.
TEST(SignalFilters, EveryStateSurvivesJson) {
    test::Random random(1);
    for (const signal::Kind& kind : signal::kinds()) {
        const signal::Filter filter = kind.blank();
        signal::FilterState state;
        for (int i = 0; i < 30; ++i) {
            const double input = static_cast<double>(random.around(1.0f));
            signal::step(filter, state, input, 1.0 / 60.0);
        }
        const Json remembered = parse_json(filter_state_json(state).dump());
        EXPECT_EQ(filter_state_from_json({remembered, "state"}), state) << kind.name;
    }
}

TEST(SignalInputs, ASquareWaveIsUpRightAfterItsJump) {
    SignalInput input{.kind = InputKind::Square, .amplitude = 2.0, .period = 2.0};
    EXPECT_EQ(input_at(input, 0.0), -2.0);
    EXPECT_EQ(input_at(input, 1.0 / 144.0), 2.0);
    EXPECT_EQ(input_at(input, 1.0), 2.0);
    EXPECT_EQ(input_at(input, 1.0 + 1.0 / 144.0), -2.0);
    EXPECT_EQ(input_at(input, 2.0), -2.0);
}

TEST(SignalInputs, ARecordingRepeatsAllOfItsRows) {
    InputRows rows;
    for (int i = 0; i < 7; ++i) rows.push_back({1.0 / 60.0, 10.0 + i});
    const SignalInput input{.kind = InputKind::Recorded,
                            .recording = std::make_shared<const InputRows>(rows)};
    EXPECT_EQ(input_at(input, 0.0), 10.0);
    double time = 0.0;
    for (int tick = 0; tick < 700; ++tick) {
        time += 1.0 / 60.0;
        ASSERT_EQ(input_at(input, time), 10.0 + tick % 7) << tick;
    }
}

TEST(SignalInputs, AFilesRowsHoldForTheirDt) {
    const InputRows rows{{0.1, 1.0}, {0.0, 5.0}, {0.3, -2.0}};
    const SignalInput input{.kind = InputKind::Csv, .file = std::make_shared<const InputRows>(rows)};
    for (const double start : {0.0, 0.4, 40.0}) {
        EXPECT_EQ(input_at(input, start + 0.05), 1.0);
        EXPECT_EQ(input_at(input, start + 0.1), 1.0) << "up to its end";
        EXPECT_EQ(input_at(input, start + 0.11), -2.0) << "a row without time is never seen";
        EXPECT_EQ(input_at(input, start + 0.4), -2.0);
    }
}

TEST(SignalInputs, MeasuringTakesTenSecondsAtMost) {
    const auto seconds = [](const SignalInput& input) {
        return signal::times_of(measuring_rows(input, 60.0)).back();
    };
    EXPECT_NEAR(seconds({.kind = InputKind::Sine, .period = 60.0}), 10.0, 1e-6);
    EXPECT_NEAR(seconds({.kind = InputKind::Sine, .period = 0.3}), 14 * 0.3, 1e-6) << "whole periods";
    const auto rows = std::make_shared<const InputRows>(InputRows{{15.0, 1.0}, {15.0, 2.0}});
    EXPECT_NEAR(seconds({.kind = InputKind::Csv, .file = rows}), 10.0, 1e-6);
    EXPECT_TRUE(measuring_rows({.kind = InputKind::Hand}, 60.0).empty());
}

TEST(SignalInputs, AreFiniteAndWithinTheirAmplitude) {
    for (const InputKind kind : {InputKind::Square, InputKind::Sine, InputKind::Noise}) {
        const SignalInput input{.kind = kind, .amplitude = 3.0, .period = 0.7};
        double low = 0.0, high = 0.0;
        for (int i = 0; i < 5000; ++i) {
            const double value = input_at(input, 0.013 * i);
            ASSERT_TRUE(std::isfinite(value));
            low = std::min(low, value), high = std::max(high, value);
        }
        EXPECT_LE(high, 3.0 + 1e-9);
        EXPECT_GE(low, -3.0 - 1e-9);
        EXPECT_GT(high - low, 3.0);
    }
}

}  // namespace
}  // namespace tendril::app
