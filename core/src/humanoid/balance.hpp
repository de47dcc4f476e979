// Support from known heights of the soles over the ground. Not installed.
#pragma once

#include "tendril/humanoid/balance.hpp"

namespace tendril::humanoid::detail {

/// Heights over the ground, metres; max_magnitude where there is none.
struct SoleHeights {
    double heel = 0.0, toe = 0.0;
};
std::array<SoleHeights, 2> sole_heights(const std::array<SolePoints, 2>& at, const Ground* ground) noexcept;

Support find_support(const Soles& soles, const std::array<SolePoints, 2>& at,
                     const std::array<SoleHeights, 2>& over) noexcept;

}  // namespace tendril::humanoid::detail
