// Before the first iteration: the joints that take part, reachable goals, and the weights of means.
#include <algorithm>
#include <cfloat>
#include <cmath>

#include "ik/math.hpp"
#include "ik/tree/workspace.hpp"
#include "ik/tunables.hpp"

namespace tendril::ik::detail {
namespace {

using namespace tune::tree;

/// True if the bone is at its length up to rounding and can be kept. Same tolerance as a chain, except that
/// it is relative for bones under a metre.
bool has_length(const glm::vec3& from, const glm::vec3& to, float length) noexcept {
    const double wanted = static_cast<double>(length);
    const double furthest = std::max<double>(largest_coordinate(from), largest_coordinate(to));
    double allowed = 1e-4 * wanted + furthest * static_cast<double>(FLT_EPSILON);
    if (furthest <= 1e3) allowed = std::min(allowed, 1e-4 * std::max(1.0, wanted));
    return std::abs(gap(from, to) - wanted) <= allowed;
}

void load_start(TreeScratch& scratch, std::span<const glm::vec3> joints) noexcept {
    scratch.start[0] = joints[0];
    for (std::size_t k = 1; k < joints.size(); ++k) {
        const glm::vec3& anchor = scratch.start[scratch.joints[k].parent];
        const float length = scratch.joints[k].length;
        scratch.start[k] =
            has_length(anchor, joints[k], length) ? joints[k] : at_length(anchor, joints[k], length);
    }
}

/// Assigns a node to every joint on a path to an effector.
void assign_nodes(TreeScratch& scratch) noexcept {
    const std::size_t count = scratch.joints.size();
    for (std::size_t k = 0; k < count; ++k)
        scratch.node_of[k] = scratch.effector_at[k] == no_joint ? no_node : 0;
    for (std::size_t k = count; k-- > 1;) {
        if (scratch.node_of[k] != no_node) scratch.node_of[scratch.joints[k].parent] = 0;
    }
    scratch.nodes[0] = Node{};
    scratch.at[0] = scratch.start[0];
    scratch.node_of[0] = 0;
    scratch.used = 1;
    for (std::size_t k = 1; k < count; ++k) {
        if (scratch.node_of[k] == no_node) continue;
        const TreeJoint& joint = scratch.joints[k];
        const std::size_t parent = scratch.node_of[joint.parent];
        if (joint.length == 0.0f) {
            scratch.node_of[k] = parent;
            continue;
        }
        Node node;
        node.parent = parent;
        node.joint = k;
        node.length = joint.length;
        scratch.nodes[scratch.used] = node;
        scratch.at[scratch.used] = scratch.start[k];
        scratch.node_of[k] = scratch.used++;
        ++scratch.nodes[parent].branches;
    }
}

/// The point nearest to the effector's target that it can reach alone.
glm::dvec3 reachable(const TreeScratch& scratch, const Effector& effector) noexcept {
    const glm::vec3& root = scratch.start[0];
    glm::dvec3 way = between(root, effector.target);
    const double distance = length(way), wanted = scratch.path[effector.joint].clamped(distance);
    if (wanted == distance) return wide(effector.target);
    // A target at the root has no direction: use the joint's.
    if (distance < 1e-6 * wanted) way = between(root, scratch.start[effector.joint]);
    const glm::dvec3 along = direction_of(way, 1e-6 * wanted).value_or(glm::dvec3(1.0, 0.0, 0.0));
    return plus(wide(root), times(along, wanted));
}

void collect_goals(TreeScratch& scratch, std::span<const Effector> effectors) noexcept {
    double max_weight = 0.0;
    scratch.lightest = 1.0;
    for (const Effector& effector : effectors) {
        if (scratch.path[effector.joint].furthest == 0.0) continue;  // it cannot move
        max_weight = std::max(max_weight, static_cast<double>(effector.weight));
    }
    // By joint, not in list order: sums at one node must not depend on the list.
    for (std::size_t k = 1; k < scratch.joints.size(); ++k) {
        if (scratch.effector_at[k] == no_joint || scratch.node_of[k] == 0) continue;
        const Effector& effector = effectors[scratch.effector_at[k]];
        const double weight = std::max(min_weight, static_cast<double>(effector.weight) / max_weight);
        scratch.lightest = std::min(scratch.lightest, weight);
        const glm::dvec3 goal = reachable(scratch, effector);
        Node& node = scratch.nodes[scratch.node_of[k]];
        node.weight += weight;
        node.goal_sum = plus(node.goal_sum, times(goal, weight));
    }
}

void assign_centroid_weights(TreeScratch& scratch) noexcept {
    scratch.goal_count = 0;
    for (std::size_t k = scratch.used; k-- > 1;) {
        Node& node = scratch.nodes[k];
        node.branch_weight += node.weight;
        scratch.nodes[node.parent].branch_weight += node.branch_weight;
    }
    for (std::size_t k = 1; k < scratch.used; ++k) {
        Node& node = scratch.nodes[k];
        node.own_weight = static_cast<float>(node.weight / node.branch_weight);
        node.centroid_weight =
            static_cast<float>(node.branch_weight / scratch.nodes[node.parent].branch_weight);
        if (node.weight == 0.0) continue;
        node.goal = narrow(times(node.goal_sum, 1.0 / node.weight));
        scratch.goals[scratch.goal_count++] = k;
    }
}

/// The only effector with a weight that can move; null if there is none or more than one.
const Effector* single_effector(const TreeScratch& scratch, std::span<const Effector> effectors) noexcept {
    const Effector* only = nullptr;
    for (const Effector& effector : effectors) {
        if (effector.weight == 0.0f || scratch.node_of[effector.joint] == 0) continue;
        if (only) return nullptr;
        only = &effector;
    }
    return only;
}

}  // namespace

void prepare(TreeScratch& scratch, std::span<const glm::vec3> joints,
             std::span<const Effector> effectors) noexcept {
    load_start(scratch, joints);
    std::fill(scratch.effector_at.begin(), scratch.effector_at.end(), no_joint);
    for (std::size_t i = 0; i < effectors.size(); ++i) {
        if (effectors[i].weight > 0.0f) scratch.effector_at[effectors[i].joint] = i;
    }
    assign_nodes(scratch);
    collect_goals(scratch, effectors);
    assign_centroid_weights(scratch);
}

bool solve_out_of_reach(TreeScratch& scratch, std::span<const Effector> effectors) noexcept {
    const Effector* const effector = single_effector(scratch, effectors);
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

}  // namespace tendril::ik::detail
