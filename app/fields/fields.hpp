// Converts tables of fields (tendril/fields.hpp) to files and command arguments. A lab adds a label and a
// help text for each field; the table provides the rest.
#pragma once

#include <array>
#include <concepts>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tendril/fields.hpp>
#include <vector>

#include "app/document/argument.hpp"
#include "app/io/json_place.hpp"
#include "app/io/names.hpp"

namespace tendril::app {

/// True if a field is an angle: a number of unit "rad" or "rad/s". Files, commands and panels use degrees.
bool is_angle(const Field& field);
/// A field's name in files and commands: "damping"; for an angle, "twist_min_deg".
std::string file_name(const Field& field);
/// The field's range in files, with bounds as their shortest decimals.
FieldRange file_range(const Field& field);

/// A field's presentation.
struct FieldText {
    const char* name;             ///< the field's name in its table
    const char* label = nullptr;  ///< label of its row in a panel; null: no row
    const char* help;    ///< its effect in a sentence or two, for the panel and the command's argument
    float step = 0.01f;  ///< change of the shown value per pixel of a drag
    int decimals = 2;
    double scale = 1.0;                              ///< shown value = value * scale
    const char* unit = nullptr;                      ///< unit of the shown value, if not the field's: "ms"
    const char* at_zero = nullptr;                   ///< shown instead of 0: "never"
    std::array<const char*, 2> ends{"low", "high"};  ///< for a pair: follow the label
    bool in_line = false;                ///< for a point: its three numbers side by side, below its label
    bool more = false;                   ///< rarely needed: shown under "More", if the section has it
    bool listed = false;                 ///< choices in a drop-down list instead of buttons
    std::span<const EnumRow> choices{};  ///< titles of choices, in panel order
};

/// The texts of the fields that a command sets, in the order of its arguments.
template <class Struct>
std::span<const FieldText> field_texts();

/// A struct and its table.
struct FieldsOf {
    template <class Struct>
    FieldsOf(const Struct& of) : table(fields<Struct>()), object(&of) {
        if constexpr (std::default_initializable<Struct>) fresh = tendril::detail::fresh<Struct>();
    }
    template <class Struct>
    FieldsOf(const Struct&&) = delete;  // a temporary would not outlive the call
    FieldsOf(std::span<const Field> of_table, const void* of, const void* with_defaults = nullptr)
        : table(of_table), object(of), fresh(with_defaults) {}

    std::span<const Field> table;
    const void* object;
    const void* fresh = nullptr;  ///< a struct with default values, if it has any
};
struct FieldsIn {
    template <class Struct>
    requires(!std::same_as<Struct, FieldsIn>) FieldsIn(Struct& in) : table(fields<Struct>()), object(&in) {}
    FieldsIn(std::span<const Field> of_table, void* in) : table(of_table), object(in) {}

    std::span<const Field> table;
    void* object;
};

/// True if two structs have the same value in this field.
bool same_field(const Field& field, const void* a, const void* b);

// In files, an element whose first row is a text is identified by it: the text is not empty, and unique
// unless optional. An index is written as its element's text. A list without a name, as a struct's only row,
// stands for the struct. An empty text, a missing element and an infinite number are null. Old angles in
// radians, under the plain name, can still be read.

/// Includes nested structs and lists. Omits the empty elements of a list with names.
Json save_fields(FieldsOf of);
/// Omits members at their default, unless a file must have them.
Json save_sparse_fields(FieldsOf of);
/// Missing fields keep their values, so that older scenes open. Throws std::runtime_error that begins with
/// the JSON path of the error.
void load_fields(const JsonPlace& place, FieldsIn in);
/// The same, but a missing field is an error, unless it is in `newer`, which old files lack.
void load_all_fields(const JsonPlace& place, FieldsIn in, std::span<const std::string_view> newer = {});

/// If a field is missing: keep its value unless it is required; fail; or always keep its value.
enum class MissingField { Default, Refused, Kept };
/// A struct whose fields an object in a file may have, together with those of other structs.
struct KnownFields {
    FieldsIn in;
    MissingField missing = MissingField::Default;
    std::vector<std::string_view> newer{};  ///< missing in old files, also in nested structs
};
/// Refuses members that are neither fields nor `besides`, which the caller reads.
void load_known_fields(const JsonPlace& place, const std::vector<KnownFields>& structs,
                       const std::vector<std::string_view>& besides = {});
inline void load_known_fields(const JsonPlace& place, FieldsIn in,
                              const std::vector<std::string_view>& besides = {},
                              MissingField missing = MissingField::Default) {
    load_known_fields(place, std::vector<KnownFields>{{in, missing, {}}}, besides);
}
/// Names as in files, including the fields of a variant's present kind.
std::vector<std::string> field_names(std::span<const Field> table, const void* object);

/// An optional argument for each field that has a text.
std::vector<Argument> field_arguments(std::span<const Field> table, std::span<const FieldText> texts);
template <class Struct>
std::vector<Argument> field_arguments() {
    return field_arguments(fields<Struct>(), field_texts<Struct>());
}
/// Sets the given fields, except for the field `except`.
void set_fields(const Arguments& given, FieldsIn in, std::string_view except = {});

// Rows that take name, unit and range from another struct's table.

template <auto outer, auto inner>
struct FieldIn {
    static const void* in(const void* object) noexcept { return &tendril::detail::member_of<outer>(object); }
    static FieldValue get(const void* object) noexcept {
        return tendril::detail::get_field<inner>(in(object));
    }
    static void set(void* object, const FieldValue& value) noexcept {
        tendril::detail::set_field<inner>(&tendril::detail::member_of<outer>(object), value);
    }
    static bool fits(const Field& row, const void* object) noexcept {
        return tendril::detail::fits_field<inner>(row, in(object));
    }
};

/// field_in<&LookAtSetting::options, &humanoid::LookAtOptions::view>(). `name` and `within` override those of
/// its own table; a range may only become narrower.
template <auto outer, auto inner>
Field field_in(const char* name = nullptr, std::optional<FieldRange> within = {}) noexcept {
    using In = FieldIn<outer, inner>;
    Field row = field_of<inner>();
    if (name != nullptr) row.name = name;
    if (within) row.range = *within, row.over_low = false;
    row.get = In::get, row.set = In::set, row.fits = In::fits;
    return row;
}

/// field_like<&BodySettings::length, &rope::HairShape::length>(): a row for a number that the library reads
/// by a function, with the name, unit and range of a shape's member.
template <auto member, auto like>
Field field_like(const char* name = nullptr) noexcept {
    const Field& of = field_of<like>();
    return field<member>(name != nullptr ? name : of.name, of.range, of.unit);
}

}  // namespace tendril::app
