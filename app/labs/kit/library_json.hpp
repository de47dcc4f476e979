// JSON of the library's states of IK and of springs.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <tendril/fields.hpp>
#include <tendril/ik/state.hpp>
#include <tendril/signal/input.hpp>
#include <tendril/signal/spring.hpp>
#include <vector>

#include "app/io/json.hpp"
#include "app/io/json_place.hpp"
#include "app/io/names.hpp"

namespace tendril::app {

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
    {{"free", "as it is", "The chain keeps its present side."},
     {"left", "left", "To the left of the line from root to tip, as the 2D view shows it."},
     {"right", "right", "To the right of the line from root to tip, as the 2D view shows it."}}};
inline constexpr EnumNames<ik::PoleTurn, 2> pole_turns{
    "pole turn", {{"whole_chain", "whole chain"}, {"each_joint", "each joint"}}};

Json save_ik_state(const ik::State& state);
/// The state of `bones` bones, at rest if the file has no rotations. A pole without joints gets `joints`.
/// Throws std::runtime_error that begins with the JSON path of the fault.
ik::State load_ik_state(const JsonPlace& place, std::size_t bones, const std::vector<glm::vec3>& joints = {});

/// A spring's state as rigs and filters save it. A spring may reach max_output, which the library's own table
/// does not allow.
template <class T>
std::span<const Field> spring_fields() noexcept {
    using State = signal::SpringState<T>;
    constexpr FieldRange outputs{-signal::max_output, signal::max_output};
    static constexpr Field rows[] = {field<&State::value>("value", outputs).needed(),
                                     field<&State::velocity>("velocity", outputs).needed(),
                                     field<&State::previous_target>("previous_target", outputs).needed(),
                                     field<&State::started>("started").needed()};
    return rows;
}

}  // namespace tendril::app
