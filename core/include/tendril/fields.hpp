// Tables of the fields of settings and states: each field's name, unit and range, with nested structs, lists
// and variants. Checks, files, commands, panels and exported code all read the same rows. An engine's editor
// can use them too, to show settings that it knows nothing about:
//
//     for (const Field& field : fields<rope::Settings>())
//         if (field.type == FieldType::Number && !field.count) slider(field.name, field.slider());
//
// A table is a constant array: reading a row costs nothing and allocates nothing.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/ext/quaternion_double.hpp>
#include <glm/ext/quaternion_float.hpp>
#include <glm/ext/vector_double2.hpp>
#include <glm/ext/vector_double3.hpp>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>

#include "tendril/result.hpp"
#include "tendril/vec3.hpp"

namespace tendril {

enum class FieldType : std::uint8_t {
    Flag,     ///< 0 or 1
    Integer,  ///< an integer
    Number,
    Pair,      ///< two numbers, such as {low, high}
    Point,     ///< three numbers
    Rotation,  ///< a quaternion: x, y, z, w
    Choice,    ///< an index into `choices`
    Text,      ///< a std::string
    Index,     ///< index of an element of the list `of`; files store its name
    Struct,    ///< has a table of its own
    Kind,      ///< a std::variant of structs: an index into `choices`, and the table of the active struct
    Other      ///< any other type, such as a rig::Input; its functions are in `access`
};

/// A field of any type, as up to four numbers.
using FieldValue = std::array<double, 4>;

inline glm::quat rotation_of(const FieldValue& value) noexcept {
    return glm::quat(static_cast<float>(value[3]), static_cast<float>(value[0]), static_cast<float>(value[1]),
                     static_cast<float>(value[2]));
}

/// The range of a number, of each number of a pair or a point, or of a rotation's length; both ends included.
struct FieldRange {
    double low = 0.0, high = 0.0;
};
/// Lengths at which a quaternion counts as a rotation.
inline constexpr FieldRange unit_length{0.999, 1.001};

enum class FieldScale : std::uint8_t { Linear, Logarithmic };

struct Field;
/// A kind of struct that a field may hold.
struct FieldKind {
    std::span<const Field> (*table)() noexcept;
    const void* (*fresh)() noexcept;  ///< creates one with default values
    std::string_view in_code;         ///< "tendril::rig::Aim"
};

/// Functions for values of type Other. A module adds functions in a derived struct, such as rig::InputAccess.
struct FieldAccess {
    bool (*same)(const void* one, const void* other);
};

/// One field of a struct. `get`, `set` and `empty` take the struct; `set` checks nothing.
///
/// A list of values or structs has a `count`: type, range and unit then describe an element, and `get`, `set`
/// and `empty` take its address. For type Other they take the address of the value. A text has `text` and
/// `set_text` instead. Setting a variant's index gives it a fresh struct of that kind.
struct Field {
    const char* name;       ///< as in files and commands: "gravity_scale"
    const char* unit = "";  ///< "m/s^2", "rad"; empty for none
    FieldType type = FieldType::Number;
    bool exact = false;     ///< stored in double precision; otherwise float
    bool optional = false;  ///< may be empty, which reads as NaN and is set by NaN
    FieldRange range{};     ///< 0 to 1 for a flag, 0 to the last index for a choice; may be infinite
    bool over_low = false;  ///< range.low itself is out of range
    std::span<const char* const> choices{};
    std::string_view in_code{};  ///< a choice's enumeration: "tendril::ik::SketchHold"; otherwise the member,
                                 ///< if it differs from `name`
    const char* of = "";         ///< the list that an index or a name refers to, in an enclosing struct
    FieldRange usual{};          ///< for sliders and random tests; empty: `range`
    FieldScale scale = FieldScale::Linear;  ///< how sliders map it
    FieldValue (*get)(const void* object) noexcept = nullptr;
    void (*set)(void* object, const FieldValue& value) noexcept = nullptr;
    /// True if the value is in the range of `row`, or empty.
    bool (*fits)(const Field& row, const void* object) noexcept = nullptr;
    std::string_view (*text)(const void* object) noexcept = nullptr;
    void (*set_text)(void* object, std::string_view text) = nullptr;
    const FieldAccess* access = nullptr;

