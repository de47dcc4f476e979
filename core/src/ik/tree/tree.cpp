// Tree's entry points: checks input and writes the report.
#include "tendril/ik/tree.hpp"

#include <algorithm>

#include "ik/math.hpp"
#include "ik/solve/validate.hpp"
#include "ik/tree/workspace.hpp"
#include "math/checks.hpp"
#include "math/ranges.hpp"
#include "tendril/magnitude.hpp"

namespace tendril::ik {

using namespace detail;
using namespace tendril::detail;

struct Tree::Parts {
    TreeScratch scratch;
};

namespace {

Result check_joint(std::size_t index, const TreeJoint& joint) noexcept {
    const Argument parent{"joints", index, "parent"};
    if (index == 0 && joint.parent != no_joint)
        return refused("Tree", parent, "no_joint, as it is the root", joint.parent);
    if (index > 0 && joint.parent == no_joint)
        return refused("Tree", parent, "a joint before this one", "no_joint");
    if (index > 0 && joint.parent >= index)
        return refused("Tree", parent, "a joint before this one", joint.parent);
    return check_length("Tree", {"joints", index, "length"}, joint.length);
}

constexpr Field joint_rows[] = {index<&TreeJoint::parent>("parent", "joints", true),
                                field<&TreeJoint::length>("length", {0.0, max_magnitude}, "m")};
constexpr Field effector_rows[] = {index<&Effector::joint>("joint", "joints"),
                                   field<&Effector::target>("target", {-max_magnitude, max_magnitude}, "m"),
                                   field<&Effector::weight>("weight", {0.0, max_magnitude})};
constexpr Field tree_rows[] = {field<&TreeOptions::tolerance>("tolerance", {0.0, max_magnitude}, "m"),
                               field<&TreeOptions::max_iterations>("max_iterations", {1, 1'000'000}),
                               field<&TreeOptions::every_iteration>("every_iteration"),
                               field<&TreeOptions::plain>("plain")};

/// Refuses two effectors with a weight at one joint.
Result check_apart(TreeScratch& scratch, std::span<const Effector> effectors) noexcept {
    std::fill(scratch.effector_at.begin(), scratch.effector_at.end(), no_joint);
    for (std::size_t i = 0; i < effectors.size(); ++i) {
        if (effectors[i].weight == 0.0f) continue;
        std::size_t& at = scratch.effector_at[effectors[i].joint];
        if (at != no_joint)
            return refused("solve", {"effectors", i, "joint"}, "a joint of its own", effectors[i].joint);
        at = i;
    }
    return {};
}

Result check_input(TreeScratch& scratch, std::span<const glm::vec3> joints,
                   std::span<const Effector> effectors, const TreeOptions& options) noexcept {
    const std::size_t count = scratch.joints.size();
    if (const Result bad = check_count("solve", "joints", joints.size(), count); !bad) return bad;
    if (!are_in_range<tree_rows>(&options)) return check_fields("solve", options);
    for (std::size_t i = 0; i < joints.size(); ++i)
        if (!is_point(joints[i])) return refused_point("solve", {"joints", i}, joints[i]);
    for (std::size_t i = 0; i < effectors.size(); ++i) {
        const Effector& each = effectors[i];
        if (each.joint >= count)
            return refused("solve", {"effectors", i, "joint"}, "a joint of the tree", each.joint);
        if (!are_in_range<effector_rows>(&each)) return refused_element("solve", "effectors", i, each);
    }
    if (!options.rotations.empty() && options.rotations.size() != count)
        return refused_count("solve", "rotations", options.rotations.size(), count);
    for (std::size_t i = 0; i < options.rotations.size(); ++i)
        if (!is_unit(options.rotations[i]))
            return refused("solve", {"rotations", i}, "a unit quaternion", "one of another length");
    return check_apart(scratch, effectors);
}

/// Stretched or TooClose if an effector could not reach its target even alone; else `otherwise`.
Status out_of_reach(const TreeScratch& scratch, std::span<const Effector> effectors, double tolerance,
                    Status otherwise) noexcept {
    Status status = otherwise;
    for (const Effector& effector : effectors) {
        if (effector.weight == 0.0f) continue;
        const double far = gap(scratch.start[0], effector.target);
        const Status here = scratch.path[effector.joint].status(far, tolerance);
        if (here == Status::Stretched) return here;
        if (here == Status::TooClose) status = here;
    }
    return status;
}

double write_residuals(std::span<const glm::vec3> joints, std::span<const Effector> effectors,
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
    if (joints.empty()) return refused("Tree", "joints", "at least one", "none");
    for (std::size_t k = 0; k < joints.size(); ++k) {
        if (const Result bad = check_joint(k, joints[k]); !bad) return bad;
    }
    auto parts = std::make_unique<Parts>();
    TreeScratch& scratch = parts->scratch;
    const std::size_t count = joints.size();
    scratch.joints.assign(joints.begin(), joints.end());
    scratch.path.resize(count);
    std::vector<double> longest(count);
    for (std::size_t k = 1; k < count; ++k) {
        const double length = static_cast<double>(joints[k].length);
        longest[k] = std::max(longest[joints[k].parent], length);
        scratch.path[k] = Reachability::of(scratch.path[joints[k].parent].furthest + length, longest[k]);
        scratch.reach = std::max(scratch.reach, scratch.path[k].furthest);
    }
    for (auto* places :
         {&scratch.start, &scratch.at, &scratch.proposed, &scratch.next, &scratch.trial, &scratch.best}) {
        places->resize(count);
    }
    for (auto* indices : {&scratch.node_of, &scratch.effector_at, &scratch.goals}) indices->resize(count);
    scratch.rotations.resize(count);
    scratch.nodes.resize(count);
    scratch.responses.resize(count);
    return Tree(std::move(parts));
}

Tree::~Tree() = default;
Tree::Tree(Tree&&) noexcept = default;
Tree& Tree::operator=(Tree&&) noexcept = default;

std::size_t Tree::size() const noexcept {
    return parts_ ? parts_->scratch.joints.size() : 0;
}

double Tree::reach() const noexcept {
    return parts_ ? parts_->scratch.reach : 0.0;
}

TreeReport Tree::solve(std::span<glm::vec3> joints, std::span<const Effector> effectors,
                       const TreeOptions& options) noexcept {
    if (!parts_) return refusal<TreeReport>(moved_from("solve", "tree"));
    if (const Result bad = check_input(parts_->scratch, joints, effectors, options); !bad)
        return refusal<TreeReport>(bad);
    TreeScratch& scratch = parts_->scratch;
    const double tolerance =
        options.tolerance ? static_cast<double>(*options.tolerance) : 1e-3 * scratch.reach;
    prepare(scratch, joints, effectors);
    TreeReport report;
    bool stalled = false;
    const bool converged = worst_residual(scratch, effectors) <= tolerance;
    if ((!converged || options.every_iteration) && !solve_out_of_reach(scratch, effectors)) {
        const TreeRun run = iterate(scratch, effectors, options, tolerance);
        report.iterations = run.iterations;
        stalled = run.stalled;
    }
    finish(scratch, joints);
    if (!options.rotations.empty()) transport_rotations(scratch, joints, options.rotations);
    const double residual = write_residuals(joints, effectors, options.effector_residuals);
    report.residual = static_cast<float>(residual);
    if (residual > tolerance) {
        report.status =
            out_of_reach(scratch, effectors, tolerance, stalled ? Status::Stalled : Status::IterationLimit);
    }
    return report;
}

}  // namespace tendril::ik

template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::TreeJoint>() noexcept {
    return ik::joint_rows;
}

template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::Effector>() noexcept {
    return ik::effector_rows;
}

template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::TreeOptions>() noexcept {
    return ik::tree_rows;
}
