#include "app/labs/rig/rig_lab.hpp"

#include <initializer_list>
#include <utility>

#include "app/document/json_complete.hpp"
#include "app/labs/rig/code.hpp"
#include "app/labs/rig/panel.hpp"
#include "app/labs/rig/presets.hpp"
#include "app/labs/rig/rig_commands.hpp"

namespace tendril::app {
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

std::string RigLab::code(const Workspace& workspace) const {
    return rig_code(rig_part(workspace));
}

namespace {

// A control beside the face moves its mouth and lids: its x opens the mouth, its z closes the lids.
constexpr glm::vec3 talk_centre(-0.85f, 1.15f, 0.5f);
constexpr float talk_radius = 0.2f;

CommandCall curve_of_talk(const char* unit, const char* axis, float middle, float span, Json keys) {
    const auto number = [](float value) { return shortest_decimal(value); };
    return {"rig.unit.add",
            {{"unit", "evaluate_curve"},
             {"name", unit},
             {"value", SharedJson(Json{{"element", "talk"}, {"of", axis}, {"space", "local"}})},
             {"curve", SharedJson(Json{{"keys", std::move(keys)},
                                       {"source_min", number(middle - span)},
                                       {"source_max", number(middle + span)}})}}};
}

CommandCall set_curve_to(const char* curve, const char* unit) {
    return {"rig.unit.add",
            {{"unit", "set_curve"},
             {"name", std::string("set ") + curve},
             {"curve", SharedJson(Json(curve))},
             {"value", SharedJson(Json{{"unit", unit}, {"output", "result"}})}}};
}

Json keys_of(std::initializer_list<std::pair<double, double>> points) {
    Json keys = Json::array();
    for (const auto& [time, value] : points)
        keys.push_back({{"time", time}, {"value", value}, {"piece", "linear"}});
    return keys;
}

}  // namespace

/// The head follows a control that goes round above it, blinks and speaks.
std::vector<CommandCall> RigLab::opening() const {
    const Json closing = keys_of({{0.0, 0.0}, {0.95, 0.0}, {0.985, 1.0}, {1.0, 1.0}});
    const Json syllables = keys_of({{0.0, 0.0},
                                    {0.1, 0.0},
                                    {0.18, 0.8},
                                    {0.25, 0.15},
                                    {0.33, 1.0},
                                    {0.41, 0.1},
                                    {0.49, 0.6},
                                    {0.55, 0.2},
                                    {0.63, 0.9},
                                    {0.72, 0.1},
                                    {0.8, 0.7},
                                    {0.88, 0.0},
                                    {1.0, 0.0}});
    return {{"rig.motion",
             {{"name", "tilt"},
              {"path", "figure_eight"},
              {"centre", glm::vec3(0.0f, 0.8f, 0.0f)},
              {"radius", 0.6f},
              {"period", 5.0f}}},
            {"rig.curve.add", {{"name", "blink"}}},
            {"rig.curve.add", {{"name", "mouth"}}},
            {"rig.element.add",
             {{"name", "talk"},
              {"kind", "control"},
              {"control", "position"},
              {"local", SharedJson(Json{{"translation", point(talk_centre)}})}}},
            curve_of_talk("lids", "z", talk_centre.z, 0.5f * talk_radius, closing),
            set_curve_to("blink", "lids"),
            curve_of_talk("lips", "x", talk_centre.x, talk_radius, syllables),
            set_curve_to("mouth", "lips"),
            {"rig.motion",
             {{"name", "talk"},
              {"path", "figure_eight"},
              {"centre", talk_centre},
              {"radius", talk_radius},
              {"period", 4.5f}}},
            {"rig.select", {}}};
}

/// Stops with the eyes open and the mouth closed.
std::vector<CommandCall> RigLab::calm() const {
    return {
        {"rig.motion", {{"name", "tilt"}, {"path", "still"}}},
        {"rig.motion", {{"name", "talk"}, {"path", "still"}}},
        {"rig.control.set",
         {{"name", "talk"}, {"value", SharedJson(Json(point(talk_centre - glm::vec3(talk_radius, 0, 0))))}}}};
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
