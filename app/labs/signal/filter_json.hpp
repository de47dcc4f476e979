// JSON of filters and their states, for FILTER.json, commands, scene files and --state.
//
//     {"kind": "spring", "strength": 4, "critical_damping": 0.5}
//
// Names, ranges and defaults come from signal::kinds(). A pair is a list of two numbers; a curve's keys are a
// list of {"time", "value", "arrive", "leave", "piece"}, of which only time and value are required.
#pragma once

#include <string>
#include <string_view>
#include <tendril/signal/filter.hpp>
#include <vector>

#include "app/document/json.hpp"

namespace tendril::app {

/// Includes all parameters.
Json filter_json(const signal::Filter& filter);
/// Omits the kind.
Json parameters_json(const signal::Filter& filter);

/// Missing parameters have the kind's defaults; unknown keys are ignored. Throws std::runtime_error that
/// begins with the JSON path of the fault: "filters.1.halflife: expected 0 to 10000, found -1".
signal::Filter filter_from_json(const Json& json, const std::string& where);
/// One filter, or a list of at most `most`. JSON paths in a list are "<where>.1.halflife".
std::vector<signal::Filter> filters_from_json(const Json& json, const std::string& where, std::size_t most);

/// Sets the given parameters and keeps the others. `others`: members that are no parameters. Throws as above,
/// for unknown members too, and leaves the filter unchanged.
void set_parameters(signal::Filter& filter, const Json& given, const std::string& where,
                    const std::vector<std::string_view>& others);

/// "exponential_decay, rate_limit, ...".
std::string kind_names();

Json filter_state_json(const signal::FilterState& state);
signal::FilterState filter_state_from_json(const Json& json, const std::string& where);

/// Prefixes `error`, which begins with a JSON path under `where`, with its line in `text`. The text must
/// contain at least one filter.
std::string with_line(const std::string& text, const std::string& where, const std::string& error);

}  // namespace tendril::app
