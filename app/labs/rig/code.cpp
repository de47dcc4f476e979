#include "app/labs/rig/code.hpp"

#include "app/document/json_complete.hpp"
#include "app/document/json_place.hpp"
#include "app/labs/kit/code_text.hpp"
#include "app/labs/rig/unit_code.hpp"
#include "app/labs/rig/value_json.hpp"

namespace tendril::app {
namespace {

constexpr const char* head = R"(// A rig, exported from Tendril.
//
// CMake: find_package(tendril REQUIRED)
//        target_link_libraries(your_program PRIVATE tendril::core)
#if defined(__GNUC__) && !defined(__clang__)
// GCC 12 takes variants that are moved for ones that were never initialised.
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#include <cstdio>
#include <tendril/rig/rig.hpp>
#include <tendril/rig/workspace.hpp>

using namespace tendril;

)";

std::string control_code(const rig::Control& control) {
    std::string text = "rig::Control{.kind = rig::ControlKind::" + pascal_text(rig::name(control.kind));
    if (control.axes != rig::Control().axes) {
        text +=
            ", .axes = {" + std::to_string(control.axes[0]) + ", " + std::to_string(control.axes[1]) + '}';
    }
    const auto end = [&](const char* name, const std::optional<glm::dvec3>& value) {
        if (value) text += std::string(", .") + name + " = glm::dvec3" + braced(*value);
    };
    end("minimum", control.minimum);
    end("maximum", control.maximum);
    return text + '}';
}

std::string definition_code(const rig::Definition& definition) {
    std::string text = "static rig::Definition definition() {\n    rig::Definition made;\n";
    for (const rig::Element& element : definition.elements) {
        text += "    made.elements.push_back({.name = " + string_text(element.name) +
                ", .kind = rig::ElementKind::" + pascal_text(rig::name(element.kind));
        if (!element.parent.empty()) text += ", .parent = " + string_text(element.parent);
        if (element.initial != rig::Transform())
            text += ",\n                             .initial = " + transform_code(element.initial);
        if (element.control)
            text += ",\n                             .control = " + control_code(*element.control);
        text += "});\n";
    }
    for (const rig::NamedCurve& curve : definition.curves)
        text += "    made.curves.push_back({.name = " + string_text(curve.name) +
                ", .value = " + double_text(curve.value) + "});\n";
    for (const rig::Unit& unit : definition.units)
        text += "    made.units.push_back(" + unit_code(unit, "    ") + ");\n";
    return text + "    return made;\n}\n\n";
}

/// What a person has set: input poses, controls, curves.
std::string inputs_code(const RigPart& part) {
    const rig::State rest = part.rig.initial_state();
    std::string text;
    const Json saved = part.save();
    for (const auto& [name, poses] : saved.at("state").at("poses").items()) {
        if (!poses.contains("input")) continue;
        const bool global = poses.at("input").contains("global");
        const JsonPlace place(poses.at("input").at(global ? "global" : "local"), "");
        text += "    state.elements.put(id(" + string_text(name) +
                "), rig::Space::" + (global ? "Global" : "Local") + ", " +
                transform_code(read_transform(place, {}, max_reached)) +
                ",\n                       rig::Propagate::Yes, rig::Pose::Input);\n";
    }
    for (std::size_t i = 0; i < part.state.controls.size(); ++i)
        if (part.state.controls[i] != rest.controls[i])
            text += "    state.controls[*made->element(" +
                    string_text(part.rig.definition().elements[i].name) +
                    ")] = " + value_code(part.state.controls[i]) + ";\n";
    for (std::size_t i = 0; i < part.state.input_curves.size(); ++i)
        if (part.state.input_curves[i] != rest.input_curves[i])
            text += "    state.input_curves[*made->curve(" +
                    string_text(part.rig.definition().curves[i].name) +
                    ")] = " + double_text(part.state.input_curves[i]) + ";\n";
    return text;
}

std::string memories_code(const RigPart& part) {
    std::string text;
    for (std::size_t unit = 0; unit < part.state.units.size(); ++unit)
        for (std::size_t i = 0; i < part.state.units[unit].memory.size(); ++i)
            text += memory_code("state.units[" + std::to_string(unit) + "].memory[" + std::to_string(i) + ']',
                                part.state.units[unit].memory[i]);
    return text.empty() ? text
                        : "    // What its units remember by now: springs swing on from here.\n" + text;
}

constexpr const char* tail = R"(
    rig::Workspace workspace(*made);  // kept from frame to frame
    const double dt = 0.0;            // seconds since the last frame
    made->solve(state, dt, workspace);
    for (const rig::Element& element : made->definition().elements) {
        const rig::Transform& at = state.elements.get(id(element.name.c_str()), rig::Space::Global);
        std::printf("%.17g %.17g %.17g  %.17g %.17g %.17g %.17g  %.17g %.17g %.17g  %s\n",
                    at.translation.x, at.translation.y, at.translation.z, at.rotation.x, at.rotation.y,
                    at.rotation.z, at.rotation.w, at.scale.x, at.scale.y, at.scale.z, element.name.c_str());
    }
}
)";

}  // namespace

std::string rig_code(const RigPart& part) {
    std::string text = head + definition_code(part.rig.definition());
    text +=
        "int main() {\n"
        "    const tendril::Expected<rig::Rig> made = rig::Rig::make(definition());\n"
        "    if (!made) {\n"
        "        std::fprintf(stderr, \"%s\\n\", made.message());\n"
        "        return 1;\n"
        "    }\n"
        "    rig::State state = made->initial_state();\n"
        "    const auto id = [&](const char* name) { return made->id(*made->element(name)); };\n";
    return text + inputs_code(part) + memories_code(part) + tail;
}

}  // namespace tendril::app
