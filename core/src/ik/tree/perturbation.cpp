// Straight lines: how a tree gets out of one, and when it belongs on one.
#include <cmath>
#include <cstdint>

#include "ik/math.hpp"
#include "ik/tree/workspace.hpp"

namespace tendril::ik::detail {
namespace {

constexpr float small_bend = 0.05f, large_bend = 0.3f;  ///< part of a bone's length
constexpr float min_sine = 1e-3f;                       ///< a bone off the line by less is on it

/// Where a limb starts that ends at node `tip`.
std::size_t limb_base(const TreeScratch& scratch, std::size_t tip) noexcept {
    std::size_t base = scratch.nodes[tip].parent;
    while (base != 0 && scratch.nodes[base].branches == 1 && scratch.nodes[base].weight == 0.0) {
        base = scratch.nodes[base].parent;
    }
    return base;
}

bool on_line(const TreeScratch& scratch, std::size_t tip, std::size_t base, const glm::vec3& line) noexcept {
    for (std::size_t k = tip; k != base; k = scratch.nodes[k].parent) {
        const glm::vec3 bone = minus(scratch.at[k], scratch.at[scratch.nodes[k].parent]);
        if (length(cross(bone, line)) > min_sine * scratch.nodes[k].length) return false;
    }
    return true;
}

bool perturb_limb(TreeScratch& scratch, std::size_t tip, double tolerance) noexcept {
    const std::size_t base = limb_base(scratch, tip);
    if (scratch.nodes[tip].parent == base) return false;  // one bone turns to its goal at once
    const glm::vec3 &goal = scratch.nodes[tip].goal, &place = scratch.at[tip];
    if (static_cast<double>(distance(goal, place)) <= tolerance) return false;
    glm::vec3 line = minus(goal, scratch.at[base]);
    if (length(line) < 1e-3f * scratch.nodes[tip].length)
        line = minus(place, scratch.at[scratch.nodes[tip].parent]);
    const float size = length(line);
    if (!(size > 1e-15f)) return false;
    line = times(line, 1.0f / size);
    if (!on_line(scratch, tip, base, line)) return false;
    const glm::vec3 side = perpendicular(line);
    for (std::size_t k = scratch.nodes[tip].parent; k != base; k = scratch.nodes[k].parent) {
        scratch.at[k] = moved(scratch.at[k], side, small_bend * scratch.nodes[k].length);
    }
    return true;
}

void enforce_all_lengths(TreeScratch& scratch) noexcept {
    for (std::size_t k = 1; k < scratch.used; ++k) {
        const Node& node = scratch.nodes[k];
        scratch.at[k] = lay(scratch.at[node.parent], scratch.at[k], node.length);
    }
}

/// -1 to 1, another for each number: the top bits of a product with the golden ratio.
float scattered(std::size_t number) noexcept {
    const std::uint32_t bits = static_cast<std::uint32_t>(number) * 2654435769u;
    return static_cast<float>(bits >> 8) * (2.0f / 16777216.0f) - 1.0f;
}

/// The only effector with any weight; null where there are more.
const Effector* only_one(const TreeScratch& scratch, std::span<const Effector> effectors) noexcept {
    const Effector* only = nullptr;
    for (const Effector& effector : effectors) {
        if (effector.weight == 0.0f || scratch.node_of[effector.joint] == 0) continue;
        if (only) return nullptr;
        only = &effector;
    }
    return only;
}

}  // namespace

bool solve_at_rim(TreeScratch& scratch, std::span<const Effector> effectors) noexcept {
    const Effector* const effector = only_one(scratch, effectors);
    if (!effector) return false;
    const Reachability& can = scratch.path[effector->joint];
    const Status status = can.status(gap(scratch.at[0], effector->target), 0.0);
    const auto length_of = [&](std::size_t i) { return scratch.nodes[i + 1].length; };
    const auto place = [&](std::size_t i, const glm::vec3& to) { scratch.at[i] = to; };
    const auto joints = std::span<const glm::vec3>(scratch.at).first(scratch.used);
    if (status == Status::Stretched) straighten(joints, effector->target, length_of, place);
    if (status == Status::TooClose) fold(joints, effector->target, can.nearest, length_of, place);
    return status != Status::Converged;
}

bool perturb_collinear_limbs(TreeScratch& scratch, double tolerance) noexcept {
    bool perturbed = false;
    for (std::size_t i = 0; i < scratch.goal_count; ++i)
        perturbed |= perturb_limb(scratch, scratch.goals[i], tolerance);
    if (perturbed) enforce_all_lengths(scratch);
    return perturbed;
}

void perturb_all(TreeScratch& scratch) noexcept {
    for (std::size_t k = 1; k < scratch.used; ++k) {
        const Node& node = scratch.nodes[k];
        const glm::vec3 bone = minus(scratch.at[k], scratch.at[node.parent]);
        const float size = length(bone);
        if (!(size > 1e-15f)) continue;
        const glm::vec3 along = times(bone, 1.0f / size), side = perpendicular(along);
        const float by = large_bend * node.length;
        scratch.at[k] = moved(scratch.at[k], side, by * scattered(2 * k));
        scratch.at[k] = moved(scratch.at[k], cross(along, side), by * scattered(2 * k + 1));
    }
    enforce_all_lengths(scratch);
}

}  // namespace tendril::ik::detail
