// Units: the small operations of which a rig is made, as data. rig.hpp runs them, in order.
//
// Each operation is one struct of inputs with defaults. Every one hands out a `result`; what it computes:
//
//     Aim                  aim.hpp. The item's transform
//     AimMath              the same on a transform that it is given; sets nothing
//     ParentConstraint     parent_constraint.hpp. The item's transform
//     OffsetTransform      composes an offset onto the item, in its own space. Its transform
//     SetTransform         the item's transform
//     SetRotation          the item's rotation
//     ProjectToParent      the child's place at rest in one parent, in another: a transform; sets nothing
//     FromTwoVectors       the shortest rotation from one direction to another; none where one has no length
//     TransformLocation    a point out of a transform's space: a vector
//     TransformDirection   a direction out of it, turned but not moved: a vector
//     ForEach              runs a body of units on each of a chain of children. Their number
//     AlphaInterpolate     signal/scale_bias_clamp.hpp: a number
//     SpringInterpolate    signal/spring.hpp, of numbers, vectors and rotations; also its `velocity`
//     EvaluateCurve        signal/curve.hpp: a number
//     SetCurve             writes a named curve, a morph weight or a value of a material: a number
//     TwoBone, Fabrik      turn the bones from `root` to `tip`. Metres left from the tip to the target
//
// Every unit has a weight in [0, 1]: at 0 the item stays as it is, to the bit; an operation without an item
// hands out its input unchanged (identity, for FromTwoVectors). That of a for-each multiplies its body's.
#pragma once

#include <array>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "tendril/rig/aim.hpp"
#include "tendril/rig/input.hpp"
#include "tendril/rig/parent_constraint.hpp"
#include "tendril/signal/curve.hpp"

namespace tendril::rig {

struct AimInputs {
    Input<glm::dvec3> axis = glm::dvec3(1, 0, 0);  ///< of the item, not zero
    Input<glm::dvec3> target = glm::dvec3(0);      ///< global: a point, or a direction
    AimTarget kind = AimTarget::Location;
    Input<double> weight = 1.0;  ///< of this part, in [0, 1]
    bool operator==(const AimInputs&) const = default;
};
struct Aim {
    Item item{};
    AimInputs primary{};
    std::optional<AimInputs> secondary{};
    Input<double> max_speed = 0.0;  ///< degrees a second; 0: no limit
    bool operator==(const Aim&) const = default;
};
struct AimMath {
    Input<Transform> transform{};
    AimInputs primary{};
    std::optional<AimInputs> secondary{};
    Input<double> max_speed = 0.0;
    bool operator==(const AimMath&) const = default;
};
struct ParentInputs {
    Item item{};
    Input<double> weight = 1.0;  ///< 0 or more, relative to the others'
    bool operator==(const ParentInputs&) const = default;
};
struct ParentConstraint {
    Item item{};
    std::vector<ParentInputs> parents{};  ///< at least one
    Input<bool> maintain_offset = true;
    TransformFilter filter{};
    bool operator==(const ParentConstraint&) const = default;
};
struct OffsetTransform {
    Item item{};
    Input<Transform> offset{};
    Input<bool> propagate = true;
    bool operator==(const OffsetTransform&) const = default;
};
struct SetTransform {
    Item item{};
    Input<Transform> transform{};
    Space space = Space::Global;
    Input<bool> propagate = true;
    bool operator==(const SetTransform&) const = default;
};
struct SetRotation {
    Item item{};
    Input<glm::dquat> rotation = glm::dquat(1, 0, 0, 0);
    Space space = Space::Global;
    Input<bool> propagate = true;
    bool operator==(const SetRotation&) const = default;
};
struct ProjectToParent {
    Item child{};
    Item old_parent{}, new_parent{};  ///< the child's place at rest in the one, carried over to the other
    bool operator==(const ProjectToParent&) const = default;
};
struct FromTwoVectors {
    Input<glm::dvec3> from = glm::dvec3(1, 0, 0), to = glm::dvec3(1, 0, 0);
    bool operator==(const FromTwoVectors&) const = default;
};
struct TransformLocation {
    Input<Transform> transform{};
    Input<glm::dvec3> location = glm::dvec3(0);
    bool operator==(const TransformLocation&) const = default;
};
struct TransformDirection {
    Input<Transform> transform{};
    Input<glm::dvec3> direction = glm::dvec3(0);
    bool operator==(const TransformDirection&) const = default;
};

struct Unit;
/// The units of a for-each: a std::vector, but for a Unit that is not known yet.
class Body {
  public:
    Body() noexcept;
    Body(std::initializer_list<Unit> units);
    Body(const Body&);
    Body(Body&&) noexcept;
    Body& operator=(const Body&);
    Body& operator=(Body&&) noexcept;
    ~Body();

