// Faults of the keys themselves: signs of quaternions, and sizes.
#include <algorithm>

#include "humanoid/lint/lint.hpp"

namespace tendril::humanoid::lint_detail {
namespace {

using namespace rig::detail;

std::size_t frame_of(const Check& check, double time) {
    const auto frame = static_cast<std::size_t>(std::floor(time * check.report.rate + 0.5));
    return std::min(frame, check.report.frames - 1);
}

/// One finding for each run of keys in the hemisphere opposite to the first key's.
void check_signs_of(Check& check, const Channel& channel) {
    const Track<glm::dquat>& track = channel.rotation;
    if (track.interpolation == Interpolation::Step) return;
    const bool cubic = track.interpolation == Interpolation::Cubic;
    const auto key = [&](std::size_t i) -> const glm::dquat& { return track.values[cubic ? 3 * i + 1 : i]; };
    const std::size_t count = track.times.size();
    std::vector<std::size_t> flips;  // keys in the hemisphere opposite to the key before
    for (std::size_t i = 1; i < count; ++i)
        if (dot(key(i - 1), key(i)) < 0.0) flips.push_back(i);
    for (std::size_t i = 0; i < flips.size(); i += 2) {
        const std::size_t first = flips[i], last = i + 1 < flips.size() ? flips[i + 1] - 1 : count - 1;
        const double way = 2.0 * half_angle_between(key(first - 1), key(first)) * degrees;
        std::string text = first == last
                               ? "has a rotation key that goes the long way round: "
                               : "has rotation keys that go the long way round from one frame to the next: ";
        text += "unless read the short way, it turns by " + shown(360.0 - way) + " degrees between two keys";
        check
            .add(Fault::SignFlip, static_cast<std::int32_t>(channel.node),
                 frame_of(check, track.times[first]), frame_of(check, track.times[first]),
                 frame_of(check, track.times[last]), 360.0 - way, "deg", text)
            .has_cure = true;
    }
}

/// Reports the first key that flattens the node to a plane, a line or a point, or mirrors it, relative to its
/// rest.
void check_scale_keys(Check& check, const Channel& channel) {
    const Track<glm::dvec3>& track = channel.scale;
    const bool cubic = track.interpolation == Interpolation::Cubic;
    const glm::dvec3& rest = check.skeleton[channel.node].key_rest().scale;
    for (std::size_t i = 0; i < track.times.size(); ++i) {
        const glm::dvec3& value = track.values[cubic ? 3 * i + 1 : i];
        for (int axis = 0; axis < 3; ++axis) {
            const double part = value[axis] / rest[axis];
            if (part > 1e-6) continue;
            const std::size_t frame = frame_of(check, track.times[i]);
            check.add(Fault::Scale, static_cast<std::int32_t>(channel.node), frame, frame, frame, part,
                      "times",
                      part < -1e-6 ? "is mirrored by a scale key" : "is scaled to nothing by a scale key");
            return;
        }
    }
}

/// A figure of implausible height.
void check_height(Check& check) {
    if (!check.map.is_usable() || check.report.frames == 0) return;
    const double height = check.height;
    if (height > 0.2 && height < 12.0) return;
    std::string text =
        "is " + shown(height, height < 1.0 ? 3 : 0) + " m tall: the unit of its file is probably wrong";
    check.add(Fault::Scale, -1, 0, 0, check.report.frames - 1, height, "m", text);
}

template <class T>
void negate(std::vector<T>& values, std::size_t first, std::size_t count) {
    for (std::size_t i = first; i < first + count; ++i) values[i] = -values[i];
}

}  // namespace

std::optional<double> size_of_clip(const Skeleton& skeleton, const Clip& clip) {
    // Lengths of bones in the clip relative to rest. Roots move freely and do not count.
    std::vector<double> ratios;
    for (const Channel& channel : clip.channels) {
        const Track<glm::dvec3>& track = channel.translation;
        if (track.times.empty() || skeleton[channel.node].key_parent() < 0) continue;
        const double rest = length(skeleton[channel.node].key_rest().translation);
        const double now = length(track.values[track.interpolation == Interpolation::Cubic ? 1 : 0]);
        if (rest > 1e-6) ratios.push_back(now / rest);
    }
    if (ratios.size() < 5) return std::nullopt;
    std::sort(ratios.begin(), ratios.end());
    const double middle = ratios[ratios.size() / 2];
    if (middle > 0.5 && middle < 2.0) return std::nullopt;
    const auto alike = std::count_if(ratios.begin(), ratios.end(), [&](double each) {
        return each > 0.8 * middle && each < 1.25 * middle;
    });
    if (10 * static_cast<std::size_t>(alike) < 6 * ratios.size() || !(middle > 1e-6)) return std::nullopt;
    return middle;
}

void check_signs(Check& check) {
    for (const Channel& channel : check.clip.channels) check_signs_of(check, channel);
}

void check_sizes(Check& check) {
    check_height(check);
    for (const Channel& channel : check.clip.channels) check_scale_keys(check, channel);
    if (const auto size = size_of_clip(check.skeleton, check.clip)) {
        const std::string text = "has bones that are " + shown(*size, *size < 1.0 ? 3 : 0) +
                                 " times as long in this clip as they are at rest";
        check.add(Fault::Scale, -1, 0, 0, check.report.frames - 1, *size, "times", text).has_cure = true;
    }
}

}  // namespace tendril::humanoid::lint_detail
