// What a solver remembers of its last solve that had a pole. Not installed.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include "tendril/ik/options.hpp"

namespace tendril::ik::detail {

struct PoleRoom {
    bool valid = false;             ///< whether the last solve had a pole
    PoleTurn turn{};                ///< how it was faced
    glm::vec3 pole{}, target{};     ///< from the root
    float twist = 0.0f;             ///< of two bones
    std::vector<glm::vec3> joints;  ///< n + 1, from the root: the pose that was left
    double allowance = 0.0;         ///< how far the solve that runs may still move a joint to face its pole

    std::vector<glm::dvec3> wide_joints;  ///< n + 1: those of the solve, while each joint turns by itself

    void resize(std::size_t bones) {
        joints.resize(bones + 1);
        wide_joints.resize(bones + 1);
    }
};

}  // namespace tendril::ik::detail
