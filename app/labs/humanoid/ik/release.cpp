#include "app/labs/humanoid/ik/release.hpp"

#include <algorithm>
#include <glm/gtc/quaternion.hpp>

namespace tendril::app {

Release release_between(const std::vector<rig::Transform>& before, const std::vector<rig::Transform>& now,
                        std::optional<std::size_t> hips) {
    Release release{.left = release_seconds};
    if (hips) release.shift = before[*hips].translation - now[*hips].translation;
    for (std::size_t node = 0; node < now.size(); ++node)
        if (before[node].rotation != now[node].rotation)
            release.turns[node] = rig::normalised(glm::conjugate(now[node].rotation) * before[node].rotation);
    return release;
}

double fading(const Release& release) {
    const double part = std::clamp(1.0 + (release.left - release_seconds) / fade_seconds, 0.0, 1.0);
    return part * part * (3.0 - 2.0 * part);
}

void apply(const Release& release, std::vector<rig::Transform>& pose, std::optional<std::size_t> hips) {
    const double part = fading(release);
    if (part <= 0.0) return;
    if (hips) pose[*hips].translation += part * release.shift;
    for (const auto& [node, turn] : release.turns)
        pose[node].rotation =
            rig::normalised(pose[node].rotation * rig::blend(glm::dquat(1.0, 0.0, 0.0, 0.0), turn, part));
}

void pass(Release& release, double seconds) {
    release.left -= seconds;
    if (!(release.left > 0.0)) release = {};
}

void forget_on_the_way_to(Release& release, const humanoid::Skeleton& skeleton, std::size_t node) {
    release.shift = glm::dvec3(0.0);  // the hips are on every way
    std::erase_if(release.turns, [&](const auto& each) {
        return each.first == node || skeleton.is_below(node, each.first) ||
               skeleton.is_below(each.first, node);
    });
}

}  // namespace tendril::app
