#include "app/labs/rig/definition_json.hpp"

#include <string_view>

#include "app/document/json_complete.hpp"
#include "app/labs/rig/unit_json.hpp"
#include "app/labs/rig/value_json.hpp"
#include "app/labs/rig/value_text.hpp"

namespace tendril::app {
namespace {

constexpr const char* axis_names[] = {"x", "y", "z"};

/// How many numbers an end of its range has; 0 where it has no range.
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
        axes.check_size(2, "axes, two of x, y, z");
        for (std::size_t i = 0; i < 2; ++i)
            control.axes[i] = static_cast<int>(read_name(axes.element(i), {"x", "y", "z"}));
    }
    read_end(place, "minimum", control.kind, control.minimum);
    read_end(place, "maximum", control.kind, control.maximum);
    return control;
}

/// The parent, which a control may call its space.
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

}  // namespace tendril::app
