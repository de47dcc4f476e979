// The state of a rig in a scene file, and the Rig lab's --state.
//
// Stores only poses that differ from rest. One of local and global pose was computed from the other; storing
// the latter makes the round trip exact.
#include "app/labs/rig/state_json.hpp"

#include <cstring>
#include <glm/trigonometric.hpp>
#include <string_view>
#include <utility>

#include "app/io/json_complete.hpp"
#include "app/labs/kit/library_json.hpp"
#include "app/labs/kit/past.hpp"
#include "app/labs/rig/clip.hpp"
#include "app/labs/rig/panel.hpp"
#include "app/labs/rig/rig_edit.hpp"
#include "app/labs/rig/rig_file.hpp"
#include "app/labs/rig/rig_lab.hpp"
#include "app/labs/rig/rig_runtime.hpp"
#include "app/labs/rig/values.hpp"

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
    rig::Hierarchy tree = state.elements;  // copy: reading computes pending poses
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

/// Stored numbers may exceed the limits for given ones, and a scale may be 0: units can produce such poses.
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

Json save_curves(const rig::Rig& rig, const rig::State& state) {
    Json curves = Json::object();
    for (std::size_t i = 0; i < state.curves.size(); ++i)
        curves[rig.definition().curves[i].name] = {{"input", state.input_curves[i]},
                                                   {"now", state.curves[i]}};
    return curves;
}

void load_curves(const JsonPlace& place, const rig::Rig& rig, rig::State& state) {
    const auto curves = names(rig.definition().curves, [](const rig::NamedCurve& each) { return each.name; });
    load_named(place, "curve", curves, [&](std::size_t i, const JsonPlace& stored) {
        check_members(stored, {"input", "now"});
        state.input_curves[i] = stored["input"].real();
        state.curves[i] = stored["now"].real();
    });
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
    place["outputs"].check_size(unit.outputs.size(), "values, one per output");
    for (std::size_t i = 0; i < unit.outputs.size(); ++i)
        unit.outputs[i] = read_stored(place["outputs"].element(i), type_of(unit.outputs[i]));
    unit.warning = static_cast<rig::Warning>(read_name(place["warning"], warnings));
    place["memory"].check_size(unit.memory.size(), "values, one per element that the unit runs on");
    for (std::size_t i = 0; i < unit.memory.size(); ++i)
        unit.memory[i] = read_memory(place["memory"].element(i));
}

}  // namespace

Json rig_state_json(const rig::Rig& rig, const rig::State& state) {
    Json units = Json::object();
    for (std::size_t i = 0; i < state.units.size(); ++i)
        units[rig.unit_names()[i]] = save_unit(state.units[i]);
    return Json{{"controls", controls_json(rig, state.controls)},
                {"curves", save_curves(rig, state)},
                {"poses", save_poses(rig, state)},
                {"units", std::move(units)}};
}

rig::State read_rig_state(const JsonPlace& place, const rig::Rig& rig) {
    rig::State state = rig.initial_state();
    load_controls(place["controls"], rig, state.controls);
    load_curves(place["curves"], rig, state);
    load_poses(place["poses"], rig, state);
    load_named(place["units"], "unit", {rig.unit_names().begin(), rig.unit_names().end()},
               [&](std::size_t i, const JsonPlace& stored) { load_unit(stored, state.units[i]); });
    return state;
}

