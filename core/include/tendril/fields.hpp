// What a struct of settings is made of, said once: the name, unit and range of each field. Checks, files,
// commands, panels and exported code read the same rows; so can the editor of an engine, which then shows a
// setting that it has never heard of:
//
//     for (const Field& field : fields<rope::Settings>())
//         if (field.type == FieldType::Number) slider(field.name, field.slider(), field.unit);
//
// A table is an array of constants: reading a row costs nothing and allocates nothing.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <type_traits>

#include "tendril/result.hpp"
#include "tendril/vec3.hpp"

namespace tendril {

enum class FieldType : std::uint8_t {
    Flag,     ///< 0 or 1
    Integer,  ///< a whole number
    Number,
    Pair,   ///< two numbers, such as {low, high}
    Point,  ///< three numbers
    Choice  ///< the place of one of `choices`
};

/// A field of any type, as up to three numbers.
using FieldValue = std::array<double, 3>;

/// The range of a number, or of each number of a pair or a point; both ends belong to it.
struct FieldRange {
    double low = 0.0, high = 0.0;
};

enum class FieldScale : std::uint8_t { Linear, Logarithmic };

/// One field of a struct. `get` and `set` take the struct; `set` checks nothing.
struct Field {
    const char* name;       ///< as files and commands have it: "gravity_scale"
    const char* unit = "";  ///< "m/s^2"; empty for none
    FieldType type = FieldType::Number;
    bool exact = false;     ///< a number with the digits of a double; else those of a float
    bool optional = false;  ///< may be empty, which reads as NaN
    FieldRange range{};     ///< 0 to 1 of a flag, 0 to the last of choices
    std::span<const char* const> choices{};
    FieldRange usual{};                     ///< of sliders and random tests; empty: `range`
    FieldScale scale = FieldScale::Linear;  ///< how sliders map it
    FieldValue (*get)(const void* object) noexcept = nullptr;
    void (*set)(void* object, const FieldValue& value) noexcept = nullptr;

    /// How many numbers of a FieldValue it takes.
    int size() const noexcept { return type == FieldType::Point ? 3 : type == FieldType::Pair ? 2 : 1; }
    bool whole() const noexcept {
        return type == FieldType::Flag || type == FieldType::Integer || type == FieldType::Choice;
    }
    /// Reads or sets one number; the others stay.
    double number(const void* object, int axis = 0) const noexcept {
        return get(object)[static_cast<std::size_t>(axis)];
    }
    void set_number(void* object, double value, int axis = 0) const noexcept {
        FieldValue changed = get(object);
        changed[static_cast<std::size_t>(axis)] = value;
        set(object, changed);
    }
    FieldRange slider() const noexcept { return usual.low < usual.high ? usual : range; }
};

/// The table of a struct, in the order of its members. Each header that has one declares it beside the
/// struct.
template <class Struct>
std::span<const Field> fields() noexcept;

/// Null for an unknown name.
const Field* find_field(std::span<const Field> table, std::string_view name) noexcept;

/// Refuses, naming `operation`, the field, its range and the value, the first field of `object` that is out
/// of its range. `object` is a struct of the table's type.
Result check_fields(const char* operation, std::span<const Field> table, const void* object) noexcept;

template <class Struct>
Result check_fields(const char* operation, const Struct& object) noexcept {
    return check_fields(operation, fields<Struct>(), &object);
}

namespace detail {

template <class Member>
struct FieldMember;
template <class Struct, class Value>
struct FieldMember<Value Struct::*> {
    using struct_type = Struct;
    using value_type = Value;
};

template <class Value>
struct FieldOptional : std::false_type {
    using type = Value;
};
template <class Value>
struct FieldOptional<std::optional<Value>> : std::true_type {
    using type = Value;
};

template <class Value>
struct FieldPair : std::false_type {};
template <class Value>
struct FieldPair<std::array<Value, 2>> : std::true_type {};

template <auto member>
FieldValue get_field(const void* object) noexcept {
    using Of = FieldMember<decltype(member)>;
    const auto& value = static_cast<const typename Of::struct_type*>(object)->*member;
    if constexpr (FieldOptional<typename Of::value_type>::value)
        return {value ? static_cast<double>(*value) : std::numeric_limits<double>::quiet_NaN()};
    else if constexpr (std::is_arithmetic_v<typename Of::value_type> ||
                       std::is_enum_v<typename Of::value_type>)
        return {static_cast<double>(value)};
    else if constexpr (FieldPair<typename Of::value_type>::value)
        return {static_cast<double>(value[0]), static_cast<double>(value[1])};
    else
        return {value.x, value.y, value.z};
}

template <auto member>
void set_field(void* object, const FieldValue& given) noexcept {
    using Of = FieldMember<decltype(member)>;
    using Value = typename Of::value_type;
    auto& value = static_cast<typename Of::struct_type*>(object)->*member;
    if constexpr (FieldOptional<Value>::value)
        value =
            given[0] == given[0] ? Value(static_cast<typename Value::value_type>(given[0])) : std::nullopt;
    else if constexpr (std::is_same_v<Value, bool>)
        value = given[0] != 0.0;
    else if constexpr (std::is_enum_v<Value>)
        value = static_cast<Value>(static_cast<int>(given[0]));
    else if constexpr (std::is_arithmetic_v<Value>)
        value = static_cast<Value>(given[0]);
    else if constexpr (FieldPair<Value>::value)
        value = {static_cast<typename Value::value_type>(given[0]),
                 static_cast<typename Value::value_type>(given[1])};
    else
        value = Value(given[0], given[1], given[2]);
}

template <class Value>
constexpr FieldType field_type() noexcept {
    if (std::is_same_v<Value, bool>) return FieldType::Flag;
    if (std::is_enum_v<Value>) return FieldType::Choice;
    if (std::is_integral_v<Value>) return FieldType::Integer;
    if (FieldPair<Value>::value) return FieldType::Pair;
    return std::is_arithmetic_v<Value> ? FieldType::Number : FieldType::Point;
}

}  // namespace detail

/// A row of a table: field<&Settings::damping>("damping", {0.0, max_rate}, "1/s").
template <auto member>
constexpr Field field(const char* name, FieldRange range = {0.0, 1.0}, const char* unit = "") noexcept {
    using Member = typename detail::FieldMember<decltype(member)>::value_type;
    using Value = typename detail::FieldOptional<Member>::type;
    return {.name = name,
            .unit = unit,
            .type = detail::field_type<Value>(),
            .exact = std::is_same_v<Value, double> || std::is_same_v<Value, glm::dvec3> ||
                     std::is_same_v<Value, std::array<double, 2>>,
            .optional = detail::FieldOptional<Member>::value,
            .range = range,
            .get = detail::get_field<member>,
            .set = detail::set_field<member>};
}

/// One of an enumeration whose enumerators count from 0: their names, in order.
template <auto member>
constexpr Field field(const char* name, std::span<const char* const> choices) noexcept {
    Field row = field<member>(name, {0.0, static_cast<double>(choices.size()) - 1.0});
    row.choices = choices;
    return row;
}

}  // namespace tendril
