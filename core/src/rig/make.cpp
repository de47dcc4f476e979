#include <algorithm>
#include <string>
#include <type_traits>
#include <variant>

#include "rig/checks.hpp"
#include "rig/plan.hpp"
#include "rig/resolve.hpp"
#include "rig/value.hpp"
#include "tendril/rig/collect.hpp"
#include "tendril/rig/rig.hpp"

namespace tendril::rig {
namespace {

using detail::Layout;
using detail::Plan;
using detail::quoted;
using detail::Shared;
using detail::UnitPlan;

/// Work, in steps of about 30 ns. A bone takes 10 while its chain follows a target and 20 when the chain must
/// bend into a new pose; 20 is charged.
constexpr std::uint64_t work_per_unit = 10, work_per_bone = 20;

Result invalid(const std::string& message) {
    return {ErrorCode::InvalidArgument, message};
}
Result missing(const std::string& message) {
    return {ErrorCode::NotFound, message};
}

class Builder {
  public:
    explicit Builder(Definition definition) : definition_(std::move(definition)) {}

    Expected<const Plan*> build() {
        if (const Result bad = index_names(); !bad) return bad;
        if (const Result bad = add_elements(); !bad) return bad;
        if (const Result bad = add_controls_and_curves(); !bad) return bad;
        for (; top_ < definition_.units.size(); ++top_)
            if (const Result bad = add_unit(definition_.units[top_], 1); !bad) return bad;
        return new Plan(std::move(definition_), Shared(std::move(layout_)));
    }

  private:
    Result index_names() {
        for (std::size_t i = 0; i < definition_.elements.size(); ++i) {
            const Element& element = definition_.elements[i];
            if (element.name.empty())
                return invalid("elements[" + std::to_string(i) + "]: its name is empty");
            if (!layout_.elements.emplace(element.name, i).second)
                return {ErrorCode::AlreadyExists,
                        "element " + quoted(element.name) + ": another has this name already"};
        }
        for (const Element& element : definition_.elements) {
            const auto parent = layout_.elements.find(element.parent);
            if (!element.parent.empty() && parent == layout_.elements.end())
                return missing("element " + quoted(element.name) + ": there is no element " +
                               quoted(element.parent) + " for its parent");
            layout_.parents.push_back(element.parent.empty() ? -1
                                                             : static_cast<std::int64_t>(parent->second));
        }
        for (std::size_t i = 0; i < definition_.curves.size(); ++i) {
            const NamedCurve& curve = definition_.curves[i];
            if (curve.name.empty()) return invalid("curves[" + std::to_string(i) + "]: its name is empty");
            if (!layout_.curves.emplace(curve.name, i).second)
                return {ErrorCode::AlreadyExists,
                        "curve " + quoted(curve.name) + ": another has this name already"};
            if (const Result bad = check("value", curve.value); !bad)
                return invalid("curve " + quoted(curve.name) + ": " + bad.message());
        }
        return {};
    }

    /// Adds parents before their children, whatever their order in the definition.
    Result add_elements() {
        const std::size_t count = definition_.elements.size();
        layout_.work = count;
        layout_.ids.resize(count);
        element_at_.resize(count);
        std::vector<std::size_t> path;
        for (std::size_t i = 0; i < count; ++i) {
            path.clear();
            for (std::int64_t at = static_cast<std::int64_t>(i);
                 at >= 0 && !layout_.ids[static_cast<std::size_t>(at)];) {
                const auto element = static_cast<std::size_t>(at);
                path.push_back(element);
                if (path.size() > count) return refused_cycle(path);
                at = layout_.parents[element];
            }
            for (; !path.empty(); path.pop_back())
                if (const Result bad = add_element(path.back()); !bad) return bad;
        }
        return {};
    }

    Result refused_cycle(const std::vector<std::size_t>& path) const {
        const auto name = [&](std::size_t at) { return quoted(definition_.elements[path[at]].name); };
        // The last element is part of the cycle; the one before it is its child.
        const std::size_t last = path.size() - 1;
        return invalid("element " + name(last) + ": its parent " +
                       quoted(definition_.elements[path[last]].parent) + " is itself below it");
    }

