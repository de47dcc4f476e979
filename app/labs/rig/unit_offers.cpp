// The units that Add a unit offers, wired to the selection.
#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <set>
#include <string_view>
#include <utility>

#include "app/io/json_complete.hpp"
#include "app/labs/kit/arguments.hpp"
#include "app/labs/rig/definition_json.hpp"
#include "app/labs/rig/draw.hpp"
#include "app/labs/rig/rig_edit.hpp"
#include "app/labs/rig/unit_inputs.hpp"

namespace tendril::app {
namespace {

using Elements = std::vector<rig::Element>;

const rig::Element* item_of(const RigPart& part) {
    const Elements& elements = part.rig.definition().elements;
    if (const auto active = part.selected.elements.active()) return &elements[*active];
    for (const rig::Element& each : elements)
        if (each.kind == rig::ElementKind::Bone) return &each;
    return elements.empty() ? nullptr : &elements.front();
}

const rig::Element* parent_of(const RigPart& part, const rig::Element& element) {
    const auto parent = part.rig.element(element.parent);
    return parent ? &part.rig.definition().elements[*parent] : nullptr;
}

std::vector<std::string> selected_but(const RigPart& part, const rig::Element& item) {
    std::vector<std::string> names = names_of(part, part.selected.elements.all());
    std::erase(names, item.name);
    return names;
}

/// A selected element other than a control or, without one, the first bone; null if there is neither.
const rig::Element* no_control(const RigPart& part) {
    const Elements& elements = part.rig.definition().elements;
    for (const std::size_t each : part.selected.elements.all())
        if (elements[each].kind != rig::ElementKind::Control) return &elements[each];
    const auto bone = std::ranges::find(elements, rig::ElementKind::Bone, &rig::Element::kind);
    return bone == elements.end() ? nullptr : &*bone;
}

/// The selected elements without a selected ancestor: a for-each visits descendants itself.
std::vector<std::string> roots_selected(const RigPart& part) {
    const Elements& elements = part.rig.definition().elements;
    std::vector<bool> covered(elements.size());
    std::vector<std::size_t> roots;
    for (const std::size_t at : from_the_roots(part.rig, part.state->elements)) {
        const auto parent = part.rig.element(elements[at].parent);
        const bool below = parent && covered[*parent], selected = part.selected.elements.has(at);
        covered[at] = below || selected;
        if (selected && !below) roots.push_back(at);
    }
    return names_of(part, roots);
}

/// Another element to follow or point at: prefers selected ones, then controls.
const rig::Element* other_than(const RigPart& part, const rig::Element& element) {
    for (const std::size_t each : part.selected.elements.all())
        if (const rig::Element& other = part.rig.definition().elements[each]; &other != &element)
            return &other;
    const rig::Element* found = nullptr;
    for (const rig::Element& each : part.rig.definition().elements) {
        if (&each == &element) continue;
        if (each.kind == rig::ElementKind::Control) return &each;
        if (found == nullptr) found = &each;
    }
    return found;
}

/// The element `count` levels above a bone; null if any on the way is not a bone.
const rig::Element* bones_above(const RigPart& part, const rig::Element& tip, std::size_t count) {
    const rig::Element* at = &tip;
    for (std::size_t i = 0; i < count && at != nullptr; ++i) at = parent_of(part, *at);
    return at;
}

UnitOffer with_item(const RigPart& part, Json unit) {
    const rig::Element* item = item_of(part);
    if (item == nullptr) return {{}, "add an element first"};
    unit["item"] = item->name;
    return {SharedJson(std::move(unit))};
}

/// The item's own axis that points most nearly at the other element; a head's face, wherever that is. Unless
/// it is y, its length, also the axis that points up, which stays up: a head stays upright.
void aim_at(const RigPart& part, const rig::Element& item, const rig::Element& other, Json& unit) {
    constexpr int length = 1;
    rig::Hierarchy now = part.state->elements;
    const auto pose = [&](const rig::Element& each) {
        return now.get(part.rig.id(*part.rig.element(each.name)), rig::Space::Global);
    };
    const rig::Transform from = pose(item);
    const glm::dquat to_own = glm::inverse(from.rotation);
    const auto nearest = [](const glm::dvec3& way, int besides) {
        int at = besides == length ? 2 : length;
        for (const int i : {0, 2})
            if (i != besides && std::abs(way[i]) > std::abs(way[at])) at = i;
        return at;
    };
    const auto axis = [](const glm::dvec3& way, int at) {
        glm::dvec3 unit_vector(0.0);
        unit_vector[at] = way[at] < 0.0 ? -1.0 : 1.0;
        return dpoint(unit_vector);
    };
    const glm::dvec3 ahead = figure_of(part, *part.rig.element(item.name)) == Figure::Head
                                 ? glm::dvec3(0, 0, 1)
                                 : to_own * (pose(other).translation - from.translation);
    const glm::dvec3 up = to_own * glm::dvec3(0, 1, 0);
    const int first = nearest(ahead, -1);
    unit["primary"] = {{"axis", axis(ahead, first)}, {"target", other.name}};
    if (first != length)
        unit["secondary"] = {
            {"axis", axis(up, nearest(up, first))}, {"target", {0, 1, 0}}, {"kind", "direction"}};
}

UnitOffer follower(const RigPart& part, Json unit) {
    const rig::Element* item = item_of(part);
    const rig::Element* other = item != nullptr ? other_than(part, *item) : nullptr;
    if (other == nullptr) return {{}, "add a second element first"};
    // Controls are meant to be followed; a control that follows would only lose its own pose.
    if (const rig::Element* instead = no_control(part);
        instead != nullptr && item->kind == rig::ElementKind::Control)
        other = std::exchange(item, instead);
    if (unit["unit"] == "parent_constraint") {
        unit["item"] = item->name;
        std::vector<std::string> parents = selected_but(part, *item);
        if (parents.empty()) parents.push_back(other->name);
        unit["parents"] = Json::array();
        for (const std::string& each : parents) unit["parents"].push_back({{"item", each}});
    } else if (unit["unit"] == "aim") {
        unit["item"] = item->name;
        aim_at(part, *item, *other, unit);
    } else {
        unit["child"] = item->name;
        unit["old_parent"] = item->parent.empty() ? other->name : item->parent;
        unit["new_parent"] = other->name;
    }
    return {SharedJson(std::move(unit))};
}

UnitOffer chain(const RigPart& part, Json unit) {
    const rig::Element* tip = item_of(part);
    const rig::Element* root = tip != nullptr ? bones_above(part, *tip, 2) : nullptr;
    if (root == nullptr) return {{}, "select a bone that has two bones above it"};
    unit["root"] = root->name;
    unit["tip"] = tip->name;
    if (const rig::Element* other = other_than(part, *tip);
        other != nullptr && other->kind == rig::ElementKind::Control)
        unit["target"] = other->name;
    return {SharedJson(std::move(unit))};
}

/// Unlike the other solvers, offers the whole chain: through the selected elements in order or, without any,
/// from the root's position through all controls.
UnitOffer along_points(const RigPart& part, Json unit) {
    UnitOffer offer = chain(part, std::move(unit));
    if (!offer.unit) return offer;
    const rig::Element* tip = item_of(part);
    const rig::Element* root = bones_above(part, *tip, 2);
    for (const rig::Element* above = parent_of(part, *root);
         above != nullptr && above->kind == rig::ElementKind::Bone; above = parent_of(part, *above))
        root = above;
    std::vector<std::string> points = selected_but(part, *tip);
    if (points.size() < 2) {
        points = {root->name};
        for (const rig::Element& each : part.rig.definition().elements)
            if (each.kind == rig::ElementKind::Control) points.push_back(each.name);
    }
    if (points.size() < 2) return {{}, "add a control for the curve first"};
    return {
        SharedJson(Json{{"unit", "spline"}, {"root", root->name}, {"tip", tip->name}, {"points", points}})};
}

/// Continues from the selected unit: a place, a spring that follows it, an aim at the spring.
UnitOffer offered(const RigPart& part, std::string_view kind) {
    Json unit{{"unit", kind}};
    const auto active = part.selected.elements.active();
    const std::string selected = active ? part.rig.definition().elements[*active].name : "";
    const Json given{{"unit", part.selected.unit}};
    std::size_t gives = 0;  // as rig::Type
    if (const auto row = unit_row(part, part.selected.unit); row && part.selected.unit_last)
        gives = part.state->units[row->at].outputs.at(0).index();
    const bool point = gives == static_cast<std::size_t>(rig::Type::Vector);
    const bool follows = point || gives == static_cast<std::size_t>(rig::Type::Rotation);
    if (kind == "spring_interpolate" && (follows || active))
        unit["target"] = follows ? given : Json(selected);
    if (kind.starts_with("transform_") && active) {
        unit["transform"] = {{"element", selected}, {"of", "transform"}};
        unit[kind == "transform_location" ? "location" : "direction"] = {0, 0.3, 0};  // as long as a new bone
    }
    if (kind == "aim" && point && active) {
        unit.update({{"item", selected}, {"primary", {{"axis", {0, 1, 0}}, {"target", given}}}});
        return {SharedJson(std::move(unit))};
    }
    if (kind == "aim" || kind == "parent_constraint" || kind == "project_to_parent")
        return follower(part, std::move(unit));
    if (kind == "two_bone" || kind == "fabrik") return chain(part, std::move(unit));
    if (kind == "spline") return along_points(part, std::move(unit));
    if (kind == "offset_transform" || kind == "set_transform" || kind == "set_rotation")
        return with_item(part, std::move(unit));
    if (kind == "for_each") {
        const rig::Element* item = item_of(part);
        if (item == nullptr) return {{}, "add an element first"};
        const std::vector<std::string> roots = roots_selected(part);
        unit["roots"] = roots.empty() ? Json::array({item->name}) : Json(roots);
        unit["body"] = Json::array();
    }
    if (kind == "set_curve") {
        if (part.rig.definition().curves.empty()) return {{}, "add a curve first"};
        unit["curve"] = part.rig.definition().curves.front().name;
    }
    return {SharedJson(std::move(unit))};
}

}  // namespace

std::string free_element_name(const RigPart& part, const std::string& base) {
    std::string name = base;
    for (int i = 2; part.rig.element(name); ++i) {
        name = base;
        name += ' ';
        name += std::to_string(i);
    }
    return name;
}

std::string selected_loop(const RigPart& part) {
    const auto row = unit_row(part, part.selected.unit);
    if (!row) return {};
    const rig::Unit& top = part.rig.definition().units[row->top];
    return std::holds_alternative<rig::ForEach>(top.operation) ? top.name : std::string();
}

UnitOffer offered_unit(const RigPart& part, std::size_t operation) {
    const std::string_view kind = rig::operation_name(operation);
    const std::string loop = selected_loop(part);
    if (!loop.empty() && kind == "for_each") return {{}, "not in a for-each; click an element first"};
    UnitOffer offer = offered(part, kind);
    if (loop.empty() || !offer.unit) return offer;
    Json unit = **offer.unit;
    unit["into"] = loop;
    for (const char* member : {"item", "target"})
        if (unit.contains(member) && unit[member].is_string() && !unit.contains("root"))
            unit[member] = {{"item", "each"}};
    if (kind.starts_with("transform_")) unit["transform"] = {{"item", "each"}, {"of", "transform"}};
    return {SharedJson(std::move(unit))};
}

}  // namespace tendril::app
