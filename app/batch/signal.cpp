#include "app/batch/subcommands.hpp"

#include <algorithm>
#include <cstdio>
#include <tendril/signal/run.hpp>

#include "app/batch/output.hpp"
#include "app/io/json_complete.hpp"
#include "app/io/samples.hpp"
#include "app/labs/signal/filter_json.hpp"
#include "app/labs/signal/fit.hpp"

namespace tendril::app {
namespace {

using Filters = std::vector<signal::Filter>;
using SignalSamples = std::vector<signal::Sample>;

constexpr std::size_t max_filters = 64;

Filters read_filters(const std::string& path) {
    const std::string text = read_text_file(path);
    try {
        const Json json = parse_json(text);
        const char* const where = json.is_array() ? "filters" : "filter";
        try {
            return filters_from_json({json, where}, max_filters);
        } catch (const ParseError&) {
            throw;
        } catch (const std::runtime_error& error) {
            throw std::runtime_error(with_line(text, where, error.what()));
        }
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(path + ": " + error.what());
    }
}

/// Writes rows until `ending` is set.
class SampleRows {
  public:
    SampleRows(const TimedSamples& rows, const std::atomic<bool>& ending)
        : rows_(rows), ending_(ending), out_(progress_) {}

    void write(const std::string& outputs, auto output_of) {
        out_.write("time,input," + outputs + "\n");
        for (std::size_t i = 0; i < rows_.samples.size() && !ending_; ++i) {
            out_.write(decimal(rows_.times[i]) + "," + decimal(rows_.samples[i].input) + "," + output_of(i) +
                       "\n");
        }
        out_.finish();
    }

  private:
    const TimedSamples& rows_;
    const std::atomic<bool>& ending_;
    Progress progress_;
    Output out_;
};

void print_outputs(const Filters& filters, const TimedSamples& rows, const std::atomic<bool>& ending) {
    std::vector<signal::FilterState> states(filters.size());
    SampleRows(rows, ending).write("output", [&](std::size_t i) {
        return decimal(signal::step(filters, states, rows.samples[i].input, rows.samples[i].dt));
    });
}

/// "output_15", "output_60_jittered".
std::string column_name(const signal::FrameRate& rate) {
    return "output_" + decimal(rate.hz) + (rate.jittered ? "_jittered" : "");
}

void print_rates(const Filters& filters, const TimedSamples& rows, const std::atomic<bool>& ending) {
    const SignalSamples& samples = rows.samples;
    std::string names;
    for (const signal::FrameRate& rate : signal::usual_rates())
        names.append(names.empty() ? "" : ",").append(column_name(rate));
    const std::vector<std::vector<double>> outputs =
        signal::outputs_at(filters, samples, signal::times_of(samples));
    SampleRows(rows, ending).write(names, [&](std::size_t i) {
        std::string text;
        for (const auto& each : outputs) text.append(text.empty() ? "" : ",").append(decimal(each[i]));
        return text;
    });
    const double begin = rows.times.front() - std::max(samples.front().dt, 0.0);
    const signal::RateComparison comparison = signal::compare_rates(filters, samples);
    std::fprintf(stderr, "maximum difference between the rates: %s at %s s\n",
                 decimal(comparison.difference).c_str(), decimal(comparison.at + begin).c_str());
}

/// The given filter of this kind, where the fit starts; null if there is none.
const signal::Filter* initial_filter(const Filters& filters, const signal::Kind& kind) {
    const auto found = std::find_if(filters.begin(), filters.end(), [&](const signal::Filter& filter) {
        return &signal::kind_of(filter) == &kind;
    });
    return found == filters.end() ? nullptr : &*found;
}

void print_fits(const Filters& filters, const SignalSamples& samples, const std::vector<double>& response,
                const std::atomic<bool>& ending) {
    const FitProblem problem{samples, response};
    const auto kinds = signal::kinds();
    std::vector<Fit> fits;
    Progress progress;
    for (std::size_t i = 0; i < kinds.size() && !ending; ++i) {
        progress.show("fitting", static_cast<double>(i) / static_cast<double>(kinds.size()));
        fits.push_back(fit_kind(kinds[i], problem, initial_filter(filters, kinds[i])));
    }
    rank(fits);
    Output out(progress);
    out.write("kind,residual,filter\n");
    for (const Fit& fit : fits) {
        out.write(std::string(signal::kind(fit.filter)) + "," + decimal(fit.residual) + "," +
                  csv_field(filter_json(fit.filter).dump()) + "\n");
    }
    out.finish();
    progress.clear();
    if (ending) std::fprintf(stderr, "tendril: stopped after %zu kinds of filter\n", fits.size());
}

}  // namespace

void run_signal(const SignalOptions& options, const std::atomic<bool>& ending) {
    const Filters filters = read_filters(options.filters);
    const TimedSamples rows = read_samples(options.samples);
    if (!options.fit.empty())
        print_fits(filters, rows.samples, read_response(options.fit, rows.samples.size()), ending);
    else if (options.rates)
        print_rates(filters, rows, ending);
    else
        print_outputs(filters, rows, ending);
}

const char* const signal_subcommand = "signal";

std::string signal_help() {
    return "Kinds: " + kind_names() +
           ".\n"
           R"(FILTER is a filter, or a list of up to 64 that are applied in order:
  {"kind": "spring", "strength": 4, "critical_damping": 0.5}
Omitted keys take their defaults; keys that the kind does not have are ignored.
SAMPLES is a CSV file, one row per sample: dt,input. dt is the time in seconds since
the previous row; a row whose dt is not over 0 changes nothing. A first row may name
the columns: dt, or time, which must not decrease, in s, ms or us as in time [ms];
and input or value. Of two columns, the one that is not the time is the input. Prints
rows of time,input,output.
--rates prints one output for each frame rate (15, 30, 60 and 144 Hz, and 60 Hz
with uneven frames), and on stderr the maximum difference between them.
--fit finds for every kind of filter the parameters whose output comes closest to
RESPONSE, and prints kind,residual,filter, the best first. RESPONSE has one row per
sample; its column output, response or value is used, or else its last. The residual
is the root mean square error as a fraction of the response's range. For the kinds in
FILTER, the search also starts from the parameters there.
A missing value, text, or a number out of range is reported with its file, row and
column, and nothing is printed (exit code 2).
To open a scene file that is named signal, write ./signal.)";
}

}  // namespace tendril::app
