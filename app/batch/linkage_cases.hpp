// Cases of `tendril solve` that are linkages:
//
//   {"name": "turn", "linkage": "four_bar", "lengths": {"crank": 0.8},
//    "drivers": {"crank": {"from": 0, "to": 360, "step": 15}}}
//   {"linkage": "delta", "targets": {"platform": [[0, 0, -0.5], [0.1, 0, -0.5]]}}
//
// "linkage" is a preset, with "lengths" that differ from it, or a linkage as in a scene file. A driver's
// value is a number (degrees or metres), a list of numbers or a range; a target's is a point or a list. A
// list gives a row per element, each from the pose before; all lists of a case are equally long.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "app/document/json_place.hpp"
#include "app/labs/linkage/linkage_part.hpp"

namespace tendril::app {

struct LinkageCase {
    LinkagePart part;
    /// Keyed by joint and point names; radians or metres. One value, or one for each row.
    std::vector<std::pair<std::string, std::vector<double>>> drivers{};
    std::vector<std::pair<std::string, std::vector<glm::dvec3>>> targets{};

    std::size_t rows() const;
    /// Moves the part to a row's values.
    void solve(std::size_t row, LinkageRuntime& runtime, const ik::LinkageOptions& options);
    /// CSV columns beyond the common ones: drivers by name, points by name and axis.
    std::vector<std::string> columns() const;
    std::vector<double> column_values() const;
};
inline constexpr std::size_t max_linkage_rows = 100'000;

/// Throws std::runtime_error that begins with the JSON path of the error.
LinkageCase linkage_case_from_json(const JsonPlace& place);
/// Replaces the case's "drivers" and "targets" by the given ones of the same names. Throws std::runtime_error
/// that begins with the argument: "--drive crank".
void override_linkage_goals(const Json& goals, LinkageCase& to);
/// Parses goals from arguments: "crank=30", "crank=0:360:15", "P=1,2,0". Throws std::runtime_error.
Json linkage_goals_from_arguments(const std::vector<std::string>& drivers,
                                  const std::vector<std::string>& targets);
/// A row as JSON: as in --state, with additional members of a solve.
Json linkage_row_json(const LinkagePart& part);

}  // namespace tendril::app