namespace {

constexpr std::size_t max_bones = 10'000;
constexpr double max_remembered = signal::max_output;

struct ToJson {
    Json operator()(std::monostate) const { return nullptr; }
    Json operator()(const rig::Turned& turned) const { return {{"turned", dquaternion(turned.rotation)}}; }
    Json operator()(const signal::OutputState& state) const { return {{"output", save_fields(state)}}; }
    template <class T>
    Json operator()(const signal::SpringState<T>& state) const {
        return {{"spring", save_fields({spring_fields<T>(), &state})}};
    }
    Json operator()(const ik::State& state) const { return {{"ik", save_ik_state(state)}}; }
};

/// Rotations do not have unit length before the filter has started.
template <class T>
rig::UnitMemory read_spring(const JsonPlace& place) {
    signal::SpringState<T> state;
    if (std::is_same_v<T, glm::dquat> && !place["started"].flag()) return {state};
    load_known_fields(place, {spring_fields<T>(), &state});
    check_unit(place["value"], state.value);
    check_unit(place["previous_target"], state.previous_target);
    return {state};
}

rig::UnitMemory read_any_spring(const JsonPlace& place) {
    check_members(place, field_names(spring_fields<double>(), nullptr));
    switch (type_of(read_any_value(place["value"], max_remembered))) {
        case rig::Type::Number:
            return read_spring<double>(place);
        case rig::Type::Vector:
            return read_spring<glm::dvec3>(place);
        case rig::Type::Rotation:
            return read_spring<glm::dquat>(place);
        default:
            place["value"].fail("expected a number, a vector or a rotation");
    }
}

ik::State read_chain(const JsonPlace& place) {
    check_members(place, {"rotations", "pole", "limits"});
    return load_ik_state(place, place["rotations"].list_size("rotations", max_bones));
}

}  // namespace

Json memory_json(const rig::UnitMemory& memory) {
    return std::visit(ToJson(), memory.held);
}

rig::UnitMemory read_memory(const JsonPlace& place) {
    if (place.json().is_null()) return {};
    check_members(place, {"turned", "output", "spring", "ik"});
    if (place.json().size() != 1) place.fail("expected one of turned, output, spring, ik");
    if (place.has("turned"))
        return {rig::Turned{std::get<glm::dquat>(read_stored(place["turned"], rig::Type::Rotation))}};
    if (place.has("spring")) return read_any_spring(place["spring"]);
    if (place.has("ik")) return {read_chain(place["ik"])};
    signal::OutputState output;
    load_known_fields(place["output"], output);
    return {output};
}

// The Rig lab's --state.