    std::span<const FieldKind> kinds{};  ///< a variant's, by index; a struct has one
    /// The address of a struct or other value (null while an optional one is empty), of a variant's active
    /// struct, or of a list's element.
    const void* (*address)(const void* object, std::size_t index) noexcept = nullptr;
    std::size_t (*count)(const void* object) noexcept = nullptr;
    /// Resizes a list, or an optional struct to 0 or 1. Null if the number of elements is fixed, or if the
    /// struct does not own the list.
    void (*resize)(void* object, std::size_t count) noexcept = nullptr;
    std::size_t fewest = 0, most = static_cast<std::size_t>(-1);  ///< number of elements in a list
    std::span<const char* const> names{};                         ///< the elements' names: "left", "right"
    bool in_line = false;   ///< in files the named elements are members of the struct itself
    bool sparse = false;    ///< files omit it at its default; for a struct, members at theirs
    bool required = false;  ///< files must have it: there is no default

    /// Bit i: method i honours it, without and within joint limits. See honours() in ik/method.hpp.
    std::uint16_t without_limits = 0xffff, within_limits = 0xffff;

    /// Number of values used in a FieldValue.
    int size() const noexcept {
        return type == FieldType::Rotation ? 4
               : type == FieldType::Point  ? 3
               : type == FieldType::Pair   ? 2
                                           : 1;
    }
    bool whole() const noexcept {
        return type == FieldType::Flag || type == FieldType::Integer || type == FieldType::Choice ||
               type == FieldType::Index || type == FieldType::Kind;
    }
    /// The table of a nested struct, and a struct with default values.
    std::span<const Field> table() const noexcept { return kinds[0].table(); }
    const void* fresh() const noexcept { return kinds[0].fresh(); }
    /// True if it is a struct of that type, or a list of such structs.
    template <class Struct>
    bool holds() const noexcept;
    /// False unless the field is optional.
    bool empty(const void* object) const noexcept {
        return optional && get != nullptr && type != FieldType::Other && number(object) != number(object);
    }
    /// The kind of the struct here: a variant's active one, or a list's element.
    const FieldKind& kind(const void* object) const noexcept {
        return kinds[type == FieldType::Kind ? static_cast<std::size_t>(number(object)) : 0];
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
    /// False for NaN.
    constexpr bool in_range(double value) const noexcept {
        return (over_low ? value > range.low : value >= range.low) && value <= range.high;
    }
    void* address_in(void* object, std::size_t index = 0) const noexcept {
        return const_cast<void*>(address(object, index));
    }

    // Variations of a row: field<&Options::damping>("damping", {0.0, 10.0}).over().
    constexpr Field over() const noexcept {
        Field row = *this;
        row.over_low = true;
        return row;
    }
    constexpr Field by(std::uint16_t without, std::uint16_t within) const noexcept {
        Field row = *this;
        row.without_limits = without, row.within_limits = within;
        return row;
    }
    constexpr Field as_member(std::string_view member) const noexcept {
        Field row = *this;
        row.in_code = member;
        return row;
    }
    constexpr Field sparsely() const noexcept {
        Field row = *this;
        row.sparse = true;
        return row;
    }
    constexpr Field up_to(std::size_t elements, std::size_t at_least = 0) const noexcept {
        Field row = *this;
        row.most = elements, row.fewest = at_least;
        return row;
    }
    constexpr Field needed() const noexcept {
        Field row = *this;
        row.required = true;
        return row;
    }
    /// Lets files omit a name.
    constexpr Field omissible() const noexcept {
        Field row = *this;
        row.optional = true;
        return row;
    }
    /// For texts that name elements of a list.
    constexpr Field naming(const char* list) const noexcept {
        Field row = *this;
        row.of = list;
        return row;
    }
    constexpr Field with_names(std::span<const char* const> of_elements,
                               bool members = false) const noexcept {
        Field row = *this;
        row.names = of_elements, row.in_line = members;
        return row;
    }
};

/// The table of a struct, in the order of its members; declared next to the struct. Does not compile for a
/// struct without a table.
template <class Struct>
std::span<const Field> fields() noexcept = delete;
template <class Struct>
bool Field::holds() const noexcept {
    return type == FieldType::Struct && kinds[0].table == fields<Struct>;
}

/// Finds a row by name; null if there is none.
const Field* find_field(std::span<const Field> table, std::string_view name) noexcept;

/// Refuses the first number in `object`, its structs and its lists that is out of range, and the first index
/// without an element. The message names `operation`, the field, its range and the value: "Body::solve:
/// options.feet.left.lift must be ...", where `place` is "options". `object` is a struct of the table's type.
Result check_fields(const char* operation, std::span<const Field> table, const void* object,
                    const char* place = "") noexcept;

template <class Struct>
Result check_fields(const char* operation, const Struct& object, const char* place = "") noexcept {
    return check_fields(operation, fields<Struct>(), &object, place);
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

/// True if a list's elements are structs with a table, false if they are values.
template <class Value>
inline constexpr bool has_table =
    std::is_class_v<Value> && !std::is_same_v<Value, std::string> && !FieldOptional<Value>::value &&
    !FieldPair<Value>::value && !requires(Value v) {
    v.x, v.y, v.z;
};
template <class Value>
inline constexpr bool is_rotation = std::is_same_v<Value, glm::quat> || std::is_same_v<Value, glm::dquat>;

template <class Value>
FieldValue to_field(const Value& value) noexcept {
    if constexpr (std::is_arithmetic_v<Value> || std::is_enum_v<Value>)
        return {static_cast<double>(value)};
    else if constexpr (FieldPair<Value>::value)
        return {static_cast<double>(value[0]), static_cast<double>(value[1])};
    else if constexpr (is_rotation<Value>)
        return {value.x, value.y, value.z, value.w};
    else
        return {value.x, value.y, value.z};
}

/// Converts to the type. For an integer, NaN and values out of the type's range become its maximum, or its
/// minimum if it is signed and they are below it, so no field accepts them.
template <class Value>
Value number_from(double given) noexcept {
    if constexpr (std::is_enum_v<Value>) {
        return static_cast<Value>(number_from<std::underlying_type_t<Value>>(given));
    } else if constexpr (std::is_integral_v<Value>) {
        using Limits = std::numeric_limits<Value>;
        const auto low = static_cast<double>(Limits::min());
        const double beyond = 2.0 * static_cast<double>(Limits::max() / 2 + 1);
        if ((given >= low || given > low - 1.0) && given < beyond) return static_cast<Value>(given);
        return std::is_signed_v<Value> && given < low ? Limits::min() : Limits::max();
    } else {
        return static_cast<Value>(given);
    }
}

template <class Value>
Value from_field(const FieldValue& given) noexcept {
    if constexpr (std::is_same_v<Value, bool>)
        return given[0] != 0.0;
    else if constexpr (std::is_enum_v<Value> || std::is_arithmetic_v<Value>)
        return number_from<Value>(given[0]);
    else if constexpr (FieldPair<Value>::value)
        return {number_from<typename Value::value_type>(given[0]),
                number_from<typename Value::value_type>(given[1])};
    else if constexpr (std::is_same_v<Value, glm::quat>)
        return rotation_of(given);
    else if constexpr (std::is_same_v<Value, glm::dquat>)
        return {given[3], given[0], given[1], given[2]};
    else
        return Value(given[0], given[1], given[2]);
}

/// Reads an index; -1, which means none, reads as NaN.
inline FieldValue get_index(const void* at) noexcept {
    const std::size_t index = *static_cast<const std::size_t*>(at);
    return {index == static_cast<std::size_t>(-1) ? std::numeric_limits<double>::quiet_NaN()
                                                  : static_cast<double>(index)};
}
inline void set_index(void* at, const FieldValue& given) noexcept {
    *static_cast<std::size_t*>(at) = number_from<std::size_t>(given[0]);
}

/// "tendril::ik::SketchHold"; empty if the compiler does not tell.
template <class Value>
constexpr std::string_view type_name() noexcept {
#ifdef __GNUC__
    constexpr std::string_view all = __PRETTY_FUNCTION__, before = "Value = ";
    constexpr std::size_t begin = all.find(before) + before.size();
    return all.substr(begin, all.find_first_of(";]", begin) - begin);
#else
    return {};
#endif
}

template <class Value>
const void* fresh() noexcept {
    static const Value value{};
    return &value;
}

template <class Value>
inline constexpr FieldKind kind_of{fields<Value>, fresh<Value>, type_name<Value>()};

/// The variant that a type is or derives from; for type deduction only.
template <class... Kinds>
std::type_identity<std::variant<Kinds...>> variant_of(const std::variant<Kinds...>&);

template <class Variant>
struct FieldKinds;
template <class... Kinds>
struct FieldKinds<std::variant<Kinds...>> {
    using variant = std::variant<Kinds...>;
    static constexpr FieldKind list[] = {kind_of<Kinds>...};
    static constexpr std::size_t count = sizeof...(Kinds);

    template <std::size_t... index>
    static void hold(variant& value, std::size_t kind, std::index_sequence<index...>) noexcept {
        ((index == kind ? static_cast<void>(value.template emplace<index>()) : void()), ...);
    }
};

template <class Value>
FieldValue get_value(const void* at) noexcept {
    const Value& value = *static_cast<const Value*>(at);
    if constexpr (FieldOptional<Value>::value)
        return value ? to_field(*value) : FieldValue{std::numeric_limits<double>::quiet_NaN()};
    else
        return to_field(value);
}

template <class Value>
void set_value(void* at, const FieldValue& given) noexcept {
    Value& value = *static_cast<Value*>(at);
    if constexpr (FieldOptional<Value>::value)
        value = given[0] == given[0] ? Value(from_field<typename Value::value_type>(given)) : std::nullopt;
    else
        value = from_field<Value>(given);
}

template <class Value>
bool fits(const Field& row, const Value& value) noexcept {
    if constexpr (FieldOptional<Value>::value) {
        return !value || fits(row, *value);
    } else if constexpr (std::is_same_v<Value, bool>) {
        return true;
    } else if constexpr (std::is_arithmetic_v<Value> || std::is_enum_v<Value>) {
        return row.in_range(static_cast<double>(value));
    } else if constexpr (is_rotation<Value>) {
        const FieldValue q = to_field(value);
        const double squared = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
        return squared >= row.range.low * row.range.low && squared <= row.range.high * row.range.high;
    } else {
        const bool first = row.in_range(static_cast<double>(value[0]));
        if constexpr (FieldPair<Value>::value)
            return first && row.in_range(static_cast<double>(value[1]));
        else
            return first && row.in_range(static_cast<double>(value[1])) &&
                   row.in_range(static_cast<double>(value[2]));
    }
}
template <class Value>
bool fits_value(const Field& row, const void* at) noexcept {
    return fits(row, *static_cast<const Value*>(at));
}

template <auto member>
using StructOf = typename FieldMember<decltype(member)>::struct_type;
template <auto member>
using ValueOf = typename FieldMember<decltype(member)>::value_type;

template <auto member>
const ValueOf<member>& member_of(const void* object) noexcept {
    return static_cast<const StructOf<member>*>(object)->*member;
}
template <auto member>
ValueOf<member>& member_of(void* object) noexcept {
    return static_cast<StructOf<member>*>(object)->*member;
}
template <auto member>
FieldValue get_field(const void* object) noexcept {
    return get_value<ValueOf<member>>(&member_of<member>(object));
}
template <auto member>
void set_field(void* object, const FieldValue& given) noexcept {
    set_value<ValueOf<member>>(&member_of<member>(object), given);
}
template <auto member>
bool fits_field(const Field& row, const void* object) noexcept {
    return fits(row, member_of<member>(object));
}

template <auto member>
std::string_view get_text(const void* object) noexcept {
    return member_of<member>(object);
}
template <auto member>
void set_text(void* object, std::string_view text) {
    member_of<member>(object) = text;
}
inline std::string_view get_text_at(const void* at) noexcept {
    return *static_cast<const std::string*>(at);
}
inline void set_text_at(void* at, std::string_view text) {
    *static_cast<std::string*>(at) = text;
}

template <auto member>
using KindsOf = FieldKinds<typename decltype(variant_of(std::declval<const ValueOf<member>&>()))::type>;
template <auto member>
FieldValue get_kind(const void* object) noexcept {
    return {static_cast<double>(member_of<member>(object).index())};
}
/// An index without a kind leaves the variant unchanged.
template <auto member>
void set_kind(void* object, const FieldValue& given) noexcept {
    KindsOf<member>::hold(member_of<member>(object), number_from<std::size_t>(given[0]),
                          std::make_index_sequence<KindsOf<member>::count>());
}
template <auto member>
bool fits_kind(const Field&, const void* object) noexcept {
    return !member_of<member>(object).valueless_by_exception();
}
template <auto member>
const void* held_address(const void* object, std::size_t) noexcept {
    const typename KindsOf<member>::variant& value = member_of<member>(object);
    return std::visit([](const auto& each) -> const void* { return &each; }, value);
}

template <auto member>
FieldValue get_index_field(const void* object) noexcept {
    return get_index(&member_of<member>(object));
}
template <auto member>
void set_index_field(void* object, const FieldValue& given) noexcept {
    set_index(&member_of<member>(object), given);
}

template <auto member>
const void* struct_address(const void* object, std::size_t) noexcept {
    const auto& value = member_of<member>(object);
    if constexpr (FieldOptional<ValueOf<member>>::value)
        return value ? &*value : nullptr;
    else
        return &value;
}
template <auto member>
void resize_struct(void* object, std::size_t count) noexcept {
    auto& value = member_of<member>(object);
    if (count == 0)
        value.reset();
    else if (!value)
        value.emplace();
}
template <auto member>
const void* element_address(const void* object, std::size_t index) noexcept {
    return &member_of<member>(object)[index];
}
template <auto member>
std::size_t count_elements(const void* object) noexcept {
    return member_of<member>(object).size();
}
template <auto member>
void resize_list(void* object, std::size_t count) noexcept {
    member_of<member>(object).resize(count);
}

template <class Value>
constexpr FieldType field_type() noexcept {
    if (std::is_same_v<Value, bool>) return FieldType::Flag;
    if (std::is_enum_v<Value>) return FieldType::Choice;
    if (std::is_integral_v<Value>) return FieldType::Integer;
    if (FieldPair<Value>::value) return FieldType::Pair;
    if (is_rotation<Value>) return FieldType::Rotation;
    return std::is_arithmetic_v<Value> ? FieldType::Number : FieldType::Point;
}

/// A row for values of this type, without `get` and `set`.
template <class Member>
constexpr Field value_row(const char* name, FieldRange range, const char* unit) noexcept {
    using Value = typename FieldOptional<Member>::type;
    return {.name = name,
            .unit = unit,
            .type = field_type<Value>(),
            .exact = std::is_same_v<Value, double> || std::is_same_v<Value, glm::dvec3> ||
                     std::is_same_v<Value, glm::dvec2> || std::is_same_v<Value, std::array<double, 2>> ||
                     std::is_same_v<Value, glm::dquat>,
            .optional = FieldOptional<Member>::value,
            .range = range};
}

}  // namespace detail

/// A row of a table: field<&Settings::damping>("damping", {0.0, max_rate}, "1/s").
template <auto member>
constexpr Field field(const char* name, FieldRange range = {0.0, 1.0}, const char* unit = "") noexcept {
    using Value = detail::ValueOf<member>;
    if constexpr (std::is_same_v<Value, std::string>) {
        return {.name = name,
                .type = FieldType::Text,
                .text = detail::get_text<member>,
                .set_text = detail::set_text<member>};
    } else {
        Field row = detail::value_row<Value>(name, range, unit);
        row.get = detail::get_field<member>, row.set = detail::set_field<member>;
        row.fits = detail::fits_field<member>;
        return row;
    }
}

/// A row for an enumeration whose enumerators count from 0; `choices` are their names, in order.
template <auto member>
constexpr Field field(const char* name, std::span<const char* const> choices) noexcept {
    Field row = field<member>(name, {0.0, static_cast<double>(choices.size()) - 1.0});
    row.choices = choices;
    row.in_code = detail::type_name<typename detail::FieldOptional<detail::ValueOf<member>>::type>();
    return row;
}

/// A row for a struct with a table, or an optional one.
template <auto member>
constexpr Field nested(const char* name) noexcept {
    using Member = detail::ValueOf<member>;
    using Struct = typename detail::FieldOptional<Member>::type;
    Field row{.name = name, .type = FieldType::Struct, .optional = detail::FieldOptional<Member>::value};
    row.kinds = {&detail::kind_of<Struct>, 1};
    row.address = detail::struct_address<member>;
    if constexpr (detail::FieldOptional<Member>::value) row.resize = detail::resize_struct<member>;
    return row;
}

/// A row for a std::variant of structs with tables, or a class derived from one; `names`: its kinds' names,
/// in order. Files store the name with the fields of that kind.
template <auto member>
constexpr Field kinds(const char* name, std::span<const char* const> names) noexcept {
    return {.name = name,
            .type = FieldType::Kind,
            .range = {0.0, static_cast<double>(detail::KindsOf<member>::count) - 1.0},
            .choices = names,
            .get = detail::get_kind<member>,
            .set = detail::set_kind<member>,
            .fits = detail::fits_kind<member>,
            .kinds = detail::KindsOf<member>::list,
            .address = detail::held_address<member>};
}

/// A row for an array of structs with a table, or of values. For a vector or a span add .up_to().
template <auto member>
constexpr Field list(const char* name, FieldRange range = {0.0, 1.0}, const char* unit = "") noexcept {
    using List = detail::ValueOf<member>;
    using Element = std::remove_cvref_t<decltype(std::declval<List&>()[0])>;
    Field row{.name = name, .type = FieldType::Struct};
    if constexpr (detail::has_table<Element>) {
        row.kinds = {&detail::kind_of<Element>, 1};
    } else if constexpr (std::is_same_v<Element, std::string>) {
        row.type = FieldType::Text;
        row.text = detail::get_text_at, row.set_text = detail::set_text_at;
    } else {
        row = detail::value_row<Element>(name, range, unit);
        row.get = detail::get_value<Element>, row.set = detail::set_value<Element>;
        row.fits = detail::fits_value<Element>;
    }
    row.address = detail::element_address<member>;
    row.count = detail::count_elements<member>;
    if constexpr (requires(List & all) { all.resize(1); }) row.resize = detail::resize_list<member>;
    if constexpr (requires { std::tuple_size<List>::value; }) row.most = std::tuple_size<List>::value;
    return row;
}

/// A row for an index, or a list of indices, into the list `of` of an enclosing struct. `optional`: -1 means
/// none.
template <auto member>
constexpr Field index(const char* name, const char* of, bool optional = false) noexcept {
    Field row{};
    if constexpr (std::is_same_v<detail::ValueOf<member>, std::size_t>) {
        row.get = detail::get_index_field<member>, row.set = detail::set_index_field<member>;
    } else {
        row = list<member>(name);
        row.get = detail::get_index, row.set = detail::set_index;
    }
    row.name = name, row.type = FieldType::Index, row.fits = nullptr;
    row.of = of, row.optional = optional;
    return row;
}

/// The row of a member that is a value: field_of<&Settings::damping>().
template <auto member>
const Field& field_of() noexcept {
    const std::span<const Field> table = fields<detail::StructOf<member>>();
    std::size_t at = 0;
    while (table[at].get != detail::get_field<member>) ++at;
    return table[at];
}

}  // namespace tendril
