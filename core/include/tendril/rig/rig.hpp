// A compiled rig: solve() runs its units in order, from controls to bones.
//
//     Expected<Rig> rig = Rig::make(definition);       // resolves names and checks types, once
//     State state = rig->initial_state();              // a value: copy it, save it, restore it
//     Workspace workspace(*rig);                       // scratch, kept from frame to frame
//     if (Result bad = rig->set_control(state, *rig->element("dial"), 0.5); !bad) return log(bad.message());
//     rig->solve(state, dt, workspace);                // every frame
//     Transform hand = state.elements.get(rig->id(*rig->element("hand")), Space::Global);
//
// A solve first resets bones and nulls to their input pose (the initial one, until set_element changes it)
// and then runs the units, so solving twice gives the same as solving once. Memory from frame to frame
// (springs) is in the state and changes only with dt. The same state and dt give the same bits. Nothing is
// thrown; memory is allocated only if an IK chain is new or one of its bones has a new length.
//
// A unit that cannot be computed (an aim whose target is at the item) is skipped with a Warning and leaves
// the item unchanged. All results are finite.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "tendril/ik/state.hpp"
#include "tendril/result.hpp"
#include "tendril/rig/definition.hpp"
#include "tendril/signal/scale_bias_clamp.hpp"
#include "tendril/signal/spring.hpp"

namespace tendril::rig {

/// Why a unit, or a part of it, was skipped: the first reason in a solve.
enum class Warning : std::uint8_t {
    None,
    TargetAtItem,        ///< aim: the target is at the item, so there is no direction to it
    ZeroAxis,            ///< aim: an axis of length 0
    SecondaryOnPrimary,  ///< aim: the second target is on the primary axis, so any roll fits
    AxesParallel,        ///< aim: the second axis is parallel to the first
    ZeroWeights,         ///< parent constraint: all weights are 0
    WeightOutOfRange,    ///< a weight from another unit or a control is not in [0, 1]; clamped
    OutOfRange,          ///< the result is not finite, or over max_magnitude
    CannotSolve,         ///< IK: a bone has length 0 or is out of range
    ParameterOutOfRange  ///< a spring's, from another unit or a control: clamped
};
/// "all weights are 0"; empty for None.
const char* message(Warning warning) noexcept;

/// The last rotation of a speed-limited aim.
struct Turned {
    glm::dquat rotation{1, 0, 0, 0};
    bool operator==(const Turned&) const = default;
};
/// A unit's memory of one element from solve to solve.
struct UnitMemory {
    std::variant<std::monostate, Turned, signal::OutputState, signal::SpringState<double>,
                 signal::SpringState<glm::dvec3>, signal::SpringState<glm::dquat>, ik::State>
        held;
    bool operator==(const UnitMemory&) const = default;
};
struct UnitState {
    std::vector<UnitMemory> memory{};  ///< one; in the body of a for-each one per visited element
    std::vector<Value> outputs;        ///< from the last solve, in the order of outputs()
    Warning warning = Warning::None;
    bool operator==(const UnitState&) const = default;
};

struct State {
    Hierarchy elements;                  ///< see Rig::id
    std::vector<Value> controls{};       ///< one per element; `false` if it is no control
    std::vector<double> curves{};        ///< after the units, in the order of Definition::curves
    std::vector<double> input_curves{};  ///< before the units
    std::vector<UnitState> units{};      ///< in the order of Rig::unit_names
    bool operator==(const State&) const = default;
};

namespace detail {
struct Plan;
}
class Workspace;

/// Called after each unit of the definition (not of bodies), whether it ran or was skipped. May read the
/// state.
class Observer {
  public:
    virtual ~Observer() = default;
    /// Everything is reset, no unit has run.
    virtual void begin(State&) {}
    /// `unit` is its index in Definition::units.
    virtual void unit_done(std::size_t unit, State& state) = 0;
};

class Rig {
  public:
    /// Refused: a name that is empty or used twice, a parent that is missing or below its child, an input
    /// that names something missing, running later or of another type, a literal out of range. The message
    /// names the unit, the input and the value.
    static Expected<Rig> make(Definition definition);
    /// This rig with the unit of that name replaced, as make() would return it. If only values or links
    /// change, the new rig shares everything but its definition with this one, so moving a slider costs one
    /// copy of the definition. Refused as by make(), and NotFound for an unknown name.
    Expected<Rig> with_unit(Unit unit) const;
    /// A moved-from rig has no elements, curves or units.
    Rig(const Rig&) noexcept;
    Rig(Rig&&) noexcept;
    Rig& operator=(const Rig&) noexcept;
    Rig& operator=(Rig&&) noexcept;
    ~Rig();

    const Definition& definition() const noexcept;

    State initial_state() const;
    /// After an edit: initial_state() with the parts that still apply of `state`, a state of the rig
    /// `before`. Matched by name: elements whose kind, initial transform and control settings are unchanged;
    /// curves; units whose output types are unchanged, with their memory of each element.
    State adopted(const Rig& before, State state) const;
    /// Whether adopted() would return it unchanged, as after with_unit() that changed only values or links.
    bool keeps_states_of(const Rig& before) const noexcept;
    /// Whether `state` belongs to this rig, by its sizes and types; solve() requires it.
    bool fits(const State& state) const noexcept;

    std::optional<std::size_t> element(std::string_view name) const noexcept;
    std::optional<std::size_t> curve(std::string_view name) const noexcept;
    ElementId id(std::size_t element) const noexcept;
    /// The names of all units; those in a body follow their for-each.
    std::span<const std::string> unit_names() const noexcept;

    /// Rough cost of a forward solve, in steps of about 30 ns, for callers that limit their work.
    std::uint64_t work() const noexcept;

    /// Sets the value of a control, clamped to its limits.
    Result set_control(State& state, std::size_t element, const Value& value) const;
    /// Changes the input pose, from which every solve begins, and the current one. A control gets the value
    /// that brings it nearest to that pose within its limits.
    Result set_element(State& state, std::size_t element, Space space, const Transform& transform,
                       Propagate propagate = Propagate::Yes) const;
    /// The global transform of an element at the start of a solve, before any unit has run. O(depth).
    Transform start_pose(const State& state, std::size_t element) const;
    Result set_curve(State& state, std::size_t curve, double value) const;

    /// dt in seconds; units with memory (springs) do not advance if it is not positive. Returns whether any
    /// of them still moves: then solve again next frame even if nothing else changes. With a moved-from
    /// rig or workspace it does nothing.
    bool solve(State& state, double dt, Workspace& workspace, Observer* observer = nullptr) const noexcept;

  private:
    explicit Rig(const detail::Plan* plan) noexcept : plan_(plan) {}
    const detail::Plan& plan() const noexcept;
    const detail::Plan* plan_;  ///< shared with copies; null: moved from
};

}  // namespace tendril::rig
