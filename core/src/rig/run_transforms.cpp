// The units that transform or constrain one element.
#include <algorithm>

#include "rig/math.hpp"
#include "rig/runner.hpp"
#include "rig/workspace.hpp"
#include "tendril/rig/transform_units.hpp"

namespace tendril::rig {
namespace {

Warning warning_of(AimWarning warning) noexcept {
    switch (warning) {
        case AimWarning::None:
            break;
        case AimWarning::ZeroAxis:
            return Warning::ZeroAxis;
        case AimWarning::TargetAtItem:
            return Warning::TargetAtItem;
        case AimWarning::TargetOnAxis:
            return Warning::SecondaryOnPrimary;
        case AimWarning::AxesParallel:
            return Warning::AxesParallel;
    }
    return Warning::None;
}

Transform normalised_transform(Transform transform) noexcept {
    transform.rotation = normalised(transform.rotation);
    return transform;
}

constexpr double radians = detail::pi / 180.0;

}  // namespace

AimPart Runner::part(const AimInputs& inputs) noexcept {
    return {read(inputs.axis), read(inputs.target), inputs.kind, weight(inputs.weight)};
}

Transform Runner::aimed(const Transform& from, const AimInputs& primary,
                        const std::optional<AimInputs>& secondary, const Input<double>& max_speed) noexcept {
    AimOptions options{.primary = part(primary), .weight = weight_};
    options.secondary.weight = 0.0;
    if (secondary) options.secondary = part(*secondary);
    const AimResult result = aim(from, options);
    warn(warning_of(result.primary));
    warn(warning_of(result.secondary));

    const double speed = read(max_speed);
    if (!(speed > 0.0)) return result.transform;
    // The item is reset at every solve, so its last rotation is remembered here.
    if (skipped_) return from;
    auto* turned = std::get_if<Turned>(&memory().held);
    if (!turned) turned = &memory().held.emplace<Turned>(Turned{result.transform.rotation});
    Transform limited = result.transform;
    const double angle = 2.0 * detail::half_angle_between(turned->rotation, limited.rotation);
    const double max_turn = dt_ > 0.0 ? speed * radians * dt_ : 0.0;
    if (angle > max_turn) {
        limited.rotation = blend(turned->rotation, limited.rotation, max_turn / angle);
        moving_ = true;
    }
    turned->rotation = limited.rotation;
    return limited;
}

void Runner::operator()(const Aim& op) noexcept {
    const ElementId id = item(op.item);
    const Transform from = state_.elements.get(id, Space::Global);
    const Transform to = aimed(from, op.primary, op.secondary, op.max_speed);
    place(id, Space::Global, to, true);
    set_output(0, state_.elements.get(id, Space::Global));
}

void Runner::operator()(const AimMath& op) noexcept {
    set_output(0, aimed(read(op.transform), op.primary, op.secondary, op.max_speed));
}

void Runner::operator()(const ParentConstraint& op) noexcept {
    Hierarchy& tree = state_.elements;
    const ElementId id = item(op.item);
    std::vector<ConstraintParent>& parents = workspace_.parents;
    parents.clear();  // keeps its capacity, which is enough for every unit of the rig
    double sum = 0.0;
    for (const ParentInputs& inputs : op.parents) {
        const ElementId parent = item(inputs.item);
        const double weight = std::max(0.0, read(inputs.weight));
        parents.push_back(
            {tree.get(parent, Space::Global), tree.get(parent, Space::Global, Pose::Initial), weight});
        sum += weight;
    }
    if (sum == 0.0) warn(Warning::ZeroWeights);
    const ElementId above = tree.parent(id);
    const ConstraintChild child{tree.get(id, Space::Global), tree.get(id, Space::Global, Pose::Initial),
                                above ? tree.get(above, Space::Global) : Transform()};
    const ParentConstraintOptions options{
        .maintain_offset = read(op.maintain_offset), .filter = op.filter, .weight = weight_};
    place(id, Space::Global, parent_constraint(child, parents, options), true);
    set_output(0, tree.get(id, Space::Global));
}

void Runner::operator()(const OffsetTransform& op) noexcept {
    const ElementId id = item(op.item);
    const Transform from = state_.elements.get(id, Space::Global);
    place(id, Space::Global, offset_transform(from, normalised_transform(read(op.offset)), weight_),
          read(op.propagate));
    set_output(0, state_.elements.get(id, Space::Global));
}

void Runner::operator()(const SetTransform& op) noexcept {
    const ElementId id = item(op.item);
    const Transform from = state_.elements.get(id, op.space);
    place(id, op.space, set_transform(from, normalised_transform(read(op.transform)), weight_),
          read(op.propagate));
    set_output(0, state_.elements.get(id, Space::Global));
}

void Runner::operator()(const SetRotation& op) noexcept {
    const ElementId id = item(op.item);
    const Transform from = state_.elements.get(id, op.space);
    place(id, op.space, set_rotation(from, normalised(read(op.rotation)), weight_), read(op.propagate));
    set_output(0, state_.elements.get(id, op.space).rotation);
}

void Runner::operator()(const ProjectToParent& op) noexcept {
    Hierarchy& tree = state_.elements;
    const Transform child = tree.get(item(op.child), Space::Global, Pose::Initial);
    const Transform old_parent = tree.get(item(op.old_parent), Space::Global, Pose::Initial);
    const Transform to = project_to_parent(child, old_parent, global(op.new_parent));
    set_output(0, blend(global(op.child), to, weight_));
}

void Runner::operator()(const FromTwoVectors& op) noexcept {
    const glm::dquat full = from_two_vectors(read(op.from), read(op.to));
    set_output(0, blend(glm::dquat(1.0, 0.0, 0.0, 0.0), full, weight_));
}

void Runner::operator()(const TransformLocation& op) noexcept {
    const glm::dvec3 from = read(op.location);
    set_output(0, detail::mix(from, transform_location(read(op.transform), from), weight_));
}

void Runner::operator()(const TransformDirection& op) noexcept {
    const glm::dvec3 from = read(op.direction);
    set_output(0, detail::mix(from, transform_direction(read(op.transform), from), weight_));
}

}  // namespace tendril::rig
