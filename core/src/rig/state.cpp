// The state of a rig: initial, adopted after an edit, and changed by setters.
#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "rig/math.hpp"
#include "rig/plan.hpp"
#include "rig/value.hpp"

namespace tendril::rig {
namespace {

using detail::Plan;

Result refused_index(const char* operation, const char* what, std::size_t index, std::size_t count) {
    return {ErrorCode::OutOfRange, std::string(operation) + ": " + what + " " + std::to_string(index) +
                                       " is out of range, the rig has " + std::to_string(count)};
}

std::optional<std::size_t> find_index(const Names& names, std::string_view name) {
    const auto at = names.find(name);
    return at == names.end() ? std::nullopt : std::optional(at->second);
}

/// The local pose before any unit has run: the input pose, or a control's pose for its value.
Transform start_local(const Plan& plan, State& state, std::size_t element) {
    const Transform& base = state.elements.get(plan.layout->ids[element], Space::Local, Pose::Input);
    const std::optional<Control>& control = plan.definition.elements[element].control;
    return control ? posed(*control, base, state.controls[element]) : base;
}

Transform start_global(const Plan& plan, State& state, std::size_t element) {
    std::vector<std::size_t> path;
    for (auto at = static_cast<std::int64_t>(element); at >= 0; at = plan.layout->parents[path.back()])
        path.push_back(static_cast<std::size_t>(at));
    Transform global = start_local(plan, state, path.back());
    for (path.pop_back(); !path.empty(); path.pop_back())
        global = compose(global, start_local(plan, state, path.back()));
    return global;
}

/// After the input pose of a control has been set: takes its value from that pose. A Vector2d keeps its value
/// and moves its rest pose instead.
void take_value(const Control& control, State& state, std::size_t element, ElementId id) {
    Hierarchy& tree = state.elements;
    const Transform there = tree.get(id, Space::Local, Pose::Input);
    Value& value = state.controls[element];
    switch (control.kind) {
        case ControlKind::Transform:
            value = clamped(control, there);
            break;
        case ControlKind::Position:
            value = clamped(control, there.translation);
            break;
        case ControlKind::Rotation:
            value = there.rotation;
            break;
        case ControlKind::Vector2d: {
            const Transform offset = posed(control, Transform(), value);
            Transform base = there;
            base.translation =
                detail::minus(base.translation, detail::rotated(there.rotation, offset.translation));
            tree.put(id, Space::Local, base, Propagate::Yes, Pose::Input);
            break;
        }
        case ControlKind::Float:
        case ControlKind::Bool:
            break;
    }
}

/// The names of the elements that a unit has memory of: for a chain, its bones; for a unit with a single
/// memory, one empty name.
std::vector<std::string_view> memory_names(const Plan& plan, std::size_t unit) {
    std::vector<std::string_view> names;
    const auto name = [&](std::uint32_t element) {
        return std::string_view(plan.definition.elements[element].name);
    };
    const detail::UnitPlan& planned = plan.layout->units[unit];
    for (const std::uint32_t bone : planned.bones) names.push_back(name(bone));
    if (planned.for_each)
        for (const detail::Visit& visit : plan.layout->units[*planned.for_each].visits)
            names.push_back(name(visit.element));
    else if (names.empty())
        names.emplace_back();
    return names;
}

/// Copies the memory of elements that still exist. Repeated visits to an element are matched in order.
void adopt_memory(const Plan& plan, std::size_t unit, UnitState& state, const Plan& before, std::size_t was,
                  const UnitState& old) {
    const std::vector<std::string_view> now = memory_names(plan, unit), then = memory_names(before, was);
    if (!plan.layout->units[unit].bones.empty() || !before.layout->units[was].bones.empty()) {
        if (now == then) state.memory = old.memory;
        return;
    }
    std::multimap<std::string_view, std::size_t> places;
    for (std::size_t i = 0; i < then.size(); ++i) places.emplace(then[i], i);
    for (std::size_t i = 0; i < now.size(); ++i) {
        const auto place = places.lower_bound(now[i]);
        if (place == places.end() || place->first != now[i]) continue;
        state.memory[i] = old.memory[place->second];
        places.erase(place);
    }
}

bool same_outputs(const UnitState& a, const UnitState& b) {
    return std::equal(a.outputs.begin(), a.outputs.end(), b.outputs.begin(), b.outputs.end(),
                      [](const Value& one, const Value& other) { return one.index() == other.index(); });
}
bool same_shape(const UnitState& a, const UnitState& b) {
    return a.memory.size() == b.memory.size() && same_outputs(a, b);
}

}  // namespace

Rig::Rig(const Rig& other) noexcept : plan_(other.plan_) {
    if (plan_) plan_->owners.fetch_add(1, std::memory_order_relaxed);
}
Rig::Rig(Rig&& other) noexcept : plan_(std::exchange(other.plan_, nullptr)) {}
Rig& Rig::operator=(const Rig& other) noexcept {
    return *this = Rig(other);
}
Rig& Rig::operator=(Rig&& other) noexcept {
    std::swap(plan_, other.plan_);
    return *this;
}
Rig::~Rig() {
    if (plan_ && plan_->owners.fetch_sub(1, std::memory_order_acq_rel) == 1) delete plan_;
}

const detail::Plan& Rig::plan() const noexcept {
    if (plan_) return *plan_;
    static const detail::Plan empty(Definition{}, detail::Shared(detail::Layout{}));
    return empty;
}
const Definition& Rig::definition() const noexcept {
    return plan().definition;
}
std::uint64_t Rig::work() const noexcept {
    return plan().layout->work;
}
ElementId Rig::id(std::size_t element) const noexcept {
    return element < plan().layout->ids.size() ? plan().layout->ids[element] : ElementId();
}
std::span<const std::string> Rig::unit_names() const noexcept {
    return plan().layout->unit_names;
}
std::optional<std::size_t> Rig::element(std::string_view name) const noexcept {
    return find_index(plan().layout->elements, name);
}
std::optional<std::size_t> Rig::curve(std::string_view name) const noexcept {
    return find_index(plan().layout->curves, name);
}

State Rig::initial_state() const {
    return plan().layout->initial;
}

bool Rig::keeps_states_of(const Rig& before) const noexcept {
    return plan().layout == before.plan().layout;
}

State Rig::adopted(const Rig& before, State state) const {
    if (keeps_states_of(before)) return state;
    const Plan &plan = this->plan(), &last = before.plan();
    State result = plan.layout->initial;
    Hierarchy old = state.elements;  // reading computes what is pending
    for (std::size_t i = 0; i < plan.layout->ids.size(); ++i) {
        const Element& element = plan.definition.elements[i];
        const auto was = before.element(element.name);
        if (!was) continue;
        const Element& then = before.definition().elements[*was];
        if (then.kind != element.kind || then.control != element.control ||
            !(then.initial == element.initial))
            continue;
        result.controls[i] = state.controls[*was];
        for (const Pose pose : {Pose::Input, Pose::Current})
            result.elements.put(plan.layout->ids[i], Space::Local,
                                old.get(before.id(*was), Space::Local, pose), Propagate::Yes, pose);
    }
    for (std::size_t i = 0; i < plan.definition.curves.size(); ++i)
        if (const auto was = before.curve(plan.definition.curves[i].name)) {
            result.curves[i] = state.curves[*was];
            result.input_curves[i] = state.input_curves[*was];
        }
    for (std::size_t i = 0; i < plan.layout->unit_names.size(); ++i) {
        const auto was = find_index(last.layout->units_by_name, plan.layout->unit_names[i]);
        if (!was || !same_outputs(state.units[*was], result.units[i])) continue;
        result.units[i].outputs = state.units[*was].outputs;
        result.units[i].warning = state.units[*was].warning;
        adopt_memory(plan, i, result.units[i], last, *was, state.units[*was]);
    }
    return result;
}

bool Rig::fits(const State& state) const noexcept {
    const Plan& plan = this->plan();
    const State& own = plan.layout->initial;
    if (state.elements.size() != own.elements.size() || state.controls.size() != own.controls.size() ||
        state.curves.size() != own.curves.size() || state.units.size() != own.units.size())
        return false;
    for (const ElementId id : plan.layout->ids)
        if (!state.elements.contains(id) || state.elements.parent(id) != own.elements.parent(id))
            return false;
    for (std::size_t i = 0; i < own.controls.size(); ++i)
        if (state.controls[i].index() != own.controls[i].index()) return false;
    return std::equal(state.units.begin(), state.units.end(), own.units.begin(), same_shape);
}

Result Rig::set_control(State& state, std::size_t element, const Value& value) const {
    const Plan& plan = this->plan();
    if (element >= plan.layout->ids.size())
        return refused_index("set_control", "element", element, plan.layout->ids.size());
    const Element& control = plan.definition.elements[element];
    if (!control.control)
        return {ErrorCode::InvalidArgument, "set_control: \"" + control.name + "\" is not a control"};
    if (const Result bad = check_value("set_control: value", *control.control, value); !bad) return bad;
    Value& held = state.controls[element];
    held = clamped(*control.control, normalised(value));
    const Transform& base = state.elements.get(plan.layout->ids[element], Space::Local, Pose::Input);
    state.elements.put(plan.layout->ids[element], Space::Local, posed(*control.control, base, held));
    return {};
}

Transform Rig::start_pose(const State& state, std::size_t element) const {
    const Plan& plan = this->plan();
    Transform global;
    for (auto at = static_cast<std::int64_t>(element); at >= 0;) {
        const auto each = static_cast<std::size_t>(at);
        const auto base = state.elements.known(plan.layout->ids[each], Space::Local, Pose::Input);
        if (!base) {
            State copy = state;  // reading computes what is pending
            return start_global(plan, copy, element);
        }
        const std::optional<Control>& control = plan.definition.elements[each].control;
        const Transform local = control ? posed(*control, *base, state.controls[each]) : *base;
        global = each == element ? local : compose(local, global);
        at = plan.layout->parents[each];
    }
    return global;
}

Result Rig::set_element(State& state, std::size_t element, Space space, const Transform& transform,
                        Propagate propagate) const {
    const Plan& plan = this->plan();
    if (element >= plan.layout->ids.size())
        return refused_index("set_element", "element", element, plan.layout->ids.size());
    const ElementId id = plan.layout->ids[element];
    const auto valid = checked(transform, "set_element");
    if (!valid) return valid.error();
    Hierarchy& tree = state.elements;

    // A child that stays keeps its global pose at the start of a solve. For a control, its value sets that
    // pose.
    std::vector<std::pair<std::size_t, Transform>> kept_globals;
    if (propagate == Propagate::No) {
        const Transform before = start_global(plan, state, element);
        for (std::size_t i = 0; i < plan.layout->ids.size(); ++i)
            if (tree.parent(plan.layout->ids[i]) == id)
                kept_globals.emplace_back(i, compose(before, start_local(plan, state, i)));
    }

    // Below a control a global pose is relative to where the control is now, not to where it was at rest.
    const std::int64_t parent = plan.layout->parents[element];
    const bool below = space == Space::Global && parent >= 0;
    const Transform local =
        below ? relative(start_global(plan, state, static_cast<std::size_t>(parent)), *valid) : *valid;
    tree.put(id, Space::Local, local, propagate, Pose::Input);
    tree.put(id, space, *valid, propagate);
    const std::optional<Control>& control = plan.definition.elements[element].control;
    if (control) {
        take_value(*control, state, element, id);
        if (control->minimum || control->maximum)
            tree.put(id, Space::Local, start_local(plan, state, element), propagate);
    }

    if (kept_globals.empty()) return {};
    const Transform after = start_global(plan, state, element);
    for (const auto& [child, global] : kept_globals) {
        const ElementId at = plan.layout->ids[child];
        tree.put(at, Space::Local, relative(after, global), Propagate::Yes, Pose::Input);
        if (const auto& settings = plan.definition.elements[child].control)
            take_value(*settings, state, child, at);
    }
    return {};
}

Result Rig::set_curve(State& state, std::size_t curve, double value) const {
    if (curve >= state.curves.size()) return refused_index("set_curve", "curve", curve, state.curves.size());
    if (const Result bad = check("set_curve: value", value); !bad) return bad;
    state.curves[curve] = state.input_curves[curve] = value;
    return {};
}

}  // namespace tendril::rig
