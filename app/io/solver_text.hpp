// Solvers in words, the same everywhere: panel, microscope, race, `tendril solve`.
#pragma once

#include <string>
#include <tendril/ik/method.hpp>
#include <tendril/ik/report.hpp>

namespace tendril::app {

/// "FABRIK, accelerated"
const char* solver_title(ik::Method method);

/// What ran in a solve: "FABRIK + least squares, 3 restarts". With limits FABRIK omits its accelerated step,
/// and two bones continue from their closed form with least-squares steps.
std::string ran_text(ik::Method method, const ik::Report& report, bool within_limits);

}  // namespace tendril::app
