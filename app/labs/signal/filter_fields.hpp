// Labels and help for the fields of filters. The fields themselves are in signal::kinds().
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

/// One per field of the kind, in the same order.
std::span<const FieldText> filter_texts(const signal::Kind& kind);

}  // namespace tendril::app
