// The tree's doors: what may come in, what is said when it is done.
#include "tendril/ik/tree.hpp"

#include <algorithm>
#include <cmath>

#include "ik/math.hpp"
#include "ik/solve/validate.hpp"
#include "ik/tree/workspace.hpp"
#include "math/checks.hpp"

namespace tendril::ik {

using namespace detail;

struct Tree::Parts {
    TreeRoom room;
};

namespace {

Result check_joint(std::size_t index, const TreeJoint& joint) noexcept {
    using namespace tendril::detail;
    const Argument parent{"joints", index, "parent"};
    if (index == 0 && joint.parent != no_joint)
        return refused("Tree", parent, "no_joint, for it is the root", joint.parent);
    if (index > 0 && joint.parent == no_joint)
        return refused("Tree", parent, "a joint before this one", "no_joint");
    if (index > 0 && joint.parent >= index)
        return refused("Tree", parent, "a joint before this one", joint.parent);
    return check_length("Tree", {"joints", index, "length"}, joint.length);
}

bool is_valid(const Effector& effector, std::size_t joints) noexcept {
    return effector.joint < joints && tendril::detail::is_point(effector.target) &&
           tendril::detail::is_length(effector.weight);
}

/// Marks the joints that have an effector; false where one has two.
bool are_apart(TreeRoom& room, std::span<const Effector> effectors) noexcept {
    std::fill(room.effector_at.begin(), room.effector_at.end(), no_joint);
    for (std::size_t i = 0; i < effectors.size(); ++i) {
        if (effectors[i].weight == 0.0f) continue;
        if (room.effector_at[effectors[i].joint] != no_joint) return false;
        room.effector_at[effectors[i].joint] = i;
    }
    return true;
}

bool is_valid(TreeRoom& room, std::span<const glm::vec3> joints, std::span<const Effector> effectors,
              const TreeOptions& options) noexcept {
    if (joints.size() != room.joints.size()) return false;
    if (options.tolerance && !tendril::detail::is_length(*options.tolerance)) return false;
    if (options.max_iterations < 1 || options.max_iterations > 1'000'000) return false;
    for (const glm::vec3& joint : joints) {
        if (!tendril::detail::is_point(joint)) return false;
    }
    for (const Effector& effector : effectors) {
        if (!is_valid(effector, joints.size())) return false;
    }
    if (!options.rotations.empty() && options.rotations.size() != joints.size()) return false;
    if (!std::all_of(options.rotations.begin(), options.rotations.end(), is_unit)) return false;
    return are_apart(room, effectors);
}

/// What keeps the effectors from their targets, where one of them could not even get there by itself.
Status out_of_reach(const TreeRoom& room, std::span<const Effector> effectors, double tolerance,
                    Status otherwise) noexcept {
    Status status = otherwise;
    for (const Effector& effector : effectors) {
        if (effector.weight == 0.0f) continue;
        const double far = gap(room.start[0], effector.target);
        const double furthest = room.path_reach[effector.joint];
        if (far - furthest > tolerance) return Status::Stretched;
        if (2.0 * room.path_longest[effector.joint] - furthest - far > tolerance) status = Status::TooClose;
    }
    return status;
}

double tell_residuals(std::span<const glm::vec3> joints, std::span<const Effector> effectors,
                      std::span<float> residuals) noexcept {
    double worst = 0.0;
    for (std::size_t i = 0; i < effectors.size(); ++i) {
        const double residual = gap(joints[effectors[i].joint], effectors[i].target);
        if (i < residuals.size()) residuals[i] = static_cast<float>(residual);
        if (effectors[i].weight > 0.0f) worst = std::max(worst, residual);
    }
    return worst;
}

}  // namespace

Tree::Tree(std::unique_ptr<Parts> parts) noexcept : parts_(std::move(parts)) {}

Expected<Tree> Tree::make(std::span<const TreeJoint> joints) {
    if (joints.empty()) return tendril::detail::refused("Tree", "joints", "at least one", "none");
    for (std::size_t k = 0; k < joints.size(); ++k) {
        if (const Result bad = check_joint(k, joints[k]); !bad) return bad;
    }
    auto parts = std::make_unique<Parts>();
    TreeRoom& room = parts->room;
    const std::size_t count = joints.size();
    room.joints.assign(joints.begin(), joints.end());
    room.path_reach.resize(count);
    room.path_longest.resize(count);
    for (std::size_t k = 1; k < count; ++k) {
        const double length = static_cast<double>(joints[k].length);
        room.path_reach[k] = room.path_reach[joints[k].parent] + length;
        room.path_longest[k] = std::max(room.path_longest[joints[k].parent], length);
        room.reach = std::max(room.reach, room.path_reach[k]);
    }
    for (auto* places : {&room.start, &room.at, &room.proposed, &room.next, &room.trial, &room.best}) {
        places->resize(count);
    }
    for (auto* indices : {&room.slot_of, &room.effector_at, &room.goals}) indices->resize(count);
    room.turns.resize(count);
    room.slots.resize(count);
    room.responses.resize(count);
    return Tree(std::move(parts));
}

Tree::~Tree() = default;
Tree::Tree(Tree&&) noexcept = default;
Tree& Tree::operator=(Tree&&) noexcept = default;

std::size_t Tree::size() const noexcept {
    return parts_->room.joints.size();
}

double Tree::reach() const noexcept {
    return parts_->room.reach;
}

TreeReport Tree::solve(std::span<glm::vec3> joints, std::span<const Effector> effectors,
                       const TreeOptions& options) noexcept {
    TreeRoom& room = parts_->room;
    if (!is_valid(room, joints, effectors, options)) return {Status::InvalidInput, 0, 0.0f};
    const double tolerance = options.tolerance ? static_cast<double>(*options.tolerance) : 1e-3 * room.reach;
    prepare(room, joints, effectors);
    TreeReport report;
    bool stalled = false;
    const bool there = worst_residual(room, effectors) <= tolerance;
    if ((!there || options.every_iteration) && !lay_at_rim(room, effectors)) {
        const TreeRun run = iterate(room, effectors, options, tolerance);
        report.iterations = run.iterations;
        stalled = run.stalled;
    }
    finish(room, joints);
    if (!options.rotations.empty()) carry_rotations(room, joints, options.rotations);
    const double residual = tell_residuals(joints, effectors, options.effector_residuals);
    report.residual = static_cast<float>(residual);
    if (residual > tolerance) {
        report.status =
            out_of_reach(room, effectors, tolerance, stalled ? Status::Stalled : Status::IterationLimit);
    }
    return report;
}

}  // namespace tendril::ik
