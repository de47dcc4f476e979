// Inputs, items and values of rigs as JSON, in commands, scene files and --state. A value is a bool, a
// number, [x, y, z], [x, y, z, w] or {"translation", "rotation", "scale"}. Doubles round trip bit for bit.
#pragma once

#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <tendril/rig/input.hpp>
#include <vector>

#include "app/io/json.hpp"
#include "app/io/json_place.hpp"

namespace tendril::app {

/// Refuses any member that is not `known`: "units.2: unknown member "taget"; it takes: item, primary".
void check_members(const JsonPlace& place, const std::vector<std::string>& known);
/// The index in `names` of the text at `place`. Refuses other texts, and lists the valid ones.
std::size_t read_name(const JsonPlace& place, std::span<const std::string_view> names);
inline std::size_t read_name(const JsonPlace& place, std::initializer_list<std::string_view> names) {
    return read_name(place, std::span(names.begin(), names.size()));
}

/// Limits for given values, and for values that a rig may reach on its own.
inline constexpr double most_given = 1e9, max_reached = 1e100;

// The readers below refuse numbers larger than `most` in magnitude.

Json transform_json(const rig::Transform& transform);
/// Omitted members are taken from `otherwise`.
rig::Transform read_transform(const JsonPlace& place, const rig::Transform& otherwise = {},
                              double most = most_given);

Json value_json(const rig::Value& value);
/// Reads a value of that type.
rig::Value read_value(const JsonPlace& place, rig::Type type, double most = most_given);
/// Infers the type from the JSON form.
rig::Value read_any_value(const JsonPlace& place, double most = most_given);

// Inputs as JSON:
//
//     [0, 1, 2]                                                          a literal
//     "head"                                                             an element: the input takes its part
//     {"element": "head", "of": "translation", "space": "global"}        part of an element's pose
//     {"element": "dial", "of": "value"}                                 the value of a control
//     {"unit": "curve", "output": "result"}                              an output of another unit
//     {"item": "each"}, {"each": "ratio"}                                inside a for-each
//
// Without "of" the input takes the part that fits its type: the transform, the translation, the rotation, or,
// for numbers and bools, the value of a control. {"item": "each"} may have "of" and "space" too.

/// `at`: the input, the item or the transform.
Json input_json(const rig::InputAccess& access, const void* at);
void read_input(const JsonPlace& place, const rig::InputAccess& access, void* at);

}  // namespace tendril::app
