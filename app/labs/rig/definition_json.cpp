#include "app/labs/rig/definition_json.hpp"

#include <algorithm>
#include <iterator>
#include <string_view>
#include <tendril/rig/fields.hpp>
#include <utility>

#include "app/document/json_complete.hpp"
#include "app/labs/kit/library_json.hpp"
#include "app/labs/rig/values.hpp"

namespace tendril::app {
namespace {

constexpr const char* axis_names[] = {"x", "y", "z"};

/// Numbers in an end of the range; 0 if the kind has no range.
std::size_t axes_of(rig::ControlKind kind) {
    switch (kind) {
        case rig::ControlKind::Transform:
        case rig::ControlKind::Position:
            return 3;
        case rig::ControlKind::Vector2d:
            return 2;
        case rig::ControlKind::Float:
            return 1;
        case rig::ControlKind::Rotation:
        case rig::ControlKind::Bool:
            break;
    }
    return 0;
}

Json end_json(rig::ControlKind kind, const glm::dvec3& end) {
    if (axes_of(kind) == 1) return end.x;
    Json json = Json::array({end.x, end.y});
    if (axes_of(kind) == 3) json.push_back(end.z);
    return json;
}

void read_end(const JsonPlace& place, const char* key, rig::ControlKind kind,
              std::optional<glm::dvec3>& end) {
    if (!place.has(key)) return;
    const JsonPlace found = place[key];
    const std::size_t parts = axes_of(kind);
    if (parts == 0) found.fail("a " + std::string(control_title(kind)) + " has no range");
    end.emplace(0.0);
    if (parts == 1) {
        end->x = found.real();
        return;
    }
    found.check_size(parts, parts == 2 ? "numbers [a, b]" : "numbers [x, y, z]");
    for (std::size_t i = 0; i < parts; ++i) (*end)[static_cast<int>(i)] = found.element(i).real();
}

rig::Control read_control(const JsonPlace& place) {
    rig::Control control;
    if (place.has("control"))
        control.kind = static_cast<rig::ControlKind>(
            read_name(place["control"], {"transform", "position", "rotation", "float", "bool", "vector2d"}));
    if (place.has("axes")) {
        const JsonPlace axes = place["axes"];
        if (control.kind != rig::ControlKind::Vector2d) axes.fail("only a 2D control (vector2d) has axes");
        axes.check_size(2, "axes out of x, y and z");
        for (std::size_t i = 0; i < 2; ++i)
            control.axes[i] = static_cast<int>(read_name(axes.element(i), {"x", "y", "z"}));
    }
    read_end(place, "minimum", control.kind, control.minimum);
    read_end(place, "maximum", control.kind, control.maximum);
    return control;
}

/// The parent, which a control may call "space".
std::string read_parent(const JsonPlace& place, bool control) {
    const auto name = [&](const char* key) {
        if (!place.has(key) || place.json()[key].is_null()) return std::string();
        return place[key].text();
    };
    const std::string parent = name("parent"), space = name("space");
    if (!control && place.has("space")) place["space"].fail("only a control has a space");
    if (!parent.empty() && !space.empty() && parent != space)
        place["space"].fail("the space of a control is its parent, which is \"" + parent + "\"");
    return parent.empty() ? space : parent;
}

}  // namespace

std::vector<std::string> element_members() {
    return {"name", "kind", "parent", "local", "control", "axes", "minimum", "maximum", "space"};
}

Json element_json(const rig::Element& element) {
    Json json{{"name", element.name}, {"kind", rig::name(element.kind)}};
    if (!element.parent.empty()) json["parent"] = element.parent;
    json["local"] = transform_json(element.initial);
    if (!element.control) return json;
    const rig::Control& control = *element.control;
    json["control"] = rig::name(control.kind);
    if (control.kind == rig::ControlKind::Vector2d)
        for (const int axis : control.axes) json["axes"].push_back(axis_names[axis]);
    if (axes_of(control.kind) > 0) {
        if (control.minimum) json["minimum"] = end_json(control.kind, *control.minimum);
        if (control.maximum) json["maximum"] = end_json(control.kind, *control.maximum);
    }
    return json;
}

rig::Element read_element(const JsonPlace& place) {
    check_members(place, element_members());
    rig::Element element;
    element.name = place["name"].text();
    if (place.has("kind"))
        element.kind = static_cast<rig::ElementKind>(read_name(place["kind"], {"bone", "null", "control"}));
    const bool control = element.kind == rig::ElementKind::Control;
    element.parent = read_parent(place, control);
    if (place.has("local")) element.initial = read_transform(place["local"]);
    if (control) {
        element.control = read_control(place);
    } else {
        for (const char* key : {"control", "axes", "minimum", "maximum"})
            if (place.has(key)) place[key].fail("only a control has this");
    }
    return element;
}

Json definition_json(const rig::Definition& definition) {
    Json elements = Json::array(), curves = Json::array();
    for (const rig::Element& each : definition.elements) elements.push_back(element_json(each));
    for (const rig::NamedCurve& each : definition.curves)
        curves.push_back({{"name", each.name}, {"value", each.value}});
    return Json{{"elements", std::move(elements)},
                {"curves", std::move(curves)},
                {"units", units_json(definition.units)}};
}

rig::Definition read_definition(const JsonPlace& place) {
    rig::Definition definition;
    place["elements"].for_each("elements", max_lab_elements, [&](const JsonPlace& each) {
        definition.elements.push_back(read_element(each));
    });
    place["curves"].for_each("curves", max_lab_curves, [&](const JsonPlace& each) {
        check_members(each, {"name", "value"});
        definition.curves.push_back({each["name"].text(), each["value"].real()});
    });
    definition.units = read_units(place["units"]);
    std::set<std::string> taken;
    collect_names(definition.units, taken);
    name_units(definition.units, taken);
    return definition;
}

namespace {

constexpr std::size_t max_parents = 1'000, max_roots = 1'000;

/// Fields that are required in every operation.
template <class T>
constexpr bool is_required = false;
template <>
constexpr bool is_required<rig::Item> = true;
template <>
constexpr bool is_required<std::vector<rig::ParentInputs>> = true;
template <>
constexpr bool is_required<std::vector<std::string>> = true;
template <>
constexpr bool is_required<std::string> = true;

class Reader {
  public:
    /// Reads an operation, or a struct with rig::fields(). `beside`: members that are read elsewhere.
    template <class T>
    static void all(const JsonPlace& place, T& of, std::vector<std::string> beside = {}) {
        std::vector<std::string> known = std::move(beside);
        rig::fields(of, [&](const char* name, auto&) { known.push_back(name); });
        if constexpr (std::is_same_v<T, rig::EvaluateCurve>) add_curve_members(known);
        check_members(place, known);
        rig::fields(of, [&](const char* name, auto& field) {
            using Field = std::remove_reference_t<decltype(field)>;
            if (place.has(name) || is_required<Field>) read(place[name], field);
        });
        if constexpr (std::is_same_v<T, rig::EvaluateCurve>) read_curve_members(place, of.curve);
    }

