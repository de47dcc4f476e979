// Filters and their states as JSON, for FILTER.json, commands, scene files and --state, and the texts of
// their fields.
//
//     {"kind": "spring", "strength": 4, "critical_damping": 0.5}
//
// Names, ranges and defaults come from the tables of signal::kinds(). A pair is a list of two numbers; a
// curve's keys are a list of {"time", "value", "arrive", "leave", "piece"}, of which only time and value are
// required.
#pragma once

#include <span>
#include <string>
#include <tendril/signal/filter.hpp>
#include <vector>

#include "app/fields/fields.hpp"
#include "app/io/json.hpp"
#include "app/io/json_place.hpp"

namespace tendril::app {

/// Includes all parameters.
Json filter_json(const signal::Filter& filter);

/// Missing parameters have the kind's defaults; unknown keys are ignored. Throws std::runtime_error that
/// begins with the JSON path of the fault: "filters.1.halflife: expected 0 to 10000, found -1".
signal::Filter filter_from_json(const JsonPlace& place);
/// One filter, or a list of at most `most`.
std::vector<signal::Filter> filters_from_json(const JsonPlace& place, std::size_t most);
/// Throws as above if the library refuses the filter.
void check_filter(const JsonPlace& place, const signal::Filter& filter);

/// "exponential_decay, rate_limit, ...".
std::string kind_names();

Json filter_state_json(const signal::FilterState& state);
signal::FilterState filter_state_from_json(const JsonPlace& place);

/// Adds the line in `text` to `error`, which begins with a JSON path under `where`. The text must contain a
/// filter.
std::string with_line(const std::string& text, const std::string& where, const std::string& error);

// Labels and help for the fields of filters.

/// One per field of the kind, in the same order; none for a curve's keys, which have an editor.
std::span<const FieldText> filter_texts(const signal::Kind& kind);

}  // namespace tendril::app
