// A panel's rows for the fields of a struct: name, field, unit, range, tooltip and command follow from the
// table.
#pragma once

#include <string>

#include "app/fields/fields.hpp"
#include "app/widgets/emit.hpp"

namespace tendril::app {

class FieldRows {
  public:
    /// What a person changes goes out as `command` with the field's name and value, after `with`.
    template <class Struct>
    FieldRows(const Struct& object, std::string command, Emit& emit, ArgumentList with = {})
        : of_(object),
          texts_(field_texts<Struct>()),
          command_(std::move(command)),
          emit_(emit),
          with_(std::move(with)) {}

    void row(std::string_view name) const;
    /// A number that another one keeps within a part of its range.
    void row(std::string_view name, FieldRange within) const;
    template <class... Names>
    void rows(Names... names) const {
        (row(names), ...);
    }

  private:
    ArgumentList arguments(const Field& field, ArgumentValue value) const;
    const FieldText& text_of(const Field& field) const;
    const Field& field_named(std::string_view name) const;
    void number_row(const Field& field, FieldRange range) const;
    void point_row(const Field& field, const FieldText& text) const;
    void choice_rows(const Field& field, const FieldText& text) const;

    FieldsOf of_;
    std::span<const FieldText> texts_;
    std::string command_;
    Emit& emit_;
    ArgumentList with_;
};

}  // namespace tendril::app
