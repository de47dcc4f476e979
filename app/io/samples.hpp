// Samples of a signal in a CSV file: for the subcommand and the lab alike.
//
// Columns are separated by commas; what is between quotes is one field. A first row of names is optional.
// Without one, samples have exactly two columns, dt and input; with one, the columns are found by name, and a
// column `time`, which must not fall, may stand in for `dt`: the first row is then where filters start,
// whatever its time is. Empty lines at the end do not count; anything else that is not a finite number of at
// most 1e9 is refused, with its file, row and column.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <tendril/signal/run.hpp>
#include <vector>

namespace tendril::app {

inline constexpr std::size_t max_samples = 1'000'000;

/// Samples, and the time of each as the file has it: where it has dt, the time after that.
struct TimedSamples {
    std::vector<signal::Sample> samples;
    std::vector<double> times;
};

/// `name` is the file's, for messages: "samples.csv: row 3, column 2 (input): expected a number, found "x"".
/// Throws std::runtime_error. A file without a sample is refused too.
TimedSamples parse_timed_samples(std::string_view text, const std::string& name);
TimedSamples read_timed_samples(const std::filesystem::path& path);
std::vector<signal::Sample> parse_samples(std::string_view text, const std::string& name);
std::vector<signal::Sample> read_samples(const std::filesystem::path& path);

/// A response to `count` samples, one number a row: the column named output, response or value, or else the
/// last one. So what `tendril signal` printed can be fitted to.
std::vector<double> parse_response(std::string_view text, const std::string& name, std::size_t count);
std::vector<double> read_response(const std::filesystem::path& path, std::size_t count);

/// A number by the fewest digits that read back as this very double.
std::string decimal(double value);

}  // namespace tendril::app
