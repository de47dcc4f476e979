#include "app/labs/rig/code.hpp"

#include <tendril/rig/fields.hpp>
#include <type_traits>

#include "app/document/json_complete.hpp"
#include "app/document/json_place.hpp"
#include "app/labs/kit/code_text.hpp"
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

namespace {

std::string list_code(const auto& list, const auto& text) {
    std::string code = "{";
    for (const auto& each : list) code += (code.size() > 1 ? ", " : "") + text(each);
    return code + '}';
}

/// A literal input, with its C++ type.
std::string literal_code(bool value) {
    return value ? "true" : "false";
}
std::string literal_code(double value) {
    return double_text(value);
}
std::string literal_code(const glm::dvec3& value) {
    return "glm::dvec3" + braced(value);
}
std::string literal_code(const glm::dquat& value) {
    return rotation_code(value);
}
std::string literal_code(const rig::Transform& value) {
    return transform_code(value);
}
std::string literal_code(const rig::Value& value) {
    return value_code(value);
}

std::string code(const rig::Item& item) {
    const auto* name = std::get_if<std::string>(&item.which);
    return name != nullptr ? string_text(*name) : "rig::ThisElement()";
}

std::string code(rig::Of of) {
    constexpr const char* names[] = {"Transform", "Translation", "Rotation", "Scale",
                                     "X",         "Y",           "Z",        "ControlValue"};
    return std::string("rig::Of::") + names[static_cast<std::size_t>(of)];
}
std::string code(rig::Space space) {
    return space == rig::Space::Global ? "rig::Space::Global" : "rig::Space::Local";
}
std::string code(rig::Pose pose) {
    return pose == rig::Pose::Initial ? "rig::Pose::Initial" : "rig::Pose::Current";
}
std::string code(rig::AimTarget kind) {
    return kind == rig::AimTarget::Location ? "rig::AimTarget::Location" : "rig::AimTarget::Direction";
}

std::string code(const rig::FromElement& from) {
    const rig::FromElement usual;
    std::string text = "rig::FromElement{.element = " + code(from.element);
    if (from.of != usual.of) text += ", .of = " + code(from.of);
    if (from.space != usual.space) text += ", .space = " + code(from.space);
    if (from.pose != usual.pose) text += ", .pose = " + code(from.pose);
    return text + '}';
}
std::string code(const rig::FromUnit& from) {
    std::string text = "rig::FromUnit{.unit = " + string_text(from.unit);
    if (from.output != rig::FromUnit().output) text += ", .output = " + string_text(from.output);
    return text + '}';
}
std::string code(rig::Each each) {
    constexpr const char* names[] = {"rig::Each::Ratio", "rig::Each::Index", "rig::Each::Count"};
    return names[static_cast<std::size_t>(each)];
}

template <class T>
std::string code(const rig::Input<T>& input) {
    if (const T* literal = input.literal()) return literal_code(*literal);
    return std::visit(
        [](const auto& source) {
            if constexpr (std::is_same_v<std::remove_cvref_t<decltype(source)>, T>)
                return std::string();
            else
                return code(source);
        },
        input.source);
}

/// Lists the fields of an operation, or of a struct with rig::fields(), that differ from their default.
struct FieldsCode {
    std::string margin;

    template <class T>
    std::string all(const T& of) const {
        const T usual{};
        std::vector<const void*> by_default;
        rig::fields(usual, [&](const char*, const auto& field) { by_default.push_back(&field); });
        std::string text;
        std::size_t at = 0;
        rig::fields(of, [&](const char* name, const auto& field) {
            using Field = std::remove_cvref_t<decltype(field)>;
            if (field == *static_cast<const Field*>(by_default[at++])) return;
            text +=
                (text.empty() ? "." : ",\n" + margin + '.') + std::string(name) + " = " + field_code(field);
        });
        return '{' + text + '}';
    }

  private:
    FieldsCode deeper() const { return {margin + "    "}; }

