// A rig's definition as JSON, in the words of the commands that build one:
//
//     {"elements": [{"name", "kind", "parent", "local"}, {..., "control", "axes", "minimum", "maximum"}],
//      "curves": [{"name", "value"}],
//      "units": [{"unit", "name", ...}]}
#pragma once

#include <set>
#include <string>
#include <tendril/rig/definition.hpp>
#include <tendril/rig/input.hpp>
#include <tendril/rig/unit.hpp>
#include <vector>

#include "app/document/json.hpp"
#include "app/document/json_place.hpp"

namespace tendril::app {

inline constexpr std::size_t max_lab_elements = 5'000;
inline constexpr std::size_t max_lab_curves = 1'000;

Json element_json(const rig::Element& element);
/// "space" of a control is its parent by another name. Throws std::runtime_error that begins with the place.
rig::Element read_element(const JsonPlace& place);
/// What read_element knows.
std::vector<std::string> element_members();

Json definition_json(const rig::Definition& definition);
/// Units without a name get one. Throws std::runtime_error that begins with the place; what only shows when
/// all is put together, Rig::make refuses.
rig::Definition read_definition(const JsonPlace& place);

// Units of a rig as JSON. Reader and writer both go through rig::fields(), so that an operation of the
// library has its form in files, commands and --state as soon as it is listed there.

inline constexpr std::size_t max_lab_units = 2'000;  ///< bodies included

/// With every input, and its name.
Json unit_json(const rig::Unit& unit);
Json units_json(const std::vector<rig::Unit>& units);

/// What is left out is as the operation has it; a name that is left out stays empty. Throws
/// std::runtime_error that begins with the place of what is wrong: an operation or a member that is not
/// known, a form that the input does not take. Whether names are of anything the library checks: Rig::make.
rig::Unit read_unit(const JsonPlace& place);
std::vector<rig::Unit> read_units(const JsonPlace& place);

/// Gives every unit without a name one that is not in `taken`, after its operation: "aim", "aim 2".
void name_units(std::vector<rig::Unit>& units, std::set<std::string>& taken);
/// Adds the names of units, bodies included, but for empty ones.
void collect_names(const std::vector<rig::Unit>& units, std::set<std::string>& names);

/// What units can be called for in a command: "aim", ..., in the order of rig::Operation.
std::vector<std::string> operation_names();
/// Every member that a unit of any operation can have, once each, but for unit and name.
std::vector<std::string> unit_members();

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

Json item_json(const rig::Item& item);
rig::Item read_item(const JsonPlace& place);

/// T is one of bool, double, glm::dvec3, glm::dquat, rig::Transform and rig::Value.
template <class T>
Json input_json(const rig::Input<T>& input);
template <class T>
rig::Input<T> read_input(const JsonPlace& place);

}  // namespace tendril::app
