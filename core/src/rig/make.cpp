#include <algorithm>
#include <string>

#include "rig/checks.hpp"
#include "rig/plan.hpp"
#include "rig/resolve.hpp"
#include "rig/value.hpp"
#include "tendril/rig/collect.hpp"
#include "tendril/rig/rig.hpp"

namespace tendril::rig {
namespace {

using detail::Plan;
using detail::quoted;
using detail::UnitPlan;

/// In steps of about 30 ns. A bone of a chain takes ten if the chain follows, twice that if it has to be bent
/// anew.
constexpr std::uint64_t work_a_unit = 10, work_a_bone = 20;

Result invalid(const std::string& message) {
    return {ErrorCode::InvalidArgument, message};
}
Result missing(const std::string& message) {
    return {ErrorCode::NotFound, message};
}

class Builder {
  public:
    explicit Builder(Definition definition) { plan_.definition = std::move(definition); }

    Result build() {
        if (const Result bad = index_names(); !bad) return bad;
        if (const Result bad = add_elements(); !bad) return bad;
        if (const Result bad = add_controls_and_curves(); !bad) return bad;
        Resolver resolver(plan_.definition, plan_.elements, plan_.curves);
        if (const Result bad = resolver.resolve(plan_.definition.units); !bad) return bad;
        plan_.unit_names = std::move(resolver.names);
        plan_.units.resize(plan_.unit_names.size());
        for (std::size_t i = 0; i < plan_.units.size(); ++i)
            plan_.units[i].outputs = std::move(resolver.outputs[i]);
        for (std::size_t i = 0; i < plan_.units.size(); ++i) plan_.units_by_name[plan_.unit_names[i]] = i;
        return add_units();
    }
    Plan take() { return std::move(plan_); }

  private:
    Result index_names() {
        for (std::size_t i = 0; i < plan_.definition.elements.size(); ++i) {
            const Element& element = plan_.definition.elements[i];
            if (element.name.empty())
                return invalid("elements[" + std::to_string(i) + "]: its name is empty");
            if (!plan_.elements.emplace(element.name, i).second)
                return {ErrorCode::AlreadyExists,
                        "element " + quoted(element.name) + ": another has this name already"};
        }
        for (const Element& element : plan_.definition.elements) {
            const auto parent = plan_.elements.find(element.parent);
            if (!element.parent.empty() && parent == plan_.elements.end())
                return missing("element " + quoted(element.name) + ": there is no element " +
                               quoted(element.parent) + " for its parent");
            plan_.parents.push_back(element.parent.empty() ? -1 : static_cast<std::int64_t>(parent->second));
        }
        for (std::size_t i = 0; i < plan_.definition.curves.size(); ++i) {
            const NamedCurve& curve = plan_.definition.curves[i];
            if (curve.name.empty()) return invalid("curves[" + std::to_string(i) + "]: its name is empty");
            if (!plan_.curves.emplace(curve.name, i).second)
                return {ErrorCode::AlreadyExists,
                        "curve " + quoted(curve.name) + ": another has this name already"};
            if (const Result bad = check("value", curve.value); !bad)
                return invalid("curve " + quoted(curve.name) + ": " + bad.message());
        }
        return {};
    }

    /// Adds parents before their children, whatever their order in the definition.
    Result add_elements() {
        const std::size_t count = plan_.definition.elements.size();
        plan_.work = count;
        plan_.ids.resize(count);
        element_at_.resize(count);
        std::vector<std::size_t> line;
        for (std::size_t i = 0; i < count; ++i) {
            line.clear();
            for (std::int64_t at = static_cast<std::int64_t>(i);
                 at >= 0 && !plan_.ids[static_cast<std::size_t>(at)];) {
                const auto element = static_cast<std::size_t>(at);
                line.push_back(element);
                if (line.size() > count) return refused_cycle(line);
                at = plan_.parents[element];
            }
            for (; !line.empty(); line.pop_back())
                if (const Result bad = add_element(line.back()); !bad) return bad;
        }
        return {};
    }

    Result refused_cycle(const std::vector<std::size_t>& line) const {
        const auto name = [&](std::size_t at) { return quoted(plan_.definition.elements[line[at]].name); };
        // The last element is part of the cycle; the one before it is its child.
        const std::size_t last = line.size() - 1;
        return invalid("element " + name(last) + ": its parent " +
                       quoted(plan_.definition.elements[line[last]].parent) + " is itself below it");
    }

