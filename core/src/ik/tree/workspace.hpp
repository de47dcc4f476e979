// The state of one solve of a tree, shared by its parts. Not installed.
//
// Only joints between the root and an effector are solved. They are copied, in order, into *nodes*, so that
// an iteration reads contiguous memory. A joint at zero distance from its parent shares the parent's node.
// Node 0 is the root.
#pragma once

#include <cmath>
#include <cstddef>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "ik/math.hpp"
#include "ik/solve/reachability.hpp"
#include "math/symmetric3.hpp"
#include "tendril/ik/tree.hpp"

namespace tendril::ik::detail {

inline constexpr std::size_t no_node = static_cast<std::size_t>(-1);

struct Node {
    std::size_t parent = 0;  ///< index of an earlier node
    std::size_t joint = 0;   ///< the joint at the end of the node's bone
    float length = 0.0f;
    float own_weight = 0.0f;       ///< weight of its own goal in the mean of its proposals
    float centroid_weight = 0.0f;  ///< weight of its proposal in the mean at its parent
    glm::vec3 goal{0.0f};          ///< reachable point nearest to the target (mean if several)
    double weight = 0.0;           ///< weight of the effectors here, relative to the heaviest
    double branch_weight = 0.0;    ///< the same, including all effectors beyond
    glm::dvec3 goal_sum{0.0};      ///< sum of weight times goal, temporary
    std::size_t branches = 0;      ///< number of child nodes
};

/// Results that the Newton step stores at a node on its inward pass for the outward pass.
struct Response {
    Symmetric3 branches;           ///< stiffness of its branches
    glm::dvec3 force;              ///< force from its goal and branches
    glm::dvec3 along;              ///< unit vector along the bone
    glm::dvec3 free, per_tension;  ///< move without the bone; added move per unit of tension
    double stiffness, pull;        ///< the branch's parabola, as seen from its parent; see newton.cpp
};

struct TreeScratch {
    // Per tree.
    std::vector<TreeJoint> joints;
    std::vector<Reachability> path;  ///< per joint, along the bones from the root
    double reach = 0.0;

    // Per solve, by joint.
    std::vector<glm::vec3> start;          ///< the given pose, at the bones' lengths
    std::vector<std::size_t> node_of;      ///< or no_node
    std::vector<std::size_t> effector_at;  ///< index into the caller's list, or no_joint
    std::vector<glm::quat> rotations;      ///< rotations of the bones in branches without effectors

    // Per solve, by node: sized for all joints, `used` of them in use.
    std::size_t used = 0;
    std::vector<Node> nodes;
    double lightest = 1.0;  ///< minimum weight of an effector, relative to the heaviest
    std::size_t goal_count = 0;
    std::vector<std::size_t> goals;  ///< nodes with a goal, `goal_count` of them
    std::vector<glm::vec3> at, proposed, next, trial, best;
    std::vector<Response> responses;
};

/// Distance of the nodes from the goals.
struct Fit {
    double cost = 0.0;   ///< sum of weight times squared distance
    double worst = 0.0;  ///< maximum distance, metres
};

/// Copies the joints, enforcing their lengths, and computes nodes, goals and centroid weights.
void prepare(TreeScratch& scratch, std::span<const glm::vec3> joints,
             std::span<const Effector> effectors) noexcept;

/// Forward reaching, from the effectors inward: `at` to `proposed`.
void forward_reaching(TreeScratch& scratch) noexcept;
/// Backward reaching, from the root outward: `proposed` to `next`, every bone at its length.
void backward_reaching(TreeScratch& scratch) noexcept;
/// From the positions `from` to `trial`, every bone at its length. `damping`: over 0, relative to weights of
/// 1.
void newton_step(TreeScratch& scratch, std::span<const glm::vec3> from, double damping) noexcept;
Fit fit(const TreeScratch& scratch, std::span<const glm::vec3> places) noexcept;

struct TreeRun {
    int iterations = 0;
    bool stalled = false;
};
/// Iterates on `at`.
TreeRun iterate(TreeScratch& scratch, std::span<const Effector> effectors, const TreeOptions& options,
                double tolerance) noexcept;
/// Maximum residual of the effectors with a weight, for the positions in `at`; metres.
double worst_residual(const TreeScratch& scratch, std::span<const Effector> effectors) noexcept;

/// A single effector whose target is at or beyond the rim of its reach has only one solution: straight
/// towards the target, or folded against the longest bone. Applies it; false otherwise.
bool solve_out_of_reach(TreeScratch& scratch, std::span<const Effector> effectors) noexcept;

/// Updates every bone's rotation by the minimal rotation from its initial direction to its current one.
void transport_rotations(const TreeScratch& scratch, std::span<const glm::vec3> joints,
                         std::span<glm::quat> rotations) noexcept;

/// Writes the positions of nodes, and of branches without effectors, to the caller's joints.
void finish(TreeScratch& scratch, std::span<glm::vec3> joints) noexcept;

/// Distance in double, so that a residual within tolerance here is within tolerance for every caller.
static inline double gap(const glm::vec3& a, const glm::vec3& b) noexcept {
    return length(between(a, b));
}

/// Like step() in math/point.hpp, but for bones of any size: only points less than 1e-15 m apart have no
/// direction.
static inline glm::vec3 at_length(const glm::vec3& anchor, const glm::vec3& old, float length) noexcept {
    const float x = old.x - anchor.x, y = old.y - anchor.y, z = old.z - anchor.z;
    const float squared = x * x + y * y + z * z;
    if (squared < 1e-30f) return {anchor.x + length, anchor.y, anchor.z};
    const float scale = length / std::sqrt(squared);
    return {anchor.x + x * scale, anchor.y + y * scale, anchor.z + z * scale};
}

}  // namespace tendril::ik::detail
