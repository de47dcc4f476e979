// `tendril solve`: cases from a file, solved, one row of the answer after another.
#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <tendril/ik/method.hpp>
#include <vector>

namespace tendril::app {

enum class RowFormat { Table, Csv, Json };

struct SolveOptions {
    std::string cases;                ///< path
    std::vector<ik::Method> methods;  ///< each case by each of them
    int max_iterations = 100;         ///< 1 to 1 000 000
    std::optional<float> tolerance;   ///< metres; 1e-3 of the reach if left out
    RowFormat format = RowFormat::Table;
};

/// What the command line calls the solvers: a name, or "all". Throws std::runtime_error that lists the names.
std::vector<ik::Method> methods_named(const std::string& name);

/// The whole file is read and checked before the first case is solved. Stops between two solves once `ending`
/// is set: what is done is written, and whole. Throws std::runtime_error where the file cannot be read or is
/// not as cases.hpp has it, or the output cannot be written.
void solve_cases(const SolveOptions& options, const std::atomic<bool>& ending);

/// How the file is written, for --help.
extern const char* const solve_help;

}  // namespace tendril::app
