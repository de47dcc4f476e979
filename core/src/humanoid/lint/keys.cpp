// Faults of the keys themselves: signs of quaternions, and sizes.
#include <algorithm>

#include "humanoid/lint/lint.hpp"

namespace tendril::humanoid::lint_detail {
namespace {

using namespace rig::detail;

std::size_t frame_of(const Check& check, double time) {
    const double frame = std::floor(time * check.report.rate + 0.5) - static_cast<double>(check.begin);
    return std::min(static_cast<std::size_t>(std::max(frame, 0.0)), check.report.frames - 1);
}

/// Keys in the hemisphere opposite to the previous key's, in all tracks.
struct Flips {
    std::size_t count = 0, tracks = 0, first = 0, last = 0;  // frames
    std::size_t worst = 0;                                   // frame
    std::int32_t node = -1;                                  // the worst key's
    double most = 0.0;                                       // degrees that it turns the long way round
};

/// Keys between two flips are in the opposite hemisphere, too.
void find_flips(const Check& check, const Channel& channel, Flips& all) {
    const Track<glm::dquat>& track = channel.rotation;
    if (track.interpolation == Interpolation::Step) return;
    const bool cubic = track.interpolation == Interpolation::Cubic;
    const auto key = [&](std::size_t i) -> const glm::dquat& { return track.values[cubic ? 3 * i + 1 : i]; };
    const std::size_t count = track.times.size();
    bool flipped = false, any = false;
    for (std::size_t i = 1; i < count; ++i) {
        const bool flips = dot(key(i - 1), key(i)) < 0.0;
        flipped ^= flips;
        const std::size_t frame = frame_of(check, track.times[i]);
        if (flipped) all.last = std::max(all.last, frame);
        if (!flips || !flipped) continue;
        const double turn = 360.0 - 2.0 * half_angle_between(key(i - 1), key(i)) * degrees;
        all.first = all.count == 0 ? frame : std::min(all.first, frame);
        if (turn > all.most)
            all.most = turn, all.worst = frame, all.node = static_cast<std::int32_t>(channel.node);
        ++all.count;
        any = true;
    }
    all.tracks += any;
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

void check_height(Check& check) {
    if (!check.map.is_usable() || check.report.frames == 0) return;
    const double height = check.height;
    if (height > 0.2 && height < 12.0) return;
    std::string text =
        "is " + shown(height, height < 1.0 ? 3 : 0) + " m tall: the unit of its file is probably wrong";
    check.add(Fault::Scale, -1, 0, 0, check.report.frames - 1, height, "m", text);
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

/// One finding for the whole clip: an exporter that ignores signs ignores all of them.
void check_signs(Check& check) {
    Flips all;
    for (const Channel& channel : check.clip.channels) find_flips(check, channel, all);
    if (all.count == 0) return;
    std::string text = "has rotation keys that go the long way round: ";
    if (all.count > 1) {
        text = "has rotation keys that go the long way round, " + std::to_string(all.count) + " times";
        text += all.tracks > 1 ? " in " + std::to_string(all.tracks) + " joints: " : ": ";
    }
    text += "unless read the short way, it turns by " + shown(all.most) + " degrees between two keys";
    check.add(Fault::SignFlip, all.node, all.worst, all.first, all.last, all.most, "deg", text).has_cure =
        true;
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
