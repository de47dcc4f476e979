#include "app/labs/rig/value_text.hpp"

#include <glm/trigonometric.hpp>
#include <tendril/rig/euler.hpp>

#include "app/document/units.hpp"

namespace tendril::app {

std::string vector_text(const glm::dvec3& vector, int decimals) {
    return fixed_text(vector.x, decimals) + "  " + fixed_text(vector.y, decimals) + "  " +
           fixed_text(vector.z, decimals);
}

std::string rotation_text(const glm::dquat& rotation) {
    return vector_text(euler_degrees(rotation), 1);
}

std::string value_text(const rig::Value& value) {
    struct ToText {
        std::string operator()(bool on) const { return on ? "on" : "off"; }
        std::string operator()(double number) const { return fixed_text(number, 3); }
        std::string operator()(const glm::dvec3& vector) const { return vector_text(vector); }
        std::string operator()(const glm::dquat& rotation) const {
            return rotation_text(rotation) + "\xC2\xB0";
        }
        std::string operator()(const rig::Transform& pose) const {
            const bool turned = pose.rotation != rig::Transform().rotation;
            return vector_text(pose.translation) +
                   (turned ? ", " + rotation_text(pose.rotation) + "\xC2\xB0" : "");
        }
    };
    return std::visit(ToText(), value);
}

std::string output_text(const rig::Operation& operation, const rig::Value& value) {
    const auto* count = std::get_if<double>(&value);
    return count && std::holds_alternative<rig::ForEach>(operation) ? fixed_text(*count, 0)
                                                                    : value_text(value);
}

const char* control_title(rig::ControlKind kind) {
    switch (kind) {
        case rig::ControlKind::Transform:
            return "transform control";
        case rig::ControlKind::Position:
            return "position control";
        case rig::ControlKind::Rotation:
            return "rotation control";
        case rig::ControlKind::Float:
            return "float control";
        case rig::ControlKind::Bool:
            return "bool control";
        case rig::ControlKind::Vector2d:
            break;
    }
    return "2D control";
}

glm::dvec3 euler_degrees(const glm::dquat& rotation) {
    return glm::degrees(rig::to_euler(rotation)) + 0.0;
}

glm::dquat from_euler_degrees(const glm::dvec3& degrees) {
    return rig::from_euler(glm::radians(degrees));
}

}  // namespace tendril::app
