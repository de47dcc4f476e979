// Solver names and results as text, the same everywhere: panel, microscope, race, `tendril solve`, traces.
#pragma once

#include <span>
#include <string>
#include <tendril/ik/method.hpp>
#include <tendril/ik/report.hpp>

namespace tendril::app {

/// Throws std::runtime_error that begins with `where` and lists the names.
ik::Method method_from_name(const std::string& name, const std::string& where);
/// By ik::Method.
std::span<const char* const> solver_names();
/// "fabrik, fabrik_plain, ccd, ..."
std::string method_names();

/// "FABRIK, accelerated"
const char* solver_title(ik::Method method);

/// How a solve ended: "converged", "out of reach", "did not converge" within its iterations.
const char* outcome_name(ik::Status status);

/// The solvers that ran in a solve: "FABRIK, accelerated + least squares, 3 restarts", or "FABRIK,
/// accelerated, 1 perturbation" for a chain that had stalled or was collinear. Methods keep their names with
/// limits, although FABRIK then omits its accelerated step and two bones continue with least-squares steps.
std::string ran_text(ik::Method method, const ik::Report& report);

}  // namespace tendril::app
