// Checks constant tables of fields where check_fields() would cost too much. Not installed.
#pragma once

#include <cstddef>
#include <cstdio>
#include <iterator>
#include <utility>

#include "tendril/fields.hpp"

namespace tendril::detail {

template <const auto& rows, std::size_t at>
bool is_in_range(const void* object) noexcept {
    constexpr auto fits = rows[at].count == nullptr ? rows[at].fits : nullptr;
    if constexpr (fits == nullptr || rows[at].type == FieldType::Flag)
        return true;
    else
        return fits(rows[at], object);
}
/// True if each value is in its row's range; lists and structs are skipped. The loop is unrolled and the
/// accessors inlined, so it costs as little as handwritten comparisons.
template <const auto& rows>
bool are_in_range(const void* object) noexcept {
    return [object]<std::size_t... at>(std::index_sequence<at...>) {
        return (is_in_range<rows, at>(object) && ...);
    }
    (std::make_index_sequence<std::size(rows)>());
}

/// Prepends the list's element to check_fields()' message: `solve: effectors[2].weight must be ...`
template <class Row>
Result refused_element(const char* operation, const char* list, std::size_t index, const Row& row) noexcept {
    char place[64];
    std::snprintf(place, sizeof place, "%s[%zu]", list, index);
    return check_fields(operation, row, place);
}

}  // namespace tendril::detail
