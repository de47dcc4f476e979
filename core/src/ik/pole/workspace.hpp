// Scratch memory of a solve with a pole. Its persistent memory is in the State. Not installed.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

namespace tendril::ik::detail {

struct PoleScratch {
    double allowance = 0.0;  ///< remaining move of a joint to face its pole in this solve, metres
    std::vector<glm::dvec3> wide_joints;  ///< n + 1: the joints in double, for PoleTurn::EachJoint

    void resize(std::size_t bones) { wide_joints.resize(bones + 1); }
};

}  // namespace tendril::ik::detail
