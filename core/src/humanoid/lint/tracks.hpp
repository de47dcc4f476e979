// Sampling a track of a node, and replacing a range of its keys. Not installed.
#pragma once

#include <algorithm>
#include <vector>

#include "rig/math.hpp"
#include "tendril/humanoid/clip.hpp"

namespace tendril::humanoid::lint_detail {

/// The value of the channel's translation or rotation, by track type, at a time.
inline glm::dvec3 value_at(const Channel& channel, double time, const Track<glm::dvec3>&) {
    rig::Transform local;
    sample(channel, time, local);
    return local.translation;
}
inline glm::dquat value_at(const Channel& channel, double time, const Track<glm::dquat>&) {
    rig::Transform local;
    sample(channel, time, local);
    return local.rotation;
}

namespace tracks_detail {

/// The quaternion of a rotation that is nearer to `other`; a vector is returned unchanged.
inline glm::dvec3 near_to(const glm::dvec3&, const glm::dvec3& value) noexcept {
    return value;
}
inline glm::dquat near_to(const glm::dquat& other, const glm::dquat& value) noexcept {
    return rig::detail::dot(other, value) < 0.0 ? -value : value;
}

}  // namespace tracks_detail

/// Replaces the keys of `track` from times.front() to times.back(). Values outside that range do not change.
/// The interpolation stays; cubic keys get tangents. `times`: two or more, increasing. `was`: the channel
/// before the change.
template <class T>
void replace_keys(const Channel& was, Track<T>& track, const std::vector<double>& times,
                  std::vector<T> values) {
    using tracks_detail::near_to;
    constexpr double same = 1e-6;  // seconds
    const std::size_t width = track.interpolation == Interpolation::Cubic ? 3 : 1, middle = width / 2;
    const auto first = static_cast<std::size_t>(
        std::lower_bound(track.times.begin(), track.times.end(), times.front() - same) - track.times.begin());
    const auto last = static_cast<std::size_t>(
        std::upper_bound(track.times.begin(), track.times.end(), times.back() + same) - track.times.begin());
    const auto key = [&](std::size_t i) -> const T& { return track.values[width * i + middle]; };

    if (first > 0) values.front() = near_to(key(first - 1), values.front());
    for (std::size_t i = 1; i < values.size(); ++i) values[i] = near_to(values[i - 1], values[i]);
    if (first == 0 && last < track.times.size() && near_to(key(last), values.back()) != values.back())
        for (T& value : values) value = -value;

    std::vector<T> written;
    for (std::size_t i = 0; i < times.size(); ++i) {
        const std::size_t from = i > 0 ? i - 1 : 0, to = std::min(i + 1, times.size() - 1);
        const T slope = (values[to] - values[from]) / (times[to] - times[from]);
        // At the ends of the range the track keeps its own slope.
        const auto own_slope = [&] {
            constexpr double step = 1e-4;
            const T a = near_to(values[i], value_at(was, times[i] - step, track)),
                    b = near_to(values[i], value_at(was, times[i] + step, track));
            return (b - a) / (2.0 * step);
        };
        if (width == 3) written.push_back(i == 0 && first > 0 ? own_slope() : slope);
        written.push_back(values[i]);
        if (width == 3)
            written.push_back(i + 1 == times.size() && last < track.times.size() ? own_slope() : slope);
    }
    const auto at = [](auto& list, std::size_t i) { return list.begin() + static_cast<std::ptrdiff_t>(i); };
    track.times.erase(at(track.times, first), at(track.times, last));
    track.times.insert(at(track.times, first), times.begin(), times.end());
    track.values.erase(at(track.values, width * first), at(track.values, width * last));
    track.values.insert(at(track.values, width * first), written.begin(), written.end());
}

}  // namespace tendril::humanoid::lint_detail
