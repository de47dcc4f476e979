// Inputs, items and values of rigs as JSON.
#include "app/fields/input_json.hpp"
#include "app/io/text.hpp"

#include <algorithm>
#include <cmath>

#include "app/io/json_complete.hpp"

namespace tendril::app {
namespace {

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

constexpr std::string_view of_names[] = {"transform", "translation", "rotation", "scale",
                                         "x",         "y",           "z",        "value"};
constexpr std::string_view each_names[] = {"ratio", "index", "count"};

/// The part of an element that an input of this type uses by default.
rig::Of part_taken(const std::optional<rig::Type>& type) {
    using enum rig::Type;
    if (type == Bool || type == Number) return rig::Of::ControlValue;
    if (type == Rotation) return rig::Of::Rotation;
    return type == Transform ? rig::Of::Transform : rig::Of::Translation;
}

const char* space_name(rig::Space space, rig::Pose pose) {
    if (pose == rig::Pose::Current) return space == rig::Space::Global ? "global" : "local";
    return space == rig::Space::Global ? "initial_global" : "initial_local";
}

rig::FromElement read_from_element(const JsonPlace& place, const char* key, rig::Of of) {
    check_members(place, {key, "of", "space"});
    rig::FromElement from;
    const JsonPlace name = place[key];
    if (key == std::string_view("item")) {
        read_name(name, {"each"});
        from.element = rig::ThisElement();
    } else {
        from.element = name.text();
    }
    from.of = of;
    if (place.has("of")) from.of = static_cast<rig::Of>(read_name(place["of"], of_names));
    if (place.has("space")) {
        const std::size_t which =
            read_name(place["space"], {"global", "local", "initial_global", "initial_local"});
        from.space = which % 2 == 0 ? rig::Space::Global : rig::Space::Local;
        from.pose = which < 2 ? rig::Pose::Current : rig::Pose::Initial;
    }
    return from;
}

rig::FromUnit read_from_unit(const JsonPlace& place) {
    check_members(place, {"unit", "output"});
    rig::FromUnit from;
    from.unit = place["unit"].text();
    if (place.has("output")) from.output = place["output"].text();
    return from;
}

/// Accepts any length; the library normalises it.
glm::dquat read_rotation(const JsonPlace& place, double most) {
    if (!place.json().is_array() || place.json().size() != 4)
        place.fail("expected a rotation [x, y, z, w], found " + json_summary(place.json()));
    return {real_at(place, 3, most), real_at(place, 0, most), real_at(place, 1, most),
            real_at(place, 2, most)};
}

}  // namespace

void check_members(const JsonPlace& place, const std::vector<std::string>& known) {
    if (!place.json().is_object()) place.fail("expected an object, found " + json_summary(place.json()));
    for (const auto& [key, value] : place.json().items())
        if (std::find(known.begin(), known.end(), key) == known.end())
            place.fail("unknown member " + json_summary(Json(key)) + "; it takes: " + comma_list(known));
}

std::size_t read_name(const JsonPlace& place, std::span<const std::string_view> names) {
    const std::string text = place.text();
    const auto found = std::find(names.begin(), names.end(), text);
    if (found == names.end())
        place.fail("expected one of " + comma_list(names) + ", found " + json_summary(place.json()));
    return static_cast<std::size_t>(found - names.begin());
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

Json input_json(const rig::InputAccess& access, const void* at) {
    const rig::Input<rig::Value> input = access.get(at);
    if (const rig::Value* literal = input.literal()) return value_json(*literal);
    if (const auto* from = std::get_if<rig::FromElement>(&input.source)) {
        const auto* const name = std::get_if<std::string>(&from->element.which);
        if (name != nullptr && access.takes == rig::InputAccess::Takes::Item) return *name;
        Json json = name != nullptr ? Json{{"element", *name}} : Json{{"item", "each"}};
        if (access.takes == rig::InputAccess::Takes::Item) return json;
        json["of"] = of_names[static_cast<std::size_t>(from->of)];
        json["space"] = space_name(from->space, from->pose);
        return json;
    }
    if (const auto* from = std::get_if<rig::FromUnit>(&input.source))
        return Json{{"unit", from->unit}, {"output", from->output}};
    const auto each = static_cast<std::size_t>(std::get<rig::Each>(input.source));
    return Json{{"each", each_names[each]}};
}

namespace {

rig::Item read_item(const JsonPlace& place) {
    if (place.json().is_string()) return place.text();
    if (!place.has("item"))
        place.fail("expected the name of an element or {\"item\": \"each\"}, found " +
                   json_summary(place.json()));
    check_members(place, {"item"});
    read_name(place["item"], {"each"});
    return rig::ThisElement();
}

rig::Input<rig::Value> read_any(const JsonPlace& place, const rig::InputAccess& access) {
    using enum rig::InputAccess::Takes;
    if (access.takes == Item) return rig::FromElement{.element = read_item(place)};
    if (access.takes == Literal) return read_value(place, *access.type);
    const rig::Of part = part_taken(access.type);
    if (place.json().is_string()) return rig::FromElement{.element = place.text(), .of = part};
    if (place.has("element")) return read_from_element(place, "element", part);
    if (place.has("item")) return read_from_element(place, "item", part);
    if (place.has("unit")) return read_from_unit(place);
    if (!place.has("each")) return access.type ? read_value(place, *access.type) : read_any_value(place);
    check_members(place, {"each"});
    return static_cast<rig::Each>(read_name(place["each"], each_names));
}

}  // namespace

void read_input(const JsonPlace& place, const rig::InputAccess& access, void* at) {
    access.set(at, read_any(place, access));
}

}  // namespace tendril::app
