#include "app/labs/rig/adding.hpp"

#include <string_view>

#include "app/document/json_complete.hpp"
#include "app/labs/rig/rig_edit.hpp"

namespace tendril::app {
namespace {

using Elements = std::vector<rig::Element>;

/// The active element; else the first bone; else the first element.
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

/// Beside the active one.
std::vector<std::string> others_selected(const RigPart& part) {
    std::vector<std::size_t> others = part.selected.elements.all();
    std::erase_if(others, [&](std::size_t each) { return each == part.selected.elements.active(); });
    return names_of(part, others);
}

/// Those selected that are below no other one: a for-each comes to what is below them by itself.
std::vector<std::string> roots_selected(const RigPart& part) {
    const Elements& elements = part.rig.definition().elements;
    std::vector<bool> covered(elements.size());
    std::vector<std::size_t> roots;
    for (const std::size_t at : from_the_roots(part.rig, part.state.elements)) {
        const auto parent = part.rig.element(elements[at].parent);
        const bool below = parent && covered[*parent], selected = part.selected.elements.has(at);
        covered[at] = below || selected;
        if (selected && !below) roots.push_back(at);
    }
    return names_of(part, roots);
}

/// Any that is not this one, those selected and then controls before others: what can be followed, or pointed
/// at.
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

/// So many bones above a bone, all of them bones; null where there are fewer.
const rig::Element* bones_above(const RigPart& part, const rig::Element& tip, std::size_t count) {
    const rig::Element* at = &tip;
    for (std::size_t i = 0; i < count && at != nullptr; ++i) at = parent_of(part, *at);
    return at;
}

UnitOffer with_item(const RigPart& part, Json unit) {
    const rig::Element* item = item_of(part);
    if (item == nullptr) return {{}, "an element"};
    unit["item"] = item->name;
    return {SharedJson(std::move(unit))};
}

UnitOffer follower(const RigPart& part, Json unit) {
    const rig::Element* item = item_of(part);
    const rig::Element* other = item != nullptr ? other_than(part, *item) : nullptr;
    if (other == nullptr) return {{}, "two elements"};
    if (unit["unit"] == "parent_constraint") {
        unit["item"] = item->name;
        std::vector<std::string> parents = others_selected(part);
        if (parents.empty()) parents.push_back(other->name);
        unit["parents"] = Json::array();
        for (const std::string& each : parents) unit["parents"].push_back({{"item", each}});
    } else if (unit["unit"] == "aim") {
        unit["item"] = item->name;
        unit["primary"] = {{"axis", {0, 1, 0}}, {"target", other->name}};
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
    if (root == nullptr) return {{}, "a selected bone, two bones below another"};
    unit["root"] = root->name;
    unit["tip"] = tip->name;
    if (const rig::Element* other = other_than(part, *tip);
        other != nullptr && other->kind == rig::ElementKind::Control)
        unit["target"] = other->name;
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

UnitOffer offered_unit(const RigPart& part, std::size_t operation) {
    const std::string_view kind = rig::operation_name(operation);
    Json unit{{"unit", kind}};
    if (kind == "aim" || kind == "parent_constraint" || kind == "project_to_parent")
        return follower(part, std::move(unit));
    if (kind == "two_bone" || kind == "fabrik") return chain(part, std::move(unit));
    if (kind == "offset_transform" || kind == "set_transform" || kind == "set_rotation")
        return with_item(part, std::move(unit));
    if (kind == "for_each") {
        const rig::Element* item = item_of(part);
        if (item == nullptr) return {{}, "an element"};
        const std::vector<std::string> selected = roots_selected(part);
        unit["roots"] = selected.empty() ? Json::array({item->name}) : Json(selected);
        unit["body"] = Json::array();
    }
    if (kind == "set_curve") {
        if (part.rig.definition().curves.empty()) return {{}, "a named curve"};
        unit["curve"] = part.rig.definition().curves.front().name;
    }
    return {SharedJson(std::move(unit))};
}

}  // namespace tendril::app
