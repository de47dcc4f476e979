// An animation as files store it: tracks of translation, rotation and scale keys for each node, each track
// with its own times.
//
//     std::vector<rig::Transform> pose(skeleton.size());
//     sample(clip, skeleton, seconds, pose);
//     place(skeleton, pose, placements);
//
// Keys are interpolated exactly as in glTF (glTF 2.0, appendix C, "Animation Sampler Interpolation Modes"):
// the first value holds before the first key, the last one after the last. Rotations take the short way:
// spherically for Linear, by component and renormalised for Cubic.
//
// Cost: O(log keys) per track.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "tendril/humanoid/skeleton.hpp"

namespace tendril::humanoid {

/// Interpolation between a track's keys.
enum class Interpolation : std::uint8_t {
    Step,  ///< keeps the key's value
    Linear,
    Cubic  ///< cubic Hermite with the keys' tangents
};
/// "step", "linear", "cubic"
const char* name(Interpolation interpolation) noexcept;

/// T is glm::dvec3 or glm::dquat.
template <class T>
struct Track {
    Interpolation interpolation = Interpolation::Linear;
    std::vector<double> times{};  ///< seconds, from 0, strictly increasing; empty: the node keeps its rest
    /// One per key. Cubic has three: in-tangent, value, out-tangent; tangents are per second.
    std::vector<T> values{};
    bool operator==(const Track&) const = default;
};

/// Local to the node's parent, or to its key space if it has one.
struct Channel {
    std::size_t node = 0;
    Track<glm::dvec3> translation{};  ///< metres
    Track<glm::dquat> rotation{};     ///< values (not tangents) are unit quaternions, to 1e-3
    Track<glm::dvec3> scale{};        ///< a key may be 0
    bool operator==(const Channel&) const = default;
};

struct Clip {
    std::string name{};
    double duration = 0.0;            ///< seconds, at least the time of the last key
    std::vector<Channel> channels{};  ///< at most one per node
    double rate = 0.0;                ///< frames per second, from its file; 0: not given there
    bool operator==(const Clip&) const = default;
};

/// Refuses an invalid node or one with two channels, lists of mismatched sizes, times that are not finite, do
/// not increase or exceed the duration, numbers that are not finite or over 1e9, and rotations that are not
/// unit quaternions. "Clip walk: channels[3].rotation.times[7] must be later than the time before it, got
/// 0.2"
Result check(const Clip& clip, const Skeleton& skeleton);

/// Writes the pose at a time in seconds: skeleton.size() transforms, local to the parents. A node without
/// keys gets its rest transform. The clip must have passed check().
void sample(const Clip& clip, const Skeleton& skeleton, double time, std::span<rig::Transform> pose) noexcept;
/// One node only, in its key space. Keeps the parts of `local` for which the channel has no keys.
void sample(const Channel& channel, double time, rig::Transform& local) noexcept;
/// The frames of a clip, for a program that goes through it frame by frame.
struct Frames {
    std::size_t count = 1;  ///< from time 0 on
    double step = 0.0;      ///< seconds
    double time(std::size_t frame) const noexcept { return static_cast<double>(frame) * step; }
};
/// The clip at `rate` frames per second. If that is its own rate, every key is a frame: files round the time
/// between frames, and 127 steps of 0.0333333 s are a little less than 127 thirtieths. A clip's own frames
/// are the keys of a track, each within 0.06 steps of even times from 0 to the clip's end. If two rates
/// differ by only 0.1 %, such as 30 and 29.97, the nearer one is the clip's own.
Frames frames_at(const Clip& clip, double rate) noexcept;
/// Merges increasing key times with the frames between the first and the last of them. A frame within 0.06
/// steps of a key is that key: a second call adds nothing.
std::vector<double> with_frames(const std::vector<double>& times, const Frames& frames);

/// The key that puts the node where it is in the pose: the pose's own transform, unless the node has a key
/// space of its own.
rig::Transform key_of(const Skeleton& skeleton, std::span<const rig::Transform> pose,
                      std::size_t node) noexcept;

}  // namespace tendril::humanoid
