// The chains of a body as they are solved: layer 0 the hips, layer 1 legs and spine, layer 2 arms, neck and
// head.
#pragma once

#include <vector>

#include "app/labs/humanoid/humanoid_part.hpp"

namespace tendril::app {

struct BodyChain {
    int layer = 0;
    std::vector<humanoid::Bone> bones;  ///< mapped ones, from the hips out
    humanoid::Bone end = humanoid::Bone::Hips;
};

/// None where the map is not usable.
std::vector<BodyChain> body_chains(const humanoid::BoneMap& map);

/// Why nothing is solved for this map, in words; empty where it is. "LeftHand and RightHand are missing"
std::string why_unusable(const humanoid::BoneMap& map);

}  // namespace tendril::app
