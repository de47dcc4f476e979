// An animation as files have it: keys of translation, rotation and scale, node by node, each with times of
// its own.
//
//     std::vector<rig::Transform> pose(skeleton.size());
//     sample(clip, skeleton, seconds, pose);
//     place(skeleton, pose, placements);
//
// How keys are joined is glTF's, to the letter (glTF 2.0, appendix C, "Animation Sampler Interpolation
// Modes"): before the first key its value, after the last one that. Rotations go the short way round, along
// the arc for Linear, by component and made a unit again for Cubic.
//
// Cost: O(log keys) for each track.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "tendril/humanoid/skeleton.hpp"

namespace tendril::humanoid {

/// How a track goes on from a key to the next.
enum class Interpolation : std::uint8_t {
    Step,  ///< keeps the key's value
    Linear,
    Cubic  ///< Hermite's cubic by the keys' tangents
};
/// "step", "linear", "cubic"
const char* name(Interpolation interpolation) noexcept;

/// T is glm::dvec3 or glm::dquat.
template <class T>
struct Track {
    Interpolation interpolation = Interpolation::Linear;
    std::vector<double>
        times{};  ///< seconds from 0 up, each over the one before; none: the node keeps its rest
    /// One a key. Cubic has three: the tangent that arrives, the value, the tangent that leaves, per second.
    std::vector<T> values{};
    bool operator==(const Track&) const = default;
};

struct Channel {
    std::size_t node = 0;
    Track<glm::dvec3> translation{};  ///< metres
    Track<glm::dquat> rotation{};     ///< those that are values are unit quaternions, to 1e-3
    Track<glm::dvec3> scale{};        ///< a key may be 0
    bool operator==(const Channel&) const = default;
};

struct Clip {
    std::string name{};
    double duration = 0.0;            ///< seconds, at least the time of the last key
    std::vector<Channel> channels{};  ///< at most one a node
    bool operator==(const Clip&) const = default;
};

/// Refuses a node that is not there or has two channels, lists that do not fit each other, times that are not
/// finite, not rising or after the duration, numbers that are not finite or over 1e9, and rotations that are
/// no unit quaternions. "Clip walk: channels[3].rotation.times[7] must be over the time before it, 0.2, got
/// 0.2"
Result check(const Clip& clip, const Skeleton& skeleton);

/// The pose at a time in seconds, local to the parents: a clip that passed check(), size() transforms. A node
/// without keys keeps its rest transform.
void sample(const Clip& clip, const Skeleton& skeleton, double time, std::span<rig::Transform> pose) noexcept;
/// Of one node alone, over what `local` is.
void sample(const Channel& channel, double time, rig::Transform& local) noexcept;

}  // namespace tendril::humanoid
