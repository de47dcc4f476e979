// Curves of keys as JSON, by the names that signal.md has:
//
//     {"keys": [{"time": 0, "value": 0, "arrive": 0, "leave": 0, "piece": "linear"}, ...],
//      "source_min": 0, "source_max": 1, "target_min": 0, "target_max": 1}
#pragma once

#include <string>
#include <tendril/signal/curve.hpp>
#include <vector>

#include "app/document/json.hpp"
#include "app/labs/kit/json_place.hpp"

namespace tendril::app {

Json curve_json(const signal::Curve& curve);
/// What is left out is as in a straight line from 0 to 1.
signal::Curve read_curve(const JsonPlace& place);

/// A unit that evaluates a curve may have the curve's members among its own.
void add_curve_members(std::vector<std::string>& names);
void read_curve_members(const JsonPlace& place, signal::Curve& curve);

}  // namespace tendril::app
