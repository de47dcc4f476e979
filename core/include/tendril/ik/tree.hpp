// Inverse kinematics of a tree of chains: one root, several effectors, joints that branches share.
//
// A torso with two arms and a head, a spider, a hand: the joints are given as a list in which every joint
// names the one that it hangs on, and any number of them, inner ones too, may have a target.
//
// Method: FABRIK for several end effectors. Forward reaching, from the effectors inward, gives every joint a
// place that each of its branches proposes; where branches meet, the proposals are averaged, each by the
// weight of all effectors on its branch. Backward reaching, from the root outward, then gives every bone its
// length again. A. Aristidou, J. Lasenby, "FABRIK: A fast, iterative solver for the Inverse Kinematics
// problem", Graphical Models 73(5), 2011, section on multiple end effectors; A. Aristidou, Y. Chrysanthou, J.
// Lasenby, "Extending FABRIK with model constraints", Computer Animation and Virtual Worlds 27(1), 2016.
//
// From the third iteration on a damped Gauss-Newton step follows each pair of passes, and is kept where it
// brings the effectors nearer: of all moves that keep the lengths and bring the effectors to their targets,
// each to first order, the one that moves the joints least (Levenberg 1944, Marquardt 1963). On a tree its
// equations are solved from the leaves inward without fill-in (as D. Baraff, "Linear-time dynamics using
// Lagrange multipliers", SIGGRAPH 1996, does for forces). Without it reaching converges slowly where branches
// share joints.
//
// A Tree holds the joints' list and scratch memory, nothing of the solves before: what goes on from solve to
// solve are the joints' places and, where they are wanted, the bones' rotations, both the caller's.
//
// Cost: an iteration is O(joints on the way from the root to an effector), however many effectors there are.
// Solving allocates nothing, throws nothing and gives the same bits for the same call, in whatever order the
// effectors are listed.
//
// Branches without an effector take no part: each goes along, rigid, with the bone that it hangs on, turned
// by the minimal rotation of that bone. What hangs on the root itself, or on a joint that stays, stays where
// it is.
//
// Bones keep their lengths as in chain.hpp.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>

#include "tendril/ik/observer.hpp"
#include "tendril/ik/report.hpp"
#include "tendril/quat.hpp"
#include "tendril/result.hpp"
#include "tendril/vec3.hpp"

namespace tendril::ik {

struct TreeJoint {
    std::size_t parent = no_joint;  ///< comes before this joint in the list; the root, the first, has none
    float length = 0.0f;            ///< metres to the parent, 0 to 1e9; the root's has no effect
};

/// A joint with a target.
struct Effector {
    std::size_t joint = 0;
    glm::vec3 target{0.0f};  ///< metres, at most max_magnitude
    /// 0 to max_magnitude; 0 is ignored. Only the weights' ratios count, and only where the effectors cannot
    /// all be at their targets: then the sum of weight times squared distance is made small. A weight under
    /// 1e-4 of the heaviest counts as that.
    float weight = 1.0f;
};

struct TreeOptions {
    /// Metres, 0 to max_magnitude; 1e-3 of the reach where left out.
    std::optional<float> tolerance{};
    /// 1 to 1 000 000.
    int max_iterations = 100;
    /// Goes on to max_iterations whatever was reached; for measuring. Not where a single effector is out of
    /// reach: then there is nothing to iterate.
    bool every_iteration = false;
    /// The two passes alone, as published, for study: slower, and a straight branch stays on its line.
    bool plain = false;
    /// Where given, element i receives the worst residual after iteration i + 1, as far as it is long.
    std::span<float> residuals{};
    /// Where given, element i receives the metres from effector i's joint to its target when all is done, as
    /// far as it is long; also for those of weight 0.
    std::span<float> effector_residuals{};
    /// Where given, one a joint: element k is the rotation, in the world, of the bone that leads to joint k
    /// (the root's belongs to no bone and stays). Each is turned on by the minimal rotation from where its
    /// bone was (brought to its length) to where the solve leaves it. Unit quaternions, to 1e-3.
    std::span<glm::quat> rotations{};
};

struct TreeReport {
    /// Converged: every effector is within tolerance. Otherwise Stretched where the way from the root to one
    /// of them is shorter than to its target by more than the tolerance, or TooClose where it cannot fold
    /// that far; then Stalled (the effectors disagree, as a rule) or IterationLimit.
    Status status = Status::Converged;
    int iterations = 0;
    float residual = 0.0f;  ///< metres, the worst of the effectors that weigh something
    bool operator==(const TreeReport&) const = default;
};

class Tree {
  public:
    /// Refuses an empty list, a first joint that has a parent, another that has none or one that does not
    /// come before it, and a length out of its range.
    static Expected<Tree> make(std::span<const TreeJoint> joints);
    ~Tree();
    Tree(Tree&&) noexcept;
    Tree& operator=(Tree&&) noexcept;

    std::size_t size() const noexcept;
    /// The longest way from the root to a joint, metres.
    double reach() const noexcept;

    /// Moves the joints (size() of them, metres), all but the root, so that the effectors' come to their
    /// targets. What it starts from is brought to the bones' lengths first, if it was not. A target that its
    /// effector cannot reach counts as the nearest point that it can: how far off it lies adds nothing to its
    /// weight. InvalidInput, and nothing is moved, where a joint's index or a number is out of its range, or
    /// two effectors that weigh something sit on one joint.
    TreeReport solve(std::span<glm::vec3> joints, std::span<const Effector> effectors,
                     const TreeOptions& options = {}) noexcept;

  private:
    struct Parts;
    explicit Tree(std::unique_ptr<Parts> parts) noexcept;
    std::unique_ptr<Parts> parts_;
};

}  // namespace tendril::ik
