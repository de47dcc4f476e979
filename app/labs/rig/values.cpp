#include "app/labs/rig/values.hpp"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <tendril/rig/euler.hpp>

#include "app/document/json_complete.hpp"
#include "app/document/units.hpp"

namespace tendril::app {
namespace {

std::string joined(const auto& words) {
    std::string text;
    for (const auto& word : words) text += (text.empty() ? "" : ", ") + std::string(word);
    return text;
}

double read_real(const JsonPlace& place, double most) {
    if (most == most_given) return place.real();
    const double value = place.json().is_number() ? place.json().get<double>() : std::nan("");
    if (!(std::abs(value) <= most)) place.fail("expected a number, found " + json_summary(place.json()));
    return value;
}

double real_at(const JsonPlace& place, std::size_t index, double most) {
    return read_real(place.element(index), most);
}

glm::dvec3 read_vector(const JsonPlace& place, double most) {
    if (!place.json().is_array() || place.json().size() != 3)
        place.fail("expected a point [x, y, z], found " + json_summary(place.json()));
    return {real_at(place, 0, most), real_at(place, 1, most), real_at(place, 2, most)};
}

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

void check_members(const JsonPlace& place, const std::vector<std::string>& known) {
    if (!place.json().is_object()) place.fail("expected an object, found " + json_summary(place.json()));
    for (const auto& [key, value] : place.json().items())
        if (std::find(known.begin(), known.end(), key) == known.end())
            place.fail("unknown member " + json_summary(Json(key)) + "; it takes: " + joined(known));
}

std::size_t read_name(const JsonPlace& place, std::span<const std::string_view> names) {
    const std::string text = place.text();
    const auto found = std::find(names.begin(), names.end(), text);
    if (found == names.end())
        place.fail("expected one of " + joined(names) + ", found " + json_summary(place.json()));
    return static_cast<std::size_t>(found - names.begin());
}

glm::dquat read_rotation(const JsonPlace& place, double most) {
    if (!place.json().is_array() || place.json().size() != 4)
        place.fail("expected a rotation [x, y, z, w], found " + json_summary(place.json()));
    return {real_at(place, 3, most), real_at(place, 0, most), real_at(place, 1, most),
            real_at(place, 2, most)};
}

Json transform_json(const rig::Transform& transform) {
    return Json{{"translation", dpoint(transform.translation)},
                {"rotation", dquaternion(transform.rotation)},
                {"scale", dpoint(transform.scale)}};
}

rig::Transform read_transform(const JsonPlace& place, const rig::Transform& otherwise, double most) {
    check_members(place, {"translation", "rotation", "scale"});
    rig::Transform transform = otherwise;
    if (place.has("translation")) transform.translation = read_vector(place["translation"], most);
    if (place.has("rotation")) transform.rotation = read_rotation(place["rotation"], most);
    if (place.has("scale")) transform.scale = read_vector(place["scale"], most);
    return transform;
}

Json value_json(const rig::Value& value) {
    struct ToJson {
        Json operator()(bool flag) const { return flag; }
        Json operator()(double number) const { return number; }
        Json operator()(const glm::dvec3& vector) const { return dpoint(vector); }
        Json operator()(const glm::dquat& rotation) const { return dquaternion(rotation); }
        Json operator()(const rig::Transform& transform) const { return transform_json(transform); }
    };
    return std::visit(ToJson(), value);
}

rig::Value read_value(const JsonPlace& place, rig::Type type, double most) {
    switch (type) {
        case rig::Type::Bool:
            return place.flag();
        case rig::Type::Number:
            return read_real(place, most);
        case rig::Type::Vector:
            return read_vector(place, most);
        case rig::Type::Rotation:
            return read_rotation(place, most);
        case rig::Type::Transform:
            break;
    }
    return read_transform(place, {}, most);
}

rig::Value read_any_value(const JsonPlace& place, double most) {
    const Json& json = place.json();
    if (json.is_boolean()) return place.flag();
    if (json.is_number()) return read_real(place, most);
    if (json.is_array() && json.size() == 3) return read_vector(place, most);
    if (json.is_array() && json.size() == 4) return read_rotation(place, most);
    if (json.is_object()) return read_transform(place, {}, most);
    place.fail("expected a bool, a number, [x, y, z], [x, y, z, w] or a transform, found " +
               json_summary(json));
}

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
    return glm::dvec3(real_at(place, 0, most), real_at(place, 1, most), 0.0);
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
