#include "rig/resolve.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "rig/checks.hpp"
#include "rig/plan.hpp"
#include "rig/value.hpp"
#include "tendril/magnitude.hpp"
#include "tendril/signal/spring.hpp"

namespace tendril::rig {

using detail::quoted;

namespace {

/// The Type of an input of T; -1 for one that takes any.
template <class T>
constexpr int type_index = -1;
template <>
constexpr int type_index<bool> = 0;
template <>
constexpr int type_index<double> = 1;
template <>
constexpr int type_index<glm::dvec3> = 2;
template <>
constexpr int type_index<glm::dquat> = 3;
template <>
constexpr int type_index<Transform> = 4;

Type part_type(Of of) noexcept {
    switch (of) {
        case Of::Transform:
            return Type::Transform;
        case Of::Translation:
        case Of::Scale:
            return Type::Vector;
        case Of::Rotation:
            return Type::Rotation;
        default:
            return Type::Number;
    }
}

/// Inputs with this suffix are weights: 0 to 1.
bool is_weight(std::string_view name) {
    return name == "weight" || name.ends_with(".weight");
}

}  // namespace

bool converts(Type from, Type to) noexcept {
    return from == to || (from == Type::Bool && to == Type::Number) ||
           (from == Type::Transform && (to == Type::Vector || to == Type::Rotation));
}

void Resolver::refuse(const std::string& what) {
    if (refusal_) refusal_ = Result(ErrorCode::InvalidArgument, place_ + ": " + what);
}

Expected<std::vector<Output>> Resolver::resolve(Unit& unit, std::size_t index,
                                                std::optional<std::size_t> for_each) {
    index_ = index;
    for_each_ = for_each;
    refusal_ = {};
    any_types_.clear();
    place_ = "unit " + quoted(unit.name);
    std::vector<Output> outputs = rig::outputs(unit.operation);
    field("weight", unit.weight);
    field("when", unit.when);
    std::visit(
        [&](auto& operation) {
            fields(operation, [&](const char* name, auto& member) { field(name, member); });
        },
        unit.operation);
    if (auto* set = std::get_if<SetCurve>(&unit.operation)) {
        const auto found = layout_.curves.find(set->curve);
        if (found == layout_.curves.end())
            refuse("curve: there is no curve " + quoted(set->curve));
        else
            set->resolved.index = static_cast<std::int32_t>(found->second);
    }
    if (std::holds_alternative<SpringInterpolate>(unit.operation) && refusal_) spring(outputs);
    if (!refusal_) return refusal_;
    return outputs;
}

void Resolver::spring(std::vector<Output>& handed_out) {
    const Type target = any_types_[0];
    if (target == Type::Bool || target == Type::Transform)
        return refuse(std::string("target takes a number, a vector or a rotation, got a ") + name(target));
    const Type rate = target == Type::Rotation ? Type::Vector : target;
    if (any_types_.size() > 1 && any_types_[1] != rate)
        return refuse(std::string("force takes a ") + name(rate) + " here, got a " + name(any_types_[1]));
    handed_out[0].type = target;
    handed_out[1].type = rate;
}

void Resolver::field(const std::string& name, Item& item) {
    item.resolved = {};
    if (std::holds_alternative<ThisElement>(item.which)) {
        if (!for_each_) refuse(name + R"(: {"item": "each"} only works inside a for-each)");
        return;
    }
    const auto& element = std::get<std::string>(item.which);
    const auto found = layout_.elements.find(element);
    if (found == layout_.elements.end()) return refuse(name + ": there is no element " + quoted(element));
    item.resolved.index = static_cast<std::int32_t>(found->second);
}

void Resolver::field(const std::string& name, AimInputs& inputs) {
    fields(inputs, [&](const char* member, auto& value) { field(name + "." + member, value); });
}

void Resolver::field(const std::string& name, std::vector<ParentInputs>& parents) {
    if (parents.empty()) return refuse(name + " must not be empty");
    for (std::size_t i = 0; i < parents.size(); ++i)
        fields(parents[i], [&](const char* member, auto& value) {
            field(name + "[" + std::to_string(i) + "]." + member, value);
        });
}

void Resolver::field(const std::string& name, Body&) {
    if (for_each_) refuse(name + ": a for-each cannot be inside another");
}

void Resolver::field(const std::string& name, std::vector<std::string>& roots) {
    if (roots.empty()) return refuse(name + " must not be empty");
    for (const std::string& root : roots)
        if (!layout_.elements.contains(root)) return refuse(name + ": there is no element " + quoted(root));
}

void Resolver::field(const std::string& name, std::array<double, 2>& range) {
    for (const double end : range) check_literal(name, end);
}

void Resolver::field(const std::string& name, Space& space) {
    if (space != Space::Global && space != Space::Local) refuse(name + " must be global or local");
}

void Resolver::field(const std::string& name, signal::Curve& curve) {
    if (const Result bad = signal::check(curve); !bad) refuse(name + ": " + bad.message());
}

template <class T>
void Resolver::field(const std::string& name, Input<T>& input) {
    Type type{};
    if (T* literal = std::get_if<T>(&input.source)) {
        const Value value(*literal);
        type = type_of(value);
        check_literal(name, value);
    } else {
        type = std::visit(
            [&]<class Source>(Source& source) {
                if constexpr (std::is_same_v<Source, T>)
                    return Type::Bool;  // handled above
                else
                    return type_of_source(name, source);
            },
            input.source);
    }
    if (!refusal_) return;
    if constexpr (type_index<T> < 0) {
        any_types_.push_back(type);
    } else if (const auto wanted = static_cast<Type>(type_index<T>); !converts(type, wanted)) {
        refuse(name + " takes a " + rig::name(wanted) + ", got a " + rig::name(type));
    }
}

Type Resolver::type_of_source(const std::string& name, FromElement& from) {
    field(name, from.element);
    if (from.of != Of::ControlValue || !refusal_) return part_type(from.of);
    if (from.element.resolved.index < 0) {
        refuse(name + ": only a control has a value, but a for-each visits elements of any kind");
        return Type::Number;
    }
    const Element& element = definition_.elements[static_cast<std::size_t>(from.element.resolved.index)];
    if (element.kind != ElementKind::Control) {
        refuse(name + ": " + quoted(element.name) + " is not a control and has no value");
        return Type::Number;
    }
    return type_of(element.control.value_or(Control()).kind);
}

Type Resolver::type_of_source(const std::string& name, FromUnit& from) {
    const auto found = layout_.units_by_name.find(from.unit);
    if (found == layout_.units_by_name.end() || found->second >= index_ || found->second == for_each_) {
        refuse(name + ": no unit " + quoted(from.unit) + " runs before this one");
        return Type::Number;
    }
    const detail::UnitPlan& unit = layout_.units[found->second];
    if (unit.for_each && unit.for_each != for_each_) {
        refuse(name + ": unit " + quoted(from.unit) + " runs inside a for-each, once per element");
        return Type::Number;
    }
    from.resolved_unit.index = static_cast<std::int32_t>(found->second);
    const std::vector<Output>& handed_out = unit.outputs;
    const auto output = std::find_if(handed_out.begin(), handed_out.end(),
                                     [&](const Output& each) { return each.name == from.output; });
    if (output == handed_out.end()) {
        refuse(name + ": unit " + quoted(from.unit) + " has no output " + quoted(from.output));
        return Type::Number;
    }
    from.resolved_output.index = static_cast<std::int32_t>(output - handed_out.begin());
    return output->type;
}

Type Resolver::type_of_source(const std::string& name, Each&) {
    if (!for_each_) refuse(name + R"(: {"each": ...} only works inside a for-each)");
    return Type::Number;
}

void Resolver::check_literal(const std::string& name, const Value& value) {
    if (const auto* number = std::get_if<double>(&value)) {
        const std::string got = ", got " + std::string(tendril::detail::Shown(*number).text());
        if (name.starts_with("parents[") && !(*number >= 0.0)) refuse(name + " must not be negative" + got);
        if (is_weight(name) && !name.starts_with("parents[") && !(*number >= 0.0 && *number <= 1.0))
            refuse(name + " must be 0 to 1" + got);
        if (name == "max_speed" && !(*number >= 0.0)) refuse(name + " must not be negative" + got);
        const auto check_up_to = [&](const char* parameter, double maximum, const char* range) {
            if (name == parameter && !(*number >= 0.0 && *number <= maximum))
                refuse(name + " must be " + range + got);
        };
        check_up_to("strength", signal::max_strength, "0 to 1e4 Hz");
        check_up_to("max_factor", 100.0, "0 to 100");
        check_up_to("critical_damping", signal::max_damping, "0 to 1000");
        check_up_to("target_velocity_amount", 1.0, "0 to 1");
    }
    if (const Result bad = check(name.c_str(), value); !bad) refuse(bad.message());
}

}  // namespace tendril::rig
