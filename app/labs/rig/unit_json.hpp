// Units of a rig as JSON. Reader and writer both go through rig::fields(), so that an operation of the
// library has its form in files, commands and --state as soon as it is listed there.
#pragma once

#include <set>
#include <string>
#include <tendril/rig/unit.hpp>
#include <vector>

#include "app/document/json.hpp"
#include "app/document/json_place.hpp"

namespace tendril::app {

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

}  // namespace tendril::app
