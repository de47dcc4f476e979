#include "app/labs/rig/unit_inputs.hpp"

#include <algorithm>
#include <utility>

#include "app/fields/fields.hpp"
#include "app/io/json_complete.hpp"
#include "app/io/text.hpp"
#include "app/labs/rig/values.hpp"

namespace tendril::app {
namespace {

constexpr const char* of_words[] = {"transform", "translation", "rotation", "scale", "x", "y", "z", "value"};

const char* words_of(rig::Of of) {
    return of_words[static_cast<std::size_t>(of)];
}

const char* words_of(rig::Space space, rig::Pose pose) {
    if (pose == rig::Pose::Initial) return space == rig::Space::Global ? ", initial" : ", initial local";
    return space == rig::Space::Global ? "" : ", local";
}

rig::Value part_of(const rig::Transform& pose, rig::Of of) {
    const glm::dvec3& at = pose.translation;
    const rig::Value parts[] = {pose, at, pose.rotation, pose.scale, at.x, at.y, at.z, pose};
    return parts[static_cast<std::size_t>(of)];
}

const char* unit_of(const Field& field) {
    const std::string_view unit = field.unit;
    return unit == "deg" ? "\xC2\xB0" : unit == "deg/s" ? "\xC2\xB0/s" : unit == "1/s" ? "/s" : field.unit;
}

class Lister {
  public:
    Lister(const RigPart& part, const rig::Hierarchy& now, std::vector<UnitInput>& list)
        : part_(part), now_(now), list_(list) {}

    void all(std::span<const Field> table, const void* object, const std::string& path,
             const std::string& title) {
        for (const Field& field : table) {
            std::string words = field.name;
            std::replace(words.begin(), words.end(), '_', ' ');
            if (!title.empty()) words = title + ' ' + words;
            list(field, object, path + '/' + field.name, words);
        }
    }

    void list(const Field& field, const void* object, const std::string& path, const std::string& title) {
        const bool nested = field.type == FieldType::Struct;
        if (field.holds<rig::Unit>()) return;  // units of a body have their own rows
        if (nested && field.count != nullptr) {
            const std::size_t count = field.count(object);
            for (std::size_t i = 0; i < count; ++i)
                all(field.table(), field.address(object, i), path + '/' + std::to_string(i),
                    count == 1 ? std::string("parent") : "parent " + std::to_string(i + 1));
            return;
        }
        const void* const at =
            field.address != nullptr && field.count == nullptr ? field.address(object, 0) : object;
        const bool whole = field.holds<rig::TransformFilter>() || field.holds<signal::Curve>();
        if (nested && !whole && at != nullptr) return all(field.table(), at, path, title);
        UnitInput& row = list_.emplace_back(UnitInput{
            .path = path, .title = title, .unit = unit_of(field), .from = {}, .field = &field, .at = at});
        if (at == nullptr) {
            row.from = "none";
        } else if (row.takes_input()) {
            const rig::Input<rig::Value> input = rig::access_of(field).get(at);
            if (const rig::Value* literal = input.literal()) row.value = *literal;
            std::visit([&](const auto& source) { source_of(row, source); }, input.source);
        } else if (field.type == FieldType::Flag) {
            row.value = field.number(at) != 0.0;
        } else if (row.is(FieldType::Other) && row.names().empty()) {
            row.from = "each element";
        }
    }

  private:
    template <class T>
    static void source_of(UnitInput&, const T&) {}  // a literal
    void source_of(UnitInput& row, const rig::FromElement& from) const {
        const auto* name = std::get_if<std::string>(&from.element.which);
        row.from = name != nullptr ? *name : "each element";
        row.from += std::string(", ") + words_of(from.of);
        if (from.of != rig::Of::ControlValue) row.from += words_of(from.space, from.pose);
        if (name == nullptr) return;
        const auto element = part_.rig.element(*name);
        if (!element) return;
        if (from.of == rig::Of::ControlValue)
            row.value = part_.state->controls[*element];
        else
            row.value = part_of(*now_.known(part_.rig.id(*element), from.space, from.pose), from.of);
    }
    void source_of(UnitInput& row, const rig::FromUnit& from) const {
        row.from = "unit " + from.unit;
        if (from.output != "result") row.from += ", " + from.output;
        const auto giver = unit_row(part_, from.unit);
        if (!giver) return;
        row.count = std::holds_alternative<rig::ForEach>(giver->unit->operation);
        const std::vector<rig::Output> outputs = rig::outputs(giver->unit->operation);
        for (std::size_t i = 0; i < outputs.size(); ++i)
            if (outputs[i].name == from.output) row.value = part_.state->units[giver->at].outputs[i];
    }
    void source_of(UnitInput& row, rig::Each each) const {
        constexpr const char* words[] = {"each ratio, 0 to 1", "each index", "count of elements"};
        row.from = words[static_cast<std::size_t>(each)];
    }

