// Scratch memory of solves with limits, allocated with the solver. Not installed.
#pragma once

#include <array>
#include <cstddef>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <utility>
#include <vector>

#include "ik/limits/joint.hpp"
#include "math/symmetric3.hpp"

namespace tendril::ik::detail {

/// A pose: joint positions and bone rotations.
struct LimitedPose {
    std::vector<glm::vec3> joints;      ///< n + 1
    std::vector<glm::quat> rotations;   ///< n: the bones' rotations in the world
    std::vector<glm::quat> local;       ///< n: relative to the parent bones, within the limits
    std::vector<glm::vec3> directions;  ///< n: unit vectors along the bones

    void resize(std::size_t bones) {
        joints.resize(bones + 1);
        rotations.resize(bones);
        local.resize(bones);
        directions.resize(bones);
    }
};

/// The world axes about which a joint may rotate.
struct JointFreedom {
    glm::vec3 arm{0.0f};              ///< from the joint to the end of the bones that it turns, in reaches
    bool turns_tip = true;            ///< the tip's bone turns with it
    bool ball = true;                 ///< true: all axes but those listed; false: only those listed
    int count = 0;                    ///< number of axes
    float mobility = 1.0f;            ///< as LimitedJoint::mobility
    int own = 0;                      ///< number of axes while no one-sided bound is active
    std::array<glm::vec3, 3> axes{};  ///< orthonormal
    Bounds bounds;                    ///< the one-sided bounds that it is at; in the world
    glm::vec3 rotation{0.0f};         ///< rotation vector of the joint in a step, radians
};

/// J W J' of the tip's three coordinates and, with a tip orientation, its three rotations. `both`: the
/// columns of the off-diagonal block.
struct Normal {
    math::Symmetric3 moves, rotations;
    std::array<glm::dvec3, 3> both{};
};

struct LimitedScratch {
    std::vector<Limit> source;           ///< n: the source of `limits`
    std::vector<LimitedJoint> limits;    ///< n
    std::vector<JointFreedom> freedoms;  ///< n
    std::vector<std::size_t> bounded;    ///< n: joints at a bound; the first `at_bounds` are used
    std::size_t at_bounds = 0;
    Normal normal;            ///< the matrix with no one-sided bound active
    bool linearized = false;  ///< `freedoms` to `normal` match `pose`
    bool planar = false;      ///< `limits` are a planar chain's
    bool made = false;        ///< `limits` has been filled, for these rest directions
    LimitedPose pose;         ///< the current one
    LimitedPose trial;        ///< result of a step, not accepted yet
    LimitedPose best;         ///< best pose so far, if the solve restarts elsewhere
    LimitedPose start;        ///< start of a drag; or the pose to restore

    LimitedPose saved;         ///< explain: the pose from which each joint is freed
    std::vector<Limit> freed;  ///< explain: the limits with one replaced

    void resize(std::size_t bones) {
        source.resize(bones);
        limits.resize(bones);
        freedoms.resize(bones);
        bounded.resize(bones);
        for (LimitedPose* each : {&pose, &trial, &best, &start, &saved}) each->resize(bones);
        freed.resize(bones);
    }

    /// Swaps the pose with `other`.
    void swap_pose(LimitedPose& other) noexcept {
        std::swap(pose, other);
        linearized = false;
    }
};

}  // namespace tendril::ik::detail
