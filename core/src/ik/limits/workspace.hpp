// What a solve with limits needs besides joints and rotations, made when the solver is. Not installed.
#pragma once

#include <array>
#include <cstddef>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "ik/limits/joint.hpp"

namespace tendril::ik::detail {

/// Where all joints are and how all bones are turned.
struct LimitedPose {
    std::vector<glm::vec3> joints;     ///< n + 1
    std::vector<glm::quat> rotations;  ///< n

    void resize(std::size_t bones) {
        joints.resize(bones + 1);
        rotations.resize(bones);
    }
};

struct LimitedRoom {
    std::vector<LimitedJoint> limits;               ///< n
    std::vector<JointAngles> angles;                ///< n: of the pose that a step starts from
    std::vector<std::array<glm::vec3, 3>> axes;     ///< n: how each angle turns the bone, in the world
    std::vector<std::array<glm::vec3, 3>> columns;  ///< n: how each angle moves the tip
    LimitedPose before;                             ///< what an iteration starts from
    LimitedPose trial;                              ///< what a step would lead to
    LimitedPose nearest;                            ///< the nearest to the target so far

    LimitedPose kept;              ///< explain: the pose from which each joint is freed
    std::vector<glm::quat> given;  ///< explain: the rotations that it must not change
    std::vector<Limit> freed;      ///< explain: the limits, but for one

    void resize(std::size_t bones) {
        kept.resize(bones);
        given.resize(bones);
        freed.resize(bones);
        limits.resize(bones);
        angles.resize(bones);
        axes.resize(bones);
        columns.resize(bones);
        before.resize(bones);
        trial.resize(bones);
        nearest.resize(bones);
    }
};

}  // namespace tendril::ik::detail
