#include "app/labs/humanoid/ik/chains.hpp"

namespace tendril::app {

using humanoid::Bone;

std::vector<BodyChain> body_chains(const humanoid::BoneMap& map) {
    if (!map.is_usable()) return {};
    std::vector<BodyChain> all{
        {0, {Bone::Hips}},
        {1, {Bone::LeftUpperLeg, Bone::LeftLowerLeg, Bone::LeftFoot}},
        {1, {Bone::RightUpperLeg, Bone::RightLowerLeg, Bone::RightFoot}},
        {1, {Bone::Spine, Bone::Chest, Bone::UpperChest}},
        {2, {Bone::LeftShoulder, Bone::LeftUpperArm, Bone::LeftLowerArm, Bone::LeftHand}},
        {2, {Bone::RightShoulder, Bone::RightUpperArm, Bone::RightLowerArm, Bone::RightHand}},
        {2, {Bone::Neck, Bone::Head}}};
    for (BodyChain& chain : all) {
        std::erase_if(chain.bones, [&](Bone bone) { return map[bone].node < 0; });
        chain.end = chain.bones.back();
    }
    return all;
}

std::string why_unusable(const humanoid::BoneMap& map) {
    std::string names;
    for (std::size_t i = 0; i < map.missing.size(); ++i) {
        if (i > 0) names += i + 1 == map.missing.size() ? " and " : ", ";
        names += humanoid::name(map.missing[i]);
    }
    if (!names.empty()) return names + (map.missing.size() == 1 ? " is missing" : " are missing");
    return map.upright ? "" : "from hips to head it goes more aside than up";
}

}  // namespace tendril::app
