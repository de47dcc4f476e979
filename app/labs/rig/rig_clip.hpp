// A clip: the poses of a rig's bones, sixty a second, as an animation that is imported has them. And what a
// backward solve leaves of it: what the rig cannot express.
#pragma once

#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <tendril/rig/rig.hpp>
#include <vector>

namespace tendril::app {

inline constexpr std::size_t max_clip_frames = 3'600, max_clip_poses = 100'000;

/// Within the nearest bone above, or within the world where there is none.
struct ClipPose {
    glm::vec3 translation{0.0f};
    glm::quat rotation{1.0f, 0.0f, 0.0f, 0.0f};
    glm::vec3 scale{1.0f};
    bool operator==(const ClipPose&) const = default;
};

struct RigClip {
    std::vector<std::string> bones;  ///< parents before their children
    std::vector<ClipPose> poses;     ///< frame after frame, one a bone
    std::uint64_t began = 0;         ///< the tick of the lab's time that the first frame is of

    std::size_t frames() const { return bones.empty() ? 0 : poses.size() / bones.size(); }
    bool operator==(const RigClip&) const = default;
};

/// What is left of a bone, and is less than that, nobody sees, and a clip's numbers do not tell.
inline constexpr double min_shown_mm = 0.1, min_shown_degrees = 0.01, min_shown_scale = 0.001;

/// Of the bone with the most left in a frame.
struct FrameLeft {
    float mm = 0.0f, degrees = 0.0f;
    std::uint32_t bone = 0;  ///< its place in RigClip::bones
    float scale = 0.0f;      ///< the largest difference of a component
    bool stopped = false;    ///< by the work it took: there may be values that come nearer
    bool expressed() const {
        return static_cast<double>(mm) <= min_shown_mm && static_cast<double>(degrees) <= min_shown_degrees &&
               static_cast<double>(scale) <= min_shown_scale;
    }
    bool operator==(const FrameLeft&) const = default;
};

/// A backward solve of the clip, frame by frame, each from the one before.
struct ClipSolve {
    bool running = true;
    std::vector<FrameLeft> left;       ///< of the frames so far
    std::vector<rig::Value> controls;  ///< of the last of them: where the next begins
    std::size_t done() const { return left.size(); }
    bool operator==(const ClipSolve&) const = default;
};

}  // namespace tendril::app
