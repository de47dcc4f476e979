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
    std::vector<glm::vec3> joints;      ///< n + 1
    std::vector<glm::quat> rotations;   ///< n: of the bones, in the world
    std::vector<glm::quat> local;       ///< n: of the bones against the ones before, within the limits
    std::vector<glm::vec3> directions;  ///< n: where the bones point, unit vectors

    void resize(std::size_t bones) {
        joints.resize(bones + 1);
        rotations.resize(bones);
        local.resize(bones);
        directions.resize(bones);
    }
};

/// The axes in the world about which a joint may turn.
struct JointFreedom {
    glm::vec3 arm{0.0f};              ///< from the joint to the tip, in reaches
    bool ball = true;                 ///< all axes less those listed; or those listed and no others
    int count = 0;                    ///< of axes
    std::array<glm::vec3, 3> axes{};  ///< at right angles to each other, unit vectors
    Bounds bounds;                    ///< which it stands at, on one side; in the world
};

struct LimitedScratch {
    std::vector<Limit> source;           ///< n: what `limits` were made from
    std::vector<LimitedJoint> limits;    ///< n
    std::vector<JointFreedom> freedoms;  ///< n
    std::vector<std::size_t> bounded;    ///< n: joints that stand at a bound; as many as `at_bounds`
    std::size_t at_bounds = 0;
    bool made = false;  ///< whether there were any limits
    LimitedPose pose;   ///< the one that is solved
    LimitedPose trial;  ///< what a step would lead to
    LimitedPose best;   ///< the nearest to the target so far, of a solve that goes on elsewhere
    LimitedPose start;  ///< where a solve begins that must not go far, or whose end must not change

    LimitedPose saved;         ///< explain: the pose from which each joint is freed
    std::vector<Limit> freed;  ///< explain: the limits, but for one

    void resize(std::size_t bones) {
        source.resize(bones);
        limits.resize(bones);
        freedoms.resize(bones);
        bounded.resize(bones);
        for (LimitedPose* each : {&pose, &trial, &best, &start, &saved}) each->resize(bones);
        freed.resize(bones);
    }
};

}  // namespace tendril::ik::detail