    template <class T>
    static std::string field_code(const rig::Input<T>& input) {
        return code(input);
    }
    static std::string field_code(const rig::Item& item) { return code(item); }
    static std::string field_code(rig::AimTarget kind) { return code(kind); }
    static std::string field_code(rig::Space space) { return code(space); }
    std::string field_code(const rig::AimInputs& inputs) const {
        return "rig::AimInputs" + deeper().all(inputs);
    }
    template <class T>
    std::string field_code(const std::optional<T>& field) const {
        return field ? field_code(*field) : "std::nullopt";
    }
    std::string field_code(const std::vector<rig::ParentInputs>& parents) const {
        return list_code(parents, [&](const auto& each) { return deeper().all(each); });
    }
    static std::string field_code(const rig::TransformFilter& filter) {
        const auto axes = [](const std::array<bool, 3>& passes) {
            return list_code(passes, [](bool each) { return literal_code(each); });
        };
        return "{.translation = " + axes(filter.translation) + ", .rotation = " + axes(filter.rotation) +
               ", .scale = " + axes(filter.scale) + '}';
    }
    static std::string field_code(const std::vector<std::string>& names) {
        return list_code(names, [](const std::string& each) { return string_text(each); });
    }
    std::string field_code(const rig::Body& body) const {
        std::string text;
        for (const rig::Unit& unit : body.units())
            text += (text.empty() ? "\n" : ",\n") + margin + "    " + unit_code(unit, margin + "    ");
        return '{' + text + '}';
    }
    static std::string field_code(bool flag) { return literal_code(flag); }
    static std::string field_code(const std::string& text) { return string_text(text); }
    static std::string field_code(const std::array<double, 2>& range) {
        return list_code(range, double_text);
    }
    std::string field_code(const signal::Curve& curve) const {
        const signal::Curve usual;
        std::string text = ".keys = " + keys_text(curve, margin + "    ");
        const auto end = [&](const char* name, double value, double by_default) {
            if (value != by_default) text += std::string(", .") + name + " = " + double_text(value);
        };
        end("source_min", curve.source_min, usual.source_min);
        end("source_max", curve.source_max, usual.source_max);
        end("target_min", curve.target_min, usual.target_min);
        end("target_max", curve.target_max, usual.target_max);
        return "signal::Curve{" + text + '}';
    }
};

}  // namespace

std::string rotation_code(const glm::dquat& rotation) {
    return "glm::dquat(" + double_text(rotation.w) + ", " + double_text(rotation.x) + ", " +
           double_text(rotation.y) + ", " + double_text(rotation.z) + ')';
}

std::string transform_code(const rig::Transform& transform) {
    const rig::Transform usual;
    std::string text;
    const auto add = [&](const char* name, const std::string& value) {
        text += (text.empty() ? "." : ", .") + std::string(name) + " = " + value;
    };
    if (transform.translation != usual.translation) add("translation", braced(transform.translation));
    if (transform.rotation != usual.rotation) add("rotation", rotation_code(transform.rotation));
    if (transform.scale != usual.scale) add("scale", braced(transform.scale));
    return "rig::Transform{" + text + '}';
}

std::string value_code(const rig::Value& value) {
    return "rig::Value(" + std::visit([](const auto& held) { return literal_code(held); }, value) + ')';
}

std::string unit_code(const rig::Unit& unit, const std::string& margin) {
    const std::string next = ",\n" + margin + "    ";
    std::string text = "rig::Unit{.name = " + string_text(unit.name) + next +
                       ".operation = rig::" + pascal_text(rig::operation_name(unit.operation.index()));
    const FieldsCode inner{margin + "        "};
    text += std::visit([&](const auto& operation) { return inner.all(operation); }, unit.operation);
    const rig::Unit usual;
    if (!(unit.weight == usual.weight)) text += next + ".weight = " + code(unit.weight);
    if (!(unit.when == usual.when)) text += next + ".when = " + code(unit.when);
    if (!unit.enabled) text += next + ".enabled = false";
    return text + '}';
}

namespace {

struct MemoryCode {
    std::string place;

    std::string operator()(std::monostate) const { return {}; }
    std::string operator()(const rig::Turned& turned) const {
        return held("rig::Turned{" + rotation_code(turned.rotation) + '}');
    }
    std::string operator()(const signal::OutputState& state) const {
        return held("signal::OutputState{.value = " + double_text(state.value) +
                    ", .started = " + literal_code(state.started) + '}');
    }
    template <class T>
    std::string operator()(const signal::SpringState<T>& state) const {
        return held("signal::SpringState<" + type<T>() + ">{.value = " + literal_code(state.value) +
                    ", .velocity = " + literal_code(state.velocity) +
                    ", .previous_target = " + literal_code(state.previous_target) +
                    ", .started = " + literal_code(state.started) + '}');
    }
    std::string operator()(const ik::State& state) const {
        std::string text =
            "    {\n        tendril::ik::State solved(" + std::to_string(state.bones()) + ");\n";
        const auto say = [&](const std::string& what, const std::string& value) {
            text += "        solved." + what + " = " + value + ";\n";
        };
        say("rotations", list_code(state.rotations, [](const glm::quat& q) {
                return "glm::quat(" + rotation_code(glm::dquat(q)) + ')';
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
