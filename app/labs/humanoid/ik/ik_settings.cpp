#include "app/labs/humanoid/ik/ik_settings.hpp"

#include <algorithm>

namespace tendril::app {

bool IkSettings::has_targets() const {
    return std::ranges::any_of(targets, [](const auto& target) { return target.has_value(); });
}

LimitsFrom IkSettings::limits_of(humanoid::Bone bone) const {
    const auto own = joint_limits.find(bone);
    return own == joint_limits.end() ? limits : own->second;
}

const TargetSetting* IkSettings::hand_target(std::size_t hand) const {
    const std::optional<TargetSetting>& wanted = target(both_hands[hand]);
    return hand_ik.on && wanted ? &*wanted : nullptr;
}

std::string title(humanoid::Effector effector) {
    std::string text = humanoid::name(effector);
    std::ranges::replace(text, '_', ' ');
    return text;
}

}  // namespace tendril::app
