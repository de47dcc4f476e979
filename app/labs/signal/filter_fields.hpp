// Labels and help for the fields of filters.
#pragma once

#include <span>
#include <tendril/signal/filter.hpp>

#include "app/fields/fields.hpp"

namespace tendril::app {

/// One per field of the kind, in the same order; none for a curve's keys, which have an editor.
std::span<const FieldText> filter_texts(const signal::Kind& kind);

}  // namespace tendril::app
