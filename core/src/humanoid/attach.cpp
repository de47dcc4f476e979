#include "tendril/humanoid/attach.hpp"

#include <algorithm>

#include "humanoid/names.hpp"
#include "rig/checks.hpp"
#include "rig/math.hpp"

namespace tendril::humanoid {
namespace {

using namespace rig::detail;

/// Finds the loose foot of one side.
class LooseFootFinder {
  public:
    LooseFootFinder(const Skeleton& skeleton, const BoneMap& map)
        : skeleton_(skeleton), map_(map), places_(skeleton.size()) {
        place(skeleton, rest_pose(skeleton), places_);
    }
    std::optional<LooseFoot> find(detail::Side side) const {
        const bool is_left = side == detail::Side::Left;
        const std::int32_t upper = map_[is_left ? Bone::LeftUpperLeg : Bone::RightUpperLeg].node;
        const std::int32_t lower = map_[is_left ? Bone::LeftLowerLeg : Bone::RightLowerLeg].node;
        if (upper < 0 || lower < 0) return std::nullopt;
        const auto thigh = static_cast<std::size_t>(upper), leg = static_cast<std::size_t>(lower);
        std::optional<LooseFoot> best;
        for (std::size_t node = 0; node < skeleton_.size(); ++node) {
            const detail::NameReading reading = detail::read_name(skeleton_[node].name);
            if (reading.part != detail::Part::Foot || reading.side != side) continue;
            if (skeleton_.is_below(node, leg)) return std::nullopt;
            if (skeleton_.is_below(leg, node)) continue;
            const LooseFoot found{is_left ? Bone::LeftFoot : Bone::RightFoot, node, leg,
                                  fits(thigh, leg, node)};
            if (!best || is_better(found, *best)) best = found;
        }
        return best;
    }

  private:
    const glm::dvec3& at(std::size_t node) const { return places_[node].position; }
    /// Prefers a foot that fits, then the one with more common ancestors with the leg, then the nearest.
    bool is_better(const LooseFoot& a, const LooseFoot& b) const {
        if (a.fits != b.fits) return a.fits;
        const std::size_t shared_a = shared(a.foot, a.leg), shared_b = shared(b.foot, b.leg);
        if (shared_a != shared_b) return shared_a > shared_b;
        return length(minus(at(a.foot), at(a.leg))) < length(minus(at(b.foot), at(b.leg)));
    }
    /// The number of common ancestors.
    std::size_t shared(std::size_t a, std::size_t b) const {
        std::size_t count = 0;
        for (std::int32_t above = skeleton_[a].parent; above >= 0;
             above = skeleton_[static_cast<std::size_t>(above)].parent)
            count += skeleton_.is_below(b, static_cast<std::size_t>(above));
        return count;
    }
    bool fits(std::size_t thigh, std::size_t leg, std::size_t foot) const {
        constexpr double off = 0.15, shortest = 0.4, longest = 2.5, straight = 0.5;
        const glm::dvec3 upper = minus(at(leg), at(thigh)), lower = minus(at(foot), at(leg));
        const double upper_length = length(upper), lower_length = length(lower);
        if (!(lower_length > shortest * upper_length && lower_length < longest * upper_length)) return false;
        glm::dvec3 end = at(leg);
        for (std::size_t node = 0; node < skeleton_.size(); ++node)
            if (skeleton_.is_below(node, leg) &&
                length(minus(at(node), at(leg))) > length(minus(end, at(leg))))
                end = at(node);
        if (length(minus(end, at(leg))) > shortest * upper_length)
            return length(minus(end, at(foot))) < off * lower_length;
        return dot(upper, lower) > straight * upper_length * lower_length;
    }

    const Skeleton& skeleton_;
    const BoneMap& map_;
    std::vector<Placement> places_;
};

}  // namespace

std::vector<LooseFoot> loose_feet(const Skeleton& skeleton, const BoneMap& map) {
    std::vector<LooseFoot> found;
    if (!check(map, skeleton)) return found;
    const LooseFootFinder finder(skeleton, map);
    for (const detail::Side side : {detail::Side::Left, detail::Side::Right})
        if (const auto foot = finder.find(side)) found.push_back(*foot);
    return found;
}

bool is_same_place(const Placement& a, const Placement& b) noexcept {
    const double size = std::max({length(a.position), length(b.position), 1e-6});
    bool is_same = length(minus(a.position, b.position)) <= 1e-6 * size;
    for (int i = 0; i < 3; ++i)
        is_same = is_same && length(minus(a.axes[i], b.axes[i])) <= 1e-3 * length(a.axes[i]);
    return is_same;
}

Expected<Skeleton> attached(const Skeleton& skeleton, std::size_t node, std::size_t to) {
    using tendril::detail::refused;
    for (const std::size_t each : {node, to})
        if (each >= skeleton.size()) return refused("attached", "node", "the index of a node", each);
    if (skeleton[node].keys)
        return refused("attached", "node", "one that was not moved before",
                       std::string_view(skeleton[node].name));
    if (skeleton.is_below(to, node))
        return refused("attached", "to", "a node that is not below the moved one",
                       std::string_view(skeleton[to].name));
    std::vector<Placement> places(skeleton.size());
    place(skeleton, rest_pose(skeleton), places);
    std::vector<Node> nodes = skeleton.nodes();
    nodes[node].keys = KeySpace{nodes[node].parent, nodes[node].rest};
    nodes[node].parent = static_cast<std::int32_t>(to);
    nodes[node].rest = relative(places[to], places[node]);
    if (!is_same_place(places[node], places[to] * placement(nodes[node].rest)))
        return refused("attached", "to", "a node without shear or a scale of 0",
                       std::string_view(skeleton[to].name));
    return Skeleton::make(std::move(nodes));
}

Skeleton detached(const Skeleton& skeleton) {
    std::vector<Node> nodes = skeleton.nodes();
    for (const std::size_t each : skeleton.moved()) {
        nodes[each].parent = nodes[each].keys->parent;
        nodes[each].rest = nodes[each].keys->rest;
        nodes[each].keys.reset();
    }
    Expected<Skeleton> made = Skeleton::make(std::move(nodes));
    return made ? std::move(*made) : skeleton;
}

}  // namespace tendril::humanoid
