// A panel's rows for the fields of a struct, with name, unit, range, tooltip and command from the table.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/fields/fields.hpp"
#include "app/widgets/emit.hpp"
#include "app/widgets/more.hpp"

namespace tendril::app {

/// Overrides for one row.
struct RowOptions {
    std::optional<FieldRange> within{};  ///< narrower range, set by another field
    std::optional<double> otherwise{};   ///< shown while an optional field is empty
    std::string why_not{};               ///< reason to disable the row; empty if enabled
    std::vector<glm::vec3> swatches{};   ///< colours for listed choices, in their order
    /// Reasons to disable listed choices, in their order, null where enabled; if any is disabled.
    std::vector<const char*> why_not_choices{};
};

class FieldRows {
  public:
    /// Each change emits `command` with `with`, then the field's name and value.
    template <class Struct>
    FieldRows(const Struct& object, std::string command, Emit& emit, ArgumentList with = {})
        : FieldRows(FieldsOf(object), field_texts<Struct>(), std::move(command), emit, std::move(with)) {}
    template <class Struct>
    FieldRows(const Struct&&, std::string, Emit&,
              ArgumentList = {}) = delete;  // the rows refer to the struct
    FieldRows(FieldsOf of, std::span<const FieldText> texts, std::string command, Emit& emit,
              ArgumentList with = {})
        : of_(of), texts_(texts), command_(std::move(command)), emit_(emit), with_(std::move(with)) {}

    /// Adds the rows whose texts say so to `more` instead of drawing them here. The struct must live until
    /// they are drawn.
    FieldRows& under(MoreRows& more) {
        more_ = &more;
        return *this;
    }
    /// For structs whose type has no defaults of its own. `usual` must live as long as the rows.
    FieldRows& compared_with(FieldsOf usual) {
        of_.fresh = usual.object;
        return *this;
    }
    void row(std::string_view name, const RowOptions& options = {}) const;
    template <class... Names>
    void rows(Names... names) const {
        (row(names), ...);
    }
    /// A row for every field with a label, in the table's order.
    void all() const {
        for (const Field& field : of_.table)
            if (text_of(field).label != nullptr) row(field.name);
    }

  private:
    bool changed(const Field& field) const;
    void draw(const Field& field, const FieldText& text, const RowOptions& options) const;
    ArgumentList arguments(const Field& field, ArgumentValue value) const;
    const FieldText& text_of(const Field& field) const;
    void flag_row(const Field& field, const FieldText& text) const;
    void number_row(const Field& field, const FieldText& text, const RowOptions& options) const;
    void pair_row(const Field& field, const FieldText& text) const;
    void point_row(const Field& field, const FieldText& text) const;
    void rotation_row(const Field& field, const FieldText& text) const;
    int chosen(const Field& field, const FieldText& text) const;
    void list_row(const Field& field, const FieldText& text, const RowOptions& options) const;
    void button_rows(const Field& field, const FieldText& text) const;

    FieldsOf of_;
    std::span<const FieldText> texts_;
    std::string command_;
    Emit& emit_;
    ArgumentList with_;
    MoreRows* more_ = nullptr;
};

}  // namespace tendril::app
