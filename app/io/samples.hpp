// Reads samples of a signal from CSV files, for the subcommand and the lab.
//
// Columns are separated by commas; quotes enclose a field. The first row may name them, in any case and with
// a unit in brackets: the time is in dt, time, t, seconds or the like, the value in input, value, x, y or the
// like; of two columns, the value is the one that is not the time. Without names, samples have two columns,
// dt and input. Times must not decrease; filters start at the first row, whatever its time. Empty lines at
// the end are ignored; any other value that is not a finite number of at most 1e9 is refused, with its file,
// row and column.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <tendril/signal/run.hpp>
#include <vector>

namespace tendril::app {

inline constexpr std::size_t max_samples = 1'000'000;

/// Samples, and their times as in the file; if it has dt, the times at the end of each dt.
struct TimedSamples {
    std::vector<signal::Sample> samples;
    std::vector<double> times;
};

/// Which columns to read, by name or by number from 1; empty: found by their usual names.
struct ColumnChoice {
    std::string time, value;
};

/// `name` is the file's, for messages: "samples.csv: row 3, column 2 (input): expected a number, found "x"".
/// Throws std::runtime_error, with a list of the columns if they do not determine which to read. Refuses a
/// file without samples.
TimedSamples parse_samples(std::string_view text, const std::string& name, const ColumnChoice& choice = {});
TimedSamples read_samples(const std::filesystem::path& path, const ColumnChoice& choice = {});

/// A response to `count` samples, one number per row: the column named output, response or value, or else the
/// last one. This lets the output of `tendril signal` be fitted.
std::vector<double> parse_response(std::string_view text, const std::string& name, std::size_t count);
std::vector<double> read_response(const std::filesystem::path& path, std::size_t count);

/// The number with the fewest digits that reads back as exactly this double.
std::string decimal(double value);

}  // namespace tendril::app
