// Arms with limits, and solvers for them.
#pragma once

#include "ik_limit_support.hpp"
#include "ik_support.hpp"

namespace tendril::test {

inline KeptSolver Arm::solver() const {
    return KeptSolver(lengths, rest);
}

}  // namespace tendril::test
