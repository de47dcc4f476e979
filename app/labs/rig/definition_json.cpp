#include "app/labs/rig/definition_json.hpp"

#include <algorithm>
#include <utility>

#include "app/fields/fields.hpp"
#include "app/io/json_complete.hpp"

namespace tendril::app {
namespace {

/// The members of a unit's curve, which older files and commands have beside its other inputs.
constexpr const char* curve_members[] = {"keys", "source_min", "source_max", "target_min", "target_max"};

// Convert the notations of commands and older files to the tables' own. Errors are left for the tables to
// refuse.

/// A control without a kind is a transform control. Its parent may be called "space".
Json full_element(Json element, const JsonPlace& place) {
    if (!element.is_object() || element.value("kind", Json()) != "control") return element;
    if (!element.contains("control")) element["control"] = "transform";
    if (!element.contains("space")) return element;
    const Json space = element["space"], parent = element.value("parent", Json());
    element.erase("space");
    if (parent.is_null() || parent == "")
        element["parent"] = space;
    else if (!space.is_null() && space != "" && space != parent)
        place["space"].fail("the space of a control is its parent, which is " + parent.dump());
    return element;
}

/// The unit with its curve in one member; also in its body.
Json full_unit(Json unit) {
    if (!unit.is_object()) return unit;
    for (const char* each : curve_members)
        if (unit.contains(each) && (!unit.contains("curve") || unit["curve"].is_object())) {
            unit["curve"][each] = unit[each];
            unit.erase(each);
        }
    if (unit.contains("body") && unit["body"].is_array())
        for (Json& each : unit["body"]) each = full_unit(each);
    return unit;
}

const Field& operation_field() {
    return *find_field(fields<rig::Unit>(), "unit");
}

}  // namespace

rig::Element read_element(const JsonPlace& place) {
    rig::Element element;
    const Json full = full_element(place.json(), place);
    load_known_fields({full, place.where()}, element);
    return element;
}

rig::Definition read_definition(const JsonPlace& place) {
    rig::Definition definition;
    Json full = Json::object();
    // Sizes first: oversized lists are refused before they are read.
    for (const auto& [list, most] :
         {std::pair("elements", max_lab_elements), {"curves", max_lab_curves}, {"units", max_lab_units}})
        if (place.has(list)) {
            place[list].list_size(list, most);
            full[list] = place[list].json();
        }
    if (full.contains("elements") && full["elements"].is_array())
        for (std::size_t i = 0; Json & each : full["elements"])
            each = full_element(each, place["elements"].element(i++));
    if (full.contains("units") && full["units"].is_array())
        for (Json& each : full["units"]) each = full_unit(each);
    load_known_fields({full, place.where()}, definition);
    std::set<std::string> taken;
    collect_names(definition.units, taken);
    name_units(definition.units, taken);
    return definition;
}

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

void edit_unit(const JsonPlace& place, rig::Unit& unit, bool edit) {
    const Json full = full_unit(place.json());
    load_known_fields({full, place.where()}, unit, {}, edit ? MissingField::Kept : MissingField::Default);
}

rig::Unit read_unit(const JsonPlace& place) {
    rig::Unit unit;
    edit_unit(place, unit, false);
    return unit;
}

void collect_names(const rig::Units& units, std::set<std::string>& names) {
    for (const rig::Unit& unit : units) {
        if (!unit.name.empty()) names.insert(unit.name);
        if (const auto* for_each = std::get_if<rig::ForEach>(&unit.operation))
            collect_names(for_each->body, names);
    }
}

void name_units(rig::Units& units, std::set<std::string>& taken) {
    for (rig::Unit& unit : units) {
        if (unit.name.empty()) {
            const std::string base = rig::operation_name(unit.operation.index());
            unit.name = base;
            for (int i = 2; !taken.insert(unit.name).second; ++i) unit.name = base + " " + std::to_string(i);
        }
        if (auto* for_each = std::get_if<rig::ForEach>(&unit.operation)) name_units(for_each->body, taken);
    }
}

}  // namespace tendril::app
