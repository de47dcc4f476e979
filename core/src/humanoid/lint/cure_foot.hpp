// The cure of a foot that slides, floats or sinks. Not installed.
#pragma once

#include "humanoid/lint/lint.hpp"

namespace tendril::humanoid::lint_detail {

/// The clip with that foot standing. Refuses a finding that is not one of the clip's.
Expected<Clip> cure_foot(const Check& check, const Finding& finding);

}  // namespace tendril::humanoid::lint_detail
