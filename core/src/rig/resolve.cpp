#include "rig/resolve.hpp"

#include <algorithm>
#include <utility>

#include "rig/checks.hpp"
#include "rig/plan.hpp"
#include "rig/value.hpp"
#include "tendril/signal/spring.hpp"

namespace tendril::rig {

using detail::quoted;

namespace {

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
    check_values(fields<Unit>(), &unit);
    rows(fields<Unit>(), &unit);
    if (auto* set = std::get_if<SetCurve>(&unit.operation); set != nullptr && refusal_)
        set->resolved.index = static_cast<std::int32_t>(layout_.curves.find(set->curve)->second);
    if (auto* evaluate = std::get_if<EvaluateCurve>(&unit.operation))
        if (const Result bad = signal::check(evaluate->curve); !bad)
            refuse(std::string("curve: ") + bad.message());
    if (std::holds_alternative<SpringInterpolate>(unit.operation) && refusal_) spring(outputs);
    if (!refusal_) return refusal_;
    return outputs;
}

void Resolver::spring(std::vector<Output>& outputs) {
    const Type target = any_types_[0];
    if (target == Type::Bool || target == Type::Transform)
        return refuse(std::string("target takes a number, a vector or a rotation, got a ") + name(target));
    const Type rate = target == Type::Rotation ? Type::Vector : target;
    if (any_types_.size() > 1 && any_types_[1] != rate)
        return refuse(std::string("force takes a ") + name(rate) + " here, got a " + name(any_types_[1]));
    outputs[0].type = target;
    outputs[1].type = rate;
}

namespace {

/// Whether a field holds the body of a for-each; the units in it are resolved separately.
bool is_body(const Field& field) {
    return field.holds<Unit>();
}

}  // namespace

void Resolver::check_values(std::span<const Field> table, const void* object) {
    for (const Field& field : table) {
        if (!refusal_ || is_body(field)) continue;
        if (field.type == FieldType::Kind)
            check_values(field.kind(object).table(), field.address(object, 0));
        else
            refusal_ = check_fields(place_.c_str(), {&field, 1}, object);
    }
}

void Resolver::rows(std::span<const Field> table, void* object, const std::string& above) {
    for (const Field& field : table) {
        const std::string name = above + field.name;
        if (is_body(field)) {
            if (for_each_) refuse(name + ": a for-each cannot be inside another");
        } else if (field.type == FieldType::Kind) {
            rows(field.kind(object).table(), field.address_in(object), above);
        } else if (field.count != nullptr) {
            for (std::size_t i = 0; i < field.count(object); ++i)
                row(field, field.address_in(object, i),
                    field.type == FieldType::Struct ? name + '[' + std::to_string(i) + ']' : name);
        } else {
            row(field, field.address != nullptr ? field.address_in(object) : object, name);
        }
    }
}

/// `at`: the argument of the field's accessors; for a struct, the struct's address.
void Resolver::row(const Field& field, void* at, const std::string& name) {
    if (at == nullptr) return;
    if (field.type == FieldType::Struct) return rows(field.table(), at, name + '.');
    if (field.type == FieldType::Other) return input(name, access_of(field), at);
    if (field.type != FieldType::Text || *field.of == '\0') return;
    const bool curve = field.of == std::string_view("curves");
    const std::string to(field.text(at));
    if (!(curve ? layout_.curves : layout_.elements).contains(to))
        refuse(name + (curve ? ": there is no curve " : ": there is no element ") + quoted(to));
}

void Resolver::item(const std::string& name, Item& item) {
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

void Resolver::input(const std::string& name, const InputAccess& access, void* at) {
    if (access.takes == InputAccess::Takes::Item) return item(name, *static_cast<Item*>(at));
    Input<Value> input = access.get(at);
    const Type type = std::visit([&](auto& source) { return type_of_source(name, source); }, input.source);
    if (!refusal_) return;
    if (input.literal() == nullptr) access.set(at, input);
    if (!access.type)
        any_types_.push_back(type);
    else if (!converts(type, *access.type))
        refuse(name + " takes a " + rig::name(*access.type) + ", got a " + rig::name(type));
}

/// Numbers are checked by the table.
Type Resolver::type_of_source(const std::string& name, Value& literal) {
    if (const Result bad = check(name.c_str(), literal); !bad) refuse(bad.message());
    return type_of(literal);
}

Type Resolver::type_of_source(const std::string& name, FromElement& from) {
    item(name, from.element);
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
    const std::vector<Output>& outputs = unit.outputs;
    const auto output = std::find_if(outputs.begin(), outputs.end(),
                                     [&](const Output& each) { return each.name == from.output; });
    if (output == outputs.end()) {
        refuse(name + ": unit " + quoted(from.unit) + " has no output " + quoted(from.output));
        return Type::Number;
    }
    from.resolved_output.index = static_cast<std::int32_t>(output - outputs.begin());
    return output->type;
}

Type Resolver::type_of_source(const std::string& name, Each&) {
    if (!for_each_) refuse(name + R"(: {"each": ...} only works inside a for-each)");
    return Type::Number;
}

}  // namespace tendril::rig
