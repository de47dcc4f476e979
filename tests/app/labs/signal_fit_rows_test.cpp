// The Signal lab must play and fit the same rows.
#include <cmath>

#include "app/labs/signal/signal_part.hpp"
#include "tests/app/labs/lab_support.hpp"
#include "tests/app/support/temp_folder.hpp"

namespace tendril::app {
namespace {

class SignalFitRows : public LabTest {
  protected:
    SignalFitRows() : LabTest(signal_lab) {}
    const SignalPart& part() const { return signal_part(workspace); }
    void wait(int ticks) {
        for (int i = 0; i < ticks; ++i) lab().step(workspace);
    }
};

TEST_F(SignalFitRows, AreThoseThatAreTicked) {
    const test::TempFolder folder;
    std::string samples = "dt,input\n", response = "output\n";
    for (int i = 0; i < 150; ++i)
        samples += "0.016666666666666666," + std::to_string(std::sin(0.21 * i) + (i / 40) % 2) + "\n";
    test::write(folder / "in.csv", samples);
    const Json inputs[] = {{{"kind", "square"}, {"period", 1}},
                           {{"kind", "noise"}, {"period", 1}},
                           {{"kind", "csv"}, {"path", (folder / "in.csv").string()}}};
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
                played.push_back(state().at("input").get<double>());
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
    test::write(folder / "out.csv", response);
    run("signal.fit", {{"to", (folder / "out.csv").string()}});
    EXPECT_STREQ(signal::kind(part().fits.front().filter), "rate_limit") << "a row of the file for each tick";
    EXPECT_LT(part().fits.front().residual, 1e-6);
}

}  // namespace
}  // namespace tendril::app
