// The cure of a foot that slides, floats or sinks. Not installed.
#pragma once

#include "humanoid/lint/lint.hpp"

namespace tendril::humanoid::lint_detail {

struct FootCure {
    double ease = 0.15;     ///< seconds of blending into the clip before and after
    double nearer = 0.005;  ///< metres that soft IK brings a foot nearer to the hip at a leg's full length
};

/// The clip with that foot standing. Refuses a finding that is not one of the clip's.
Expected<Clip> cure_foot(const Check& check, const Finding& finding, const FootCure& how);

}  // namespace tendril::humanoid::lint_detail