  private:
    static void read(const JsonPlace& place, rig::Item& item) { item = read_item(place); }
    template <class T>
    static void read(const JsonPlace& place, rig::Input<T>& input) {
        input = read_input<T>(place);
    }
    static void read(const JsonPlace& place, rig::AimInputs& inputs) { all(place, inputs); }
    template <class T>
    static void read(const JsonPlace& place, std::optional<T>& field) {
        if (place.json().is_null()) return field.reset();
        read(place, field.emplace());
    }
    static void read(const JsonPlace& place, rig::AimTarget& kind) {
        kind = static_cast<rig::AimTarget>(read_name(place, {"location", "direction"}));
    }
    static void read(const JsonPlace& place, rig::Space& space) {
        space = read_name(place, {"global", "local"}) == 0 ? rig::Space::Global : rig::Space::Local;
    }
    static void read(const JsonPlace& place, std::vector<rig::ParentInputs>& parents) {
        parents.clear();
        place.for_each("parents", max_parents,
                       [&](const JsonPlace& each) { all(each, parents.emplace_back()); });
    }
    static void read(const JsonPlace& place, rig::TransformFilter& filter) {
        check_members(place, {"translation", "rotation", "scale"});
        const auto axes = [&](const char* name, std::array<bool, 3>& passes) {
            if (!place.has(name)) return;
            const JsonPlace list = place[name];
            list.check_size(3, "bools, for x, y and z");
            for (std::size_t i = 0; i < 3; ++i) passes[i] = list.element(i).flag();
        };
        axes("translation", filter.translation);
        axes("rotation", filter.rotation);
        axes("scale", filter.scale);
    }
    static void read(const JsonPlace& place, std::vector<std::string>& roots) {
        roots.clear();
        place.for_each("elements", max_roots, [&](const JsonPlace& each) { roots.push_back(each.text()); });
    }
    static void read(const JsonPlace& place, rig::Body& body) { body.units() = read_units(place); }
    static void read(const JsonPlace& place, bool& flag) { flag = place.flag(); }
    static void read(const JsonPlace& place, std::string& text) { text = place.text(); }
    static void read(const JsonPlace& place, std::array<double, 2>& range) {
        place.check_size(2, "numbers, [low, high]");
        for (std::size_t i = 0; i < 2; ++i) range[i] = place.element(i).real();
    }
    static void read(const JsonPlace& place, signal::Curve& curve) {
        std::vector<std::string> known;
        add_curve_members(known);
        check_members(place, known);
        read_curve_members(place, curve);
    }
};

struct Writer {
    template <class T>
    static Json all(const T& of) {
        Json json = Json::object();
        rig::fields(of, [&](const char* name, const auto& field) { json[name] = write(field); });
        return json;
    }

