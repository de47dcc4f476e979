// Scratch memory of a solve with a pole. What is remembered from solve to solve is in the State. Not
// installed.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

namespace tendril::ik::detail {

struct PoleScratch {
    double allowance = 0.0;  ///< how far the solve that runs may still move a joint to face its pole
    std::vector<glm::dvec3> wide_joints;  ///< n + 1: those of the solve, while each joint turns by itself

    void resize(std::size_t bones) { wide_joints.resize(bones + 1); }
};

}  // namespace tendril::ik::detail
