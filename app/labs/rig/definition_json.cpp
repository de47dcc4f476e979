#include "app/labs/rig/definition_json.hpp"

#include <algorithm>
#include <utility>

#include "app/document/json_complete.hpp"
#include "app/fields/fields.hpp"
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

/// The members of a unit's curve, which older files and commands have beside its other inputs.
constexpr const char* curve_members[] = {"keys", "source_min", "source_max", "target_min", "target_max"};

/// The unit with its curve in one member, and those in its body likewise.
Json with_curve(Json unit) {
    if (!unit.is_object()) return unit;
    for (const char* each : curve_members)
        if (unit.contains(each) && (!unit.contains("curve") || unit["curve"].is_object())) {
            unit["curve"][each] = unit[each];
            unit.erase(each);
        }
    if (unit.contains("body") && unit["body"].is_array())
        for (Json& each : unit["body"]) each = with_curve(each);
    return unit;
}

bool has_curve_members(const Json& json) {
    if (json.is_array()) return std::ranges::any_of(json, has_curve_members);
    return json.is_object() &&
           (std::ranges::any_of(curve_members, [&](const char* each) { return json.contains(each); }) ||
            (json.contains("body") && has_curve_members(json["body"])));
}

const Field& operation_field() {
    return *find_field(fields<rig::Unit>(), "unit");
}

}  // namespace

std::vector<std::string> operation_names() {
    const auto names = operation_field().choices;
    return {names.begin(), names.end()};
}

std::vector<std::string> unit_members() {
    std::vector<std::string> members{"weight", "when", "enabled"};
    const auto add = [&](const char* name) {
        if (std::ranges::find(members, name) == members.end()) members.emplace_back(name);
    };
    for (const FieldKind& kind : operation_field().kinds)
        for (const Field& field : kind.table()) add(field.name);
    for (const char* each : curve_members) add(each);
    return members;
}

Json unit_json(const rig::Unit& unit) {
    return save_fields(unit);
}

Json units_json(const std::vector<rig::Unit>& units) {
    Json list = Json::array();
    for (const rig::Unit& unit : units) list.push_back(unit_json(unit));
    return list;
}

void edit_unit(const JsonPlace& place, rig::Unit& unit, bool edit) {
    if (!has_curve_members(place.json())) return load_known_fields(place, unit, edit);
    const Json json = with_curve(place.json());
    load_known_fields({json, place.where()}, unit, edit);
}

rig::Unit read_unit(const JsonPlace& place) {
    rig::Unit unit;
    edit_unit(place, unit, false);
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

}  // namespace tendril::app
