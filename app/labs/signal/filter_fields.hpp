// The fields of filters as users see them; what they are is in the library's table, signal::kinds().
#pragma once

#include <span>
#include <tendril/signal/filter.hpp>

#include "app/fields/fields.hpp"

namespace tendril::app {

inline FieldsOf filter_fields(const signal::Filter& filter) {
    return {signal::kind_of(filter).fields, signal::fields_in(filter)};
}
inline FieldsIn filter_fields(signal::Filter& filter) {
    return {signal::kind_of(filter).fields, signal::fields_in(filter)};
}

/// One for each field of a kind, in its order.
std::span<const FieldText> filter_texts(const signal::Kind& kind);

}  // namespace tendril::app