    const RigPart& part_;
    const rig::Hierarchy& now_;
    std::vector<UnitInput>& list_;
};

}  // namespace

std::vector<UnitInput> unit_inputs(const RigPart& part, const rig::Hierarchy& now, const rig::Unit& unit) {
    std::vector<UnitInput> list;
    Lister lister(part, now, list);
    const std::span<const Field> table = fields<rig::Unit>();
    for (const char* name : {"weight", "when"})
        lister.list(*find_field(table, name), &unit, std::string("/") + name, name);
    const Field& operation = *find_field(table, "unit");
    lister.all(operation.kind(&unit).table(), operation.address(&unit, 0), "", "");
    return list;
}

std::vector<std::string> UnitInput::names() const {
    std::vector<std::string> all;
    if (at != nullptr && is(FieldType::Other) && !takes_input()) {
        if (const auto* name = std::get_if<std::string>(&static_cast<const rig::Item*>(at)->which))
            all.push_back(*name);
    } else if (is(FieldType::Text)) {
        if (field->count == nullptr) all.emplace_back(field->text(at));
        for (std::size_t i = 0; field->count != nullptr && i < field->count(at); ++i)
            all.emplace_back(field->text(field->address(at, i)));
    }
    return all;
}

bool is_speed_limit(const UnitInput& input) {
    return input.path.ends_with("max_speed");
}

std::string one_of(std::string title) {
    title.pop_back();
    return title;
}

std::string input_text(const UnitInput& input, const rig::Value& value) {
    const auto* number = std::get_if<double>(&value);
    if (number && input.count) return fixed_text(*number, 0);
    if (number && is_speed_limit(input))
        return *number > 0.0 ? fixed_text(*number, 1) + input.unit : std::string("no limit");
    return value_text(value);
}

Json with_input(const rig::Unit& unit, const std::string& path, Json value) {
    const std::size_t end = path.find('/', 1);
    const std::string member = path.substr(1, end - 1);
    Json arguments{{"name", unit.name}, {member, nullptr}};
    if (member == "parents") {  // a list is set as a whole
        const Field& operation = *find_field(fields<rig::Unit>(), "unit");
        const Field& row = *find_field(operation.kind(&unit).table(), member);
        arguments.update(save_fields({{&row, 1}, operation.address(&unit, 0)}));
    }
    arguments[Json::json_pointer(path)] = std::move(value);
    return arguments;
}

std::vector<UnitRow> unit_rows(const RigPart& part) {
    std::vector<UnitRow> rows;
    const rig::Units& units = part.rig.definition().units;
    for (std::size_t top = 0; top < units.size(); ++top) {
        rows.push_back({&units[top], rows.size(), top, false});
        if (const auto* loop = std::get_if<rig::ForEach>(&units[top].operation))
            for (const rig::Unit& inner : loop->body) rows.push_back({&inner, rows.size(), top, true});
    }
    return rows;
}

std::optional<UnitRow> unit_row(const RigPart& part, std::string_view name) {
    for (const UnitRow& row : unit_rows(part))
        if (row.unit->name == name) return row;
    return std::nullopt;
}

namespace {

/// As in Rig::make, an input of T also accepts types that convert to T.
bool converts(rig::Type from, rig::Type to) {
    using enum rig::Type;
    return from == to || (from == Bool && to == Number) ||
           (from == Transform && (to == Vector || to == Rotation));
}

/// Parts of a pose with the type; each exists in global and local space.
std::vector<rig::Of> parts_of(rig::Type type) {
    using enum rig::Of;
    const std::vector<rig::Of> parts[] = {{}, {X, Y, Z}, {Translation, Scale}, {Rotation}, {Transform}};
    return parts[static_cast<std::size_t>(type)];
}

Json zero_of(rig::Type type) {
    const Json zeros[] = {false, 0.0, {0, 0, 0}, {0, 0, 0, 1}, Json::object()};
    return zeros[static_cast<std::size_t>(type)];
}

class Offers {
  public:
    Offers(const RigPart& part, const UnitRow& row, const UnitInput& input)
        : part_(part), row_(row), input_(input) {}

