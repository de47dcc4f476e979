#include "app/labs/rig/values.hpp"

#include <cmath>
#include <glm/trigonometric.hpp>
#include <tendril/rig/euler.hpp>

#include "app/io/text.hpp"

namespace tendril::app {
namespace {

/// Calls `take` with each component of a vector, or of a transform's vectors, and its counterpart in `other`.
void for_each_in_vectors(Json& value, const Json& other, const auto& take) {
    constexpr std::size_t max_vector = 3;
    if (value.is_object() && other.is_object())
        for (auto& [key, member] : value.items())
            if (other.contains(key)) for_each_in_vectors(member, other.at(key), take);
    if (!value.is_array() || !other.is_array() || value.size() != other.size()) return;
    for (std::size_t i = 0; i < value.size() && value.size() <= max_vector; ++i) take(value[i], other[i]);
}

}  // namespace

void check_unit(const JsonPlace& place, const rig::Value& value) {
    glm::dquat q(1.0, 0.0, 0.0, 0.0);
    if (const auto* rotation = std::get_if<glm::dquat>(&value)) q = *rotation;
    if (const auto* transform = std::get_if<rig::Transform>(&value)) q = transform->rotation;
    if (!(std::abs(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w - 1.0) < 1e-6))
        place.fail("expected a rotation of length 1, found " + json_summary(dquaternion(q)));
}

rig::Value read_stored(const JsonPlace& place, rig::Type type) {
    rig::Value value = read_value(place, type, max_reached);
    check_unit(place, value);
    return value;
}

Json control_value_json(rig::ControlKind kind, const rig::Value& value) {
    if (kind != rig::ControlKind::Vector2d) return value_json(value);
    const auto& vector = std::get<glm::dvec3>(value);
    return Json::array({vector.x, vector.y});
}

rig::Value read_control_value(const JsonPlace& place, rig::ControlKind kind, const rig::Value& now,
                              double most) {
    if (kind == rig::ControlKind::Transform)
        return read_transform(place, std::get<rig::Transform>(now), most);
    if (kind != rig::ControlKind::Vector2d) return read_value(place, rig::type_of(kind), most);
    if (!place.json().is_array() || place.json().size() != 2)
        place.fail("expected two numbers [a, b], found " + json_summary(place.json()));
    const auto number = [&](std::size_t i) {
        return std::get<double>(read_value(place.element(i), rig::Type::Number, most));
    };
    return glm::dvec3(number(0), number(1), 0.0);
}

Json controls_json(const rig::Rig& rig, const std::vector<rig::Value>& controls) {
    Json json = Json::object();
    for (std::size_t i = 0; i < controls.size(); ++i)
        if (const rig::Element& element = rig.definition().elements[i]; element.control)
            json[element.name] = control_value_json(element.control->kind, controls[i]);
    return json;
}

void load_controls(const JsonPlace& place, const rig::Rig& rig, std::vector<rig::Value>& controls) {
    std::vector<std::string> names;
    for (const rig::Element& each : rig.definition().elements)
        if (each.control) names.push_back(each.name);
    load_named(place, "control", names, [&](std::size_t i, const JsonPlace& stored) {
        const std::size_t at = *rig.element(names[i]);
        controls[at] = read_reached(stored, *rig.definition().elements[at].control, controls[at]);
    });
}

rig::Value read_reached(const JsonPlace& place, const rig::Control& control, const rig::Value& now) {
    const rig::Value value = read_control_value(place, control.kind, now, max_reached);
    check_unit(place, value);
    return rig::clamped(control, value);
}

Json touched(Json after, const Json& before) {
    for_each_in_vectors(after, before, [](Json& each, const Json& was) {
        if (each == was) each = nullptr;
    });
    return after;
}

Json filled(Json given, const Json& now) {
    for_each_in_vectors(given, now, [](Json& each, const Json& is) {
        if (each.is_null()) each = is;
    });
    return given;
}

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
    constexpr const char* titles[] = {"transform control", "position control", "rotation control",
                                      "float control",     "bool control",     "2D control"};
    return titles[static_cast<std::size_t>(kind)];
}

glm::dvec3 euler_degrees(const glm::dquat& rotation) {
    return glm::degrees(rig::to_euler(rotation)) + 0.0;
}

glm::dquat from_euler_degrees(const glm::dvec3& degrees) {
    return rig::from_euler(glm::radians(degrees));
}

}  // namespace tendril::app
