// The math functions that solvers use, unqualified. Not installed.
#pragma once

#include "math/point.hpp"
#include "math/rotation.hpp"
#include "math/vector.hpp"

namespace tendril::ik::detail {

using namespace tendril::math;

}  // namespace tendril::ik::detail
