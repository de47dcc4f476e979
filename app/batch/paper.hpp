// The comparison of A. Aristidou and J. Lasenby, "FABRIK: A fast, iterative solver for the Inverse Kinematics
// problem", Graphical Models 73(5), 2011, repeated on this machine: a chain of ten joints that turn freely,
// so of ten bones, targets within reach and out of it, one tolerance for all. Here each target has a random
// pose to start from, the same for every solver.
//
// This file measures and needs the library only; the program and a benchmark print the rows.
#pragma once

#include <cstddef>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
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
    ik::Status solved;  ///< what a solver that does its work says
    std::vector<glm::vec3> targets;
    std::vector<glm::vec3> starts;  ///< paper_bones + 1 joints for each target
};

/// At 0.05 to 0.95 of the reach, and at 1.05 to 2 times the reach; the same everywhere and always.
PaperTargets reachable_targets();
PaperTargets unreachable_targets();

/// From the pose in `joints`, which it leaves solved.
using PaperSolve = std::function<ik::Report(std::span<glm::vec3> joints, glm::vec3 target)>;
PaperSolve paper_solver(ik::Method method);
/// The rows' solvers, in their order.
std::span<const ik::Method> paper_methods();

struct PaperRow {
    double solved = 0.0;  ///< part of the targets
    double mean_iterations = 0.0, median_iterations = 0.0;
    double microseconds = 0.0;  ///< a solve
    /// An iteration; none where nothing was iterated.
    std::optional<double> nanoseconds;
};

/// Solves all targets, several times over for a steadier clock. `go_on` is told how far it is, 0 to 1; where
/// it returns false there is no row.
std::optional<PaperRow> measure(const PaperTargets& targets, const PaperSolve& solve,
                                const std::function<bool(double)>& go_on);

}  // namespace tendril::app