    static Json write(const rig::Item& item) { return item_json(item); }
    template <class T>
    static Json write(const rig::Input<T>& input) {
        return input_json(input);
    }
    static Json write(const rig::AimInputs& inputs) { return all(inputs); }
    template <class T>
    static Json write(const std::optional<T>& field) {
        return field ? write(*field) : Json(nullptr);
    }
    static Json write(rig::AimTarget kind) {
        return kind == rig::AimTarget::Location ? "location" : "direction";
    }
    static Json write(rig::Space space) { return space == rig::Space::Global ? "global" : "local"; }
    static Json write(const std::vector<rig::ParentInputs>& parents) {
        Json list = Json::array();
        for (const rig::ParentInputs& each : parents) list.push_back(all(each));
        return list;
    }
    static Json write(const rig::TransformFilter& filter) {
        return Json{
            {"translation", filter.translation}, {"rotation", filter.rotation}, {"scale", filter.scale}};
    }
    static Json write(const std::vector<std::string>& roots) { return roots; }
    static Json write(const rig::Body& body) { return units_json(body.units()); }
    static Json write(bool flag) { return flag; }
    static Json write(const std::string& text) { return text; }
    static Json write(const std::array<double, 2>& range) { return range; }
    static Json write(const signal::Curve& curve) { return curve_json(curve); }
};

/// Sets `operation` to the alternative of that index, with its defaults.
template <std::size_t... index>
void make_operation(rig::Operation& operation, std::size_t wanted, std::index_sequence<index...>) {
    ((index == wanted ? static_cast<void>(operation.emplace<index>()) : void()), ...);
}
constexpr auto all_operations = std::make_index_sequence<std::variant_size_v<rig::Operation::Variant>>();

void make_operation(rig::Operation& operation, std::size_t wanted) {
    make_operation(operation, wanted, all_operations);
}

}  // namespace

std::vector<std::string> operation_names() {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < std::variant_size_v<rig::Operation::Variant>; ++i)
        names.emplace_back(rig::operation_name(i));
    return names;
}