    std::vector<InputOffer> list(std::size_t index) {
        const std::string_view of = input_.field->of;
        if (input_.takes_input()) {
            if (!input_.literal()) literal();
            for (const rig::Type type : types()) values(type);
        } else if (input_.is(FieldType::Other)) {
            if (row_.inner && of != "bones") offer("each element", {{"item", "each"}});
            elements(of == "bones");
        } else if (of == "elements") {
            one_of_names(index);
        } else if (of == "curves") {
            for (const rig::NamedCurve& curve : definition().curves) offer(curve.name, curve.name);
        }
        return std::move(offers_);
    }

  private:
    const rig::Definition& definition() const { return part_.rig.definition(); }

    void offer(std::string title, Json value) {
        const std::vector<std::string> names = input_.names();
        const bool now = title == input_.from || (!names.empty() && title == names.front());
        offers_.push_back({std::move(title), SharedJson(std::move(value)), now});
    }

    /// The types of the input; for a spring, all its types. A force must match the spring's velocity.
    std::vector<rig::Type> types() const {
        if (input_.type()) return {*input_.type()};
        if (input_.path == "/force") return {rig::type_of(part_.state->units[row_.at].outputs[1])};
        return {rig::Type::Number, rig::Type::Vector, rig::Type::Rotation};
    }

    /// Offers the current value as a literal.
    void literal() {
        const rig::Type type = types().front();
        const auto& now = input_.value;
        const bool fits = now && (rig::type_of(*now) == type || !input_.type());
        offer(type == rig::Type::Bool ? "a switch of its own" : "a value of its own",
              fits ? value_json(within_range(*now)) : zero_of(type));
    }

    rig::Value within_range(rig::Value value) const {
        const FieldRange range = input_.field->range;
        if (auto* number = std::get_if<double>(&value)) *number = std::clamp(*number, range.low, range.high);
        return value;
    }

    void values(rig::Type type) {
        if (row_.inner) from_each(type);
        from_units(type);
        for (const bool controls : {true, false})
            for (const rig::Element& element : definition().elements)
                if ((element.kind == rig::ElementKind::Control) == controls) from_element(element, type);
    }

    void from_each(rig::Type type) {
        if (type == rig::Type::Number) {
            offer("each ratio, 0 to 1", {{"each", "ratio"}});
            offer("each index", {{"each", "index"}});
            offer("count of elements", {{"each", "count"}});
        }
        from_pose("each element", {{"item", "each"}}, type);
    }

    /// Offers units that have run before. Excludes the enclosing for-each and units in other bodies.
    void from_units(rig::Type type) {
        for (const UnitRow& each : unit_rows(part_)) {
            if (each.at >= row_.at) break;
            if (each.inner ? !(row_.inner && each.top == row_.top) : row_.inner && each.top == row_.top)
                continue;
            const std::vector<rig::Output> outputs = rig::outputs(each.unit->operation);
            for (std::size_t i = 0; i < outputs.size(); ++i) {
                if (!fits(rig::type_of(part_.state->units[each.at].outputs[i]), type)) continue;
                std::string title = "unit " + each.unit->name;
                if (std::string_view(outputs[i].name) != "result") title.append(", ").append(outputs[i].name);
                offer(std::move(title), {{"unit", each.unit->name}, {"output", outputs[i].name}});
            }
        }
    }

    void from_element(const rig::Element& element, rig::Type type) {
        const Json name{{"element", element.name}};
        if (element.control && fits(rig::type_of(element.control->kind), type)) {
            Json value = name;
            value["of"] = "value";
            offer(element.name + ", value", std::move(value));
        }
        from_pose(element.name, name, type);
    }

    void from_pose(const std::string& title, const Json& name, rig::Type type) {
        for (const rig::Of of : parts_of(type)) {
            for (const char* space : {"global", "local"}) {
                Json value = name;
                value["of"] = of_words[static_cast<std::size_t>(of)];
                value["space"] = space;
                std::string words = title;
                words.append(", ").append(of_words[static_cast<std::size_t>(of)]);
                if (space[0] == 'l') words += ", local";
                offer(std::move(words), std::move(value));
            }
        }
    }

    /// An input without a type converts nothing.
    bool fits(rig::Type from, rig::Type to) const { return input_.type() ? converts(from, to) : from == to; }

