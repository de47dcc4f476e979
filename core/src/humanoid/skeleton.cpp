#include "tendril/humanoid/skeleton.hpp"

#include <algorithm>
#include <cstdio>
#include <numeric>
#include <unordered_map>

#include "humanoid/limb.hpp"
#include "rig/checks.hpp"
#include "rig/math.hpp"

namespace tendril::humanoid {
namespace {

using tendril::detail::Argument;
using tendril::detail::refused;

Result check_names(const std::vector<Node>& nodes) {
    std::unordered_map<std::string_view, std::size_t> seen;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const Argument argument("nodes", i, "name");
        if (nodes[i].name.empty()) return refused("Skeleton", argument, "not empty", "\"\"");
        if (const auto [it, is_new] = seen.emplace(nodes[i].name, i); !is_new) {
            std::string other = "that of nodes[";
            other += std::to_string(it->second);
            other += ']';
            return refused("Skeleton", argument, "other than " + other, std::string_view(nodes[i].name));
        }
    }
    return {};
}

}  // namespace

Expected<Skeleton> Skeleton::make(std::vector<Node> nodes) {
    const std::size_t count = nodes.size();
    if (count > max_nodes) return refused("Skeleton", "nodes", "at most 4096", count);
    if (const Result bad = check_names(nodes); !bad) return bad;

    Skeleton made;
    made.first_.assign(count + 1, 0);
    for (std::size_t i = 0; i < count; ++i) {
        const std::int32_t parent = nodes[i].parent;
        if (parent < -1 || parent >= static_cast<std::int32_t>(count))
            return refused("Skeleton", Argument("nodes", i, "parent"), "-1 or the index of a node", parent);
        char what[40];
        std::snprintf(what, sizeof what, "nodes[%zu].rest", i);
        const Expected<rig::Transform> rest = rig::checked(nodes[i].rest, "Skeleton", what);
        if (!rest) return rest.error();
        nodes[i].rest = *rest;
        if (std::optional<KeySpace>& keys = nodes[i].keys) {
            if (keys->parent < -1 || keys->parent >= static_cast<std::int32_t>(count))
                return refused("Skeleton", Argument("nodes", i, "keys.parent"), "-1 or the index of a node",
                               keys->parent);
            std::snprintf(what, sizeof what, "nodes[%zu].keys.rest", i);
            const Expected<rig::Transform> key_rest = rig::checked(keys->rest, "Skeleton", what);
            if (!key_rest) return key_rest.error();
            keys->rest = *key_rest;
            made.moved_.push_back(i);
        }
        if (parent >= 0) ++made.first_[static_cast<std::size_t>(parent) + 1];
    }
    std::partial_sum(made.first_.begin(), made.first_.end(), made.first_.begin());
    made.children_.resize(made.first_.back());
    std::vector<std::uint32_t> next(made.first_.begin(), made.first_.end() - 1);
    for (std::size_t i = 0; i < count; ++i)
        if (nodes[i].parent >= 0)
            made.children_[next[static_cast<std::size_t>(nodes[i].parent)]++] = static_cast<std::int32_t>(i);
    made.nodes_ = std::move(nodes);

    // Depth first from the roots, from which the nodes of a cycle cannot be reached.
    made.order_.reserve(count);
    std::vector<std::int32_t> open;
    for (std::size_t i = count; i-- > 0;)
        if (made.nodes_[i].parent < 0) open.push_back(static_cast<std::int32_t>(i));
    while (!open.empty()) {
        const std::int32_t node = open.back();
        open.pop_back();
        made.order_.push_back(node);
        const auto below = made.children(static_cast<std::size_t>(node));
        open.insert(open.end(), below.rbegin(), below.rend());
    }
    if (made.order_.size() < count) {
        std::vector<bool> reached(count);
        for (const std::int32_t node : made.order_) reached[static_cast<std::size_t>(node)] = true;
        auto lost =
            static_cast<std::size_t>(std::find(reached.begin(), reached.end(), false) - reached.begin());
        // The node may hang below the cycle: going up `count` steps leads into it.
        for (std::size_t i = 0; i < count; ++i) lost = static_cast<std::size_t>(made.nodes_[lost].parent);
        return refused("Skeleton", Argument("nodes", lost, "parent"), "a node that is not below it",
                       made.nodes_[lost].parent);
    }
    for (const std::size_t node : made.moved_)
        for (const std::int32_t from : {made.nodes_[node].parent, made.nodes_[node].keys->parent})
            for (std::int32_t above = from; above >= 0;
                 above = made.nodes_[static_cast<std::size_t>(above)].parent)
                if (made.nodes_[static_cast<std::size_t>(above)].keys)
                    return refused("Skeleton", Argument("nodes", node, "keys"),
                                   "neither above nor below other keys", from);
    return made;
}