std::vector<std::string> unit_members() {
    std::vector<std::string> members{"weight", "when", "enabled"};
    const auto add = [&](const std::string& name) {
        if (std::find(members.begin(), members.end(), name) == members.end()) members.push_back(name);
    };
    for (std::size_t i = 0; i < std::variant_size_v<rig::Operation::Variant>; ++i) {
        rig::Operation operation;
        make_operation(operation, i);
        std::visit([&](auto& each) { rig::fields(each, [&](const char* name, auto&) { add(name); }); },
                   operation);
    }
    std::vector<std::string> of_curves;
    add_curve_members(of_curves);
    for (const std::string& name : of_curves) add(name);
    return members;
}

Json unit_json(const rig::Unit& unit) {
    Json json{{"unit", rig::operation_name(unit.operation.index())}, {"name", unit.name}};
    json.update(std::visit([](const auto& operation) { return Writer::all(operation); }, unit.operation));
    json["weight"] = input_json(unit.weight);
    json["when"] = input_json(unit.when);
    json["enabled"] = unit.enabled;
    return json;
}

Json units_json(const std::vector<rig::Unit>& units) {
    Json list = Json::array();
    for (const rig::Unit& unit : units) list.push_back(unit_json(unit));
    return list;
}

rig::Unit read_unit(const JsonPlace& place) {
    const JsonPlace kind = place["unit"];
    const std::string name = kind.text();
    const std::vector<std::string> names = operation_names();
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) kind.fail("unknown unit " + json_summary(kind.json()));
    rig::Unit unit;
    make_operation(unit.operation, static_cast<std::size_t>(found - names.begin()));
    std::visit(
        [&](auto& operation) {
            Reader::all(place, operation, {"unit", "name", "weight", "when", "enabled"});
        },
        unit.operation);
    if (place.has("name")) unit.name = place["name"].text();
    if (place.has("weight")) unit.weight = read_input<double>(place["weight"]);
    if (place.has("when")) unit.when = read_input<bool>(place["when"]);
    if (place.has("enabled")) unit.enabled = place["enabled"].flag();
    return unit;
}

std::vector<rig::Unit> read_units(const JsonPlace& place) {
    std::vector<rig::Unit> units;
    place.for_each("units", max_lab_units, [&](const JsonPlace& each) { units.push_back(read_unit(each)); });
    return units;
}

void collect_names(const std::vector<rig::Unit>& units, std::set<std::string>& names) {
    for (const rig::Unit& unit : units) {
        if (!unit.name.empty()) names.insert(unit.name);
        if (const auto* for_each = std::get_if<rig::ForEach>(&unit.operation))
            collect_names(for_each->body.units(), names);
    }
}

void name_units(std::vector<rig::Unit>& units, std::set<std::string>& taken) {
    for (rig::Unit& unit : units) {
        if (unit.name.empty()) {
            const std::string base = rig::operation_name(unit.operation.index());
            unit.name = base;
            for (int i = 2; !taken.insert(unit.name).second; ++i) unit.name = base + " " + std::to_string(i);
        }
        if (auto* for_each = std::get_if<rig::ForEach>(&unit.operation))
            name_units(for_each->body.units(), taken);
    }
}