    Result add_element(std::size_t at) {
        const Element& element = definition_.elements[at];
        const std::int64_t parent = layout_.parents[at];
        const Expected<ElementId> id = layout_.initial.elements.add(
            element.kind, parent < 0 ? ElementId{} : layout_.ids[static_cast<std::size_t>(parent)],
            element.initial);
        if (!id) return {id.code(), "element " + quoted(element.name) + ": " + id.message()};
        layout_.ids[at] = *id;
        element_at_[id->index] = static_cast<std::uint32_t>(at);
        return {};
    }

    Result add_controls_and_curves() {
        for (Element& element : definition_.elements) {
            Value value = false;
            if (element.kind == ElementKind::Control) {
                if (!element.control) element.control.emplace();
                if (const Result bad = check("control", *element.control); !bad)
                    return invalid("element " + quoted(element.name) + ": " + bad.message());
                const auto id = layout_.ids[layout_.elements.find(element.name)->second];
                const Transform& rest = layout_.initial.elements.get(id, Space::Local);
                value = clamped(*element.control, rest_value(*element.control, rest));
                const Transform pose = posed(*element.control, rest, value);
                layout_.initial.elements.put(id, Space::Local, pose);
            } else if (element.control) {
                return invalid("element " + quoted(element.name) +
                               ": only a control can have a control's settings");
            }
            layout_.initial.controls.push_back(std::move(value));
        }
        for (const NamedCurve& curve : definition_.curves) layout_.initial.curves.push_back(curve.value);
        layout_.initial.input_curves = layout_.initial.curves;
        return {};
    }

    /// `times`: how often it runs in a solve. `around`: the index of the for-each that contains it, if any.
    Result add_unit(Unit& unit, std::size_t times, std::optional<std::size_t> around = {}) {
        const std::size_t index = layout_.units.size();
        const std::string place = "unit " + quoted(unit.name);
        if (unit.name.empty()) return invalid(place + ": its name is empty");
        if (!layout_.units_by_name.emplace(unit.name, index).second)
            return invalid(place + ": another unit has this name already");
        Expected<std::vector<Output>> outputs = Resolver(definition_, layout_).resolve(unit, index, around);
        if (!outputs) return outputs.error();
        UnitState state;
        state.memory.resize(times);
        for (const Output& output : *outputs) state.outputs.push_back(neutral(output.type));
        layout_.initial.units.push_back(std::move(state));
        layout_.unit_names.push_back(unit.name);
        layout_.units.push_back({{}, {}, {}, around, top_, std::move(*outputs)});
        layout_.work += times * work_per_unit;
        if (const auto* two_bone = std::get_if<TwoBone>(&unit.operation))
            return add_chain(unit, two_bone->root, two_bone->tip, 3, times, layout_.units[index]);
        if (const auto* fabrik = std::get_if<Fabrik>(&unit.operation))
            return add_chain(unit, fabrik->root, fabrik->tip, 0, times, layout_.units[index]);
        if (const auto* spline = std::get_if<Spline>(&unit.operation)) {
            for (const std::string& each : spline->points)
                layout_.units[index].points.push_back(
                    static_cast<std::uint32_t>(layout_.elements.find(each)->second));
            layout_.work += times * spline->points.size() * work_per_bone;
            return add_chain(unit, spline->root, spline->tip, 0, times, layout_.units[index]);
        }
        auto* for_each = std::get_if<ForEach>(&unit.operation);
        if (!for_each) return {};
        for (const std::string& root : for_each->roots) collect(*for_each, root, layout_.units[index]);
        const std::size_t count = layout_.units[index].visits.size();
        for (Unit& inner : for_each->body)
            if (const Result bad = add_unit(inner, count, index); !bad) return bad;
        return {};
    }

    void collect(const ForEach& for_each, const std::string& name, UnitPlan& planned) const {
        std::vector<ElementId> found;
        const Result there =
            collect_children(layout_.initial.elements, layout_.ids[layout_.elements.find(name)->second],
                             {for_each.include_parent, for_each.recursive}, found);
        if (!there) return;
        const auto count = static_cast<std::uint32_t>(found.size());
        for (std::uint32_t i = 0; i < count; ++i)
            planned.visits.push_back({element_at_[found[i].index], i, count});
    }