    Result add_element(std::size_t at) {
        const Element& element = plan_.definition.elements[at];
        const std::int64_t parent = plan_.parents[at];
        const Expected<ElementId> id = plan_.initial.elements.add(
            element.kind, parent < 0 ? ElementId{} : plan_.ids[static_cast<std::size_t>(parent)],
            element.initial);
        if (!id) return {id.code(), "element " + quoted(element.name) + ": " + id.message()};
        plan_.ids[at] = *id;
        element_at_[id->index] = static_cast<std::uint32_t>(at);
        return {};
    }

    Result add_controls_and_curves() {
        for (Element& element : plan_.definition.elements) {
            Value value = false;
            if (element.kind == ElementKind::Control) {
                if (!element.control) element.control.emplace();
                if (const Result bad = check("control", *element.control); !bad)
                    return invalid("element " + quoted(element.name) + ": " + bad.message());
                const auto id = plan_.ids[plan_.elements.find(element.name)->second];
                const Transform& rest = plan_.initial.elements.get(id, Space::Local);
                value = clamped(*element.control, rest_value(*element.control, rest));
                const Transform pose = posed(*element.control, rest, value);
                plan_.initial.elements.put(id, Space::Local, pose);
            } else if (element.control) {
                return invalid("element " + quoted(element.name) +
                               ": only a control can have a control's settings");
            }
            plan_.initial.controls.push_back(std::move(value));
        }
        for (const NamedCurve& curve : plan_.definition.curves) plan_.initial.curves.push_back(curve.value);
        plan_.initial.input_curves = plan_.initial.curves;
        return {};
    }

    Result add_units() {
        std::size_t at = 0;
        for (const Unit& unit : plan_.definition.units)
            if (const Result bad = add_unit(unit, at, 1); !bad) return bad;
        return {};
    }

    /// `times`: how many elements it runs on. `around`: the index of the for-each that contains it, if any.
    Result add_unit(const Unit& unit, std::size_t& at, std::size_t times,
                    std::optional<std::size_t> around = {}) {
        const std::size_t index = at++;
        UnitPlan& planned = plan_.units[index];
        planned.for_each = around;
        UnitState state;
        state.memory.resize(times);
        for (const Output& output : planned.outputs) state.outputs.push_back(neutral(output.type));
        plan_.initial.units.push_back(std::move(state));
        plan_.work += times * work_a_unit;
        if (const auto* two_bone = std::get_if<TwoBone>(&unit.operation))
            return add_chain(unit, two_bone->root, two_bone->tip, 3, times, planned);
        if (const auto* fabrik = std::get_if<Fabrik>(&unit.operation))
            return add_chain(unit, fabrik->root, fabrik->tip, 0, times, planned);
        const auto* for_each = std::get_if<ForEach>(&unit.operation);
        if (!for_each) return {};
        for (const std::string& root : for_each->roots) collect(*for_each, root, planned);
        const std::size_t count = planned.visits.size();
        for (const Unit& inner : for_each->body.units())
            if (const Result bad = add_unit(inner, at, count, index); !bad) return bad;
        return {};
    }

    void collect(const ForEach& for_each, const std::string& name, UnitPlan& planned) const {
        std::vector<ElementId> found;
        const Result there =
            collect_children(plan_.initial.elements, plan_.ids[plan_.elements.find(name)->second],
                             {for_each.include_parent, for_each.recursive}, found);
        if (!there) return;
        const auto count = static_cast<std::uint32_t>(found.size());
        for (std::uint32_t i = 0; i < count; ++i)
            planned.visits.push_back({element_at_[found[i].index], i, count});
    }

    Result add_chain(const Unit& unit, const Item& root, const Item& tip, std::size_t wanted,
                     std::size_t times, UnitPlan& planned) {
        const Result found = find_bones(unit, root, tip, wanted, planned);
        plan_.work += times * planned.bones.size() * work_a_bone;
        return found;
    }

    Result find_bones(const Unit& unit, const Item& root, const Item& tip, std::size_t wanted,
                      UnitPlan& planned) const {
        const std::string place = "unit " + quoted(unit.name) + ": ";
        if (root.resolved.index < 0 || tip.resolved.index < 0)
            return invalid(place + "root and tip must be elements by name");
        const auto end = static_cast<std::int64_t>(root.resolved.index);
        std::int64_t at = tip.resolved.index;
        for (; at >= 0; at = plan_.parents[static_cast<std::size_t>(at)]) {
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

    Plan plan_;
    std::vector<std::uint32_t> element_at_;  ///< element index by handle index
};

}  // namespace

Expected<Rig> Rig::make(Definition definition) {
    Builder builder(std::move(definition));
    if (const Result bad = builder.build(); !bad) return bad;
    return Rig(new Plan(builder.take()));
}

}  // namespace tendril::rig
