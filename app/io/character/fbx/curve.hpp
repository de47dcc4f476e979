// An animation curve of an FBX file: a number over time, interpolated as its keys specify.
#pragma once

#include <cstdint>
#include <vector>

#include "app/io/character/fbx/record.hpp"

namespace tendril::app::fbx {

constexpr double ticks_per_second = 46'186'158'000.0;
constexpr std::size_t max_keys = 20'000'000;  ///< in all curves together

struct CurveKey {
    enum class Shape : std::uint8_t { Constant, ConstantNext, Linear, Cubic };
    std::int64_t ticks = 0;
    double value = 0.0;
    Shape shape = Shape::Linear;                         ///< from this key to the next
    double leaving = 0.0, arriving = 0.0;                ///< slopes at this key and at the next; per second
    double leaving_weight = 0.0, arriving_weight = 0.0;  ///< tangent lengths in parts of the interval
    double time() const { return static_cast<double>(ticks) / ticks_per_second; }
};

struct Curve {
    std::vector<CurveKey> keys{};  ///< times increase
    bool is_odd = false;           ///< some keys are not fully understood

    /// Outside its keys the curve holds the first or last value.
    double at(double time) const;
};

/// Reads an AnimationCurve of version 7. Throws std::runtime_error if the numbers of times and values differ.
Curve read_curve(const Record& record);
/// Reads a channel of a version 6 take: its record Key.
Curve read_old_curve(const Record& channel);

}  // namespace tendril::app::fbx
