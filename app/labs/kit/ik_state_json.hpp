// The state that an IK solver keeps between solves, in scene files.
//
//     {"rotations": [[x, y, z, w], ...],
//      "pole": {"turn": "whole_chain", "pole": [...], "target": [...], "twist_deg": 0, "joints": [...]},
//      "limits": {"limited": false, "target": [...], "damping": 0}}
//
// Places are in metres from the root. `pole` and `limits` are there if the last solve had them.
#pragma once

#include <glm/vec3.hpp>
#include <tendril/ik/state.hpp>
#include <vector>

#include "app/document/json_place.hpp"
#include "app/document/names.hpp"

namespace tendril::app {

inline constexpr EnumNames<ik::PoleTurn, 2> pole_turns{
    "pole turn", {{"whole_chain", "whole chain"}, {"each_joint", "each joint"}}};

Json save_ik_state(const ik::State& state);
/// Of so many bones; at rest where there are no rotations. `joints` stand in for those of a pole that has
/// none. Throws std::runtime_error that begins with the place of what is wrong.
ik::State load_ik_state(const JsonPlace& place, std::size_t bones, const std::vector<glm::vec3>& joints = {});

}  // namespace tendril::app
