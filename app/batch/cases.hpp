// The cases of `tendril solve`: a list of
//
//   {"name": "arm", "lengths": [0.5, 0.4], "target": [0.3, 0.6, 0]}
//
// and optionally "curve" (control points, for a chain that lies along them instead of reaching for a target),
// "start" and "rest" (a point per joint), "pole" (a point), "limits" (one per bone, for the
// joint it starts at, in the format of solver_json.hpp; null for none), "plane" (its normal), "bend" ("left",
// "right" or "free") and "angle_limits" (one per bone, in that plane). Other keys are ignored. A case with a
// "linkage" is a LinkageCase.
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <tendril/ik/limit.hpp>
#include <tendril/ik/plane.hpp>
#include <utility>
#include <vector>

#include "app/io/json_place.hpp"
#include "app/labs/linkage/linkage_part.hpp"

namespace tendril::app {

/// Cases that are linkages:
///
///   {"name": "turn", "linkage": "four_bar", "lengths": {"crank": 0.8},
///    "drivers": {"crank": {"from": 0, "to": 360, "step": 15}}}
///   {"linkage": "delta", "targets": {"platform": [[0, 0, -0.5], [0.1, 0, -0.5]]}}
///
/// "linkage" is a preset, with "lengths" that override its own, or a linkage as in a scene file. A driver's
/// value is a number (degrees or metres), a list of numbers or a range; a target's is a point or a list. A
/// list gives one row per element, each solved from the pose before; a case's lists are equally long.
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
/// A row as JSON: as in --state, with the additional members of a solve.
Json linkage_row_json(const LinkagePart& part);

struct Case {
    std::string name;            ///< its index in the list if it has none
    std::vector<float> lengths;  ///< metres, one per bone
    std::vector<glm::vec3> rest_directions;
    std::vector<glm::vec3> start;  ///< one more than bones; default: straight along +X from the origin
    glm::vec3 target{0.0f};
    std::optional<glm::vec3> pole;
    std::vector<ik::Limit> limits;    ///< one per bone, or empty
    std::optional<glm::vec3> normal;  ///< the plane's
    ik::Side bend = ik::Side::Free;
    std::vector<ik::AngleLimit> angle_limits;  ///< one per bone, or empty
    std::vector<glm::vec3> curve;              ///< control points; empty: the chain reaches for the target
    std::optional<LinkageCase> linkage;        ///< replaces all of the above
};

/// Throws std::runtime_error that begins with the JSON path of the error: "cases.3.lengths.0".
Case case_from_json(const Json& json, const std::string& where, std::size_t index);

/// Calls `take` with each case and the fraction of the text read (0 to 1), until it returns false. Throws
/// std::runtime_error that begins with the line of the error.
void read_cases(std::string_view text, const std::function<bool(const Case&, double)>& take);

}  // namespace tendril::app
