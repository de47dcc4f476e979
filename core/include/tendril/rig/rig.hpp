// A rig that solves: units run in order, from controls to bones.
//
//     Expected<Rig> rig = Rig::make(definition);       // names resolved, types checked, once
//     State state = rig->initial_state();              // a value: copy it, save it, put it back
//     Workspace workspace(*rig);                       // scratch, kept from frame to frame
//     if (Result bad = rig->set_control(state, *rig->element("dial"), 0.5); !bad) return log(bad.message());
//     rig->solve(state, dt, workspace);                // every frame
//     Transform hand = state.elements.get(rig->id(*rig->element("hand")), Space::Global);
//
// A solve first puts bones and nulls back to their input pose (the initial one, until set_element changes it)
// and then runs the units, so solving twice gives what solving once gives; what has to be remembered from
// frame to frame (springs) is in the state, and changes with dt alone. The same state and dt give the same
// bits. Nothing is thrown, nor allocated but where an IK chain is new, or a bone of it has a new length.
//
// What cannot be computed as asked (an aim whose target is where the item is) is left out with a Warning, and
// the item stays as it is; nothing that is not finite comes out.
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

/// Why a unit, or a part of it, was left out. The first of a solve.
enum class Warning : std::uint8_t {
    None,
    TargetAtItem,        ///< aim: the target is where the item is, there is no direction to it
    ZeroAxis,            ///< aim: an axis of no length
    SecondaryOnPrimary,  ///< aim: the second target is on the primary axis, every roll is as good
    AxesParallel,        ///< aim: the second axis is the first or its opposite
    ZeroWeights,         ///< parent constraint: all weights are 0
    WeightOutOfRange,    ///< a weight that another unit or a control gave is not in [0, 1], and was clamped
    OutOfRange,          ///< the result is not finite, or over max_magnitude
    CannotSolve,         ///< IK: bones of no length
    ParameterOutOfRange  ///< of a spring, given by another unit or a control: clamped
};
/// "the target is where the item is"; empty for None.
const char* message(Warning warning) noexcept;

/// The rotation that a speed-limited aim ended with.
struct Turned {
    glm::dquat rotation{1, 0, 0, 0};
    bool operator==(const Turned&) const = default;
};
/// What a unit remembers of one element from solve to solve.
struct UnitMemory {
    std::variant<std::monostate, Turned, signal::OutputState, signal::SpringState<double>,
                 signal::SpringState<glm::dvec3>, signal::SpringState<glm::dquat>, ik::State>
        held;
    bool operator==(const UnitMemory&) const = default;
};
struct UnitState {
    std::vector<UnitMemory> memory{};  ///< one; in the body of a for-each one an element that it comes to
    std::vector<Value> outputs;        ///< of the last solve, in the order of outputs()
    Warning warning = Warning::None;
    bool operator==(const UnitState&) const = default;
};

struct State {
    Hierarchy elements;                  ///< see Rig::id
    std::vector<Value> controls{};       ///< one an element; `false` of what is no control
    std::vector<double> curves{};        ///< in the order of Definition::curves, after the units
    std::vector<double> input_curves{};  ///< and before them
    std::vector<UnitState> units{};      ///< in the order of Rig::unit_names
    bool operator==(const State&) const = default;
};

namespace detail {
struct Plan;
}
class Workspace;

/// Told after each unit of the definition (not of bodies) that it has run or was skipped. The state may be
/// read.
class Observer {
  public:
    virtual ~Observer() = default;
    /// Everything has been put back, no unit has run.
    virtual void begin(State&) {}
    /// `unit` is its index in Definition::units.
    virtual void unit_done(std::size_t unit, State& state) = 0;
};

class Rig {
  public:
    /// Refused: a name that is empty or used twice, a parent that is missing or its own child, an input that
    /// names what is not there, runs later or has another type, a literal out of its range; the message names
    /// the unit, the input and the value.
    static Expected<Rig> make(Definition definition);
    Rig(const Rig&) noexcept;
    Rig(Rig&&) noexcept;
    Rig& operator=(const Rig&) noexcept;
    Rig& operator=(Rig&&) noexcept;
    ~Rig();

    const Definition& definition() const noexcept;

    State initial_state() const;
    /// After an edit: what `state` of the rig `before` has of elements, curves and units that are here too
    /// (by name, and of the same kind), and what units remember of elements, again by name; the rest as
    /// initial_state.
    State adopted(const Rig& before, const State& state) const;
    /// Whether a state is one of this rig, by its sizes and types; solve takes no other.
    bool fits(const State& state) const noexcept;

    std::optional<std::size_t> element(std::string_view name) const noexcept;
    std::optional<std::size_t> curve(std::string_view name) const noexcept;
    ElementId id(std::size_t element) const noexcept;
    /// Of every unit, those in bodies after the for-each that has them.
    std::span<const std::string> unit_names() const noexcept;

    /// What a forward solve takes, roughly, in steps of some 30 ns: for whoever bounds what he asks for.
    std::uint64_t work() const noexcept;

    /// What a person sets. A value beyond the limits of the control goes to the end of them.
    Result set_control(State& state, std::size_t element, const Value& value) const;
    /// Changes the input pose, from which every solve begins, and the current one. For a control: its value
    /// is then the one that brings it nearest there, within its limits.
    Result set_element(State& state, std::size_t element, Space space, const Transform& transform,
                       Propagate propagate = Propagate::Yes) const;
    /// Where a solve begins with it, global, before any unit has run. O(depth).
    Transform start_pose(const State& state, std::size_t element) const;
    Result set_curve(State& state, std::size_t curve, double value) const;

    /// dt in seconds; what remembers stands still where it is not positive. Returns whether anything that
    /// remembers still moves: then it is worth calling again though nothing was set.
    bool solve(State& state, double dt, Workspace& workspace, Observer* observer = nullptr) const noexcept;

  private:
    explicit Rig(const detail::Plan* plan) noexcept : plan_(plan) {}
    const detail::Plan* plan_;  ///< shared with copies
};

}  // namespace tendril::rig