std::span<const std::int32_t> Skeleton::children(std::size_t node) const noexcept {
    return std::span(children_).subspan(first_[node], first_[node + 1] - first_[node]);
}

std::optional<std::size_t> Skeleton::find(std::string_view name) const noexcept {
    const auto it =
        std::find_if(nodes_.begin(), nodes_.end(), [&](const Node& node) { return node.name == name; });
    if (it == nodes_.end()) return std::nullopt;
    return static_cast<std::size_t>(it - nodes_.begin());
}

bool Skeleton::is_below(std::size_t node, std::size_t above) const noexcept {
    while (node != above) {
        if (nodes_[node].parent < 0) return false;
        node = static_cast<std::size_t>(nodes_[node].parent);
    }
    return true;
}

glm::dvec3 Placement::apply(const glm::dvec3& p) const noexcept {
    const auto row = [&](int i) {
        return axes[0][i] * p.x + axes[1][i] * p.y + axes[2][i] * p.z + position[i];
    };
    return {row(0), row(1), row(2)};
}

Placement operator*(const Placement& parent, const Placement& child) noexcept {
    Placement result;
    const Placement turn{parent.axes, glm::dvec3(0.0)};
    for (int i = 0; i < 3; ++i) result.axes[i] = turn.apply(child.axes[i]);
    result.position = parent.apply(child.position);
    return result;
}

Placement placement(const rig::Transform& t) noexcept {
    using rig::detail::rotated;
    Placement result;
    result.axes[0] = rotated(t.rotation, {t.scale.x, 0.0, 0.0});
    result.axes[1] = rotated(t.rotation, {0.0, t.scale.y, 0.0});
    result.axes[2] = rotated(t.rotation, {0.0, 0.0, t.scale.z});
    result.position = t.translation;
    return result;
}

glm::dquat Placement::rotation() const noexcept {
    using namespace rig::detail;
    const auto unit_or = [](const glm::dvec3& v, const glm::dvec3& fallback) {
        const double size = length(v);
        return size > 1e-150 ? times(v, 1.0 / size) : fallback;
    };
    const glm::dvec3 guess = unit_or(cross(axes[1], axes[2]), glm::dvec3(1.0, 0.0, 0.0));
    const glm::dvec3 x = unit_or(axes[0], guess);
    const glm::dvec3 z = unit_or(cross(x, axes[1]), unit_or(cross(x, cross(axes[2], x)), perpendicular(x)));
    const glm::dvec3 y = cross(z, x);
    // J. E. Shepperd, "Quaternion from rotation matrix", Journal of Guidance and Control 1(3), 1978: the
    // largest of the four first.
    const double squares[]{1.0 + x.x + y.y + z.z, 1.0 + x.x - y.y - z.z, 1.0 - x.x + y.y - z.z,
                           1.0 - x.x - y.y + z.z};
    switch (std::max_element(std::begin(squares), std::end(squares)) - std::begin(squares)) {
        case 0:
            return unit_quaternion(squares[0], y.z - z.y, z.x - x.z, x.y - y.x);
        case 1:
            return unit_quaternion(y.z - z.y, squares[1], x.y + y.x, z.x + x.z);
        case 2:
            return unit_quaternion(z.x - x.z, x.y + y.x, squares[2], y.z + z.y);
        default:
            return unit_quaternion(x.y - y.x, z.x + x.z, y.z + z.y, squares[3]);
    }
}

rig::Transform relative(const Placement& parent, const Placement& global) noexcept {
    using namespace rig::detail;
    Placement local;
    for (int i = 0; i < 3; ++i) local.axes[i] = detail::to_local(parent, global.axes[i]);
    rig::Transform result;
    for (int i = 0; i < 3; ++i) result.scale[i] = length(local.axes[i]);
    if (dot(cross(local.axes[0], local.axes[1]), local.axes[2]) < 0.0) {
        local.axes[2] = times(local.axes[2], -1.0);
        result.scale.z = -result.scale.z;
    }
    result.rotation = local.rotation();
    result.translation = detail::to_local(parent, minus(global.position, parent.position));
    return result;
}

std::vector<rig::Transform> rest_pose(const Skeleton& skeleton) {
    std::vector<rig::Transform> pose;
    pose.reserve(skeleton.size());
    for (const Node& node : skeleton.nodes()) pose.push_back(node.rest);
    return pose;
}

void place(const Skeleton& skeleton, std::span<const rig::Transform> pose,
           std::span<Placement> placements) noexcept {
    for (const std::int32_t each : skeleton.order()) {
        const auto node = static_cast<std::size_t>(each);
        const std::int32_t parent = skeleton[node].parent;
        placements[node] = placement(pose[node]);
        if (parent >= 0) placements[node] = placements[static_cast<std::size_t>(parent)] * placements[node];
    }
}

}  // namespace tendril::humanoid
