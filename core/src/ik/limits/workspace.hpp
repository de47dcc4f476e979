// What a solve with limits needs besides joints and rotations, made when the solver is. Not installed.
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
    int own = 0;                      ///< of axes, while no bound on one side is active
    std::array<glm::vec3, 3> axes{};  ///< at right angles to each other, unit vectors
    Bounds bounds;                    ///< which it stands at, on one side; in the world
    glm::vec3 rotation{0.0f};         ///< how the joint turns in a step, radians
};

/// J J' of the tip's three coordinates and, where an orientation is asked for, its three rotations. `both`:
/// the columns of the block that ties them.
struct Normal {
    math::Symmetric3 moves, rotations;
    std::array<glm::dvec3, 3> both{};
};

struct LimitedScratch {
    std::vector<Limit> source;           ///< n: what `limits` were made from
    std::vector<LimitedJoint> limits;    ///< n
    std::vector<JointFreedom> freedoms;  ///< n
    std::vector<std::size_t> bounded;    ///< n: joints that stand at a bound; as many as `at_bounds`
    std::size_t at_bounds = 0;
    Normal normal;            ///< with no bound on one side active
    bool linearized = false;  ///< whether these four are those of `pose`
    bool made = false;        ///< whether there were any limits, for these rest directions
    LimitedPose pose;         ///< the one that is solved
    LimitedPose trial;        ///< what a step would lead to
    LimitedPose best;         ///< the nearest to the target so far, of a solve that goes on elsewhere
    LimitedPose start;        ///< where a solve begins that must not go far, or whose end must not change

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

    /// The pose becomes what `other` holds, and that what the pose was.
    void swap_pose(LimitedPose& other) noexcept {
        std::swap(pose, other);
        linearized = false;
    }
};

}  // namespace tendril::ik::detail