namespace {

constexpr std::string_view of_names[] = {"transform", "translation", "rotation", "scale",
                                         "x",         "y",           "z",        "value"};
constexpr std::string_view each_names[] = {"ratio", "index", "count"};

/// The part of an element that an input of T takes by default.
template <class T>
constexpr rig::Of taken = rig::Of::Translation;
template <>
constexpr rig::Of taken<bool> = rig::Of::ControlValue;
template <>
constexpr rig::Of taken<double> = rig::Of::ControlValue;
template <>
constexpr rig::Of taken<glm::dquat> = rig::Of::Rotation;
template <>
constexpr rig::Of taken<rig::Transform> = rig::Of::Transform;

template <class T>
T read_literal(const JsonPlace& place) {
    if constexpr (std::is_same_v<T, rig::Value>) return read_any_value(place);
    if constexpr (std::is_same_v<T, bool>) return place.flag();
    if constexpr (std::is_same_v<T, double>) return place.real();
    if constexpr (std::is_same_v<T, glm::dvec3>) return place.dpoint();
    if constexpr (std::is_same_v<T, glm::dquat>) return read_rotation(place);
    if constexpr (std::is_same_v<T, rig::Transform>) return read_transform(place);
}

const char* space_name(rig::Space space, rig::Pose pose) {
    if (pose == rig::Pose::Current) return space == rig::Space::Global ? "global" : "local";
    return space == rig::Space::Global ? "initial_global" : "initial_local";
}

rig::FromElement read_from_element(const JsonPlace& place, const char* key, rig::Of of) {
    check_members(place, {key, "of", "space"});
    rig::FromElement from;
    const JsonPlace name = place[key];
    if (key == std::string_view("item")) {
        read_name(name, {"each"});
        from.element = rig::ThisElement();
    } else {
        from.element = name.text();
    }
    from.of = of;
    if (place.has("of")) from.of = static_cast<rig::Of>(read_name(place["of"], of_names));
    if (place.has("space")) {
        const std::size_t which =
            read_name(place["space"], {"global", "local", "initial_global", "initial_local"});
        from.space = which % 2 == 0 ? rig::Space::Global : rig::Space::Local;
        from.pose = which < 2 ? rig::Pose::Current : rig::Pose::Initial;
    }
    return from;
}

rig::FromUnit read_from_unit(const JsonPlace& place) {
    check_members(place, {"unit", "output"});
    rig::FromUnit from;
    from.unit = place["unit"].text();
    if (place.has("output")) from.output = place["output"].text();
    return from;
}

}  // namespace

Json item_json(const rig::Item& item) {
    if (const auto* name = std::get_if<std::string>(&item.which)) return *name;
    return Json{{"item", "each"}};
}

rig::Item read_item(const JsonPlace& place) {
    if (place.json().is_string()) return place.text();
    if (!place.has("item"))
        place.fail("expected the name of an element or {\"item\": \"each\"}, found " +
                   json_summary(place.json()));
    check_members(place, {"item"});
    read_name(place["item"], {"each"});
    return rig::ThisElement();
}

template <class T>
Json input_json(const rig::Input<T>& input) {
    if (const T* literal = input.literal()) return value_json(*literal);
    if (const auto* from = std::get_if<rig::FromElement>(&input.source)) {
        Json json = Json::object();
        if (const auto* name = std::get_if<std::string>(&from->element.which))
            json["element"] = *name;
        else
            json["item"] = "each";
        json["of"] = of_names[static_cast<std::size_t>(from->of)];
        json["space"] = space_name(from->space, from->pose);
        return json;
    }
    if (const auto* from = std::get_if<rig::FromUnit>(&input.source))
        return Json{{"unit", from->unit}, {"output", from->output}};
    const auto each = static_cast<std::size_t>(std::get<rig::Each>(input.source));
    return Json{{"each", each_names[each]}};
}

template <class T>
rig::Input<T> read_input(const JsonPlace& place) {
    const Json& json = place.json();
    if (json.is_string()) return rig::FromElement{.element = place.text(), .of = taken<T>};
    if (place.has("element")) return read_from_element(place, "element", taken<T>);
    if (place.has("item")) return read_from_element(place, "item", taken<T>);
    if (place.has("unit")) return read_from_unit(place);
    if (!place.has("each")) return read_literal<T>(place);
    check_members(place, {"each"});
    return static_cast<rig::Each>(read_name(place["each"], each_names));
}

template Json input_json(const rig::Input<bool>&);
template Json input_json(const rig::Input<double>&);
template Json input_json(const rig::Input<glm::dvec3>&);
template Json input_json(const rig::Input<glm::dquat>&);
template Json input_json(const rig::Input<rig::Transform>&);
template Json input_json(const rig::Input<rig::Value>&);
template rig::Input<bool> read_input(const JsonPlace&);
template rig::Input<double> read_input(const JsonPlace&);
template rig::Input<glm::dvec3> read_input(const JsonPlace&);
template rig::Input<glm::dquat> read_input(const JsonPlace&);
template rig::Input<rig::Transform> read_input(const JsonPlace&);
template rig::Input<rig::Value> read_input(const JsonPlace&);

}  // namespace tendril::app