    Result add_chain(const Unit& unit, const Item& root, const Item& tip, std::size_t wanted,
                     std::size_t times, UnitPlan& planned) {
        const Result found = find_bones(unit, root, tip, wanted, planned);
        layout_.work += times * planned.bones.size() * work_per_bone;
        return found;
    }

    Result find_bones(const Unit& unit, const Item& root, const Item& tip, std::size_t wanted,
                      UnitPlan& planned) const {
        const std::string place = "unit " + quoted(unit.name) + ": ";
        if (root.resolved.index < 0 || tip.resolved.index < 0)
            return invalid(place + "root and tip must be elements by name");
        const auto end = static_cast<std::int64_t>(root.resolved.index);
        std::int64_t at = tip.resolved.index;
        for (; at >= 0; at = layout_.parents[static_cast<std::size_t>(at)]) {
            planned.bones.push_back(static_cast<std::uint32_t>(at));
            if (at == end) break;
        }
        const auto name = [&](const Item& item) { return quoted(std::get<std::string>(item.which)); };
        if (at < 0 || planned.bones.size() < 2)
            return invalid(place + "tip " + name(tip) + " must be below root " + name(root));
        if (wanted && planned.bones.size() != wanted)
            return invalid(place + "needs exactly two bones from " + name(root) + " to " + name(tip) +
                           ", got " + std::to_string(planned.bones.size() - 1));
        std::reverse(planned.bones.begin(), planned.bones.end());
        return {};
    }

    Definition definition_;
    Layout layout_;
    std::vector<std::uint32_t> element_at_;  ///< element index by handle index
    std::size_t top_ = 0;                    ///< unit of the definition
};

}  // namespace

Expected<Rig> Rig::make(Definition definition) {
    const Expected<const Plan*> plan = Builder(std::move(definition)).build();
    if (!plan) return plan.error();
    return Rig(*plan);
}

namespace {

/// Whether two units of the same operation place the same elements, as far as the layout knows.
bool same_elements(const Unit& one, const Unit& other) {
    return std::visit(
        [&]<class Op>(const Op& op) {
            [[maybe_unused]] const Op& as = std::get<Op>(other.operation);
            if constexpr (std::is_same_v<Op, ForEach>) return false;
            if constexpr (std::is_same_v<Op, Spline>)
                if (op.points != as.points) return false;
            if constexpr (requires { op.tip; })
                return op.root.resolved.index == as.root.resolved.index &&
                       op.tip.resolved.index == as.tip.resolved.index;
            return true;
        },
        one.operation);
}

bool same_types(const std::vector<Output>& a, const std::vector<Output>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const Output& one, const Output& other) { return one.type == other.type; });
}

}  // namespace

Expected<Rig> Rig::with_unit(Unit unit) const {
    const Layout& layout = *plan().layout;
    const auto found = layout.units_by_name.find(unit.name);
    if (found == layout.units_by_name.end()) return missing("there is no unit " + quoted(unit.name));
    const Definition& now = plan_->definition;
    const detail::UnitPlan& planned = layout.units[found->second];
    const Unit& top = now.units[planned.top];
    const auto* loop = planned.for_each ? &std::get<ForEach>(top.operation) : nullptr;
    const std::size_t inner = planned.for_each ? found->second - *planned.for_each - 1 : 0;
    const Unit& place = loop != nullptr ? loop->body[inner] : top;
    const auto outputs = Resolver(now, layout).resolve(unit, found->second, planned.for_each);
    if (!outputs) return outputs.error();
    const bool same_layout = unit.operation.index() == place.operation.index() &&
                             same_elements(unit, place) && same_types(*outputs, planned.outputs);
    if (loop != nullptr) {
        Unit around = top;
        std::get<ForEach>(around.operation).body[inner] = std::move(unit);
        unit = std::move(around);
    }
    Definition changed{now.elements, now.curves, now.units.with(planned.top, std::move(unit))};
    if (!same_layout) return make(changed);
    return Rig(new Plan(std::move(changed), plan_->layout));
}

}  // namespace tendril::rig
