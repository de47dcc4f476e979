// A rig's definition as JSON, by the library's tables of fields, with the same names as the commands that
// build one:
//
//     {"elements": [{"name", "kind", "parent", "local"}, {..., "control", "axes", "minimum", "maximum"}],
//      "curves": [{"name", "value"}],
//      "units": [{"unit", "name", ...}]}
//
// Readers throw std::runtime_error that begins with the JSON path. Rig::make later reports errors that
// involve several parts of the definition.
#pragma once

#include <set>
#include <string>
#include <tendril/rig/definition.hpp>
#include <vector>

#include "app/io/json_place.hpp"

namespace tendril::app {

inline constexpr std::size_t max_lab_elements = 5'000;
inline constexpr std::size_t max_lab_curves = 1'000;
inline constexpr std::size_t max_lab_units = 2'000;  ///< including those in bodies

/// A control may call its parent "space".
rig::Element read_element(const JsonPlace& place);

/// Names the units that have no name. Ignores other members.
rig::Definition read_definition(const JsonPlace& place);

/// Omitted inputs keep the operation's default; an omitted name stays empty.
rig::Unit read_unit(const JsonPlace& place);
/// Omitted members keep their value, also within "primary", "secondary" and "filter".
void edit_unit(const JsonPlace& place, rig::Unit& unit, bool edit = true);

/// Names each unit without a name after its operation, avoiding those in `taken`: "aim", "aim 2".
void name_units(rig::Units& units, std::set<std::string>& taken);
/// Adds the non-empty names of the units, including those in bodies.
void collect_names(const rig::Units& units, std::set<std::string>& names);

/// The unit types that commands accept: "aim", ..., in the order of rig::Operation.
std::vector<std::string> operation_names();
/// Each member that any operation has, once; excludes "unit" and "name".
std::vector<std::string> unit_members();

}  // namespace tendril::app
