// The subcommands of `tendril`, each in a source of its own: solve, code, trace, signal, lint, bake and
// paper.
#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <tendril/ik/method.hpp>
#include <vector>

#include "app/io/trace/conventions.hpp"

namespace tendril::app {

// `tendril solve`: solves the cases of a file and prints a row for each.

enum class RowFormat { Table, Csv, Json };

struct SolveOptions {
    std::string cases;                          ///< path: a list of cases, one linkage, or a scene with one
    std::vector<ik::Method> methods;            ///< each solves every case
    std::optional<int> max_iterations;          ///< 1 to 1 000 000; default 100, or 1000 for a linkage
    std::optional<float> tolerance;             ///< metres; default 1e-3 of the reach
    std::vector<std::string> drivers, targets;  ///< for linkages, as in cases.hpp
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

// `tendril code`: prints a scene as a program to standard output.

/// Prints the scene's open lab like *Copy as C++*. Throws std::runtime_error if the scene cannot be read, the
/// lab has no code, or the output cannot be written.
void print_code(const std::string& scene);

// `tendril trace`: finds the faults in a chain's motion recorded by an engine.

struct TraceOptions {
    std::string file;  ///< path; "-" for standard input
    bool json = false, csv = false;
    ConventionChoice conventions;
    std::optional<double> fps{};
};
/// Prints each incident. Returns how many there are. Throws std::runtime_error if nothing can be read, or the
/// output cannot be written.
std::size_t run_trace(const TraceOptions& options);

/// The help text.
extern const char* const trace_help;

// `tendril signal`: runs filters over the samples of a file, or fits them.

struct SignalOptions {
    std::string filters;  ///< path of FILTER.json
    std::string samples;  ///< path of SAMPLES.csv
    bool rates = false;   ///< one output for each frame rate
    std::string fit;      ///< path of RESPONSE.csv; empty: nothing is fitted
};

/// Reads and checks all files before writing anything. Stops between two rows, or two fitted kinds of filter,
/// once `ending` is set. Throws std::runtime_error if a file cannot be read or does not match signal_help, or
/// the output cannot be written.
void run_signal(const SignalOptions& options, const std::atomic<bool>& ending);

/// The subcommand's name.
extern const char* const signal_subcommand;
/// Describes the file formats and the kinds of filter, for --help.
std::string signal_help();

// `tendril lint` and `tendril bake`: check the clips of a character file, and write them with corrections.

struct LintOptions {
    std::string file;    ///< path of the character
    std::string motion;  ///< path of a file with another character's clips; empty: the character's own
    bool json = false;   ///< one JSON object instead of lines
};
/// Prints the faults of each of the file's clips. Returns the number of findings. Throws std::runtime_error
/// if the file cannot be read or the output cannot be written.
std::size_t run_lint(const LintOptions& options);

struct BakeOptions {
    std::string file;    ///< path of the character
    std::string motion;  ///< path of a file with another character's clips; empty: the character's own
    std::string clip;    ///< by name; empty: the first
    bool all = false;    ///< every clip, each to a file of its own
    std::string ground = "none";
    bool travel = false;          ///< moves a clip that walks in place at its standing foot's speed
    std::optional<double> fps{};  ///< frames per second; the clip's own by default
    std::string out;              ///< path; empty: FILE_baked beside the file
    bool force = false;           ///< replaces glTF, GLB and BVH files that exist
};
/// Names of the grounds.
std::vector<std::string> bake_grounds();
/// Writes the clip, reads it back and prints the difference. Throws std::runtime_error if the file cannot be
/// read, has no such clip, lacks the legs that a ground needs, or cannot be written.
void run_bake(const BakeOptions& options);

/// The help text.
extern const char* const lint_help;
extern const char* const bake_help;

// `tendril paper`: the rows of paper.hpp, printed as they are measured.

/// Prints a readable table, or CSV. Stops once `ending` is set and keeps the finished rows. Throws
/// std::runtime_error if the output cannot be written.
void print_paper(bool csv, const std::atomic<bool>& ending);

/// The help text.
extern const char* const paper_help;

}  // namespace tendril::app
