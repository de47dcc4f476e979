// Real CSV files: columns found by their names, by their positions, or as chosen.
#include "app/io/samples.hpp"
#include "app/labs/signal/signal_part.hpp"
#include "tests/app/labs/lab_support.hpp"
#include "tests/app/support/panel_text.hpp"
#include "tests/app/support/temp_folder.hpp"
#include "tests/says.hpp"

namespace tendril::app {
namespace {

class SignalCsv : public LabTest {
  protected:
    SignalCsv() : LabTest(signal_lab) {}
    Json file(const std::string& text, Json more = Json::object()) {
        test::write(folder_ / "rows.csv", text);
        more["kind"] = "csv";
        more["path"] = (folder_ / "rows.csv").string();
        return more;
    }
    std::vector<double> values() const {
        std::vector<double> all;
        for (const signal::Sample& row : *workspace.document.get<SignalPart>(signal_lab).input.file)
            all.push_back(row.input);
        return all;
    }
    test::TempFolder folder_;
};

TEST_F(SignalCsv, ColumnsAreFoundByNameOrAreTheOtherOfTwo) {
    const std::vector<double> wanted{1, -2};
    for (const char* text :
         {"dt,input\n0.1,1\n0.1,-2\n", "0.1,1\n0.1,-2\n", "time,value\n0,1\n0.5,-2\n",
          "t,x,y\n0,1,9\n1,-2,9\n", "Time (s),Value [mm]\n0,1\n0.5,-2\n", "left,Seconds\n1,0\n-2,0.5\n",
          "frame,t,y\n7,0,1\n8,1,-2\n", "\"t\",\"height, in metres\"\n0,1\n1,-2\n"}) {
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
