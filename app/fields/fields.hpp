// What the rows of a table of fields (tendril/fields.hpp) become in files and in commands. A lab says beside
// the table what each field is called and what it is for; the rest follows from the row.
#pragma once

#include <concepts>
#include <span>
#include <string_view>
#include <tendril/fields.hpp>
#include <vector>

#include "app/document/argument.hpp"
#include "app/document/json_place.hpp"
#include "app/document/names.hpp"

namespace tendril::app {

/// A field as users see it.
struct FieldText {
    const char* name;    ///< the field's
    const char* label;   ///< in a panel
    const char* help;    ///< what it does, in a sentence or two: in a panel, and of the command's argument
    float step = 0.01f;  ///< change of the shown value per pixel of a drag
    int decimals = 2;
    double scale = 1.0;                  ///< shown value = value * scale
    const char* unit = nullptr;          ///< of the shown value, if not the field's: "ms"
    bool listed = false;                 ///< choices in a drop-down list instead of buttons
    std::span<const EnumRow> choices{};  ///< titles of choices, in panel order
};

/// The texts of the fields that a command sets, in the order of its arguments.
template <class Struct>
std::span<const FieldText> field_texts();

/// A struct and its table.
struct FieldsOf {
    template <class Struct>
    FieldsOf(const Struct& of) : table(fields<Struct>()), object(&of) {}
    template <class Struct>
    FieldsOf(const Struct&&) = delete;  // it would not outlive the call
    FieldsOf(std::span<const Field> of_table, const void* of) : table(of_table), object(of) {}

    std::span<const Field> table;
    const void* object;
};
struct FieldsIn {
    template <class Struct>
    requires(!std::same_as<Struct, FieldsIn>) FieldsIn(Struct& in) : table(fields<Struct>()), object(&in) {}
    FieldsIn(std::span<const Field> of_table, void* in) : table(of_table), object(in) {}

    std::span<const Field> table;
    void* object;
};

Json save_fields(FieldsOf of);
/// What is missing stays as it is, so that older scenes open. Throws std::runtime_error that begins with the
/// place of what is wrong.
void load_fields(const JsonPlace& place, FieldsIn in);

/// An argument for each field that has a text; each may be left out.
std::vector<Argument> field_arguments(std::span<const Field> table, std::span<const FieldText> texts);
template <class Struct>
std::vector<Argument> field_arguments() {
    return field_arguments(fields<Struct>(), field_texts<Struct>());
}
/// Sets what was given, but for the field `except`.
void set_fields(const Arguments& given, FieldsIn in, std::string_view except = {});

}  // namespace tendril::app
