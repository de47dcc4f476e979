// Input and output of solvers, as JSON in files, commands and --state: angles in degrees, kinds by name.
//
//   {"kind": "hinge", "axis": [0, 0, 1], "min_deg": 0, "max_deg": 145}
//   {"kind": "ball_and_socket", "axis": [0, 0, 1], "up_deg": 90, "down_deg": 40, "left_deg": 60,
//    "right_deg": 60, "twist_min_deg": -45, "twist_max_deg": 45, "stiffness": 0.5}
#pragma once

#include <string>
#include <tendril/ik/limit.hpp>
#include <tendril/ik/method.hpp>
#include <tendril/ik/report.hpp>

#include "app/io/json.hpp"

namespace tendril::app {

/// Writes the fields of the limit's kind; limit_from_json restores exactly the same angles.
Json limit_json(const ik::Limit& limit);

/// The message of ik::fault() with the limit's values: "the hinge's min is over its max: kind ..."
std::string fault_text(const char* why, const ik::Limit& limit);

/// Reads a limit of any kind. A missing field has the value of ik::Limit::of(kind); a field that the kind
/// lacks is ignored. Throws std::runtime_error that begins with the JSON path ("limits.2.min_deg") for an
/// unknown kind, a value of the wrong type or out of range, a minimum above the maximum, or an axis without
/// length.
ik::Limit limit_from_json(const Json& json, const std::string& where);

/// {"solver", "status", "iterations", "residual", "ran"}; residual is null if it is not finite, or if the
/// input was refused. "ran" is ran_text().
Json report_json(ik::Method method, const ik::Report& report);

}  // namespace tendril::app
