#include "app/labs/rig/rig_lab.hpp"

#include "app/document/json_complete.hpp"
#include "app/labs/rig/code.hpp"
#include "app/labs/rig/panel.hpp"
#include "app/labs/rig/presets.hpp"
#include "app/labs/rig/rig_commands.hpp"

namespace tendril::app {
std::shared_ptr<Part> RigLab::blank() const {
    return std::make_shared<RigPart>(first_rig());
}

std::string RigLab::invitation(const Workspace& workspace) const {
    return rig_part(workspace).rig.definition().elements.empty() ? "Add an element, or take a preset."
                                                                 : "Drag an orange shape.";
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

std::string RigLab::code(const Workspace& workspace) const {
    return rig_code(rig_part(workspace));
}

/// The head follows a control that circles above it, blinks and speaks: a control beside the face moves its
/// mouth and lids, by curves of its x and z.
std::vector<CommandCall> RigLab::opening() const {
    return rig_script("opening");
}

/// Stops with the eyes open and the mouth closed.
std::vector<CommandCall> RigLab::calm() const {
    return rig_script("calm");
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
         words},
        {"selected",
         {{"rig.clear", {}},
          {"rig.element.add", {{"name", "bone 1"}}},
          {"rig.unit.add",
           {{"unit", "offset_transform"}, {"item", "bone 1"}, {"offset", SharedJson(Json::object())}}},
          {"rig.select", {{"unit", "offset_transform"}}}},
         words}};
    scenes.push_back({"several",
                      {{"rig.preset", {{"name", "morph"}}},
                       {"rig.element.add", {{"name", "bone 1"}}},
                       {"rig.element.add", {{"name", "bone 2"}, {"parent", "bone 1"}}},
                       {"rig.select", {{"elements", SharedJson(Json{"shape", "bone 1", "bone 2"})}}}},
                      words});
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
