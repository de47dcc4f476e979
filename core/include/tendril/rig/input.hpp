// The source of a unit's input: a literal, another unit's output, an element of the rig, or the current
// element of a for-each.
//
//     Input<glm::dvec3> target = glm::dvec3(0, 1, 2);                               // a literal
//     Input<glm::dvec3> target = FromElement{"head"};                               // where "head" is
//     Input<double> bend = FromElement{.element = "dial", .of = Of::ControlValue};  // a control's value
//     Input<double> bend = FromUnit{"curve"};                                       // output of unit "curve"
//     Input<double> bend = Each::Ratio;                                             // 0 first, 1 last
//
// Names are resolved once, by Rig::make or Rig::with_unit, which also checks that the unit or element exists
// and that its value has the type that the input takes. A solve compares no strings.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "tendril/fields.hpp"
#include "tendril/rig/hierarchy.hpp"
#include "tendril/rig/transform.hpp"

namespace tendril::rig {

/// The type of an input or an output.
enum class Type : std::uint8_t { Bool, Number, Vector, Rotation, Transform };
/// "number"
const char* name(Type type) noexcept;

/// A value of any of these types, in their order.
using Value = std::variant<bool, double, glm::dvec3, glm::dquat, Transform>;
inline Type type_of(const Value& value) noexcept {
    return static_cast<Type>(value.index());
}

namespace detail {
/// The index that Rig::make found for a name. Not part of an input's value: all compare equal.
struct Resolved {
    std::int32_t index = -1;
    bool operator==(const Resolved&) const noexcept { return true; }
};
}  // namespace detail

/// The current element of the surrounding for-each.
struct ThisElement {
    bool operator==(const ThisElement&) const = default;
};

/// The element that a unit works on: by name, or the current one of a for-each.
struct Item {
    std::variant<std::string, ThisElement> which;
    detail::Resolved resolved{};

    Item() = default;
    Item(const char* element) : which(element) {}
    Item(std::string element) : which(std::move(element)) {}
    Item(ThisElement) : which(ThisElement()) {}
    bool operator==(const Item&) const = default;
};

/// Part of an element's pose, or the value of a control. X, Y and Z are components of its translation.
enum class Of : std::uint8_t { Transform, Translation, Rotation, Scale, X, Y, Z, ControlValue };
struct FromElement {
    Item element{};
    Of of = Of::Translation;
    Space space = Space::Global;
    Pose pose = Pose::Current;
    bool operator==(const FromElement&) const = default;
};

/// An output of a unit that runs earlier.
struct FromUnit {
    std::string unit{};
    std::string output = "result";
    detail::Resolved resolved_unit{}, resolved_output{};
    bool operator==(const FromUnit&) const = default;
};

/// For the current element of a for-each: index / (count - 1), or 0 if count is 1; its index, from 0; and the
/// count.
enum class Each : std::uint8_t { Ratio, Index, Count };

/// T is bool, double, glm::dvec3, glm::dquat, Transform, or Value, which takes any type.
template <class T>
struct Input {
    using Source = std::variant<T, FromElement, FromUnit, Each>;
    Source source;

    Input() = default;
    Input(T literal) : source(std::in_place_index<0>, std::move(literal)) {}
    Input(FromElement element) : source(std::move(element)) {}
    Input(FromUnit unit) : source(std::move(unit)) {}
    Input(Each each) : source(each) {}
    bool operator==(const Input&) const = default;

    /// Null if it is not a literal.
    const T* literal() const noexcept { return std::get_if<0>(&source); }
};

/// Reads and sets an Input, an Item or a Transform, given its address, as an input of any type. The table row
/// of each has one. A literal must be of `type`.
struct InputAccess : FieldAccess {
    enum class Takes : std::uint8_t { Any, Literal, Item };
    Takes takes;
    std::optional<Type> type;  ///< a literal's type; none: any
    Input<Value> (*get)(const void* input);
    void (*set)(void* input, const Input<Value>& source);
};
inline const InputAccess& access_of(const Field& row) noexcept {
    return static_cast<const InputAccess&>(*row.access);
}

}  // namespace tendril::rig
