// Mends keys that glTF forbids but files contain: before 0 s, two at one time, rotations of length 0.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <tendril/humanoid/clip.hpp>
#include <tendril/rig/transform.hpp>
#include <vector>

namespace tendril::app {

/// How many keys were dropped, and why.
struct DroppedKeys {
    std::size_t early = 0, doubled = 0, zero = 0;
    std::string first{};  ///< where the first was

    bool any() const { return early + doubled + zero > 0; }
};

namespace detail {

inline double between(double a, double b, double t) {
    return a + (b - a) * t;
}
inline glm::dvec3 between(const glm::dvec3& a, const glm::dvec3& b, double t) {
    return a + (b - a) * t;
}
inline glm::dquat between(const glm::dquat& a, const glm::dquat& b, double t) {
    return rig::blend(a, b, t);
}
inline double length_to_unit(const glm::dquat& value) {
    const double length = glm::length(value);
    return length > 0.0 ? 1.0 / length : 1.0;
}
template <class Value>
double length_to_unit(const Value&) {
    return 1.0;
}

/// The key at 0 s on a curve between a key before 0 s and the next one, after it. `n` values per key, or 3 n
/// for a cubic: in-tangents, values, out-tangents. The rest of a cubic does not change: both new tangents are
/// its derivative at 0 s.
template <class Value>
std::vector<Value> key_at_zero(const std::vector<double>& times, const std::vector<Value>& values,
                               std::size_t n, humanoid::Interpolation interpolation) {
    using humanoid::Interpolation;
    std::vector<Value> key;
    const double d = times[1] - times[0], t = -times[0] / d;
    if (interpolation != Interpolation::Cubic) {
        for (std::size_t i = 0; i < n; ++i)
            key.push_back(interpolation == Interpolation::Step ? values[i]
                                                               : between(values[i], values[n + i], t));
        return key;
    }
    key.resize(3 * n, values[0]);
    for (std::size_t i = 0; i < n; ++i) {
        const Value &a = values[n + i], &b = values[4 * n + i];
        const Value out = values[2 * n + i] * d, in = values[3 * n + i] * d;
        const double tt = t * t, ttt = tt * t;
        const Value at = a * (2.0 * ttt - 3.0 * tt + 1.0) + out * (ttt - 2.0 * tt + t) +
                         b * (3.0 * tt - 2.0 * ttt) + in * (ttt - tt);
        const Value speed = (a * (6.0 * tt - 6.0 * t) + out * (3.0 * tt - 4.0 * t + 1.0) +
                             b * (6.0 * t - 6.0 * tt) + in * (3.0 * tt - 2.0 * t)) *
                            (1.0 / d);
        const double unit = length_to_unit(at);
        key[n + i] = at * unit;
        key[i] = key[2 * n + i] = speed * unit;
    }
    return key;
}

}  // namespace detail

/// `values` has the same number of values for each key. Among keys at one time, the last one stays. Keys
/// before 0 s are replaced by one at 0 s, with the curve's value there. `is_zero` tells which keys, by the
/// index of their first value, have no rotation.
template <class Value, class IsZero>
void drop_bad_keys(std::vector<double>& times, std::vector<Value>& values,
                   humanoid::Interpolation interpolation, const IsZero& is_zero, DroppedKeys& dropped) {
    if (times.empty() || values.size() % times.size() != 0) return;
    const std::size_t width = values.size() / times.size();
    std::size_t kept = 0;
    for (std::size_t i = 0; i < times.size(); ++i) {
        const bool zero = is_zero(i * width), doubled = i + 1 < times.size() && times[i] == times[i + 1];
        if (zero || (doubled && !is_zero((i + 1) * width))) {
            ++(zero ? dropped.zero : dropped.doubled);
            continue;
        }
        if (kept < i) {
            times[kept] = times[i];
            for (std::size_t k = 0; k < width; ++k) values[kept * width + k] = values[i * width + k];
        }
        ++kept;
    }
    times.resize(kept);
    values.resize(kept * width, Value());
    const auto early = static_cast<std::size_t>(
        std::find_if(times.begin(), times.end(), [](double each) { return !(each < 0.0); }) - times.begin());
    if (early == 0) return;
    dropped.early += early;
    const auto cut = [&](std::size_t keys) {
        times.erase(times.begin(), times.begin() + static_cast<std::ptrdiff_t>(keys));
        values.erase(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(keys * width));
    };
    cut(early - 1);  // the last of them gives the value at 0
    if (times.size() > 1 && times[1] == 0.0) return cut(1);
    if (times.size() > 1 && times[1] > 0.0) {
        const bool cubic = interpolation == humanoid::Interpolation::Cubic;
        const std::vector<Value> key =
            detail::key_at_zero(times, values, cubic ? width / 3 : width, interpolation);
        std::copy(key.begin(), key.end(), values.begin());
    }
    times[0] = 0.0;
}

}  // namespace tendril::app
