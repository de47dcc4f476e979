#include "app/labs/humanoid/ik_settings.hpp"

#include <algorithm>

namespace tendril::app {

bool IkSettings::has_targets() const {
    return std::ranges::any_of(targets, [](const auto& target) { return target.has_value(); });
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
