// A CSV file of samples, or of a response, is refused with a std::runtime_error, or its rows are finite: they
// are written and read back unchanged, filters run over them, and measures of the output are finite.
#include <cmath>

#include "app/io/samples.hpp"
#include "tendril/signal/measure.hpp"
#include "tests/fuzz/check.hpp"

using namespace tendril;
using tendril::fuzz::check;

namespace {

constexpr std::size_t max_rows = 200;

bool number(const std::optional<double>& value) {
    return !value || std::isfinite(*value);
}

void use(std::vector<signal::Sample> samples) {
    std::string text = "dt,input\n";
    for (const signal::Sample& each : samples)
        text += app::decimal(each.dt) + "," + app::decimal(each.input) + "\n";
    check(app::parse_samples(text, "again.csv").samples == samples, "what is written reads back as it was");
    if (samples.size() > max_rows) samples.resize(max_rows);
    const std::vector<double> time = signal::times_of(samples);
    std::vector<double> input;
    for (const signal::Sample& each : samples) input.push_back(each.input);
    for (const signal::Kind& kind : signal::kinds()) {
        const signal::Filter filter = kind.blank();
        const std::vector<double> output = signal::run({&filter, 1}, samples);
        for (const double each : output) check(!std::isnan(each), "what comes out is a number");
        const signal::Measures measures = signal::measure({time, input, output}, input);
        check(number(measures.lag) && number(measures.overshoot) && number(measures.settling_time) &&
                  number(measures.jitter),
              "what is measured is a number");
    }
}

}  // namespace

FUZZ_TARGET(samples) {
    std::size_t rows = 1;
    try {
        const std::vector<signal::Sample> samples = app::parse_samples(text, "rows.csv").samples;
        check(!samples.empty(), "there is a sample");
        rows = samples.size();
        use(samples);
    } catch (const std::runtime_error& error) {
        check(std::string_view(error.what()).starts_with("rows.csv: "), "a refusal names the file");
    }
    try {
        check(app::parse_response(text, "rows.csv", rows).size() == rows, "a number for each sample");
    } catch (const std::runtime_error& error) {
        check(std::string_view(error.what()).starts_with("rows.csv: "), "a refusal names the file");
    }
}
