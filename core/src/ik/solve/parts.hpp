// The internals of a Solver. Not installed.
#pragma once

#include "ik/solve/problem.hpp"
#include "tendril/ik/solver.hpp"

namespace tendril::ik {

struct Solver::Parts {
    detail::Workspace scratch;
};

}  // namespace tendril::ik
