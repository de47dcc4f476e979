// The state of a rig in a scene file, which comes back to the bit.
//
// A pose is stored for the elements that are not as they are at rest, and so that it comes back to the bit:
// of local and global one was worked out from the other, and it is that other which is stored.
#include "app/labs/rig/state_json.hpp"

#include <cstring>
#include <string_view>
#include <utility>

#include "app/document/json_complete.hpp"
#include "app/labs/rig/memory_json.hpp"
#include "app/labs/rig/rig_edit.hpp"
#include "app/labs/rig/value_json.hpp"

namespace tendril::app {
namespace {

using rig::Pose;
using rig::Space;

/// In the order of rig::Warning.
constexpr std::string_view warnings[] = {
    "none",         "target_at_item",      "zero_axis",    "secondary_on_primary", "axes_parallel",
    "zero_weights", "weight_out_of_range", "out_of_range", "cannot_solve",         "parameter_out_of_range"};

bool same_bits(const rig::Transform& a, const rig::Transform& b) {
    return std::memcmp(&a, &b, sizeof(a)) == 0;
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

Json save_poses(const rig::Rig& rig, const rig::State& state) {
    rig::Hierarchy tree = state.elements;  // reading works out what is pending
    rig::Hierarchy rest = rig.initial_state().elements;
    Json poses = Json::object();
    for (const std::size_t i : from_the_roots(rig, tree)) {
        const std::string& name = rig.definition().elements[i].name;
        for (const auto& [key, pose] : {std::pair{"input", Pose::Input}, std::pair{"now", Pose::Current}})
            if (Json saved = save_pose(tree, rest, rig.id(i), pose); !saved.is_null())
                poses[name][key] = std::move(saved);
    }
    return poses;
}

/// Stored numbers may be larger than given ones, and a scale may be 0: units come to such poses.
void load_pose(const JsonPlace& place, rig::Hierarchy& tree, rig::ElementId id, Pose pose) {
    check_members(place, {"local", "global"});
    const bool global = place.has("global");
    const JsonPlace stored = place[global ? "global" : "local"];
    const rig::Transform transform = read_transform(stored, {}, max_reached);
    check_unit(stored, transform.rotation);
    tree.put(id, global ? Space::Global : Space::Local, transform, rig::Propagate::Yes, pose);
}

void load_poses(const JsonPlace& place, const rig::Rig& rig, rig::State& state) {
    if (!place.json().is_object()) place.fail("expected an object, found " + json_summary(place.json()));
    for (const auto& [name, stored] : place.json().items())
        if (!rig.element(name)) place.fail("there is no element " + json_summary(Json(name)));
    for (const std::size_t i : from_the_roots(rig, state.elements)) {
        const auto stored = place.optional(rig.definition().elements[i].name.c_str());
        if (!stored) continue;
        check_members(*stored, {"input", "now"});
        if (const auto input = stored->optional("input"))
            load_pose(*input, state.elements, rig.id(i), Pose::Input);
        if (const auto now = stored->optional("now"))
            load_pose(*now, state.elements, rig.id(i), Pose::Current);
    }
}

Json save_controls(const rig::Rig& rig, const rig::State& state) {
    Json controls = Json::object();
    for (std::size_t i = 0; i < state.controls.size(); ++i)
        if (const rig::Element& element = rig.definition().elements[i]; element.control)
            controls[element.name] = control_value_json(element.control->kind, state.controls[i]);
    return controls;
}

void load_controls(const JsonPlace& place, const rig::Rig& rig, rig::State& state) {
    for (std::size_t i = 0; i < state.controls.size(); ++i) {
        const rig::Element& element = rig.definition().elements[i];
        if (!element.control) continue;
        const JsonPlace stored = place[element.name.c_str()];
        const rig::Value value =
            read_control_value(stored, element.control->kind, state.controls[i], max_reached);
        check_unit(stored, value);
        state.controls[i] = rig::clamped(*element.control, value);
    }
}

Json save_curves(const rig::Rig& rig, const rig::State& state) {
    Json curves = Json::object();
    for (std::size_t i = 0; i < state.curves.size(); ++i)
        curves[rig.definition().curves[i].name] = {{"input", state.input_curves[i]},
                                                   {"now", state.curves[i]}};
    return curves;
}

void load_curves(const JsonPlace& place, const rig::Rig& rig, rig::State& state) {
    for (std::size_t i = 0; i < state.curves.size(); ++i) {
        const JsonPlace stored = place[rig.definition().curves[i].name.c_str()];
        state.input_curves[i] = stored["input"].real();
        state.curves[i] = stored["now"].real();
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

}  // namespace

Json rig_state_json(const rig::Rig& rig, const rig::State& state) {
    Json units = Json::object();
    for (std::size_t i = 0; i < state.units.size(); ++i)
        units[rig.unit_names()[i]] = save_unit(state.units[i]);
    return Json{{"controls", save_controls(rig, state)},
                {"curves", save_curves(rig, state)},
                {"poses", save_poses(rig, state)},
                {"units", std::move(units)}};
}

rig::State read_rig_state(const JsonPlace& place, const rig::Rig& rig) {
    rig::State state = rig.initial_state();
    load_controls(place["controls"], rig, state);
    load_curves(place["curves"], rig, state);
    load_poses(place["poses"], rig, state);
    const JsonPlace units = place["units"];
    for (std::size_t i = 0; i < state.units.size(); ++i)
        load_unit(units[rig.unit_names()[i].c_str()], state.units[i]);
    return state;
}

}  // namespace tendril::app
