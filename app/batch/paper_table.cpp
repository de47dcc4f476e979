#include "app/batch/subcommands.hpp"

#include <cstdio>
#include <string>

#include "app/batch/output.hpp"
#include "app/batch/paper.hpp"

namespace tendril::app {
namespace {

template <class... Values>
std::string formatted(const char* format, Values... values) {
    char text[256];
    std::snprintf(text, sizeof text, format, values...);
    return text;
}

std::string head(bool csv) {
    if (csv) {
        return "targets,solver,solved,mean_iterations,median_iterations,microseconds_per_solve,"
               "nanoseconds_per_iteration\n";
    }
    return formatted("%zu bones of %g m, %zu targets of each kind, tolerance %g m, at most %d iterations\n\n",
                     paper_bones, static_cast<double>(paper_bone_length), paper_count,
                     static_cast<double>(paper_tolerance), paper_iterations) +
           "                                            iterations           time\n"
           "targets      solver                solved     mean  median   µs/solve  ns/iteration\n";
}

std::string row_text(const PaperTargets& targets, ik::Method method, const PaperRow& row, bool csv) {
    const std::string each = row.nanoseconds ? formatted("%.1f", *row.nanoseconds) : csv ? "" : "-";
    return formatted(csv ? "%s,%s,%.4f,%.3f,%g,%.3f,%s\n" : "%-11s  %-18s  %7.1f%% %8.2f %7g %10.2f %13s\n",
                     targets.name, ik::name(method), csv ? row.solved : 100.0 * row.solved,
                     row.mean_iterations, row.median_iterations, row.microseconds, each.c_str());
}

}  // namespace

void print_paper(bool csv, const std::atomic<bool>& ending) {
    Progress progress;
    Output out(progress);
    out.write(head(csv));
    const std::size_t rows = 2 * paper_methods().size();
    std::size_t done = 0;
    for (const PaperTargets& targets : {reachable_targets(), unreachable_targets()}) {
        for (const ik::Method method : paper_methods()) {
            const auto row = measure(targets, paper_solver(method), [&](double part) {
                const double all = (static_cast<double>(done) + part) / static_cast<double>(rows);
                progress.show("measuring", all);
                return !ending;
            });
            if (!row) break;
            out.write(row_text(targets, method, *row, csv));
            ++done;
        }
        if (ending) break;
    }
    out.finish();
    if (done < rows) std::fprintf(stderr, "tendril: stopped after %zu of %zu rows\n", done, rows);
}

const char* const paper_help =
    "Repeats the comparison of Aristidou and Lasenby, \"FABRIK: A fast, iterative solver for the Inverse\n"
    "Kinematics problem\" (2011), on this machine: ten joints that turn freely, targets at 0.05 to 0.95 of "
    "the\n"
    "reach and at 1.05 to 2 times the reach, the same random poses to start from for every solver. Solved\n"
    "means within tolerance, or, out of reach, straight; all solvers here detect that without iterating,\n"
    "where the paper's solvers continue. Times are from the fastest of three rounds. Ctrl+C keeps the rows "
    "done so far.";

}  // namespace tendril::app
