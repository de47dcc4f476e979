// A curve through keys, as animators draw it: maps a value rather than filtering it.
//
//     signal::Curve ease{.keys = {{.time = 0, .value = 0, .piece = signal::Piece::Cubic},
//                                 {.time = 1, .value = 1}},
//                        .source_min = 0, .source_max = 90};
//     alpha = signal::evaluate(ease, angle);
//
// Cost: O(log keys).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tendril/fields.hpp"
#include "tendril/result.hpp"
#include "tendril/signal/input.hpp"

namespace tendril::signal {

/// How the curve continues from a key to the next.
enum class Piece : std::uint8_t {
    Constant,  ///< keeps the key's value
    Linear,    ///< straight
    Cubic      ///< cubic Hermite with the tangents of the two keys
};
/// "constant", "linear", "cubic"
const char* name(Piece piece) noexcept;

/// All numbers from -1e9 to 1e9.
struct CurveKey {
    double time = 0.0;    ///< 0 to 1 spans source_min to source_max; keys may lie beyond
    double value = 0.0;   ///< 0 to 1 maps to target_min to target_max; may lie beyond
    double arrive = 0.0;  ///< slope of a cubic piece that ends here, value per time
    double leave = 0.0;   ///< slope of a cubic piece that begins here
    Piece piece = Piece::Linear;
    bool operator==(const CurveKey&) const = default;
};

struct Curve {
    /// Sorted by time, all different; at least one.
    std::vector<CurveKey> keys{{.time = 0.0, .value = 0.0}, {.time = 1.0, .value = 1.0}};
    double source_min = 0.0, source_max = 1.0;  ///< if equal, every value is taken as source_min
    double target_min = 0.0, target_max = 1.0;  ///< may be reversed
    bool operator==(const Curve&) const = default;
};

/// InvalidArgument if there is no key, if times are unsorted or equal, or if a number is not finite or out of
/// its range. The message names the key: `curve: keys[2].time must be over the time of the key before it, got
/// 0.25`.
Result check(const Curve& curve) noexcept;

/// The value at a time, both in the units of the keys. Constant before the first key and after the last; 0
/// without keys.
double evaluate_keys(const Curve& curve, double time) noexcept;

/// Maps the source range to 0..1 (extrapolating), evaluates the keys, and maps 0..1 to the target range. A
/// value that input.hpp refuses is taken as source_min.
double evaluate(const Curve& curve, double value) noexcept;

/// As a filter: every step, including the first, returns evaluate(input).
double step(const Curve& parameters, OutputState& state, double input, double dt,
            Result* why = nullptr) noexcept;

/// Sets slopes that make the curve smooth: at each key the slope between its neighbours (Catmull-Rom), but 0
/// at the ends and at local extremes, so that the curve does not overshoot the keys there.
void set_smooth_tangents(Curve& curve) noexcept;

}  // namespace tendril::signal

namespace tendril {
template <>
std::span<const Field> fields<signal::CurveKey>() noexcept;
/// All fields, the keys first.
template <>
std::span<const Field> fields<signal::Curve>() noexcept;
}  // namespace tendril
