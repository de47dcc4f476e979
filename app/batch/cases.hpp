// The cases of `tendril solve`: a list of
//
//   {"name": "arm", "lengths": [0.5, 0.4], "target": [0.3, 0.6, 0]}
//
// and optionally "curve" (control points, for a chain that lies along them instead of reaching for a target),
// "start" and "rest" (a point per joint), "pole" (a point), "limits" (one per bone, for the
// joint it starts at, in the format of solver_json.hpp; null for none), "plane" (its normal), "bend" ("left",
// "right" or "free") and "angle_limits" (one per bone, in that plane). Other keys are ignored. A case with a
// "linkage" is one: linkage_cases.hpp.
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <tendril/ik/limit.hpp>
#include <tendril/ik/plane.hpp>
#include <vector>

#include "app/batch/linkage_cases.hpp"

namespace tendril::app {

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
