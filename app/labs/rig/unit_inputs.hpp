// The inputs and outputs of a unit, one after the other, as a panel shows them: where each comes from and
// what it is now. From rig::fields(), so that no operation is forgotten.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <tendril/rig/unit.hpp>
#include <variant>
#include <vector>

#include "app/document/json.hpp"
#include "app/labs/rig/rig_part.hpp"

namespace tendril::app {

/// One of several names: "location" or "direction".
struct InputChoice {
    std::size_t chosen = 0;
    std::vector<const char*> names;
};
/// Which axes of translation, rotation and scale pass.
struct InputFilter {
    rig::TransformFilter passes;
};
/// Low and high end.
struct InputRange {
    double low = 0.0, high = 1.0;
};
/// Elements or a curve, by name.
struct InputNames {
    std::vector<std::string> names;
    bool elements = true;
};
struct InputCurve {
    signal::Curve curve;
};

struct UnitInput {
    std::string path;   ///< of its value in unit_json(): "/primary/target"
    std::string title;  ///< "primary target"
    const char* unit = "";
    /// Where it comes from: "head, translation", "unit curve"; empty where it stands here, as a literal.
    std::string from;
    /// The literal, or what it is now; monostate where that differs from round to round of a for-each.
    std::variant<std::monostate, rig::Value, InputChoice, InputFilter, InputRange, InputNames, InputCurve>
        value;
    bool count = false;  ///< a number of elements, or of anything else that is whole

    /// What it can be chosen from (input_offers.hpp). Values: of `type`, or of any where that is empty.
    enum class Takes : std::uint8_t { Nothing, Value, Element, Bone, Roots, Curve } takes = Takes::Nothing;
    std::optional<rig::Type> type{};

    bool literal() const { return from.empty(); }
};

/// A limit to how fast an aim turns, of which 0 means that there is none.
bool is_speed_limit(const UnitInput& input);
/// A value of it, on one line: a count without decimals, "no limit".
std::string input_text(const UnitInput& input, const rig::Value& value);

/// Weight and switch first. `now`: all poses worked out, as they are after the last unit.
std::vector<UnitInput> unit_inputs(const RigPart& part, const rig::Hierarchy& now, const rig::Unit& unit);

/// The arguments of rig.unit.set that make the literal of that path another: {"name", "primary": {...}}.
Json with_input(const rig::Unit& unit, const std::string& path, Json value);

/// A unit among all of the rig.
struct UnitRow {
    const rig::Unit* unit = nullptr;
    std::size_t at = 0;   ///< in State::units
    std::size_t top = 0;  ///< in Definition::units: of the for-each, where it is in a body
    bool inner = false;   ///< in a body
};
/// In the order in which they run; bodies after their for-each.
std::vector<UnitRow> unit_rows(const RigPart& part);
/// Of that name; none where there is no such unit.
std::optional<UnitRow> unit_row(const RigPart& part, std::string_view name);

// What an input of a unit may be instead of what it is: elements, outputs of units before it, what a for-each
// says. For the inspector, which lists them; each is one that rig.unit.set takes.

struct InputOffer {
    std::string title;  ///< "dial, value", "unit late", "each ratio, 0 to 1"
    SharedJson value;   ///< for with_input()
    bool now = false;   ///< what the input is
};
/// Of one whose UnitInput::takes is not Nothing. An input of values can be a number of its own again, too.
/// Of roots, what the one at `index` may be; another where `index` is their number.
/// Cost: O(elements + units).
std::vector<InputOffer> input_offers(const RigPart& part, const UnitRow& row, const UnitInput& input,
                                     std::size_t index = 0);

// What the inputs of units do, for tooltips.

/// Of an operation, as scene files name it, and the path of an input (unit_inputs.hpp).
const char* input_help(std::string_view operation, std::string_view path);
/// What an operation does, in a sentence.
const char* operation_help(std::string_view operation);

}  // namespace tendril::app
