// Reads tables of numbers from other programs: samples of a signal, from CSV files, for the subcommand and
// the lab; and points, from any copied text.
//
// In a CSV file, commas separate columns; quotes enclose a field. The first row may name the columns, in any
// case and with a unit in brackets: the time is in dt, time, t, seconds or the like, the value in input,
// value, x, y or the like; of two columns, the value is the one that is not the time. Without names, samples
// have two columns, dt and input. Times must not decrease; filters start at the first row, whatever its time.
// Empty lines at the end are ignored; any other value that is not a finite number of at most 1e9 is refused,
// with its file, row and column.
#pragma once

#include <cstddef>
#include <filesystem>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <tendril/signal/run.hpp>
#include <vector>

namespace tendril::app {

inline constexpr std::size_t max_samples = 1'000'000;

/// Samples, and their times as in the file; if the file has dt, the times at the end of each dt.
struct TimedSamples {
    std::vector<signal::Sample> samples;
    std::vector<double> times;
};

/// Which columns to read, by name or by number from 1; empty: find them by their usual names.
struct ColumnChoice {
    std::string time, value;
};

/// `name` is the file's, for messages: "samples.csv: row 3, column 2 (input): expected a number, found "x"".
/// Throws std::runtime_error, with a list of the columns if it is unclear which to read. Refuses a file
/// without samples.
TimedSamples parse_samples(std::string_view text, const std::string& name, const ColumnChoice& choice = {});
TimedSamples read_samples(const std::filesystem::path& path, const ColumnChoice& choice = {});

/// A response to `count` samples, one number per row: the column named output, response or value, or else the
/// last one. This lets the output of `tendril signal` be fitted.
std::vector<double> parse_response(std::string_view text, const std::string& name, std::size_t count);
std::vector<double> read_response(const std::filesystem::path& path, std::size_t count);

/// The number with the fewest digits that reads back as exactly this double.
std::string decimal(double value);

// Reads points from text that was copied anywhere: a table, a spreadsheet, JSON, or source code.
//
// A row is three numbers, on a line of their own or in brackets of their own. Spaces, tabs, commas and
// semicolons separate numbers; (), [] and {} may nest; x=, Y=, "z": name coordinates; constructors such as
// Vector3(1, 2, 3), vec3(...) and new Vector3(1f, 2f, 3f) are read like brackets. A first line "x y z" is
// skipped. Anything else, and any number that is not finite and at most 1e9 in magnitude, is refused.

/// At least one and at most `most` points. Throws std::runtime_error with the line, from 1, and what was
/// found there: `line 3: expected three numbers, found two`.
std::vector<glm::vec3> read_points(std::string_view text, std::size_t most);

inline constexpr std::size_t max_pasted_points = 10'000;

}  // namespace tendril::app
