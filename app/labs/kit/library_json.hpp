// Curves of keys as JSON, in filters and in units of a rig:
//
//     {"keys": [{"time": 0, "value": 0, "arrive": 0, "leave": 0, "piece": "linear"}, ...],
//      "source_min": 0, "source_max": 1, "target_min": 0, "target_max": 1}
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <tendril/ik/state.hpp>
#include <tendril/signal/curve.hpp>
#include <vector>

#include "app/document/json.hpp"
#include "app/document/json_place.hpp"
#include "app/document/names.hpp"

namespace tendril::app {

/// The keys alone; tangents that are flat are left out.
Json curve_keys_json(const signal::Curve& curve);
/// Of a key only time and value have to be there; members that it does not have are not looked at. Throws
/// std::runtime_error that begins with the place of what is wrong. Whether the times are in order
/// signal::check() says.
std::vector<signal::CurveKey> read_curve_keys(const JsonPlace& place);

Json curve_json(const signal::Curve& curve);

/// Those of a curve's members that are there; the others stay.
void read_curve_members(const JsonPlace& place, signal::Curve& curve);
void add_curve_members(std::vector<std::string>& names);

// The state that an IK solver keeps between solves, in scene files.
//
//     {"rotations": [[x, y, z, w], ...],
//      "pole": {"turn": "whole_chain", "pole": [...], "target": [...], "twist_deg": 0, "joints": [...]},
//      "limits": {"limited": false, "target": [...], "damping": 0}}
//
// Places are in metres from the root. `pole` and `limits` are there if the last solve had them.

inline constexpr EnumNames<ik::PoleTurn, 2> pole_turns{
    "pole turn", {{"whole_chain", "whole chain"}, {"each_joint", "each joint"}}};

Json save_ik_state(const ik::State& state);
/// Of so many bones; at rest where there are no rotations. `joints` stand in for those of a pole that has
/// none. Throws std::runtime_error that begins with the place of what is wrong.
ik::State load_ik_state(const JsonPlace& place, std::size_t bones, const std::vector<glm::vec3>& joints = {});

}  // namespace tendril::app
