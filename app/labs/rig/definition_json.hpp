// A rig's definition as JSON, with the same names as the commands that build one:
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
/// A control may call its parent "space". Throws std::runtime_error that begins with the JSON path.
rig::Element read_element(const JsonPlace& place);
/// The members that read_element accepts.
std::vector<std::string> element_members();

Json definition_json(const rig::Definition& definition);
/// Names the units that have no name. Throws std::runtime_error that begins with the JSON path. Rig::make
/// later reports the errors that involve several parts of the definition.
rig::Definition read_definition(const JsonPlace& place);

// Units as JSON, by their table of fields.

inline constexpr std::size_t max_lab_units = 2'000;  ///< including those in bodies

/// Contains every input, and the name.
Json unit_json(const rig::Unit& unit);
Json units_json(const std::vector<rig::Unit>& units);

/// Omitted inputs keep the operation's default; an omitted name stays empty. Throws std::runtime_error that
/// begins with the JSON path for an unknown operation or member, or a form that the input does not accept.
/// Rig::make checks whether names refer to anything.
rig::Unit read_unit(const JsonPlace& place);
/// Omitted members keep their value, also inside "primary", "secondary" and "filter".
void edit_unit(const JsonPlace& place, rig::Unit& unit, bool edit = true);
std::vector<rig::Unit> read_units(const JsonPlace& place);

/// Names each unit without a name after its operation, avoiding those in `taken`: "aim", "aim 2".
void name_units(std::vector<rig::Unit>& units, std::set<std::string>& taken);
/// Adds the non-empty names of the units, including those in bodies.
void collect_names(const std::vector<rig::Unit>& units, std::set<std::string>& names);

/// The unit types that commands accept: "aim", ..., in the order of rig::Operation.
std::vector<std::string> operation_names();
/// Every member that any operation has, without duplicates; excludes "unit" and "name".
std::vector<std::string> unit_members();

}  // namespace tendril::app