    void elements(bool bones) {
        for (const rig::Element& each : definition().elements)
            if (!bones || each.kind == rig::ElementKind::Bone) offer(each.name, each.name);
    }

    void one_of_names(std::size_t index) {
        const std::vector<std::string> names = input_.names();
        for (const rig::Element& each : definition().elements) {
            if (std::ranges::count(names, each.name) > 0 &&
                !(index < names.size() && names[index] == each.name))
                continue;
            Json all = names;
            index < names.size() ? all[index] = each.name : all.emplace_back(each.name);
            offers_.push_back(
                {each.name, SharedJson(std::move(all)), index < names.size() && names[index] == each.name});
        }
        if (index >= names.size() || names.size() <= input_.field->fewest) return;
        Json fewer = names;
        fewer.erase(index);
        offers_.push_back({"none: remove this " + one_of(input_.title), SharedJson(std::move(fewer)), false});
    }

    const RigPart& part_;
    const UnitRow& row_;
    const UnitInput& input_;
    std::vector<InputOffer> offers_;
};

}  // namespace

std::vector<InputOffer> input_offers(const RigPart& part, const UnitRow& row, const UnitInput& input,
                                     std::size_t index) {
    return Offers(part, row, input).list(index);
}

namespace {

struct Help {
    const char* operation;  ///< empty: any operation with an input of that name
    const char* input;      ///< last name of the path; "primary/axis" if that is ambiguous
    const char* text;
};

constexpr Help helps[] = {
    {"", "primary/weight", "How far the axis is turned to its target. 1 is all the way."},
    {"", "secondary/weight", "How far the item is rolled towards the second target. 1 is all the way."},
    {"", "primary/axis", "The axis of the item, in its own space, that points at the target."},
    {"", "secondary/axis",
     "The axis of the item that points at the second target, as closely as the first allows."},
    {"", "primary/target", "The target of the axis: a point in the scene, or a direction."},
    {"", "secondary/target",
     "The target of the roll: a point in the scene, or a direction. Often it sets which way is up."},
    {"", "secondary",
     "A second axis with its target, which decides the roll about the first. None: no roll."},
    {"", "kind", "Whether the target is a point in the scene or a direction."},
    {"", "max_speed", "How many degrees per second the item may turn. 0 is no limit."},
    {"parent_constraint", "parents/weight",
     "How much this parent counts, relative to the others. 0 ignores it."},
    {"", "weight", "How strongly the unit acts: 0 does nothing, 1 is its full effect."},
    {"", "when", "The unit runs only where this is on."},
    {"parent_constraint", "parents/item", "An element that the item follows."},
    {"", "item", "The element that the unit moves."},
    {"", "child", "The element whose rest pose is carried over to another parent."},
    {"", "old_parent", "The element that the child was attached to at rest."},
    {"", "new_parent", "The element that the child is attached to now."},
    {"", "maintain_offset",
     "On: the item follows only its parents' motion since they were added. Off: it goes to its parents."},
    {"", "filter",
     "Which axes of translation, rotation and scale are followed; the others do not change. In the space of "
     "the item's parent."},
    {"", "offset", "Added to the item's transform, in the item's own space."},
    {"", "propagate", "On: all elements below the item move with it. Off: they stay in place."},
    {"", "space", "Global: in the scene. Local: within the item's parent."},
    {"set_transform", "transform", "The transform that the item gets."},
    {"", "transform", "The transform that the unit works on."},
    {"", "rotation", "The rotation that the item gets."},
    {"", "from", "The direction that is turned. Its length does not matter."},
    {"", "to", "The direction that it is turned to. Its length does not matter."},
    {"", "location", "A point in the transform's own space. The result is that point in the scene."},
    {"", "direction",
     "A direction in the transform's own space. The result is turned with it and keeps its length."},
    {"", "roots", "The first element of the for-each: its units run on each element from here down."},
    {"", "include_parent", "On: the units also run on the root. Off: only on the elements below it."},
    {"", "recursive", "On: the units run on everything below the root. Off: only on its children."},
    {"", "map_range", "First step: maps the in range to the out range, beyond its ends too."},
    {"", "in_range", "The range that is mapped. Only with map range."},
    {"", "out_range", "The range that it is mapped to. Only with map range."},
    {"", "scale", "Second step: the value is multiplied by this, then the bias is added."},
    {"", "bias", "Second step: added after the value is multiplied by scale."},
    {"", "clamp", "Third step: keeps the value between clamp min and clamp max."},
    {"", "clamp_min", "The minimum of the value. Only with clamp."},
    {"", "clamp_max", "The maximum of the value. Only with clamp."},
    {"", "interp", "Last step: eases towards the value instead of jumping."},
    {"", "speed_increasing", "How fast it eases while the value rises. Only with interp."},
    {"", "speed_decreasing", "How fast it eases while the value falls. Only with interp."},
    {"spring_interpolate", "target", "The target of the spring: a number, a vector or a rotation."},
    {"", "strength",
     "How many times a second the spring would swing without damping. Higher follows faster."},
    {"", "critical_damping",
     "How soon swinging stops: 0 swings for ever, 1 is the fastest that does not overshoot."},
    {"", "force", "A force on the value: shifts its rest position. None: no force."},
    {"", "target_velocity_amount",
     "How much of the target's velocity the spring takes into account, from 0 to 1: at 1 it follows steady "
     "motion without lag."},
    {"set_curve", "curve", "The named curve that is written: a morph weight, or a material parameter."},
    {"set_curve", "value", "The value written into the curve."},
    {"evaluate_curve", "value", "The position at which the curve is read."},
    {"", "value", "The number that goes in."},
    {"", "root", "The first bone of the chain."},
    {"spline", "tip", "The last bone of the chain."},
    {"", "tip", "The last bone of the chain: it goes to the target."},
    {"", "points", "The elements that the curve passes through, in order. The root goes to the first."},
    {"", "b_spline", "A smoother curve, which passes only near the points between the first and the last."},
    {"", "fit", "Makes all bones longer or shorter by one factor, so that the tip is on the last point."},
    {"", "max_factor", "How far fit may go: 2 lets the bones be twice or half as long."},
    {"", "up", "The direction of the bones' upper side at the curve's beginning."},
    {"", "roll_start_deg", "How many degrees the first bone is rolled about itself."},
    {"", "roll_end_deg", "How many degrees the last bone is rolled; between them the roll is spread."},
    {"", "target", "The target of the chain's tip: a point in the scene."},
    {"", "pole_target", "A point that the elbow or knee points at. None: the chain bends as before."},
};

/// Compares paths without the index of a parent: "/parents/0/weight" matches "parents/weight".
bool is_path_of(std::string_view path, std::string_view input) {
    const std::size_t slash = input.find('/');
    if (slash == input.npos) return path.ends_with(input) && path[path.size() - input.size() - 1] == '/';
    const std::string_view group = input.substr(0, slash);
    return path.starts_with('/') && path.substr(1).starts_with(group) && path.ends_with(input.substr(slash));
}

constexpr struct {
    const char* operation;
    const char* text;
} operations[] = {
    {"aim", "Turns an element so that one of its axes points at a target."},
    {"aim_math", "Like Aim, but on a given transform: outputs the result and moves nothing."},
    {"parent_constraint", "Lets an element follow one or more others, by weight."},
    {"offset_transform", "Moves, turns and scales an element in its own space."},
    {"set_transform", "Sets an element's transform."},
    {"set_rotation", "Sets an element's rotation; it stays in place."},
    {"project_to_parent", "Outputs where an element would be if it were attached to another parent."},
    {"from_two_vectors", "Outputs the shortest rotation from one direction to another."},
    {"transform_location", "Outputs the scene position of a point in a transform's own space."},
    {"transform_direction", "Outputs a direction in a transform's own space as a direction in the scene."},
    {"for_each",
     "Runs other units on each element of a chain or a tree. While it is selected, Add a unit adds to it."},
    {"alpha_interpolate", "Maps, scales, clamps and eases a number."},
    {"spring_interpolate", "Follows a number, a vector or a rotation with a spring."},
    {"evaluate_curve", "Outputs a number read from a curve."},
    {"set_curve", "Writes a number into a named curve."},
    {"two_bone", "Turns two bones so that the tip reaches a target."},
    {"fabrik", "Turns a chain of bones so that its tip reaches a target."},
    {"spline", "Lays a chain of bones along a curve through points."},
};

}  // namespace

const char* input_help(std::string_view operation, std::string_view path) {
    for (const Help& help : helps)
        if (is_path_of(path, help.input) && (*help.operation == '\0' || operation == help.operation))
            return help.text;
    return "";
}

const char* operation_help(std::string_view operation) {
    for (const auto& each : operations)
        if (operation == each.operation) return each.text;
    return "";
}

}  // namespace tendril::app
