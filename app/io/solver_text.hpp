// Solvers in words, the same wherever one reads them: panel, microscope, race, `tendril solve`.
#pragma once

#include <string>
#include <tendril/ik/method.hpp>
#include <tendril/ik/report.hpp>

namespace tendril::app {

/// "FABRIK, accelerated"
const char* solver_title(ik::Method method);

/// What ran in a solve: "FABRIK + least squares, 3 restarts". Within limits FABRIK goes without its
/// accelerated step, and two bones take least-squares steps from their closed form on.
std::string ran_text(ik::Method method, const ik::Report& report, bool within_limits);

}  // namespace tendril::app
