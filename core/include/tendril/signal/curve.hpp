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

#include "tendril/result.hpp"
#include "tendril/signal/input.hpp"

namespace tendril::signal {

/// How the curve goes on from a key to the next.
enum class Piece : std::uint8_t {
    Constant,  ///< keeps the key's value
    Linear,    ///< straight
    Cubic      ///< Hermite's cubic by the tangents of the two keys
};
/// "constant", "linear", "cubic"
const char* name(Piece piece) noexcept;

/// All numbers from -1e9 to 1e9.
struct CurveKey {
    double time = 0.0;    ///< 0 to 1 is where source_min to source_max comes in; keys may lie beyond
    double value = 0.0;   ///< 0 to 1 goes out as target_min to target_max; may lie beyond
    double arrive = 0.0;  ///< slope of a cubic piece that ends here, value per time
    double leave = 0.0;   ///< slope of a cubic piece that begins here
    Piece piece = Piece::Linear;
    bool operator==(const CurveKey&) const = default;
};

struct Curve {
    /// By time, no two at the same; one at least.
    std::vector<CurveKey> keys{{.time = 0.0, .value = 0.0}, {.time = 1.0, .value = 1.0}};
    double source_min = 0.0, source_max = 1.0;  ///< of zero width: every value counts as source_min
    double target_min = 0.0, target_max = 1.0;  ///< may be reversed
    bool operator==(const Curve&) const = default;
};

/// InvalidArgument where there is no key, times are unsorted or equal, or a number is not finite or out of
/// its range; the message names the key: `curve: keys[2].time must be over the time before it, 0.5, got
/// 0.25`.
Result check(const Curve& curve) noexcept;

/// The value at a time, both as the keys have them: before the first key and after the last their values.
/// 0 where there is no key.
double evaluate_keys(const Curve& curve, double time) noexcept;

/// From source range to 0..1 (beyond it as well), through the keys, from 0..1 to the target range. `value` as
/// in input.hpp; what is refused there counts as source_min.
double evaluate(const Curve& curve, double value) noexcept;

/// As a filter: the first step, and any other, returns evaluate(input).
double step(const Curve& parameters, OutputState& state, double input, double dt) noexcept;

/// Slopes that make the curve smooth: at every key the slope between its neighbours (Catmull-Rom), but flat
/// at the ends and at local extremes, so that nothing goes beyond the keys there.
void set_smooth_tangents(Curve& curve) noexcept;

}  // namespace tendril::signal
