// The inputs and outputs of a unit as a panel lists them: sources, current values, possible replacements and
// help texts. Based on the table of units, so no operation is forgotten.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <tendril/rig/unit.hpp>
#include <vector>

#include "app/io/json.hpp"
#include "app/labs/rig/rig_part.hpp"

namespace tendril::app {

struct UnitInput {
    std::string path;   ///< the path of its value in a scene file: "/primary/target"
    std::string title;  ///< "primary target"
    const char* unit = "";
    /// The source: "head, translation", "unit curve"; empty for a literal.
    std::string from;
    const Field* field = nullptr;
    const void* at = nullptr;  ///< the argument of the field's accessors; null while it is empty
    /// For inputs and flags: the literal or the current value; none if that varies between iterations of a
    /// for-each.
    std::optional<rig::Value> value{};
    bool count = false;  ///< a whole number, such as a number of elements

    /// For an input: the type of a literal; none: any type.
    std::optional<rig::Type> type() const { return rig::access_of(*field).type; }
    bool is(FieldType type) const { return field->type == type; }
    /// True if it takes an input. A field of type Other that does not, holds an item.
    bool takes_input() const {
        return is(FieldType::Other) && rig::access_of(*field).takes == rig::InputAccess::Takes::Any;
    }
    /// Elements or a curve, by name; empty for other fields.
    std::vector<std::string> names() const;
    bool literal() const { return from.empty(); }
};

/// An aim's speed limit, where 0 means no limit.
bool is_speed_limit(const UnitInput& input);
/// "roots" becomes "root".
std::string one_of(std::string title);
/// `value` on one line; counts have no decimals, a missing limit reads "no limit".
std::string input_text(const UnitInput& input, const rig::Value& value);

/// Weight and switch first. `now` is the hierarchy after the last unit, with nothing pending.
std::vector<UnitInput> unit_inputs(const RigPart& part, const rig::Hierarchy& now, const rig::Unit& unit);

/// The arguments of rig.unit.set that replace the value at `path`: {"name", "primary": {...}}.
Json with_input(const rig::Unit& unit, const std::string& path, Json value);

/// A unit in the list of all units of the rig.
struct UnitRow {
    const rig::Unit* unit = nullptr;
    std::size_t at = 0;   ///< index in State::units
    std::size_t top = 0;  ///< index in Definition::units; in a body, its for-each's
    bool inner = false;   ///< in a body
};
/// In execution order; a body follows its for-each.
std::vector<UnitRow> unit_rows(const RigPart& part);
/// The unit of that name; empty if it does not exist.
std::optional<UnitRow> unit_row(const RigPart& part, std::string_view name);

// Replacements for an input: elements, outputs of earlier units, the variables of a for-each. The inspector
// lists them; rig.unit.set accepts each.

struct InputOffer {
    std::string title;  ///< "dial, value", "unit late", "each ratio, 0 to 1"
    SharedJson value;   ///< for with_input()
    bool now = false;   ///< the input has this value now
};
/// For inputs, items and names; empty for other fields. An input of a value also offers a literal. For names,
/// `index` is the one to replace; an index equal to their number appends one. Cost: O(elements + units).
std::vector<InputOffer> input_offers(const RigPart& part, const UnitRow& row, const UnitInput& input,
                                     std::size_t index = 0);

// Help texts for tooltips.

/// `operation` is named as in scene files; `path` is UnitInput::path.
const char* input_help(std::string_view operation, std::string_view path);
/// The effect of an operation, in one sentence.
const char* operation_help(std::string_view operation);

}  // namespace tendril::app
