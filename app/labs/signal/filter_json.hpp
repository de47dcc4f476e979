// Filters and their states as JSON: for FILTER.json, commands, scene files and --state alike.
//
//     {"kind": "spring", "strength": 4, "critical_damping": 0.5}
//
// Names, ranges and defaults come from signal::kinds(); nothing here lists a filter. A pair is a list of two,
// a curve's keys are a list of {"time", "value", "arrive", "leave", "piece"}, of which only time and value
// have to be there.
#pragma once

#include <string>
#include <tendril/signal/filter.hpp>
#include <vector>

#include "app/document/json.hpp"

namespace tendril::app {

/// With every parameter.
Json filter_json(const signal::Filter& filter);
/// Without its kind.
Json parameters_json(const signal::Filter& filter);

/// What is left out is as the kind has it; other keys are not looked at. Throws std::runtime_error that
/// begins with the place of what is wrong: "filters.1.halflife: expected 0 to 10000, found -1".
signal::Filter filter_from_json(const Json& json, const std::string& where);
/// One filter, or a list of at most `most`. In a list its places
/// are "<where>.1.halflife".
std::vector<signal::Filter> filters_from_json(const Json& json, const std::string& where, std::size_t most);

/// Those of the filter's parameters that are given; the others stay. Throws as above, with the filter as it
/// was.
void set_parameters(signal::Filter& filter, const Json& given, const std::string& where);

/// Every name that a filter of the kind can be given, once each: its parameters, and the keys of a curve.
std::vector<std::string> parameter_names(const signal::Kind& kind);
/// "exponential_decay, rate_limit, ...".
std::string kind_names();

Json filter_state_json(const signal::FilterState& state);
signal::FilterState filter_state_from_json(const Json& json, const std::string& where);

/// Of a text with at least one filter; the message of `error`, which begins with a place under `where`, with
/// the line before it.
std::string with_line(const std::string& text, const std::string& where, const std::string& error);

}  // namespace tendril::app
