#include <algorithm>

#include "rig/math.hpp"
#include "rig/runner.hpp"

namespace tendril::rig {

const char* message(Warning warning) noexcept {
    switch (warning) {
        case Warning::None:
            break;
        case Warning::TargetAtItem:
            return "the target is at the item, so there is no direction to it";
        case Warning::ZeroAxis:
            return "an axis has no length";
        case Warning::SecondaryOnPrimary:
            return "the second target is on the primary axis, so the roll is undefined";
        case Warning::AxesParallel:
            return "the two axes are parallel";
        case Warning::ZeroWeights:
            return "all weights are 0";
        case Warning::WeightOutOfRange:
            return "a weight is outside 0 to 1 and was clamped";
        case Warning::OutOfRange:
            return "the result is out of range and was discarded";
        case Warning::CannotSolve:
            return "the chain cannot be solved: a bone has no length or is out of range";
        case Warning::ParameterOutOfRange:
            return "a parameter is out of range and was clamped";
    }
    return "";
}

bool Rig::solve(State& state, double dt, Workspace& workspace, Observer* observer) const noexcept {
    Workspace::Parts* const parts = workspace.parts();
    return plan_ && parts && Runner(*plan_, state, dt, *parts).run(observer);
}

bool Runner::run(Observer* observer) noexcept {
    reset_pose();
    for (UnitState& unit : state_.units) unit.warning = Warning::None;
    if (observer) observer->begin(state_);
    const Units& units = plan_.definition.units;
    for (std::size_t i = 0; i < units.size(); ++i) {
        run_unit(units[i]);
        if (observer) observer->unit_done(i, state_);
    }
    return moving_;
}

/// Resets bones, nulls and curves to their input, and poses controls by their values.
void Runner::reset_pose() noexcept {
    std::copy(state_.input_curves.begin(), state_.input_curves.end(), state_.curves.begin());
    Hierarchy& tree = state_.elements;
    tree.copy_pose(Pose::Input, Pose::Current);
    for (std::size_t i = 0; i < plan_.layout->ids.size(); ++i) {
        const std::optional<Control>& control = plan_.definition.elements[i].control;
        if (!control) continue;
        const Transform& base = tree.get(plan_.layout->ids[i], Space::Local, Pose::Input);
        tree.put(plan_.layout->ids[i], Space::Local, posed(*control, base, state_.controls[i]));
    }
}

void Runner::run_unit(const Unit& unit) noexcept {
    unit_ = next_++;
    skipped_ = !unit.enabled || !read(unit.when);
    weight_ = skipped_ ? 0.0 : weight(unit.weight) * for_each_weight_;
    std::visit(*this, unit.operation);
}

void Runner::operator()(const ForEach& op) noexcept {
    const std::size_t own = unit_, first = next_;
    const std::vector<detail::Visit>& visits = plan_.layout->units[own].visits;
    set_output(0, static_cast<double>(visits.size()));
    for_each_weight_ = weight_;
    if (weight_ > 0.0)
        for (visit_index_ = 0; visit_index_ < visits.size(); ++visit_index_) {
            visit_ = &visits[visit_index_];
            next_ = first;
            for (const Unit& unit : op.body) run_unit(unit);
        }
    visit_ = nullptr;
    for_each_weight_ = 1.0;
    visit_index_ = 0;
    next_ = first + op.body.size();
}

Value Runner::value_of(const FromElement& from) noexcept {
    if (from.of == Of::ControlValue)
        return state_.controls[static_cast<std::size_t>(from.element.resolved.index)];
    const Transform& pose = state_.elements.get(item(from.element), from.space, from.pose);
    switch (from.of) {
        case Of::Translation:
            return pose.translation;
        case Of::Rotation:
            return pose.rotation;
        case Of::Scale:
            return pose.scale;
        case Of::X:
            return pose.translation.x;
        case Of::Y:
            return pose.translation.y;
        case Of::Z:
            return pose.translation.z;
        default:
            return pose;
    }
}

ElementId Runner::item(const Item& item) const noexcept {
    const auto index =
        item.resolved.index < 0 ? visit_->element : static_cast<std::uint32_t>(item.resolved.index);
    return plan_.layout->ids[index];
}

double Runner::weight(const Input<double>& input) noexcept {
    const double given = read(input);
    if (!(given >= 0.0 && given <= 1.0)) warn(Warning::WeightOutOfRange);
    return std::clamp(given, 0.0, 1.0);
}

double Runner::parameter(const Input<double>& input, double maximum) noexcept {
    const double given = read(input);
    if (!(given >= 0.0 && given <= maximum)) warn(Warning::ParameterOutOfRange);
    return std::clamp(given, 0.0, maximum);
}

void Runner::warn(Warning warning) noexcept {
    if (unit_state().warning == Warning::None && !skipped_) unit_state().warning = warning;
}

void Runner::set_output(std::size_t output, const Value& value) noexcept {
    if (is_in_range(value)) {
        unit_state().outputs[output] = value;
    } else {
        warn(Warning::OutOfRange);
        unit_state().outputs[output] = neutral(type_of(value));
    }
}

/// At weight 0 the element must stay unchanged to the last bit.
void Runner::place(ElementId id, Space space, const Transform& to, bool propagate) noexcept {
    if (weight_ == 0.0) return;
    if (!is_in_range(to)) return warn(Warning::OutOfRange);
    state_.elements.put(id, space, to, propagate ? Propagate::Yes : Propagate::No);
}

}  // namespace tendril::rig
