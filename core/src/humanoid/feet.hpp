// A character's legs, precomputed by Feet::make() and used by its steps. Not installed.
#pragma once

#include "humanoid/limb.hpp"
#include "tendril/humanoid/feet.hpp"

namespace tendril::humanoid {

namespace detail {

struct FeetPlan {
    Soles soles;
    std::size_t nodes;                          // number of nodes in the skeleton
    std::vector<std::int32_t> above_hips;       // from the root down to the hips' parent
    std::size_t hips;                           // node
    glm::dquat hips_at_rest;                    // rotation, in the character's space
    std::array<Limb, 2> legs;                   // down to the toes
    std::array<glm::dvec3, 2> balls{};          // balls of the soles, in the toes' space
    std::array<glm::dvec3, 2> leg_direction{};  // from hip to ankle at rest
    std::array<glm::dvec3, 12> disc;            // horizontal, of radius 1: where the root samples the ground
};

}  // namespace detail

struct Feet::Plan : detail::FeetPlan {};

}  // namespace tendril::humanoid
