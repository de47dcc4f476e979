// One solve of a tree, as its parts see it. Not installed.
//
// Only joints between the root and an effector take part. They are copied, in their order, into *nodes*, so
// that what an iteration walks over lies together; a joint at no distance from its parent is at the parent's
// node. Node 0 is the root.
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
    std::size_t parent = 0;  ///< a node before this one
    std::size_t joint = 0;   ///< the joint that the node's bone leads to
    float length = 0.0f;
    float own_weight = 0.0f;       ///< of its own goal in the mean of what is proposed for it
    float centroid_weight = 0.0f;  ///< of its proposal in the mean at its parent
    glm::vec3 goal{0.0f};          ///< of the effectors here: the nearest that can be reached to their target
    double weight = 0.0;           ///< of the effectors here, as part of the heaviest there is
    double branch_weight = 0.0;    ///< the same of all effectors here and beyond
    glm::dvec3 goal_sum{0.0};      ///< weight times goal, while it is being worked out
    std::size_t branches = 0;      ///< nodes that hang on this one
};

/// What the Newton step keeps at a node on its way in for the way out.
struct Response {
    Symmetric3 branches;           ///< stiffness of what hangs on it
    glm::dvec3 force;              ///< what that asks for
    glm::dvec3 along;              ///< unit vector of the bone
    glm::dvec3 free, per_tension;  ///< its move without the bone; what a unit of tension in it adds
    double stiffness, wish;        ///< of the bone, along itself, as its parent feels it
};

struct TreeScratch {
    // Of the tree.
    std::vector<TreeJoint> joints;
    std::vector<Reachability> path;  ///< of each joint from the root, along the bones between
    double reach = 0.0;

    // Of one solve, by joint.
    std::vector<glm::vec3> start;          ///< as given, at the bones' lengths
    std::vector<std::size_t> node_of;      ///< or no_node
    std::vector<std::size_t> effector_at;  ///< index into the caller's list, or no_joint
    std::vector<glm::quat> rotations;      ///< of the bones that idle branches go along with

    // Of one solve, by node: as many as there are joints, `used` of them in use.
    std::size_t used = 0;
    std::vector<Node> nodes;
    double lightest = 1.0;  ///< weight of an effector, as part of the heaviest
    std::size_t goal_count = 0;
    std::vector<std::size_t> goals;  ///< nodes that have one, `goal_count` of them
    std::vector<glm::vec3> at, proposed, next, trial, best;
    std::vector<Response> responses;
};

/// How well some places of the nodes fit the goals.
struct Fit {
    double cost = 0.0;   ///< sum of weight times squared distance
    double worst = 0.0;  ///< metres
};

/// Takes over the joints, brought to their lengths, and works out who takes part, goals and centroid weights.
void prepare(TreeScratch& scratch, std::span<const glm::vec3> joints,
             std::span<const Effector> effectors) noexcept;

/// From the effectors inward: `at` to `proposed`.
void forward_reaching(TreeScratch& scratch) noexcept;
/// From the root outward: `proposed` to `next`, every bone at its length.
void backward_reaching(TreeScratch& scratch) noexcept;
/// From the places `from` to `trial`, every bone at its length. `damping`: over 0, against weights of 1.
void newton_step(TreeScratch& scratch, std::span<const glm::vec3> from, double damping) noexcept;
Fit fit(const TreeScratch& scratch, std::span<const glm::vec3> places) noexcept;

struct TreeRun {
    int iterations = 0;
    bool stalled = false;
};
/// Iterates on `at`.
TreeRun iterate(TreeScratch& scratch, std::span<const Effector> effectors, const TreeOptions& options,
                double tolerance) noexcept;
/// Metres, the worst of the effectors with a weight, in the places that `at` holds.
double worst_residual(const TreeScratch& scratch, std::span<const Effector> effectors) noexcept;

/// Where one effector alone is at the rim of its reach or beyond, there is but one way to lie: straight
/// towards its target, or folded against the longest bone. Lies so, or false where it is not the case.
bool solve_at_rim(TreeScratch& scratch, std::span<const Effector> effectors) noexcept;

/// Turns every bone's rotation on by the minimal rotation from where the bone was at the start.
void transport_rotations(const TreeScratch& scratch, std::span<const glm::vec3> joints,
                         std::span<glm::quat> rotations) noexcept;

/// Writes the nodes' places, and the branches without effector that go along, to the caller's joints.
void finish(TreeScratch& scratch, std::span<glm::vec3> joints) noexcept;

/// In double, so that what is within tolerance here is so for everybody.
static inline double gap(const glm::vec3& a, const glm::vec3& b) noexcept {
    return length(between(a, b));
}

/// As step() of math/point.hpp, but for bones of any size: only what is nearer than 1e-15 m shows no
/// direction.
static inline glm::vec3 at_length(const glm::vec3& anchor, const glm::vec3& old, float length) noexcept {
    const float x = old.x - anchor.x, y = old.y - anchor.y, z = old.z - anchor.z;
    const float squared = x * x + y * y + z * z;
    if (squared < 1e-30f) return {anchor.x + length, anchor.y, anchor.z};
    const float scale = length / std::sqrt(squared);
    return {anchor.x + x * scale, anchor.y + y * scale, anchor.z + z * scale};
}

}  // namespace tendril::ik::detail
