// Where units take values from, as JSON:
//
//     [0, 1, 2]                                                          a literal
//     "head"                                                             an element: the input takes its part
//     {"element": "head", "of": "translation", "space": "global"}        part of an element's pose
//     {"element": "dial", "of": "value"}                                 what a control is set to
//     {"unit": "curve", "output": "result"}                              what a unit hands out
//     {"item": "each"}, {"each": "ratio"}                                inside a for-each
//
// Where "of" is left out it is what the input takes: the transform, the translation, the rotation, or, for
// numbers and bools, the value of a control. {"item": "each"} may have "of" and "space" too.
#pragma once

#include <tendril/rig/input.hpp>

#include "app/document/json.hpp"
#include "app/document/json_place.hpp"

namespace tendril::app {

Json item_json(const rig::Item& item);
rig::Item read_item(const JsonPlace& place);

/// T is one of bool, double, glm::dvec3, glm::dquat, rig::Transform and rig::Value.
template <class T>
Json input_json(const rig::Input<T>& input);
template <class T>
rig::Input<T> read_input(const JsonPlace& place);

}  // namespace tendril::app
