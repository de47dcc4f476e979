// The fields of a struct of settings, described once: name, unit and range. Checks, files, commands, panels
// and exported code read the same rows. So can an engine's editor, which can then show settings that it does
// not know:
//
//     for (const Field& field : fields<rope::Settings>())
//         if (field.type == FieldType::Number) slider(field.name, field.slider(), field.unit);
//
// A table is a constant array: reading a row costs nothing and allocates nothing.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/ext/quaternion_double.hpp>
#include <glm/ext/quaternion_float.hpp>
#include <glm/ext/vector_double2.hpp>
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
    Pair,      ///< two numbers, such as {low, high}
    Point,     ///< three numbers
    Rotation,  ///< a quaternion: x, y, z, w
    Choice     ///< an index into `choices`
};

/// A field of any type, as up to four numbers.
using FieldValue = std::array<double, 4>;

inline glm::quat rotation_of(const FieldValue& value) noexcept {
    return glm::quat(static_cast<float>(value[3]), static_cast<float>(value[0]), static_cast<float>(value[1]),
                     static_cast<float>(value[2]));
}

/// The range of a number, or of each number of a pair or a point; both ends included.
struct FieldRange {
    double low = 0.0, high = 0.0;
};

enum class FieldScale : std::uint8_t { Linear, Logarithmic };

/// One field of a struct. `get` and `set` take the struct; `set` checks nothing.
struct Field {
    const char* name;       ///< as in files and commands: "gravity_scale"
    const char* unit = "";  ///< "m/s^2", "rad"; empty for none
    FieldType type = FieldType::Number;
    bool exact = false;     ///< stored in double precision; otherwise float
    bool optional = false;  ///< may be empty, which reads as NaN
    FieldRange range{};     ///< of a flag 0 to 1, of a choice 0 to the last index
    std::span<const char* const> choices{};
    FieldRange usual{};                     ///< for sliders and random tests; empty: `range`
    FieldScale scale = FieldScale::Linear;  ///< how sliders map it
    FieldValue (*get)(const void* object) noexcept = nullptr;
    void (*set)(void* object, const FieldValue& value) noexcept = nullptr;
    /// Of an optional field; null for others.
    bool (*empty)(const void* object) noexcept = nullptr;

    /// How many numbers of a FieldValue are used.
    int size() const noexcept {
        return type == FieldType::Rotation ? 4
               : type == FieldType::Point  ? 3
               : type == FieldType::Pair   ? 2
                                           : 1;
    }
    bool whole() const noexcept {
        return type == FieldType::Flag || type == FieldType::Integer || type == FieldType::Choice;
    }
    /// Reads or sets one number; the others keep their values.
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

/// The table of a struct, in the order of its members; declared next to the struct.
template <class Struct>
std::span<const Field> fields() noexcept;

/// Null for an unknown name.
const Field* find_field(std::span<const Field> table, std::string_view name) noexcept;

/// Refuses the first field of `object` that is out of its range. The message names `operation`, the field,
/// its range and the value. `object` is a struct of the table's type.
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
template <>
struct FieldPair<glm::dvec2> : std::true_type {};

template <class Value>
FieldValue to_field(const Value& value) noexcept {
    if constexpr (std::is_arithmetic_v<Value> || std::is_enum_v<Value>)
        return {static_cast<double>(value)};
    else if constexpr (FieldPair<Value>::value)
        return {static_cast<double>(value[0]), static_cast<double>(value[1])};
    else if constexpr (std::is_same_v<Value, glm::quat>)
        return {value.x, value.y, value.z, value.w};
    else
        return {value.x, value.y, value.z};
}

template <class Value>
Value from_field(const FieldValue& given) noexcept {
    if constexpr (std::is_same_v<Value, bool>)
        return given[0] != 0.0;
    else if constexpr (std::is_enum_v<Value>)
        return static_cast<Value>(static_cast<int>(given[0]));
    else if constexpr (std::is_arithmetic_v<Value>)
        return static_cast<Value>(given[0]);
    else if constexpr (FieldPair<Value>::value)
        return {static_cast<typename Value::value_type>(given[0]),
                static_cast<typename Value::value_type>(given[1])};
    else if constexpr (std::is_same_v<Value, glm::quat>)
        return rotation_of(given);
    else
        return Value(given[0], given[1], given[2]);
}

template <auto member>
FieldValue get_field(const void* object) noexcept {
    using Of = FieldMember<decltype(member)>;
    const auto& value = static_cast<const typename Of::struct_type*>(object)->*member;
    if constexpr (FieldOptional<typename Of::value_type>::value)
        return value ? to_field(*value) : FieldValue{std::numeric_limits<double>::quiet_NaN()};
    else
        return to_field(value);
}

template <auto member>
void set_field(void* object, const FieldValue& given) noexcept {
    using Of = FieldMember<decltype(member)>;
    using Value = typename Of::value_type;
    auto& value = static_cast<typename Of::struct_type*>(object)->*member;
    if constexpr (FieldOptional<Value>::value)
        value = given[0] == given[0] ? Value(from_field<typename Value::value_type>(given)) : std::nullopt;
    else
        value = from_field<Value>(given);
}

template <auto member>
bool is_empty_field(const void* object) noexcept {
    return !(static_cast<const typename FieldMember<decltype(member)>::struct_type*>(object)->*member);
}

template <auto member>
constexpr auto empty_check() noexcept -> bool (*)(const void*) noexcept {
    if constexpr (FieldOptional<typename FieldMember<decltype(member)>::value_type>::value)
        return is_empty_field<member>;
    else
        return nullptr;
}

template <class Value>
constexpr FieldType field_type() noexcept {
    static_assert(!std::is_same_v<Value, glm::dquat>, "rotations are floats in tables");
    if (std::is_same_v<Value, bool>) return FieldType::Flag;
    if (std::is_enum_v<Value>) return FieldType::Choice;
    if (std::is_integral_v<Value>) return FieldType::Integer;
    if (FieldPair<Value>::value) return FieldType::Pair;
    if (std::is_same_v<Value, glm::quat>) return FieldType::Rotation;
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
                     std::is_same_v<Value, glm::dvec2> || std::is_same_v<Value, std::array<double, 2>>,
            .optional = detail::FieldOptional<Member>::value,
            .range = range,
            .get = detail::get_field<member>,
            .set = detail::set_field<member>,
            .empty = detail::empty_check<member>()};
}

/// A row for an enumeration whose enumerators count from 0; `choices` are their names, in order.
template <auto member>
constexpr Field field(const char* name, std::span<const char* const> choices) noexcept {
    Field row = field<member>(name, {0.0, static_cast<double>(choices.size()) - 1.0});
    row.choices = choices;
    return row;
}

}  // namespace tendril
