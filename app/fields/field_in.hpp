// Rows with the name, unit and range that another struct's table has.
#pragma once

#include <optional>
#include <tendril/fields.hpp>

namespace tendril::app {
namespace detail {

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

}  // namespace detail

/// field_in<&LookAtSetting::options, &humanoid::LookAtOptions::view>(). `name`, `within`: other ones than in
/// its own table; a range may only be narrower.
template <auto outer, auto inner>
Field field_in(const char* name = nullptr, std::optional<FieldRange> within = {}) noexcept {
    using In = detail::FieldIn<outer, inner>;
    Field row = field_of<inner>();
    if (name != nullptr) row.name = name;
    if (within) row.range = *within, row.over_low = false;
    row.get = In::get, row.set = In::set, row.fits = In::fits;
    return row;
}

/// field_like<&BodySettings::length, &rope::HairShape::length>(): a row for a number that the library has
/// under a function, with the name, unit and range that it has as the member of a shape.
template <auto member, auto like>
Field field_like(const char* name = nullptr) noexcept {
    const Field& of = field_of<like>();
    return field<member>(name != nullptr ? name : of.name, of.range, of.unit);
}

}  // namespace tendril::app
