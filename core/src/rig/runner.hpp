// One forward solve. Not installed.
#pragma once

#include <optional>

#include "rig/plan.hpp"
#include "rig/value.hpp"
#include "rig/workspace.hpp"
#include "tendril/ik/method.hpp"
#include "tendril/rig/collect.hpp"

namespace tendril::rig {

/// Runs the units of a rig on a state in order. Each operator() computes its operation for `unit_`, and in
/// the body of a for-each for `visit_`.
class Runner {
  public:
    Runner(const detail::Plan& plan, State& state, double dt, Workspace::Parts& workspace) noexcept
        : plan_(plan), state_(state), dt_(dt), workspace_(workspace) {}

    /// Returns true while anything with memory still moves.
    bool run(Observer* observer) noexcept;

    void operator()(const Aim& op) noexcept;
    void operator()(const AimMath& op) noexcept;
    void operator()(const ParentConstraint& op) noexcept;
    void operator()(const OffsetTransform& op) noexcept;
    void operator()(const SetTransform& op) noexcept;
    void operator()(const SetRotation& op) noexcept;
    void operator()(const ProjectToParent& op) noexcept;
    void operator()(const FromTwoVectors& op) noexcept;
    void operator()(const TransformLocation& op) noexcept;
    void operator()(const TransformDirection& op) noexcept;
    void operator()(const ForEach& op) noexcept;
    void operator()(const AlphaInterpolate& op) noexcept;
    void operator()(const SpringInterpolate& op) noexcept;
    void operator()(const EvaluateCurve& op) noexcept;
    void operator()(const SetCurve& op) noexcept;
    void operator()(const TwoBone& op) noexcept;
    void operator()(const Fabrik& op) noexcept;
    void operator()(const Spline& op) noexcept;

  private:
    void reset_pose() noexcept;
    void run_unit(const Unit& unit) noexcept;

    // input
    template <class T>
    T read(const Input<T>& input) noexcept;
    Value value_of(const FromElement& from) noexcept;
    ElementId item(const Item& item) const noexcept;
    double weight(const Input<double>& input) noexcept;
    /// Clamps the input to 0 to `maximum`, and warns if it is outside.
    double parameter(const Input<double>& input, double maximum) noexcept;
    const Transform& global(const Item& item) noexcept {
        return state_.elements.get(this->item(item), Space::Global);
    }

    // output
    void warn(Warning warning) noexcept;
    void set_output(std::size_t output, const Value& value) noexcept;
    void place(ElementId id, Space space, const Transform& to, bool propagate) noexcept;
    UnitState& unit_state() noexcept { return state_.units[unit_]; }
    UnitMemory& memory() noexcept { return unit_state().memory[visit_ ? visit_index_ : 0]; }

    Transform aimed(const Transform& from, const AimInputs& primary,
                    const std::optional<AimInputs>& secondary, const Input<double>& max_speed) noexcept;
    AimPart part(const AimInputs& inputs) noexcept;
    template <class T>
    void spring(const SpringInterpolate& op, const T& target) noexcept;
    void solve_chain(ik::Method method, const Input<glm::dvec3>& target,
                     const std::optional<Input<glm::dvec3>>& pole_target) noexcept;
    bool measure_chain(ChainScratch& chain);
    bool prepare_chain(ChainScratch& chain);
    void measure_rest_directions(ChainScratch& chain);
    void pose_spline_chain(const ChainScratch& chain, const glm::dvec3& first, double factor) noexcept;
    float bone_length(std::size_t bone) noexcept;
    void turn_bones(const ChainScratch& chain) noexcept;
    glm::dvec3 bone_position(std::size_t bone) noexcept;

    const detail::Plan& plan_;
    State& state_;
    double dt_;
    Workspace::Parts& workspace_;

    std::size_t unit_ = 0;  ///< index in Plan::units
    std::size_t next_ = 0;  ///< index of the next unit
    const detail::Visit* visit_ = nullptr;
    std::size_t visit_index_ = 0;
    double weight_ = 1.0;
    double for_each_weight_ = 1.0;  ///< weight of the surrounding for-each
    bool skipped_ = false;          ///< true at weight 0: memory does not advance
    bool moving_ = false;
};

template <class T>
T Runner::read(const Input<T>& input) noexcept {
    if (const T* literal = input.literal()) return *literal;
    Value value;
    if (const auto* from = std::get_if<FromElement>(&input.source)) {
        value = value_of(*from);
    } else if (const auto* unit = std::get_if<FromUnit>(&input.source)) {
        value = state_.units[static_cast<std::size_t>(unit->resolved_unit.index)]
                    .outputs[static_cast<std::size_t>(unit->resolved_output.index)];
    } else {
        const double index = visit_->index, count = visit_->count;
        switch (std::get<Each>(input.source)) {
            case Each::Index:
                value = index;
                break;
            case Each::Count:
                value = count;
                break;
            case Each::Ratio:
                value = loop_ratio(visit_->index, visit_->count);
        }
    }
    if constexpr (std::is_same_v<T, Value>) {
        return value;
    } else {
        if (const T* same = std::get_if<T>(&value)) return *same;
        if constexpr (std::is_same_v<T, double>) return std::get<bool>(value) ? 1.0 : 0.0;
        if constexpr (std::is_same_v<T, glm::dvec3>) return std::get<Transform>(value).translation;
        if constexpr (std::is_same_v<T, glm::dquat>) return std::get<Transform>(value).rotation;
        return T();
    }
}

}  // namespace tendril::rig
