// What commands do to the lab's part. A definition is changed as a whole: made anew, and what of the state is
// still of something taken over; refused as a whole too, by std::invalid_argument.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <tendril/rig/rig.hpp>
#include <tendril/rig/unit.hpp>
#include <vector>

#include "app/document/json.hpp"
#include "app/labs/rig/rig_part.hpp"

namespace tendril::app {

/// Throws std::invalid_argument where the library refuses it, or where it has more of something than the
/// lab's limits let it.
rig::Rig make_rig(rig::Definition definition);
void redefine(RigPart& part, rig::Definition definition);

/// Refused: one that is a parent of what stays, or that a unit names; the message says which.
void remove_elements(RigPart& part, const std::vector<std::size_t>& elements);
/// In bodies too. Refused: one whose output another unit takes.
void remove_unit(RigPart& part, const std::string& name);
void enable_unit(RigPart& part, const std::string& name, bool on);
/// Among the units of the rig, or those of the body that it is in. Refused: a place before a unit whose
/// output it takes, or after one that takes its own.
void move_unit(RigPart& part, const std::string& name, int at);
/// `at`: its place among the units of the rig; -1 for the end. Without a name it is given one.
void add_unit(RigPart& part, rig::Unit unit, int at);

/// Makes a unit, in a body too, as `unit` has it.
void set_unit(RigPart& part, const std::string& name, rig::Unit unit);
/// Selects what is selected in another rig, by name, of what this one has.
void select_as_in(RigPart& part, RigSelection selected, const rig::Rig& other);
/// A unit that the rig does not have is selected no more.
void forget_missing_unit(RigPart& part);
/// Throws std::invalid_argument: there is no unit "arm".
const rig::Unit& unit_named(const RigPart& part, const std::string& name);

/// The places in the definition of all elements, parents before their children.
std::vector<std::size_t> from_the_roots(const rig::Rig& rig, const rig::Hierarchy& tree);
/// The place in the definition. Throws std::invalid_argument: there is no element "arm".
std::size_t element_named(const RigPart& part, const std::string& name);
/// What they are called.
std::vector<std::string> names_of(const RigPart& part, const std::vector<std::size_t>& elements);
std::size_t curve_named(const RigPart& part, const std::string& name);

/// Something that a solve begins with was changed: a new take begins.
void changed(RigPart& part);

// Which units name something: an element, another unit, a curve. Nothing that is named can be removed.

enum class Named { Element, Unit, Curve };

struct Use {
    std::string unit;    ///< that names one of them
    std::string member;  ///< in which: "primary.target"
    std::string name;    ///< of what it names
};

/// The first, in order, bodies included; none where nothing names any of them.
std::optional<Use> first_use(const std::vector<rig::Unit>& units, Named kind,
                             const std::set<std::string>& names);

// What a menu adds: elements and units with no more than they need, taken from what is selected.

/// "bone 3": the first of these that no element has.
std::string free_element_name(const RigPart& part, const std::string& base);

/// A unit as rig.unit.add takes it, and why there is none.
struct UnitOffer {
    std::optional<SharedJson> unit;
    const char* needs = "";  ///< "two bones or more": where there is no unit
};
/// `operation` is the index in rig::Operation. Works on the active element, where it is one that works: the
/// others that are selected it follows. A for-each goes over all that are selected.
UnitOffer offered_unit(const RigPart& part, std::size_t operation);

}  // namespace tendril::app
