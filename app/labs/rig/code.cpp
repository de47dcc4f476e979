#include "app/labs/rig/code.hpp"

#include "app/io/json_complete.hpp"
#include "app/io/json_place.hpp"
#include "app/labs/kit/code_text.hpp"
#include "app/labs/kit/library_json.hpp"
#include "app/labs/rig/values.hpp"

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
        const rig::Element usual;
        text += "    made.elements.push_back({" +
                comma_list(member_texts({fields<rig::Element>().first(4), &element, &usual}));
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

/// The user's settings: input poses, controls, curves.
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
                literal_code(read_transform(place, {}, max_reached)) +
                ",\n                       rig::Propagate::Yes, rig::Pose::Input);\n";
    }
    for (std::size_t i = 0; i < part.state->controls.size(); ++i)
        if (part.state->controls[i] != rest.controls[i])
            text += "    state.controls[*made->element(" +
                    string_text(part.rig.definition().elements[i].name) +
                    ")] = " + literal_code(part.state->controls[i]) + ";\n";
    for (std::size_t i = 0; i < part.state->input_curves.size(); ++i)
        if (part.state->input_curves[i] != rest.input_curves[i])
            text += "    state.input_curves[*made->curve(" +
                    string_text(part.rig.definition().curves[i].name) +
                    ")] = " + double_text(part.state->input_curves[i]) + ";\n";
    return text;
}

std::string memories_code(const RigPart& part) {
    std::string text;
    for (std::size_t unit = 0; unit < part.state->units.size(); ++unit)
        for (std::size_t i = 0; i < part.state->units[unit].memory.size(); ++i)
            text += memory_code("state.units[" + std::to_string(unit) + "].memory[" + std::to_string(i) + ']',
                                part.state->units[unit].memory[i]);
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

std::string unit_code(const rig::Unit& unit, const std::string& margin) {
    return "rig::Unit" + kind_text(fields<rig::Unit>(), &unit, tendril::detail::fresh<rig::Unit>(), margin);
}

namespace {

std::string list_code(const auto& list, const auto& text) {
    std::string code = "{";
    for (const auto& each : list) code += (code.size() > 1 ? ", " : "") + text(each);
    return code + '}';
}

struct MemoryCode {
    std::string place;

    std::string operator()(std::monostate) const { return {}; }
    std::string operator()(const rig::Turned& turned) const {
        return held("rig::Turned{" + literal_code(turned.rotation) + '}');
    }
    std::string operator()(const signal::OutputState& state) const {
        return held("signal::OutputState" + struct_text(state));
    }
    template <class T>
    std::string operator()(const signal::SpringState<T>& state) const {
        return held("signal::SpringState<" + type<T>() + ">" + struct_text({spring_fields<T>(), &state}));
    }
    std::string operator()(const ik::State& state) const {
        std::string text =
            "    {\n        tendril::ik::State solved(" + std::to_string(state.bones()) + ");\n";
        const auto say = [&](const std::string& what, const std::string& value) {
            text += "        solved." + what + " = " + value + ";\n";
        };
        say("rotations", list_code(state.rotations, [](const glm::quat& q) {
                return "glm::quat(" + literal_code(glm::dquat(q)) + ')';
            }));
        for (const std::string& each : ik_memory_texts("solved", state)) text += "        " + each + '\n';
        if (state.pole.valid)
            say("pole.joints",
                list_code(state.pole.joints, [](const glm::vec3& p) { return "glm::vec3" + braced(p); }));
        return text + "        " + place + ".held = solved;\n    }\n";
    }

  private:
    template <class T>
    static std::string type() {
        if constexpr (std::is_same_v<T, double>) return "double";
        if constexpr (std::is_same_v<T, glm::dvec3>) return "glm::dvec3";
        if constexpr (std::is_same_v<T, glm::dquat>) return "glm::dquat";
    }
    std::string held(const std::string& value) const { return "    " + place + ".held = " + value + ";\n"; }
};

}  // namespace

std::string memory_code(const std::string& place, const rig::UnitMemory& memory) {
    return std::visit(MemoryCode{place}, memory.held);
}

}  // namespace tendril::app
