// The cases of `tendril solve`: a list of
//
//   {"name": "arm", "lengths": [0.5, 0.4], "target": [0.3, 0.6, 0]}
//
// and optionally "start" and "rest" (a point for each joint), "pole" (a point), "limits" (one for each bone,
// at the joint that it starts from, as solver_json.hpp has them; null is none). Other keys are not looked at.
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <tendril/ik/limit.hpp>
#include <vector>

#include "app/document/json.hpp"

namespace tendril::app {

struct Case {
    std::string name;            ///< its place in the list where it has none
    std::vector<float> lengths;  ///< metres, one a bone
    std::vector<glm::vec3> rest_directions;
    std::vector<glm::vec3> start;  ///< one more than bones; straight along +X from the origin if not given
    glm::vec3 target{0.0f};
    std::optional<glm::vec3> pole;
    std::vector<ik::Limit> limits;  ///< one a bone, or none at all
};

/// Throws std::runtime_error that begins with the place of what is wrong there: "cases.3.lengths.0".
Case case_from_json(const Json& json, const std::string& where, std::size_t index);

/// Calls `take` with one case after another, and how far into the text it is (0 to 1), until it returns
/// false. Throws std::runtime_error that begins with the line of what is wrong.
void read_cases(std::string_view text, const std::function<bool(const Case&, double)>& take);

}  // namespace tendril::app
