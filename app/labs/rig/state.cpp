// What --state writes of the Rig lab.
#include <glm/trigonometric.hpp>

#include "app/document/json_complete.hpp"
#include "app/labs/rig/clip.hpp"
#include "app/labs/rig/panels.hpp"
#include "app/labs/rig/past.hpp"
#include "app/labs/rig/rig_edit.hpp"
#include "app/labs/rig/rig_lab.hpp"
#include "app/labs/rig/rig_runtime.hpp"
#include "app/labs/rig/time_json.hpp"
#include "app/labs/rig/value_json.hpp"

namespace tendril::app {
namespace {

Json elements_state(const RigPart& part, const rig::Hierarchy& elements) {
    Json list = Json::array();
    for (std::size_t i = 0; i < part.state.controls.size(); ++i) {
        const rig::Element& element = part.rig.definition().elements[i];
        const rig::ElementId id = part.rig.id(i);
        Json json{{"name", element.name},
                  {"kind", rig::name(element.kind)},
                  {"parent", element.parent.empty() ? Json(nullptr) : Json(element.parent)},
                  {"local", transform_json(*elements.known(id, rig::Space::Local))},
                  {"global", transform_json(*elements.known(id, rig::Space::Global))}};
        if (element.control) {
            json["control"] = rig::name(element.control->kind);
            json["value"] = control_value_json(element.control->kind, part.state.controls[i]);
        }
        list.push_back(std::move(json));
    }
    return list;
}

Json curves_state(const RigPart& part) {
    Json curves = Json::object();
    for (std::size_t i = 0; i < part.state.curves.size(); ++i)
        curves[part.rig.definition().curves[i].name] = part.state.curves[i];
    return curves;
}

/// `at`: the place of the next unit among all of the rig, bodies included.
Json unit_state(const RigPart& part, const rig::Unit& unit, std::size_t& at) {
    const rig::UnitState& state = part.state.units[at++];
    Json outputs = Json::object();
    const std::vector<rig::Output> names = rig::outputs(unit.operation);
    for (std::size_t i = 0; i < names.size(); ++i) outputs[names[i].name] = value_json(state.outputs[i]);
    Json json{{"name", unit.name},
              {"unit", rig::operation_name(unit.operation.index())},
              {"enabled", unit.enabled},
              {"microseconds", 0.0},
              {"warning", rig::message(state.warning)},
              {"outputs", std::move(outputs)}};
    if (const auto* loop = std::get_if<rig::ForEach>(&unit.operation)) {
        json["body"] = Json::array();
        for (const rig::Unit& inner : loop->body.units()) json["body"].push_back(unit_state(part, inner, at));
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

/// Why the selected element is where it is; null where none is selected.
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

/// "frames" that cannot be expressed, by the worst of each stretch.
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
                {"past", past_view_state(workspace, rig_past(), rig_past_curve(workspace))},
                {"take", take_state(part)},
                {"motions", walks_json(part)},
                {"clip", clip_state(part)},
                {"rates", rates_json(part)}};
}

}  // namespace tendril::app
