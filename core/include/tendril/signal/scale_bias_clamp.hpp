// Maps a number to another range, clamps it and eases to it: the node Alpha Interpolate of animation graphs.
//
// The stages, in order: map_range, scale and bias, clamp, interp. Cost: a few ns.
#pragma once

#include <array>

#include "tendril/fields.hpp"
#include "tendril/signal/input.hpp"

namespace tendril::signal {

/// Numbers from -1e9 to 1e9, speeds from -1e6 to 1e6.
struct ScaleBiasClamp {
    /// 1. Maps in_range to out_range, both {low, high}, and extrapolates linearly beyond; an in_range of zero
    ///    width maps to the low end of out_range.
    bool map_range = false;
    std::array<double, 2> in_range{0.0, 1.0};
    std::array<double, 2> out_range{0.0, 1.0};
    /// 2. Always: `value * scale + bias`.
    double scale = 1.0;
    double bias = 0.0;
    /// 3. Clamps to [clamp_min, clamp_max]; clamp_min must not exceed clamp_max.
    bool clamp = false;
    double clamp_min = 0.0;
    double clamp_max = 1.0;
    /// 4. interp_to from the last output (interpolate.hpp); speeds in 1/s.
    bool interp = false;
    double speed_increasing = 10.0;
    double speed_decreasing = 10.0;
    bool operator==(const ScaleBiasClamp&) const = default;
};

/// The first step returns the result of the first three stages, without interpolation.
double step(const ScaleBiasClamp& parameters, OutputState& state, double input, double dt,
            Result* why = nullptr) noexcept;

}  // namespace tendril::signal

template <>
std::span<const tendril::Field> tendril::fields<tendril::signal::ScaleBiasClamp>() noexcept;
