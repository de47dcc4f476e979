// `tendril signal`: the built program with valid and invalid files.
#include "app/io/samples.hpp"
#include "tests/app/support/program.hpp"

namespace tendril::test {
namespace {

using app::Json;
using Strings = std::vector<std::string>;

class SignalProgram : public testing::Test {
  protected:
    Outcome run(const std::string& filter, const std::string& samples, const Strings& more = {}) {
        write(folder_ / "filter.json", filter);
        write(folder_ / "samples.csv", samples);
        Strings all{"signal", path("filter.json"), path("samples.csv")};
        all.insert(all.end(), more.begin(), more.end());
        return run_program(all, {{"DISPLAY", {}}, {"WAYLAND_DISPLAY", {}}});
    }
    std::string path(const char* name) const { return (folder_ / name).string(); }
    TempFolder folder_;
};

using Table = std::vector<Strings>;

/// The rows of a CSV text without quoted fields.
Table table_of(const std::string& text) {
    Table table;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream fields(line);
        table.emplace_back();
        for (std::string field; std::getline(fields, field, ',');) table.back().push_back(field);
    }
    return table;
}

double number(const std::string& text) {
    return std::stod(text);
}

/// A step up after `before` rows, at 60 Hz.
std::string step_samples(int rows, int before = 1) {
    std::string text;
    for (int i = 0; i < rows; ++i) text += app::decimal(1.0 / 60.0) + (i < before ? ",0\n" : ",1\n");
    return text;
}

TEST_F(SignalProgram, PrintsTimeInputAndOutput) {
    const Outcome outcome =
        run(R"({"kind": "rate_limit", "rise": 6, "fall": 3})", "0.5,0\n0.1,1\n0.1,1\n0.1,-1\r\n\n");
    ASSERT_TRUE(succeeded(outcome));
    const Table table = table_of(outcome.out);
    ASSERT_EQ(table.size(), 5u);
    EXPECT_EQ(table[0], (Strings{"time", "input", "output"}));
    EXPECT_EQ(table[1], (Strings{"0.5", "0", "0"}));
    EXPECT_NEAR(number(table[2][2]), 0.6, 1e-12);
    EXPECT_NEAR(number(table[3][2]), 1.0, 1e-12);
    EXPECT_NEAR(number(table[4][2]), 0.7, 1e-12);
    EXPECT_NEAR(number(table[4][0]), 0.8, 1e-12);
    EXPECT_EQ(table[4][1], "-1");
}

TEST_F(SignalProgram, AppliesAListInItsOrder) {
    const std::string samples = "0.1,1\n0.1,2\n";
    const auto last = [&](const std::string& filters) {
        return number(table_of(run(filters, samples).out).back()[2]);
    };
    const std::string scale = R"({"kind": "scale_bias_clamp", "scale": 10})",
                      zone = R"({"kind": "dead_zone", "width": 1.5})";
    EXPECT_NEAR(last("[" + scale + "," + zone + "]"), 18.5, 1e-12);
    EXPECT_NEAR(last("[" + zone + "," + scale + "]"), 5.0, 1e-12);
    EXPECT_NEAR(last("[]"), 2.0, 1e-12);
}

TEST_F(SignalProgram, TheFirstTimeIsWhereFiltersStart) {
    for (const char* filter : {R"({"kind": "interp_to_exact", "speed": 12.56})",
                               R"({"kind": "moving_average", "window": 0.15})"}) {
        const Table by_dt = table_of(run(filter, "0.1,0\n0.1,1\n0.1,1\n").out);
        for (const double start : {0.0, 5.0, -2.0, 0.1}) {
            std::string samples = "time,input\n";
            for (int i = 0; i < 3; ++i) samples += app::decimal(start + 0.1 * i) + (i == 0 ? ",0\n" : ",1\n");
            const Outcome outcome = run(filter, samples);
            ASSERT_TRUE(succeeded(outcome));
            const Table table = table_of(outcome.out);
            ASSERT_EQ(table.size(), by_dt.size());
            for (std::size_t i = 1; i < table.size(); ++i) {
                EXPECT_EQ(number(table[i][0]), start + 0.1 * static_cast<double>(i - 1)) << "as it was given";
                EXPECT_NEAR(number(table[i][2]), number(by_dt[i][2]), 1e-9) << filter << " from " << start;
            }
        }
    }
    const Outcome one = run(R"({"kind": "interp_to"})", "time,input\n0,3\n");
    ASSERT_TRUE(succeeded(one));
    EXPECT_EQ(table_of(one.out)[1], (Strings{"0", "3", "3"}));
}

TEST_F(SignalProgram, ItsOutputCanBeReadAgain) {
    const Outcome first = run(R"({"kind": "spring", "critical_damping": 0.3})", step_samples(40));
    ASSERT_TRUE(succeeded(first));
    const Outcome again = run(R"({"kind": "spring", "critical_damping": 0.3})", first.out);
    ASSERT_TRUE(succeeded(again));
    const Table one = table_of(first.out), two = table_of(again.out);
    ASSERT_EQ(one.size(), two.size());
    for (std::size_t i = 1; i < one.size(); ++i) EXPECT_NEAR(number(one[i][2]), number(two[i][2]), 1e-12);
}

TEST_F(SignalProgram, ARowWithoutTimeChangesNothing) {
    const Outcome outcome =
        run(R"({"kind": "exponential_decay", "halflife": 0.1})", "0.1,0\n0.1,1\n0,5\n-1,5\n0.1,1\n");
    ASSERT_TRUE(succeeded(outcome));
    const Table table = table_of(outcome.out);
    EXPECT_NEAR(number(table[2][2]), 0.5, 1e-12);
    EXPECT_EQ(table[3][2], table[2][2]);
    EXPECT_EQ(table[4][2], table[2][2]);
    EXPECT_EQ(table[4][0], table[2][0]);
    EXPECT_NEAR(number(table[5][2]), 0.75, 1e-12);
    EXPECT_TRUE(succeeded(run(R"({"kind": "interp_to"})", "time,input\n0,0\n0.1,1\n0.1,5\n0.2,1\n")));
}

TEST_F(SignalProgram, RatesShowThatAFilterDependsOnThem) {
    const std::string samples = step_samples(120, 20);
    const Outcome engine = run(R"({"kind": "interp_to", "speed": 10})", samples, {"--rates"});
    ASSERT_EQ(engine.exit_code, 0) << engine.err;
    const Table table = table_of(engine.out);
    ASSERT_EQ(table.size(), 121u);
    EXPECT_EQ(table[0], (Strings{"time", "input", "output_15", "output_30", "output_60", "output_144",
                                 "output_60_jittered"}));
    EXPECT_EQ(count_lines(engine.err), 1);
    const std::string lead = "maximum difference between the rates: ";
    ASSERT_TRUE(engine.err.starts_with(lead)) << engine.err;
    EXPECT_GT(number(engine.err.substr(lead.size())), 0.05);
    for (const auto& row : table) EXPECT_EQ(row.size(), 7u);
    const Outcome exact = run(R"({"kind": "interp_to_exact", "speed": 10})", samples, {"--rates"});
    ASSERT_TRUE(exact.err.starts_with(lead)) << exact.err;
    EXPECT_LT(number(exact.err.substr(lead.size())), 1e-12);
}

/// A filter can be copied from a scene or from --state with its additional members.
TEST_F(SignalProgram, IgnoresKeysThatItDoesNotKnow) {
    const std::string samples = "0.1,0\n0.1,1\n0.1,1\n";
    const Outcome plain = run(R"({"kind": "spring", "strength": 3})", samples);
    const Outcome more =
        run(R"([{"kind": "spring", "strength": 3, "enabled": true, "lag_ms": null, "x": {}}])", samples);
    EXPECT_TRUE(succeeded(plain));
    EXPECT_TRUE(succeeded(more));
    EXPECT_EQ(more.out, plain.out);
}

TEST_F(SignalProgram, FitRanksTheKindsAndItsFiltersRun) {
    const std::string truth = R"({"kind": "spring", "strength": 2.5, "critical_damping": 0.3})";
    std::string samples;
    for (int i = 0; i < 240; ++i)
        samples += app::decimal(1.0 / 60.0) + "," + app::decimal(i < 5 ? 0.0 : i < 100 ? 1.0 : -0.5) + "\n";
    const Outcome response = run(truth, samples);
    ASSERT_TRUE(succeeded(response));
    write(folder_ / "response.csv", response.out);
    const Outcome fitted = run(R"({"kind": "interp_to"})", samples, {"--fit", path("response.csv")});
    ASSERT_EQ(fitted.exit_code, 0) << fitted.err;  // may contain progress if it takes over a second
    EXPECT_EQ(count_lines(fitted.out), 15);
    ASSERT_TRUE(fitted.out.starts_with("kind,residual,filter\nspring,")) << fitted.out;
    std::string best = fitted.out.substr(fitted.out.find("\"{") + 1);
    best = best.substr(0, best.find("}\"") + 1);
    for (auto at = best.find("\"\""); at != best.npos; at = best.find("\"\"", at + 1)) best.erase(at, 1);
    const Json filter = app::parse_json(best);
    EXPECT_NEAR(filter.at("strength").get<double>(), 2.5, 0.01);
    EXPECT_NEAR(filter.at("critical_damping").get<double>(), 0.3, 0.002);
    const Table wanted = table_of(response.out), found = table_of(run(best, samples).out);
    ASSERT_EQ(wanted.size(), found.size());
    for (std::size_t i = 1; i < wanted.size(); ++i)
        EXPECT_NEAR(number(found[i][2]), number(wanted[i][2]), 1e-4);
    EXPECT_EQ(run(R"({"kind": "interp_to"})", samples, {"--fit", path("response.csv")}).out, fitted.out);
}

TEST_F(SignalProgram, SaysWhatIsWrongWithAFilterAndWhere) {
    struct Bad {
        const char* filter;
        Strings parts;
    };
    const Bad all[] = {
        {R"({"kind": "sponge"})", {"filter.json", "line 1", "filter.kind", "one of", "one_euro", "sponge"}},
        {R"({"strength": 1})", {"filter.json", "kind"}},
        {"[{\"kind\": \"interp_to\"},\n {\"kind\": \"exponential_decay\", \"halflife\": -1}]",
         {"line 2", "filters.1.halflife", "expected a number from 0 to 10000, found -1"}},
        {R"({"kind": "hysteresis", "low": 2, "high": 1})", {"filter", "low", "2", "high is 1"}},
        {R"({"kind": "scale_bias_clamp", "clamp_min": 2, "clamp_max": 0.5})",
         {"filter", "clamp_min", "2", "clamp_max is 0.5"}},
        {R"({"kind": "curve", "keys": [{"time": 0}]})", {"filter.keys.0", "value"}},
        {R"({"kind": "curve", "keys": [{"time": 0, "value": 0, "piece": "round"}]})",
         {"filter.keys.0.piece", "round"}},
        {"7", {"filter", "expected an object", "7"}},
        {"{", {"filter.json", "line 1"}},
    };
    for (const Bad& bad : all) {
        const Outcome outcome = run(bad.filter, "0.1,0\n");
        EXPECT_TRUE(complained(outcome, 2, bad.parts)) << bad.filter;
        EXPECT_EQ(outcome.out, "") << bad.filter;
    }
}

TEST_F(SignalProgram, FindsColumnsByNameAndUnitAsTheLabDoes) {
    const std::string filter = R"({"kind": "interp_to"})";
    const Outcome plain = run(filter, "time,input\n0,0\n0.5,1\n");
    ASSERT_TRUE(succeeded(plain));
    for (const char* samples : {"Time (ms),Height\n0,0\n500,1\n", "Value [m],T\n0,0\n1,0.5\n"})
        EXPECT_EQ(run(filter, samples).out, plain.out) << samples;
}

TEST_F(SignalProgram, SaysWhatIsWrongWithSamplesByRowAndColumn) {
    struct Bad {
        const char* samples;
        Strings parts;
    };
    const Bad all[] = {
        {"", {"samples.csv", "no samples"}},
        {"dt,input\n", {"no samples"}},
        {"0.1,0\n0.1\n", {"row 2", "1 column", "expected 2"}},
        {"0.1,0\n0.1,\n", {"row 2", "column 2 (input)", "found nothing"}},
        {"0.1,0\n\n0.1,1\n", {"row 2", "empty"}},
        {"0.1,0\n0.1,1,2\n", {"row 2", "3 columns"}},
        {"0.1,0\n0.1,high\n", {"row 2", "column 2 (input)", "a number", "\"high\""}},
        {"0.1,0\nsoon,1\n", {"row 2", "column 1 (dt)", "\"soon\""}},
        {"0.1,nan\n", {"row 1", "column 2 (input)", "nan"}},
        {"0.1,1e300\n", {"row 1", "column 2", "-1e9 to 1e9"}},
        {"0.1;0\n", {"row 1", "columns are separated by commas", "semicolon"}},
        {"dt\tinput\n0.1\t0\n", {"row 1", "columns are separated by commas", "tab"}},
        {"time,input\n0,0\n0.2,1\n0.1,1\n", {"row 4", "column 1 (time)", "at least 0.2", "found 0.1"}},
        {"time,input\n-1e9,0\n1e9,1\n", {"row 3", "column 1 (time)", "1e9 s after"}},
        {"when,what\n0.1,0\n", {"row 1", "time", "when, what"}},
    };
    for (const Bad& bad : all) {
        const Outcome outcome = run(R"({"kind": "interp_to"})", bad.samples);
        EXPECT_TRUE(complained(outcome, 2, bad.parts)) << bad.samples;
        EXPECT_EQ(outcome.out, "") << bad.samples;
    }
    EXPECT_TRUE(complained(run_program({"signal", path("filter.json"), path("none.csv")}), 2, {"none.csv"}));
}

TEST_F(SignalProgram, AResponseHasARowForEachSample) {
    write(folder_ / "response.csv", "0\n1\n");
    const Strings fit{"--fit", path("response.csv")};
    EXPECT_TRUE(complained(run(R"({"kind": "interp_to"})", "0.1,0\n", fit), 2,
                           {"response.csv", "2 values", "expected 1"}));
    write(folder_ / "response.csv", "0\nx\n");
    EXPECT_TRUE(complained(run(R"({"kind": "interp_to"})", "0.1,0\n0.1,1\n", fit), 2,
                           {"response.csv", "row 2", "column 1 (response)"}));
    write(folder_ / "response.csv", "output\n0\nx\n");
    EXPECT_TRUE(complained(run(R"({"kind": "interp_to"})", "0.1,0\n0.1,1\n", fit), 2,
                           {"response.csv", "row 3", "column 1 (output)"}));
    Strings both = fit;
    both.push_back("--rates");
    EXPECT_EQ(run(R"({"kind": "interp_to"})", "0.1,0\n", both).exit_code, 2);
}

}  // namespace
}  // namespace tendril::test