namespace {

Json elements_state(const RigPart& part, const rig::Hierarchy& elements) {
    Json list = Json::array();
    for (std::size_t i = 0; i < part.state->controls.size(); ++i) {
        const rig::Element& element = part.rig.definition().elements[i];
        const rig::ElementId id = part.rig.id(i);
        Json json = save_fields(element);
        json["local"] = transform_json(*elements.known(id, rig::Space::Local));
        json["global"] = transform_json(*elements.known(id, rig::Space::Global));
        if (element.control)
            json["value"] = control_value_json(element.control->kind, part.state->controls[i]);
        list.push_back(std::move(json));
    }
    return list;
}

Json curves_state(const RigPart& part) {
    Json curves = Json::object();
    for (std::size_t i = 0; i < part.state->curves.size(); ++i)
        curves[part.rig.definition().curves[i].name] = part.state->curves[i];
    return curves;
}

/// `at`: index of the next unit among all units of the rig, including those in bodies.
Json unit_state(const RigPart& part, const rig::Unit& unit, std::size_t& at) {
    const rig::UnitState& state = part.state->units[at++];
    Json outputs = Json::object();
    const std::vector<rig::Output> names = rig::outputs(unit.operation);
    for (std::size_t i = 0; i < names.size(); ++i) outputs[names[i].name] = value_json(state.outputs[i]);
    Json json = save_fields(unit);
    json.update(
        {{"microseconds", 0.0}, {"warning", rig::message(state.warning)}, {"outputs", std::move(outputs)}});
    if (const auto* loop = std::get_if<rig::ForEach>(&unit.operation)) {
        json["body"] = Json::array();
        for (const rig::Unit& inner : loop->body) json["body"].push_back(unit_state(part, inner, at));
    }
    return json;
}

Json units_state(const RigPart& part, const std::vector<double>& microseconds) {
    Json list = Json::array();
    std::size_t at = 0;
    for (const rig::Unit& unit : part.rig.definition().units) {
        list.push_back(unit_state(part, unit, at));
        if (const std::size_t i = list.size() - 1; i < microseconds.size())
            list.back()["microseconds"] = microseconds[i];
    }
    return list;
}

Json backward_state(const RigPart& part) {
    if (!part.backward) return nullptr;
    Json bone = nullptr;
    if (!part.backward->bone.empty()) bone = part.backward->bone;
    return Json{{"worst_mm", part.backward->worst_mm()},
                {"worst_degrees", part.backward->worst_degrees()},
                {"worst_scale", part.backward->worst_scale()},
                {"stopped", part.backward->stopped},
                {"bone", std::move(bone)}};
}

/// Why the selected element is where it is; null if none is selected.
Json why_state(const Workspace& workspace, RigRuntime& runtime) {
    const RigPart& part = rig_part(workspace);
    const auto element = part.selected.elements.active();
    if (!element) return nullptr;
    const rig::Explanation& why = runtime.explanation(workspace, *element);
    Json units = Json::array();
    for (std::size_t i = 0; i < why.units.size(); ++i) {
        const rig::Contribution& step = why.units[i];
        units.push_back({{"name", part.rig.definition().units[i].name},
                         {"mm", 1000.0 * step.metres},
                         {"degrees", glm::degrees(step.radians)},
                         {"change", transform_json(step.change)}});
    }
    return Json{{"element", part.selected_element()},
                {"input", transform_json(why.input)},
                {"units", std::move(units)},
                {"result", transform_json(why.result)}};
}

Json take_state(const RigPart& part) {
    const RigTake& take = part.take;
    return Json{{"seconds", static_cast<double>(take.now()) * tick_seconds},
                {"tick", take.now()},
                {"began", take.began},
                {"played_to", take.began + take.last},
                {"keys", take.keys ? take.keys->size() : 0}};
}

/// Frames that cannot be expressed, as runs with the worst frame of each.
Json left_state(const RigClip& clip, const ClipSolve& solve) {
    Json runs = Json::array();
    for (const LeftRun& run : left_runs(solve)) {
        const FrameLeft& worst = solve.left[run.worst];
        runs.push_back({{"from", run.first},
                        {"to", run.last},
                        {"frame", run.worst},
                        {"bone", clip.bones[worst.bone]},
                        {"mm", worst.mm},
                        {"degrees", worst.degrees},
                        {"scale", worst.scale},
                        {"stopped", worst.stopped}});
    }
    return runs;
}

Json clip_state(const RigPart& part) {
    if (!part.clip) return nullptr;
    Json json{
        {"began", part.clip->began}, {"frames", part.clip->frames()}, {"bones", part.clip->bones.size()}};
    if (!part.clip_left) return json;
    json["solved"] = part.clip_left->done();
    json["solving"] = part.clip_left->running;
    json["not_expressed"] = left_state(*part.clip, *part.clip_left);
    return json;
}

}  // namespace

Json RigLab::state(const Workspace& workspace) const {
    const RigPart& part = rig_part(workspace);
    auto& runtime = workspace.runtimes.of<RigRuntime>(rig_lab);
    return Json{{"lab", rig_lab},
                {"verdict", rig_verdict(part).text},
                {"elements", elements_state(part, runtime.resolved(workspace))},
                {"curves", curves_state(part)},
                {"units", units_state(part, runtime.microseconds(part.rig))},
                {"backward", backward_state(part)},
                {"why", why_state(workspace, runtime)},
                {"selected", {{"element", part.selected_element()}, {"unit", part.selected.unit}}},
                {"selection", names_of(part, part.selected.elements.all())},
                {"moving", part.moving},
                {"past", past_state(workspace, rig_past())},
                {"take", take_state(part)},
                {"motions", walks_json(part)},
                {"clip", clip_state(part)},
                {"rates", part.rates ? save_fields(*part.rates) : Json()}};
}

}  // namespace tendril::app
