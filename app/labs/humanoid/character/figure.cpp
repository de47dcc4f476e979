#include "app/labs/humanoid/character/figure.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace tendril::app {

std::optional<humanoid::Effector> picked_effector(PickId pick) {
    const PickId at = pick - first_effector_pick;
    if (at < 0 || at >= static_cast<PickId>(humanoid::effector_count)) return std::nullopt;
    return static_cast<humanoid::Effector>(at);
}

std::optional<std::size_t> picked_node(const HumanoidPart& part, PickId pick) {
    if (pick < 0 || static_cast<std::size_t>(pick) >= part.skeleton().size()) return std::nullopt;
    return static_cast<std::size_t>(pick);
}

std::vector<bool> body_nodes(const HumanoidPart& part) {
    const humanoid::Skeleton& skeleton = part.skeleton();
    const auto mapped =
        std::ranges::count_if(part.map->bones, [](const auto& each) { return each.node >= 0; });
    constexpr std::ptrdiff_t few = 6;
    if (mapped < few) return std::vector<bool>(skeleton.size(), true);
    std::vector<bool> body(skeleton.size());
    const auto hips = part.node_of(humanoid::Bone::Hips);
    for (const humanoid::BoneMatch& match : part.map->bones) {
        std::vector<std::size_t> way;
        for (std::int32_t at = match.node; at >= 0; at = skeleton[static_cast<std::size_t>(at)].parent) {
            way.push_back(static_cast<std::size_t>(at));
            if (hips != way.back() && !body[way.back()]) continue;
            for (const std::size_t node : way) body[node] = true;
            break;
        }
        if (match.node >= 0) body[static_cast<std::size_t>(match.node)] = true;
    }
    // The end of a last bone, where it has one and no more.
    for (const humanoid::BoneMatch& match : part.map->bones) {
        if (match.node < 0) continue;
        const auto children = skeleton.children(static_cast<std::size_t>(match.node));
        if (children.size() == 1) body[static_cast<std::size_t>(children.front())] = true;
    }
    return body;
}

std::vector<bool> swinging_nodes(const HumanoidPart& part, Solvers& solvers) {
    std::vector<bool> swinging(part.skeleton().size());
    for (const auto& chain : solvers.springs(part))
        if (chain != nullptr)
            for (const std::size_t each : chain->bones()) swinging[each] = true;
    return swinging;
}

glm::dvec3 end_of(const HumanoidPart& part, std::size_t node) {
    const std::int32_t parent = part.skeleton()[node].parent;
    if (parent < 0) return glm::dvec3(0.0);
    const humanoid::Placement& at = part.loaded->rest[node];
    const glm::dvec3 way = at.position - part.loaded->rest[static_cast<std::size_t>(parent)].position;
    return 0.5 * (glm::conjugate(at.rotation()) * way);
}

}  // namespace tendril::app
