// Units: the small operations that make up a rig, as data. Rig::solve (rig.hpp) runs them in order.
//
// Each operation is one struct of inputs with defaults, and has an output `result`:
//
//     Aim                  the item's transform; see aim.hpp
//     AimMath              the same for a transform input; sets nothing
//     ParentConstraint     the item's transform; see parent_constraint.hpp
//     OffsetTransform      the item's transform, after composing an offset in its own space
//     SetTransform         the item's transform
//     SetRotation          the item's rotation
//     ProjectToParent      transform: the child's initial offset from one parent, on another; sets nothing
//     FromTwoVectors       the shortest rotation from one direction to another; the identity if one is zero
//     TransformLocation    vector: a point out of a transform's space
//     TransformDirection   vector: a direction out of it, rotated but not moved
//     ForEach              number of elements in a list of children; runs a body of units on each
//     AlphaInterpolate     number; see signal/scale_bias_clamp.hpp
//     SpringInterpolate    number, vector or rotation, and its `velocity`; see signal/spring.hpp
//     EvaluateCurve        number; see signal/curve.hpp
//     SetCurve             number written to a named curve: a morph weight, a material parameter
//     TwoBone, Fabrik      metres from the tip to the target; rotate the bones from `root` to `tip`
//     Spline               metres from the tip to the end of a curve through `points`, along which it places
//                          the bones (ik/curve.hpp); "bones_past_end", metres "past_end", fit's "factor"
//
// Every unit has a weight in [0, 1]. At 0 the item is unchanged, bit for bit; an operation without an item
// outputs its input unchanged (FromTwoVectors: the identity). A for-each's weight multiplies its body's
// weights. fields<Unit>() is the table of it all (tendril/fields.hpp): readers, writers, checks and panels
// use it.
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
    Input<glm::dvec3> axis = glm::dvec3(1, 0, 0);  ///< in the item's own space, not zero
    Input<glm::dvec3> target = glm::dvec3(0);      ///< global: a point, or a direction
    AimTarget kind = AimTarget::Location;
    Input<double> weight = 1.0;  ///< weight of this part, in [0, 1]
    bool operator==(const AimInputs&) const = default;
};
struct Aim {
    Item item{};
    AimInputs primary{};
    std::optional<AimInputs> secondary{};
    Input<double> max_speed = 0.0;  ///< degrees per second; 0: no limit
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
    std::vector<ParentInputs> parents{};  ///< 1 to 1000
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
    Item old_parent{}, new_parent{};  ///< the child's initial offset from the one, applied to the other
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
/// A list of units: those of a rig or of a for-each, in the order in which they run. Copies are deep, but
/// rigs made by Rig::with_unit() share unchanged units: these compare fast, and must never change.
class Units {
    template <class List, class Element>
    struct Iterator {
        using value_type = Unit;
        using difference_type = std::ptrdiff_t;
        List* list = nullptr;
        std::size_t at = 0;
        Element& operator*() const noexcept { return (*list)[at]; }
        Element* operator->() const noexcept { return &(*list)[at]; }
        Iterator& operator++() noexcept { return ++at, *this; }
        Iterator operator++(int) noexcept { return {list, at++}; }
        bool operator==(const Iterator&) const = default;
    };

  public:
    Units() noexcept;
    Units(std::initializer_list<Unit> units);
    Units(const Units& other);
    Units(Units&& other) noexcept;
    Units& operator=(Units other) noexcept;
    ~Units();

    std::size_t size() const noexcept { return held_.size(); }
    bool empty() const noexcept { return held_.empty(); }
    const Unit& operator[](std::size_t index) const noexcept { return *held_[index]; }
    Unit& operator[](std::size_t index) noexcept { return *held_[index]; }
    const Unit& back() const noexcept { return (*this)[size() - 1]; }
    Unit& back() noexcept { return (*this)[size() - 1]; }
    auto begin() const noexcept { return Iterator<const Units, const Unit>{this, 0}; }
    auto begin() noexcept { return Iterator<Units, Unit>{this, 0}; }
    auto end() const noexcept { return Iterator<const Units, const Unit>{this, size()}; }
    auto end() noexcept { return Iterator<Units, Unit>{this, size()}; }
    void push_back(Unit unit);
    void insert(std::size_t index, Unit unit);
    void erase(std::size_t index) noexcept;
    void resize(std::size_t count);
    bool operator==(const Units& other) const noexcept;

  private:
    friend class Rig;
    struct Held;
    /// A copy with one unit replaced. The others are shared: neither list may change any more.
    Units with(std::size_t index, Unit unit) const;

    std::vector<Unit*> held_;  ///< each a Held
};
struct ForEach {
    std::vector<std::string> roots{};  ///< 1 to 1000
    bool include_parent = true;        ///< the roots too
    bool recursive = true;             ///< all descendants, not only direct children
    Units body{};                      ///< must not contain a ForEach
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
    Input<double> critical_damping = 1.0;  ///< 1: fastest without overshoot
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
    Item root{}, tip{};  ///< tip two bones below root
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

/// The root goes to the first point. Each bone turns from its initial pose with the curve.
struct Spline {
    Item root{}, tip{};
    std::vector<std::string> points{};  ///< elements, such as controls; 2 to 4096
    Input<bool> b_spline = false;       ///< CurveKind::BSpline instead of Hermite
    Input<bool> fit = false;            ///< scales the lengths by one factor, so that the tip is on the end
    Input<double> max_factor = 2.0;  ///< limit of `fit`, in either direction; 0 to 100, below 1 counts as 1
    Input<glm::dvec3> up = glm::dvec3(0, 1, 0);
    Input<double> roll_start_deg = 0.0, roll_end_deg = 0.0;
    bool operator==(const Spline&) const = default;
};

/// A variant of all operations. Copying, comparing and destroying it is compiled once, in the library: for
/// eighteen structs it would slow down compiling every file that uses a Unit.
struct Operation
    : std::variant<Aim, AimMath, ParentConstraint, OffsetTransform, SetTransform, SetRotation,
                   ProjectToParent, FromTwoVectors, TransformLocation, TransformDirection, ForEach,
                   AlphaInterpolate, SpringInterpolate, EvaluateCurve, SetCurve, TwoBone, Fabrik, Spline> {
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
/// "parent_constraint", as in scene files; `index` is the index in the Operation variant.
const char* operation_name(std::size_t index) noexcept;

struct Unit {
    std::string name{};  ///< unique in the whole rig, bodies included
    Operation operation{};
    Input<double> weight = 1.0;
    Input<bool> when = true;  ///< false: the unit is skipped
    bool enabled = true;      ///< can be switched off by the user
    bool operator==(const Unit&) const = default;
};

struct Output {
    const char* name;
    Type type;
};
/// The outputs of an operation. The types of a spring's outputs depend on its target; Rig::make decides them.
std::vector<Output> outputs(const Operation& operation);

}  // namespace tendril::rig

namespace tendril {
template <>
std::span<const Field> fields<rig::Unit>() noexcept;
template <>
std::span<const Field> fields<rig::TransformFilter>() noexcept;
}  // namespace tendril
