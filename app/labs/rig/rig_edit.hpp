// Edits of the lab's part. A new definition replaces the whole old one; state that still applies is kept.
// Errors are std::invalid_argument and leave the part unchanged.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <tendril/rig/rig.hpp>
#include <tendril/rig/unit.hpp>
#include <vector>

#include "app/io/json.hpp"
#include "app/labs/rig/rig_part.hpp"

namespace tendril::app {

/// Throws std::invalid_argument if the library refuses the definition, or if it exceeds the lab's limits.
rig::Rig make_rig(rig::Definition definition);
void redefine(RigPart& part, rig::Definition definition);

/// Refuses to remove the parent of a remaining element, or an element that a unit uses; the message names it.
void remove_elements(RigPart& part, const std::vector<std::size_t>& elements);
/// Copies an element and all below it to the other side of its parent, mirrored in the parent's x, and
/// selects the copy. The units that set them are mirrored too. Left becomes right in names.
void mirror_branch(RigPart& part, const std::string& top);
/// Searches bodies too. Refuses to remove a unit whose output another unit uses.
void remove_unit(RigPart& part, const std::string& name);
void enable_unit(RigPart& part, const std::string& name, bool on);
/// `at` is the index among the units of the rig, or of the body that contains it. Refuses to move a unit
/// before one whose output it uses, or after one that uses its output.
void move_unit(RigPart& part, const std::string& name, int at);
/// `at` is the index among the units of the rig, or of for-each `into`; -1 appends. Names the unit if it has
/// no name.
void add_unit(RigPart& part, rig::Unit unit, int at, const std::string& into = "");

/// Replaces a unit, which may be in a body.
void set_unit(RigPart& part, const std::string& name, rig::Unit unit);
/// Selects the elements and unit of the same names as those selected in another rig.
void select_as_in(RigPart& part, RigSelection selected, const rig::Rig& other);
/// Deselects the unit if the rig does not have it.
void forget_missing_unit(RigPart& part);
/// Throws std::invalid_argument if it does not exist: there is no unit "arm".
const rig::Unit& unit_named(const RigPart& part, std::string_view name);

/// Indices of all elements in the definition, parents before their children.
std::vector<std::size_t> from_the_roots(const rig::Rig& rig, const rig::Hierarchy& tree);
/// The index in the definition. Throws std::invalid_argument if it does not exist: there is no element "arm".
std::size_t element_named(const RigPart& part, const std::string& name);
std::vector<std::string> names_of(const RigPart& part, const std::vector<std::size_t>& elements);
std::size_t curve_named(const RigPart& part, const std::string& name);

/// Call after any change except to a control's value: starts a new take.
void changed(RigPart& part);

// Finds units that use a given element, unit or curve, which then cannot be removed.

enum class Named { Element, Unit, Curve };

struct Use {
    std::string unit;    ///< the unit that uses it
    std::string member;  ///< the input that uses it: "primary.target"
    std::string name;    ///< the used name
};

/// The first use, in order, including bodies; none if no unit uses any of the names.
std::optional<Use> first_use(rig::Units units, Named kind, const std::set<std::string>& names);

/// Renames an element, a unit or a curve, with all references: units, paths, the clip, the selection. State
/// and take do not change, so the rig computes the same bits. Refuses an empty name, and one in use.
void rename(RigPart& part, Named kind, const std::string& from, const std::string& to);

// Defaults for the Add menu: elements and units with only the required inputs, set from the selection.

/// "bone 3": the first such name that no element has.
std::string free_element_name(const RigPart& part, const std::string& base);

/// A unit in the form of rig.unit.add, or the reason why there is none.
struct UnitOffer {
    std::optional<SharedJson> unit;
    const char* needs = "";  ///< "add an element first", if there is no unit
};
/// `operation` is the index in rig::Operation. The active element becomes the item, and follows the other
/// selected elements. A for-each loops over all selected elements; while it or a unit in it is selected, the
/// new unit goes into it, for each element.
UnitOffer offered_unit(const RigPart& part, std::size_t operation);
/// The for-each that is selected, or contains the selected unit; empty if there is none.
std::string selected_loop(const RigPart& part);

}  // namespace tendril::app
