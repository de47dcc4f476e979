// What goes into a solver and what comes out of it, as files, commands and --state hold it: angles in
// degrees, names for kinds.
//
//   {"kind": "hinge", "axis": [0, 0, 1], "min_deg": 0, "max_deg": 145}
//   {"kind": "ball_and_socket", "axis": [0, 0, 1], "up_deg": 90, "down_deg": 40, "left_deg": 60,
//    "right_deg": 60, "twist_min_deg": -45, "twist_max_deg": 45}
#pragma once

#include <string>
#include <tendril/ik/active_limit.hpp>
#include <tendril/ik/limit.hpp>
#include <tendril/ik/method.hpp>
#include <tendril/ik/report.hpp>

#include "app/document/json.hpp"

namespace tendril::app {

/// With the fields that its kind has; limit_from_json gives back the very same angles.
Json limit_json(const ik::Limit& limit);

/// A limit of any kind. A field that is left out is as ik::Limit::of(kind) has it; one that its kind does not
/// have is not looked at. Throws std::runtime_error in json.hpp's manner, beginning with the place
/// ("limits.2" and what follows from there): a kind unknown, a value of the wrong type or out of its range, a
/// minimum over the maximum, an axis without length.
ik::Limit limit_from_json(const Json& json, const std::string& where);

/// {"solver", "status", "iterations", "residual", "ran"}; a residual that is not finite is null. "ran" is
/// ran_text's.
Json report_json(ik::Method method, const ik::Report& report, bool within_limits);

/// {"joint", "kind", "bound", "limit_deg", "needed_deg", "enough"}
Json active_limit_json(const ik::ActiveLimit& limit);

/// Throws std::runtime_error that begins with `where` and lists the names there are.
ik::Method method_from_name(const std::string& name, const std::string& where);
/// "fabrik, fabrik_plain, ccd, ..."
std::string method_names();

}  // namespace tendril::app
