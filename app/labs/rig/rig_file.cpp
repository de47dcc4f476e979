// The Rig lab in a scene file: the definition, in the words of the commands, and the state beside it.
//
// A pose is stored for the elements that are not as they are at rest, and so that it comes back to the bit:
// of local and global one was worked out from the other, and it is that other which is stored.
#include <cstring>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "app/document/json_complete.hpp"
#include "app/labs/kit/json_place.hpp"
#include "app/labs/rig/definition_json.hpp"
#include "app/labs/rig/memory_json.hpp"
#include "app/labs/rig/rig_edit.hpp"
#include "app/labs/rig/rig_part.hpp"
#include "app/labs/rig/value_json.hpp"

namespace tendril::app {
namespace {

using rig::Pose;
using rig::Space;

/// In the order of rig::Warning.
constexpr std::string_view warnings[] = {
    "none",         "target_at_item",      "zero_axis",    "secondary_on_primary", "axes_parallel",
    "zero_weights", "weight_out_of_range", "out_of_range", "cannot_solve"};

bool same_bits(const rig::Transform& a, const rig::Transform& b) {
    return std::memcmp(&a, &b, sizeof(a)) == 0;
}

/// The places in the definition of all elements, parents before their children.
std::vector<std::size_t> from_the_roots(const rig::Rig& rig, const rig::Hierarchy& tree) {
    std::vector<std::size_t> at(tree.size()), order;
    for (std::size_t i = 0; i < at.size(); ++i) at[rig.id(i).index] = i;
    for (rig::ElementId top = tree.first_child({}); top; top = tree.next_sibling(top))
        for (rig::ElementId each = top; each; each = tree.next_depth_first(each, top))
            order.push_back(at[each.index]);
    return order;
}

Json save_pose(rig::Hierarchy& tree, rig::Hierarchy& rest, rig::ElementId id, Pose pose) {
    const rig::Transform local = tree.get(id, Space::Local, pose), global = tree.get(id, Space::Global, pose);
    const rig::ElementId parent = tree.parent(id);
    const rig::Transform follows =
        parent ? rig::compose(tree.get(parent, Space::Global, pose), local) : local;
    if (!same_bits(follows, global)) return Json{{"global", transform_json(global)}};
    if (same_bits(local, rest.get(id, Space::Local, pose))) return nullptr;
    return Json{{"local", transform_json(local)}};
}

Json save_poses(const RigPart& part) {
    rig::Hierarchy tree = part.state.elements;  // reading works out what is pending
    rig::Hierarchy rest = part.rig.initial_state().elements;
    Json poses = Json::object();
    for (const std::size_t i : from_the_roots(part.rig, tree)) {
        const std::string& name = part.rig.definition().elements[i].name;
        for (const auto& [key, pose] : {std::pair{"input", Pose::Input}, std::pair{"now", Pose::Current}})
            if (Json saved = save_pose(tree, rest, part.rig.id(i), pose); !saved.is_null())
                poses[name][key] = std::move(saved);
    }
    return poses;
}

/// Stored numbers may be larger than given ones, and a scale may be 0: units come to such poses.
void load_pose(const JsonPlace& place, rig::Hierarchy& tree, rig::ElementId id, Pose pose) {
    check_members(place, {"local", "global"});
    const bool global = place.has("global");
    const JsonPlace stored = place[global ? "global" : "local"];
    const rig::Transform transform = read_transform(stored, {}, most_reached);
    check_unit(stored, transform.rotation);
    tree.put(id, global ? Space::Global : Space::Local, transform, rig::Propagate::Yes, pose);
}

void load_poses(const JsonPlace& place, RigPart& part) {
    if (!place.json().is_object()) place.fail("expected an object, found " + json_summary(place.json()));
    for (const auto& [name, stored] : place.json().items())
        if (!part.rig.element(name)) place.fail("there is no element " + json_summary(Json(name)));
    for (const std::size_t i : from_the_roots(part.rig, part.state.elements)) {
        const auto stored = place.optional(part.rig.definition().elements[i].name.c_str());
        if (!stored) continue;
        check_members(*stored, {"input", "now"});
        if (const auto input = stored->optional("input"))
            load_pose(*input, part.state.elements, part.rig.id(i), Pose::Input);
        if (const auto now = stored->optional("now"))
            load_pose(*now, part.state.elements, part.rig.id(i), Pose::Current);
    }
}

Json save_controls(const RigPart& part) {
    Json controls = Json::object();
    for (std::size_t i = 0; i < part.state.controls.size(); ++i)
        if (const rig::Element& element = part.rig.definition().elements[i]; element.control)
            controls[element.name] = control_value_json(element.control->kind, part.state.controls[i]);
    return controls;
}

void load_controls(const JsonPlace& place, RigPart& part) {
    for (std::size_t i = 0; i < part.state.controls.size(); ++i) {
        const rig::Element& element = part.rig.definition().elements[i];
        if (!element.control) continue;
        const JsonPlace stored = place[element.name.c_str()];
        const rig::Value value =
            read_control_value(stored, element.control->kind, part.state.controls[i], most_reached);
        check_unit(stored, value);
        part.state.controls[i] = rig::clamped(*element.control, value);
    }
}

Json save_curves(const RigPart& part) {
    Json curves = Json::object();
    for (std::size_t i = 0; i < part.state.curves.size(); ++i)
        curves[part.rig.definition().curves[i].name] = {{"input", part.state.input_curves[i]},
                                                        {"now", part.state.curves[i]}};
    return curves;
}

void load_curves(const JsonPlace& place, RigPart& part) {
    for (std::size_t i = 0; i < part.state.curves.size(); ++i) {
        const JsonPlace stored = place[part.rig.definition().curves[i].name.c_str()];
        part.state.input_curves[i] = stored["input"].real();
        part.state.curves[i] = stored["now"].real();
    }
}

Json save_unit(const rig::UnitState& unit) {
    Json outputs = Json::array(), memory = Json::array();
    for (const rig::Value& output : unit.outputs) outputs.push_back(value_json(output));
    for (const rig::UnitMemory& each : unit.memory) memory.push_back(memory_json(each));
    return Json{{"outputs", std::move(outputs)},
                {"warning", warnings[static_cast<std::size_t>(unit.warning)]},
                {"memory", std::move(memory)}};
}

void load_unit(const JsonPlace& place, rig::UnitState& unit) {
    check_members(place, {"outputs", "warning", "memory"});
    place["outputs"].check_size(unit.outputs.size(), "values, one an output");
    for (std::size_t i = 0; i < unit.outputs.size(); ++i)
        unit.outputs[i] = read_stored(place["outputs"].element(i), type_of(unit.outputs[i]));
    unit.warning = static_cast<rig::Warning>(read_name(place["warning"], warnings));
    place["memory"].check_size(unit.memory.size(), "values, one an element that the unit comes to");
    for (std::size_t i = 0; i < unit.memory.size(); ++i)
        unit.memory[i] = read_memory(place["memory"].element(i));
}

Json save_backward(const RigPart& part) {
    if (!part.backward) return nullptr;
    Json elements = Json::object();
    for (std::size_t i = 0; i < part.backward->elements.size(); ++i) {
        const rig::Element& element = part.rig.definition().elements[i];
        const rig::Residual& left = part.backward->elements[i];
        if (element.kind == rig::ElementKind::Bone)
            elements[element.name] = Json::array({left.metres, left.radians, left.scale});
    }
    return Json{{"bone", part.backward->bone}, {"left", std::move(elements)}};
}

BackwardLeft load_backward(const JsonPlace& place, const rig::Definition& definition) {
    check_members(place, {"bone", "left"});
    BackwardLeft left{place["bone"].text(), {}};
    left.elements.resize(definition.elements.size());
    for (std::size_t i = 0; i < left.elements.size(); ++i) {
        if (definition.elements[i].kind != rig::ElementKind::Bone) continue;
        const JsonPlace numbers = place["left"][definition.elements[i].name.c_str()];
        numbers.check_size(3, "numbers: metres, radians, scale");
        left.elements[i] = {numbers.element(0).real(), numbers.element(1).real(), numbers.element(2).real()};
    }
    return left;
}

}  // namespace

Json RigPart::save() const {
    Json json = definition_json(rig.definition());
    Json units = Json::object();
    for (std::size_t i = 0; i < state.units.size(); ++i)
        units[rig.unit_names()[i]] = save_unit(state.units[i]);
    json["state"] = {{"moving", moving},
                     {"controls", save_controls(*this)},
                     {"curves", save_curves(*this)},
                     {"poses", save_poses(*this)},
                     {"units", std::move(units)},
                     {"backward", save_backward(*this)},
                     {"selected", {{"element", selected.element}, {"unit", selected.unit}}}};
    return json;
}

std::shared_ptr<Part> RigPart::load(const Json& json, const std::string& where) const {
    const JsonPlace place(json, where);
    check_members(place, {"elements", "curves", "units", "state"});
    auto part = std::make_shared<RigPart>();
    try {
        *part = RigPart(read_definition(place));
    } catch (const std::logic_error& error) {  // the library's own words, told where in the file
        place.fail(error.what());
    }
    const auto state_place = place.optional("state");
    if (!state_place) return part;  // a rig that was written by hand begins at rest
    part->state = part->rig.initial_state();
    check_members(*state_place, {"moving", "controls", "curves", "poses", "units", "backward", "selected"});
    part->moving = (*state_place)["moving"].flag();
    load_controls((*state_place)["controls"], *part);
    load_curves((*state_place)["curves"], *part);
    load_poses((*state_place)["poses"], *part);
    const JsonPlace units = (*state_place)["units"];
    for (std::size_t i = 0; i < part->state.units.size(); ++i)
        load_unit(units[part->rig.unit_names()[i].c_str()], part->state.units[i]);
    if (const auto backward_place = state_place->optional("backward"))
        part->backward = load_backward(*backward_place, part->rig.definition());
    if (const auto selection = state_place->optional("selected")) {
        check_members(*selection, {"element", "unit"});
        part->selected = {(*selection)["element"].text(), (*selection)["unit"].text()};
        forget_missing_selection(*part);
    }
    return part;
}

}  // namespace tendril::app