    std::vector<Unit>& units() noexcept { return units_; }
    const std::vector<Unit>& units() const noexcept { return units_; }
    bool operator==(const Body& other) const;

  private:
    std::vector<Unit> units_;
};
struct ForEach {
    std::vector<std::string> roots{};  ///< at least one
    bool include_parent = true;        ///< the roots themselves too
    bool recursive = true;             ///< all that is below, not the first level alone
    Body body{};                       ///< no ForEach among them
    bool operator==(const ForEach&) const = default;
};

struct AlphaInterpolate {
    Input<double> value = 0.0;
    Input<bool> map_range = false;
    std::array<double, 2> in_range{0, 1}, out_range{0, 1};
    Input<double> scale = 1.0, bias = 0.0;
    Input<bool> clamp = false;
    Input<double> clamp_min = 0.0, clamp_max = 1.0;
    Input<bool> interp = false;
    Input<double> speed_increasing = 10.0, speed_decreasing = 10.0;
    bool operator==(const AlphaInterpolate&) const = default;
};
struct SpringInterpolate {
    Input<Value> target = Value(0.0);      ///< a number, a vector or a rotation
    Input<double> strength = 4.0;          ///< Hz
    Input<double> critical_damping = 1.0;  ///< 1: as fast as without overshoot
    std::optional<Input<Value>> force{};   ///< a number for numbers, a vector for vectors and rotations
    Input<double> target_velocity_amount = 0.0;
    bool operator==(const SpringInterpolate&) const = default;
};
struct EvaluateCurve {
    Input<double> value = 0.0;
    signal::Curve curve{};
    bool operator==(const EvaluateCurve&) const = default;
};
struct SetCurve {
    std::string curve{};
    Input<double> value = 0.0;
    detail::Resolved resolved{};
    bool operator==(const SetCurve&) const = default;
};
struct TwoBone {
    Item root{}, tip{};  ///< two bones apart
    Input<glm::dvec3> target = glm::dvec3(0);
    std::optional<Input<glm::dvec3>> pole_target{};
    bool operator==(const TwoBone&) const = default;
};
struct Fabrik {
    Item root{}, tip{};
    Input<glm::dvec3> target = glm::dvec3(0);
    std::optional<Input<glm::dvec3>> pole_target{};
    bool operator==(const Fabrik&) const = default;
};

/// A variant of all of them. What copying, comparing and destroying one takes is compiled once, in the
/// library: seventeen structs of inputs are much to ask of every file that has a Unit.
struct Operation
    : std::variant<Aim, AimMath, ParentConstraint, OffsetTransform, SetTransform, SetRotation,
                   ProjectToParent, FromTwoVectors, TransformLocation, TransformDirection, ForEach,
                   AlphaInterpolate, SpringInterpolate, EvaluateCurve, SetCurve, TwoBone, Fabrik> {
    using Variant = variant;
    using variant::variant;
    using variant::operator=;
    Operation() noexcept;
    Operation(const Operation&);
    Operation(Operation&&) noexcept;
    Operation& operator=(const Operation&);
    Operation& operator=(Operation&&) noexcept;
    ~Operation();
    bool operator==(const Operation& other) const;
};
/// "parent_constraint", as in scene files; in the order of Operation.
const char* operation_name(std::size_t index) noexcept;

struct Unit {
    std::string name{};  ///< one of its own in the whole rig, bodies included
    Operation operation{};
    Input<double> weight = 1.0;
    Input<bool> when = true;  ///< where it is false the unit is skipped
    bool enabled = true;      ///< switched off by a person
    bool operator==(const Unit&) const = default;
};

struct Output {
    const char* name;
    Type type;
};
/// What an operation hands out. A spring hands out what it is given: its type is decided by Rig::make.
std::vector<Output> outputs(const Operation& operation);

}  // namespace tendril::rig
