// The Signal lab in scene files, and its measurements, which do not depend on how they were triggered.
#include <tuple>

#include "app/io/samples.hpp"
#include "app/labs/signal/analysis.hpp"
#include "app/labs/signal/filter_json.hpp"
#include "app/labs/signal/signal_part.hpp"
#include "tests/app/labs/lab_support.hpp"
#include "tests/app/support/panel_text.hpp"
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

TEST(SignalInputs, RowsHoldForTheirDtAndRepeat) {
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
    const InputRows lines{{0.1, 1.0}, {0.0, 5.0}, {0.3, -2.0}};
    const SignalInput file{.kind = InputKind::Csv, .file = std::make_shared<const InputRows>(lines)};
    for (const double start : {0.0, 0.4, 40.0}) {
        EXPECT_EQ(input_at(file, start + 0.05), 1.0);
        EXPECT_EQ(input_at(file, start + 0.1), 1.0) << "up to its end";
        EXPECT_EQ(input_at(file, start + 0.11), -2.0) << "a row without time is never seen";
        EXPECT_EQ(input_at(file, start + 0.4), -2.0);
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

// Real CSV files: columns found by their names, by their positions, or as chosen.

class SignalCsv : public LabTest {
  protected:
    SignalCsv() : LabTest(signal_lab) {}
    Json file(const std::string& text, Json more = Json::object()) {
        more["kind"] = "csv";
        more["path"] = write("rows.csv", text);
        return more;
    }
    std::vector<double> values() const {
        std::vector<double> all;
        for (const signal::Sample& row : *workspace.document.get<SignalPart>(signal_lab).input.file)
            all.push_back(row.input);
        return all;
    }
};

TEST_F(SignalCsv, ColumnsAreFoundByNameOrAreTheOtherOfTwo) {
    const std::vector<double> wanted{1, -2};
    for (const char* text :
         {"dt,input\n0.1,1\n0.1,-2\n", "0.1,1\n0.1,-2\n", "time,value\n0,1\n0.5,-2\n",
          "t,x,y\n0,1,9\n1,-2,9\n", "Time (s),Value [mm]\n0,1\n0.5,-2\n", "left,Seconds\n1,0\n-2,0.5\n",
          "frame,t,y\n7,0,1\n8,1,-2\n", "input,note,dt\n1,7,0.1\n-2,8,0.1\n",
          "\"note, of mine\",\"dt\",\"input\"\n\"a,b\",0.5,\"1\"\nb,0.5,-2\n",
          "\"t\",\"height, in metres\"\n0,1\n1,-2\n"}) {
        SCOPED_TRACE(text);
        run("signal.input", file(text));
        EXPECT_EQ(values(), wanted);
    }
}

TEST_F(SignalCsv, UnknownColumnsCanBeChosenByNameOrNumber) {
    const std::string text = "frame,clock,left,right\n1,0,5,1\n2,0.5,5,-2\n";
    refuses("signal.input", file(text), "row 1 time frame clock left right");
    refuses("signal.input", file(text, {{"time", "clock"}}), "row 1 value frame clock left right");
    refuses("signal.input", file(text, {{"time", "clock"}, {"value", "up"}}),
            "no column up frame clock left right");
    refuses("signal.input", file(text, {{"time", "2"}, {"value", "5"}}), "no column 5");
    refuses("signal.input", file(text, {{"time", "2"}, {"value", "clock"}}), "same");
    refuses("signal.input", file("0,1,2\n1,1,2\n"), "time columns 1 to 3");
    refuses("signal.input", {{"kind", "sine"}, {"value", "y"}}, "value path");
    const std::vector<double> wanted{1, -2};
    run("signal.input", file(text, {{"time", "Clock"}, {"value", "right"}}));
    EXPECT_EQ(values(), wanted);
    run("signal.input", file("0,9,1\n1,9,-2\n", {{"time", "1"}, {"value", "3"}}));
    EXPECT_EQ(values(), wanted);
    refuses("signal.input", file(text + "3,x,5,1\n", {{"time", "2"}, {"value", "4"}}),
            "row 4 column 2 time x");
}

TEST_F(SignalCsv, AnExactNameWinsOverOneThatDiffersInCaseOrUnit) {
    const std::string text = "t,X,x,x (mm)\n0,1,2,3\n1,4,5,6\n";
    for (const auto& [name, wanted] : std::vector<std::pair<std::string, std::vector<double>>>{
             {"X", {1, 4}}, {"x", {2, 5}}, {"x (mm)", {3, 6}}}) {
        run("signal.input", file(text, {{"value", name}}));
        EXPECT_EQ(values(), wanted) << name;
    }
    refuses("signal.input", file(text, {{"value", "x (m)"}}), "3 columns called x");
}

TEST_F(SignalCsv, RowsAreCountedAndUnevenTimesSaid) {
    const auto said = [&](const std::string& text) {
        run("signal.input", file(text));
        return state().at("input").at("rows").get<std::string>();
    };
    EXPECT_EQ(said("t,x\n0,1\n0.25,2\n0.5,3\n"), "3 rows in 750 ms, 250 ms apart.");
    EXPECT_EQ(said("t (ms),x\n0,1\n17,2\n33,3\n50,4\n"), "4 rows in 67.0 ms, 16.8 ms apart.");
    EXPECT_EQ(said("t,x\n0,1\n0.25,2\n2.25,3\n"), "3 rows in 2.50 s, uneven: 250 ms to 2.00 s apart.");
    EXPECT_TRUE(test::says(test::PanelReader().inspector(lab(), workspace), "3 rows uneven"));
}

TEST_F(SignalCsv, TimeIsInTheUnitOfItsColumnsName) {
    const auto step = [&] { return workspace.document.get<SignalPart>(signal_lab).input.file->at(1).dt; };
    for (const auto& [unit, seconds] : std::vector<std::pair<std::string, double>>{
             {"s", 20.0}, {"Seconds", 20.0}, {"ms", 0.02}, {"MS", 0.02}, {"us", 20e-6}, {"\u00b5s", 20e-6}}) {
        run("signal.input", file("time [" + unit + "],value\n0,1\n20,2\n"));
        EXPECT_NEAR(step(), seconds, 1e-12) << unit;
    }
    refuses("signal.input", file("time (h),value\n0,1\n20,2\n"), "time h must be s ms us");
}

}  // namespace
}  // namespace tendril::app
