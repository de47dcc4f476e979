// JSON of the library's IK states, and its names.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <string>
#include <tendril/ik/state.hpp>
#include <vector>

#include "app/document/json.hpp"
#include "app/document/json_place.hpp"
#include "app/document/names.hpp"

namespace tendril::app {

/// The library's names of enumerators that count from 0, for a table of fields.
template <class Enum, std::size_t count>
std::array<const char*, count> library_names() {
    std::array<const char*, count> names{};
    for (std::size_t i = 0; i < count; ++i) names[i] = ik::name(static_cast<Enum>(i));
    return names;
}

// The state that an IK solver keeps between solves, in scene files.
//
//     {"rotations": [[x, y, z, w], ...],
//      "pole": {"turn": "whole_chain", "pole": [...], "target": [...], "twist_deg": 0, "joints": [...]},
//      "limits": {"limited": false, "target": [...], "damping": 0}}
//
// Positions are in metres from the root. `pole` and `limits` are present if the last solve used them.

/// The side to which a chain in a plane bends.
inline constexpr EnumNames<ik::Side, 3> bend_sides{
    "side",
    {{"free", "as it is", "The chain stays on the side that it is on."},
     {"left", "left", "To the left of the line from root to tip, as the 2D view shows it."},
     {"right", "right", "To the right of the line from root to tip, as the 2D view shows it."}}};
inline constexpr EnumNames<ik::PoleTurn, 2> pole_turns{
    "pole turn", {{"whole_chain", "whole chain"}, {"each_joint", "each joint"}}};

Json save_ik_state(const ik::State& state);
/// The state of `bones` bones, at rest if the file has no rotations. `joints` are for a pole without joints.
/// Throws std::runtime_error that begins with the JSON path of the fault.
ik::State load_ik_state(const JsonPlace& place, std::size_t bones, const std::vector<glm::vec3>& joints = {});

}  // namespace tendril::app
