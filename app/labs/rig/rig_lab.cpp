#include "app/labs/rig/rig_lab.hpp"

#include <glm/gtc/quaternion.hpp>
#include <tendril/rig/control.hpp>

#include "app/document/json_complete.hpp"
#include "app/labs/rig/code.hpp"
#include "app/labs/rig/draw_walks.hpp"
#include "app/labs/rig/panels.hpp"
#include "app/labs/rig/presets.hpp"
#include "app/labs/rig/rig_commands.hpp"
#include "app/labs/rig/rig_runtime.hpp"
#include "app/labs/rig/value_json.hpp"

namespace tendril::app {
namespace {

RigRuntime& runtime_of(const Workspace& workspace) {
    return workspace.runtimes.of<RigRuntime>(rig_lab);
}

glm::vec3 point_of(const rig::Hierarchy& elements, rig::ElementId id) {
    return glm::vec3(elements.known(id, rig::Space::Global)->translation);
}

/// Those that a drag moves: by a place within their limits.
bool has_place(rig::ControlKind kind) {
    return kind == rig::ControlKind::Transform || kind == rig::ControlKind::Position ||
           kind == rig::ControlKind::Vector2d;
}

/// The value that brings a control to a place, given where it would be at rest and where it is, all within
/// its parent.
Json value_at(const rig::Control& control, const rig::Transform& rest, const rig::Transform& now,
              const glm::dvec3& to) {
    if (control.kind == rig::ControlKind::Transform) return transform_json({to, now.rotation, now.scale});
    if (control.kind == rig::ControlKind::Position) return value_json(to);
    const glm::dvec3 by = glm::inverse(rest.rotation) * (to - rest.translation);
    return Json::array({by[control.axes[0]], by[control.axes[1]]});
}

}  // namespace

std::shared_ptr<Part> RigLab::blank() const {
    return std::make_shared<RigPart>(first_rig());
}

CameraPose RigLab::first_view() const {
    return rig_presets().front().view;
}

void RigLab::add_commands(CommandTable& table) const {
    add_solve_commands(table);
    add_element_commands(table);
    add_unit_commands(table);
    add_time_commands(table);
}

void RigLab::draw(const View& view, DrawList& list) const {
    const RigPart& part = rig_part(view.workspace);
    const rig::Hierarchy& elements = runtime_of(view.workspace).resolved(view.workspace);
    for (std::size_t i = 0; i < part.state.controls.size(); ++i) {
        const rig::ElementId id = part.rig.id(i), parent = elements.parent(id);
        const glm::vec3 at = point_of(elements, id);
        const bool control = elements.kind(id) == rig::ElementKind::Control;
        const glm::vec3 colour = control                                       ? view.palette.target
                                 : elements.kind(id) == rig::ElementKind::Bone ? view.palette.joint
                                                                               : view.palette.neutral;
        if (parent && !control && elements.kind(parent) == rig::ElementKind::Bone)
            list.line(point_of(elements, parent), at, 3.0f * view.scale,
                      glm::vec4(view.palette.neutral, 1.0f));
        Stroke& ball =
            list.sphere(at, (control ? 9.0f : 5.0f) * view.scale, Unit::Pixels, glm::vec4(colour, 1.0f));
        if (control) ball.pick = static_cast<PickId>(i);
    }
    draw_walks(view, list);
}

std::vector<Handle> RigLab::handles(const Workspace& workspace) const {
    const RigPart& part = rig_part(workspace);
    const rig::Hierarchy& elements = runtime_of(workspace).resolved(workspace);
    std::vector<Handle> handles;
    for (std::size_t i = 0; i < part.state.controls.size(); ++i) {
        const rig::Element& element = part.rig.definition().elements[i];
        if (!element.control) continue;
        const rig::Transform pose = *elements.known(part.rig.id(i), rig::Space::Global);
        handles.push_back({element.name,
                           static_cast<PickId>(i),
                           {glm::vec3(pose.translation), glm::quat(pose.rotation)},
                           has_place(element.control->kind) ? Drag::Position : Drag::Nothing});
    }
    return handles;
}

/// While the simulation is paused no tick solves, so a drag does.
void RigLab::drag(const Workspace& workspace, PickId pick, const Handle::Frame& frame, Emit& emit) const {
    const RigPart& part = rig_part(workspace);
    const auto at = static_cast<std::size_t>(pick);
    if (at >= part.state.controls.size()) return;
    const rig::Element& element = part.rig.definition().elements[at];
    if (!element.control || !has_place(element.control->kind)) return;
    const rig::Hierarchy& elements = runtime_of(workspace).resolved(workspace);
    const rig::ElementId id = part.rig.id(at), parent = elements.parent(id);
    const rig::Transform space = parent ? *elements.known(parent, rig::Space::Global) : rig::Transform();
    const rig::Transform to = rig::relative(space, {.translation = glm::dvec3(frame.position)});
    emit.continuously(
        "rig.control.set",
        {{"name", element.name},
         {"value",
          SharedJson(value_at(*element.control, *elements.known(id, rig::Space::Local, rig::Pose::Input),
                              *elements.known(id, rig::Space::Local), to.translation))}});
    if (!workspace.clock.playing) emit.continuously("rig.solve", {});
}

std::string RigLab::code(const Workspace& workspace) const {
    return rig_code(rig_part(workspace));
}

std::vector<LabSetting> RigLab::settings() const {
    return {pending_marks()};
}

std::vector<TestScene> RigLab::test_scenes() const {
    const std::vector<std::string> words{"head", "look",    "dial",    "shape",      "bone 2",
                                         "aim",  "curl",    "forward", "global",     "item",
                                         "unit", "element", "arm 1",   "translation"};
    std::vector<TestScene> scenes{
        {"small",
         {{"rig.clear", {}},
          {"rig.element.add", {{"name", "bone 1"}}},
          {"rig.element.add", {{"name", "bone 2"}, {"parent", "bone 1"}}},
          {"rig.element.add", {{"name", "look"}, {"kind", "control"}, {"control", "position"}}},
          {"rig.unit.add",
           {{"unit", "offset_transform"}, {"item", "bone 1"}, {"offset", SharedJson(Json::object())}}},
          {"rig.unit.add", {{"unit", "set_rotation"}, {"item", "bone 2"}, {"rotation", "look"}}}},
         words}};
    for (const RigPreset& preset : rig_presets())
        scenes.push_back({preset.name, {{"rig.preset", {{"name", preset.name}}}}, words});
    scenes.push_back({"walking",
                      {{"rig.preset", {{"name", "secondary"}}},
                       {"rig.motion", {{"name", "head"}, {"path", "figure_eight"}, {"period", 1.5}}},
                       {"rig.clip.record", {{"seconds", 0.5}}},
                       {"rig.clip.solve", {}}},
                      words});
    return scenes;
}

}  // namespace tendril::app
