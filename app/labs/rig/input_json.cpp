#include "app/labs/rig/input_json.hpp"

#include <iterator>
#include <string_view>

#include "app/document/json_complete.hpp"
#include "app/labs/rig/value_json.hpp"

namespace tendril::app {
namespace {

constexpr std::string_view of_names[] = {"transform", "translation", "rotation", "scale",
                                         "x",         "y",           "z",        "value"};
constexpr std::string_view each_names[] = {"ratio", "index", "count"};

/// What of an element an input of T takes where nothing is said.
template <class T>
constexpr rig::Of taken = rig::Of::Translation;
template <>
constexpr rig::Of taken<bool> = rig::Of::ControlValue;
template <>
constexpr rig::Of taken<double> = rig::Of::ControlValue;
template <>
constexpr rig::Of taken<glm::dquat> = rig::Of::Rotation;
template <>
constexpr rig::Of taken<rig::Transform> = rig::Of::Transform;

template <class T>
T read_literal(const JsonPlace& place) {
    if constexpr (std::is_same_v<T, rig::Value>) return read_any_value(place);
    if constexpr (std::is_same_v<T, bool>) return place.flag();
    if constexpr (std::is_same_v<T, double>) return place.real();
    if constexpr (std::is_same_v<T, glm::dvec3>) return place.dpoint();
    if constexpr (std::is_same_v<T, glm::dquat>) return read_rotation(place);
    if constexpr (std::is_same_v<T, rig::Transform>) return read_transform(place);
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

}  // namespace

Json item_json(const rig::Item& item) {
    if (const auto* name = std::get_if<std::string>(&item.which)) return *name;
    return Json{{"item", "each"}};
}

rig::Item read_item(const JsonPlace& place) {
    if (place.json().is_string()) return place.text();
    if (!place.has("item"))
        place.fail("expected the name of an element or {\"item\": \"each\"}, found " +
                   json_summary(place.json()));
    check_members(place, {"item"});
    read_name(place["item"], {"each"});
    return rig::ThisElement();
}

template <class T>
Json input_json(const rig::Input<T>& input) {
    if (const T* literal = input.literal()) return value_json(*literal);
    if (const auto* from = std::get_if<rig::FromElement>(&input.source)) {
        Json json = Json::object();
        if (const auto* name = std::get_if<std::string>(&from->element.which))
            json["element"] = *name;
        else
            json["item"] = "each";
        json["of"] = of_names[static_cast<std::size_t>(from->of)];
        json["space"] = space_name(from->space, from->pose);
        return json;
    }
    if (const auto* from = std::get_if<rig::FromUnit>(&input.source))
        return Json{{"unit", from->unit}, {"output", from->output}};
    const auto each = static_cast<std::size_t>(std::get<rig::Each>(input.source));
    return Json{{"each", each_names[each]}};
}

template <class T>
rig::Input<T> read_input(const JsonPlace& place) {
    const Json& json = place.json();
    if (json.is_string()) return rig::FromElement{.element = place.text(), .of = taken<T>};
    if (place.has("element")) return read_from_element(place, "element", taken<T>);
    if (place.has("item")) return read_from_element(place, "item", taken<T>);
    if (place.has("unit")) return read_from_unit(place);
    if (!place.has("each")) return read_literal<T>(place);
    check_members(place, {"each"});
    return static_cast<rig::Each>(read_name(place["each"], each_names));
}

template Json input_json(const rig::Input<bool>&);
template Json input_json(const rig::Input<double>&);
template Json input_json(const rig::Input<glm::dvec3>&);
template Json input_json(const rig::Input<glm::dquat>&);
template Json input_json(const rig::Input<rig::Transform>&);
template Json input_json(const rig::Input<rig::Value>&);
template rig::Input<bool> read_input(const JsonPlace&);
template rig::Input<double> read_input(const JsonPlace&);
template rig::Input<glm::dvec3> read_input(const JsonPlace&);
template rig::Input<glm::dquat> read_input(const JsonPlace&);
template rig::Input<rig::Transform> read_input(const JsonPlace&);
template rig::Input<rig::Value> read_input(const JsonPlace&);

}  // namespace tendril::app
