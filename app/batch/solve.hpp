// `tendril solve`: solves the cases of a file and prints a row for each.
#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <tendril/ik/method.hpp>
#include <vector>

namespace tendril::app {

enum class RowFormat { Table, Csv, Json };

struct SolveOptions {
    std::string cases;                          ///< path: a list of cases, one linkage, or a scene with one
    std::vector<ik::Method> methods;            ///< each case is solved by each of them
    std::optional<int> max_iterations;          ///< 1 to 1 000 000; if left out 100, or 1000 for a linkage
    std::optional<float> tolerance;             ///< metres; 1e-3 of the reach if left out
    std::vector<std::string> drivers, targets;  ///< for linkages, as in linkage_cases.hpp
    RowFormat format = RowFormat::Table;
};

/// The solver of that name, or all for "all". Throws std::runtime_error that lists the names.
std::vector<ik::Method> methods_named(const std::string& name);

/// Reads and checks the whole file before solving the first case. Stops between two solves once `ending` is
/// set; the finished rows form valid output. Throws std::runtime_error if the file cannot be read or does not
/// match cases.hpp, or the output cannot be written.
void solve_cases(const SolveOptions& options, const std::atomic<bool>& ending);

/// Describes the file format, for --help.
extern const char* const solve_help;

}  // namespace tendril::app
