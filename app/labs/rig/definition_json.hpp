// A rig's definition as JSON, in the words of the commands that build one:
//
//     {"elements": [{"name", "kind", "parent", "local"}, {..., "control", "axes", "minimum", "maximum"}],
//      "curves": [{"name", "value"}],
//      "units": [{"unit", "name", ...}]}
#pragma once

#include <string>
#include <tendril/rig/definition.hpp>
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

}  // namespace tendril::app
