// Repeats the comparison of A. Aristidou and J. Lasenby, "FABRIK: A fast, iterative solver for the Inverse
// Kinematics problem", Graphical Models 73(5), 2011, on this machine: a chain of ten free joints, hence ten
// bones, reachable and unreachable targets, one tolerance for all. Here each target starts from a random
// pose, the same for every solver.
//
// This file only measures, and depends only on the library; the program and a benchmark print the rows.
#pragma once

#include <cstddef>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <tendril/ik/method.hpp>
#include <tendril/ik/report.hpp>
#include <vector>

namespace tendril::app {

inline constexpr std::size_t paper_bones = 10;
inline constexpr float paper_bone_length = 0.1f;  ///< metres
inline constexpr float paper_tolerance = 1e-3f;   ///< metres
inline constexpr int paper_iterations = 1000;     ///< at most
inline constexpr std::size_t paper_count = 1000;  ///< targets of each kind

struct PaperTargets {
    const char* name;   ///< "reachable", "unreachable"
    ik::Status solved;  ///< the status of a successful solve
    std::vector<glm::vec3> targets;
    std::vector<glm::vec3> starts;  ///< paper_bones + 1 joints for each target
};

/// Targets at 0.05 to 0.95 and at 1.05 to 2 times the reach; the same on every platform.
PaperTargets reachable_targets();
PaperTargets unreachable_targets();

/// Solves the pose in `joints` in place.
using PaperSolve = std::function<ik::Report(std::span<glm::vec3> joints, glm::vec3 target)>;
PaperSolve paper_solver(ik::Method method);
/// The solvers, in the order of the rows.
std::span<const ik::Method> paper_methods();

struct PaperRow {
    double solved = 0.0;  ///< fraction of the targets
    double mean_iterations = 0.0, median_iterations = 0.0;
    double microseconds = 0.0;  ///< per solve
    /// Per iteration; none if there were no iterations.
    std::optional<double> nanoseconds;
};

/// Solves all targets, several times for stable timings. `progress` gets the progress, 0 to 1; if it returns
/// false there is no row.
std::optional<PaperRow> measure(const PaperTargets& targets, const PaperSolve& solve,
                                const std::function<bool(double)>& progress);

}  // namespace tendril::app
