// Inverse kinematics of a tree of chains: one root, several effectors, joints shared by branches.
//
// A torso with two arms and a head, a spider, a hand: the joints are given as a list in which each joint
// names its parent. Any number of them, including inner ones, may have a target.
//
// Method: FABRIK for several end effectors. Forward reaching, from the effectors inward, proposes a position
// per branch for every joint; where branches meet, the proposals are averaged, each weighted by all effectors
// on its branch. Backward reaching, from the root outward, then restores every bone's length. A. Aristidou,
// J. Lasenby, "FABRIK: A fast, iterative solver for the Inverse Kinematics problem", Graphical Models 73(5),
// 2011, section on multiple end effectors; A. Aristidou, Y. Chrysanthou, J. Lasenby, "Extending FABRIK with
// model constraints", Computer Animation and Virtual Worlds 27(1), 2016.
//
// From the third iteration on, a damped Gauss-Newton step follows each pair of passes, and is kept if it
// brings the effectors nearer. Among all moves that keep the lengths and bring the effectors to their
// targets, both to first order, it is the one that moves the joints least (Levenberg 1944, Marquardt 1963).
// On a tree its equations are solved from the leaves inward without fill-in (as D. Baraff, "Linear-time
// dynamics using Lagrange multipliers", SIGGRAPH 1996, does for forces). Without this step, reaching
// converges slowly where branches share joints.
//
// A Tree holds the list of joints and scratch memory, but nothing of earlier solves: all that persists are
// the joints' positions and, optionally, the bones' rotations, both owned by the caller.
//
// Cost: an iteration is O(joints on the paths from the root to the effectors), however many effectors there
// are. Solving does not allocate or throw, and gives the same bits for the same call, whatever the order of
// the effectors in the list.
//
// Branches without an effector are not solved: each moves rigidly with its parent bone, turned by the minimal
// rotation of that bone. A branch attached to the root itself, or to a bone that does not move, stays in
// place.
//
// Bones keep their lengths as in chain.hpp.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>

#include "tendril/fields.hpp"
#include "tendril/ik/observer.hpp"
#include "tendril/ik/report.hpp"
#include "tendril/quat.hpp"
#include "tendril/result.hpp"
#include "tendril/vec3.hpp"

namespace tendril::ik {

struct TreeJoint {
    std::size_t parent = no_joint;  ///< index of an earlier joint; the root, which comes first, has none
    float length = 0.0f;            ///< metres to the parent, 0 to 1e9; the root's has no effect
};

/// A joint with a target.
struct Effector {
    std::size_t joint = 0;
    glm::vec3 target{0.0f};  ///< metres, at most max_magnitude
    /// 0 to max_magnitude; 0 is ignored. Only the ratios of weights matter, and only if the effectors cannot
    /// all reach their targets: then the sum of weight times squared distance is minimised. A weight under
    /// 1e-4 of the largest is raised to 1e-4 of it.
    float weight = 1.0f;
};

struct TreeOptions {
    /// Metres, 0 to max_magnitude; by default 1e-3 of the reach.
    std::optional<float> tolerance{};
    /// 1 to 1 000 000.
    int max_iterations = 100;
    /// Runs all max_iterations even after converging; for measuring. A single effector out of reach still
    /// takes no iterations.
    bool every_iteration = false;
    /// Only the two passes, as published, for study: slower, and a straight branch stays on its line.
    bool plain = false;
    /// If given, element i receives the worst residual after iteration i + 1, up to its size.
    std::span<float> residuals{};
    /// If given, element i receives the final distance of effector i's joint from its target in metres, up to
    /// its size; also for effectors of weight 0.
    std::span<float> effector_residuals{};
    /// If given, one per joint: element k is the world rotation of the bone that leads to joint k (the root's
    /// belongs to no bone and does not change). Each is updated by the minimal rotation from the bone's
    /// initial direction (at its length) to the solved one. Unit quaternions, to 1e-3.
    std::span<glm::quat> rotations{};
};

struct TreeReport {
    /// Converged: every effector is within tolerance. Otherwise Stretched if a target is further from the
    /// root than its effector's path is long, by more than the tolerance, or TooClose if the path cannot fold
    /// that far; otherwise Stalled (usually because the effectors conflict) or IterationLimit.
    Status status = Status::Converged;
    int iterations = 0;
    float residual = 0.0f;  ///< metres, the maximum over effectors with a weight; infinite if refused
    Result accepted{};      ///< why the status is InvalidInput
    bool operator==(const TreeReport&) const = default;
};

class Tree {
  public:
    /// InvalidArgument for an empty list, a first joint with a parent, another joint without one or whose
    /// parent does not come before it, and a length out of range.
    static Expected<Tree> make(std::span<const TreeJoint> joints);
    ~Tree();
    Tree(Tree&&) noexcept;
    Tree& operator=(Tree&&) noexcept;

    std::size_t size() const noexcept;
    /// The longest path from the root to a joint, metres.
    double reach() const noexcept;

    /// Moves the joints (size() of them, metres), all but the root, so that the effectors reach their
    /// targets. If the joints do not match the bones' lengths, they are corrected first. A target out of an
    /// effector's reach is replaced by the nearest point that it can reach, so a distant target does not gain
    /// weight. InvalidInput, and nothing is moved, if an index or a number is out of range, or two effectors
    /// with a weight share a joint.
    TreeReport solve(std::span<glm::vec3> joints, std::span<const Effector> effectors,
                     const TreeOptions& options = {}) noexcept;

  private:
    struct Parts;
    explicit Tree(std::unique_ptr<Parts> parts) noexcept;
    std::unique_ptr<Parts> parts_;
};

}  // namespace tendril::ik

template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::TreeJoint>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::Effector>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::TreeOptions>() noexcept;
