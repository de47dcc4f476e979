// Hands that hold an object: its grips as constraints on the arms and the object. Not installed.
#pragma once

#include <array>
#include <span>

#include "humanoid/body_solve.hpp"
#include "tendril/humanoid/hold.hpp"

namespace tendril::humanoid::detail {

/// Closes the grips with the arms and the object, once the body has reached for them.
class HoldSolve {
  public:
    HoldSolve(Body& body, const HeldObject& object, const HoldOptions& options) noexcept
        : work_(*body.work_),
          object_(object),
          options_(options),
          turn_length_(options.turn_length.value_or(0.3 * body.work_->size)),
          pose_(object.asked) {
        pose_.rotation = rig::normalised(pose_.rotation);
        target_ = pose_;
    }
    void run(std::span<rig::Transform> pose, HoldReport& report, HoldState& state) noexcept;

  private:
    struct Joint {
        std::size_t link = 0, arm = 0;
        TurnFreedom freedom{};
        double compliance = 0.0;
        glm::dvec3 turn{0.0};
        glm::dvec3 held{0.0};  ///< the part of `turn` that stops at a limit
    };
    struct Arm {
        const Grip* grip = nullptr;
        std::size_t end = 0;  ///< link of the hand
        const BodyLimb* limb = nullptr;
        double min_bend = 0.0;               ///< radians; less bend counts as straight
        glm::dvec3 forearm{0.0};             ///< unit, in the lower arm's frame; zero: it has no length
        glm::dvec3 axis{0.0};                ///< Grip::axis in the character's space, unit or zero
        glm::dvec3 from{0.0};                ///< from the object's origin to the grip
        glm::dvec3 gap{0.0}, turn_gap{0.0};  ///< from the hand to its grip
        glm::dvec3 force{0.0}, torque{0.0};  ///< applied by the grip to the hand
        glm::dvec3 pull_force{0.0}, pull_torque{0.0};  ///< the same while the object pulls; for the report
    };
    struct Row {
        std::size_t arm;
        bool angular;
        glm::dvec3 along;
    };
    /// The derivative of a row with respect to a turn of the joint, or of the object.
    glm::dvec3 column(const Row& row, const Joint& joint) const noexcept;
    glm::dvec3 object_column(const Row& row) const noexcept;
    double row_length(const Row& row) const noexcept { return row.angular ? turn_length_ : 1.0; }

    Link& link(std::size_t index) const noexcept { return work_.links[index]; }
    /// The rotation of the parent link.
    glm::dquat before(const Link& of) const noexcept {
        return of.parent < 0 ? glm::dquat(1.0, 0.0, 0.0, 0.0)
                             : link(static_cast<std::size_t>(of.parent)).rotation;
    }
    void find_arms() noexcept;
    void align_hands() noexcept;
    double bend(const Arm& arm, glm::dvec3& about) const noexcept;
    glm::dquat grip_rotation(const Arm& arm) const noexcept;
    void measure() noexcept;
    double max_gap() const noexcept;
    double find_step() noexcept;
    bool step() noexcept;
    bool solve_rows() noexcept;
    bool block() noexcept;
    void apply(double part) noexcept;
    /// The lower arm's share of a hand's twist, radians.
    double shared_twist(const Arm& arm) const noexcept;
    bool clamp_hand(const Arm& arm) noexcept;
    bool clamp(const Joint& joint) noexcept;
    glm::dvec3 excess(const Joint& joint, const glm::dvec3& turn, glm::dquat& there) noexcept;
    bool block_bounds(Joint& joint, const glm::dquat& turn, const glm::dvec3& step) noexcept;
    bool is_finite() const noexcept;
    void write_report(HoldReport& report, HoldState& state) noexcept;

    Body::Work& work_;
    const HeldObject& object_;
    const HoldOptions& options_;
    double turn_length_;  ///< metres
    ObjectPose pose_, target_;
    std::array<Arm, 2> arms_{};
    std::size_t arm_count_ = 0;
    std::array<Joint, 8> joints_{};
    std::size_t joint_count_ = 0;
    std::array<Row, 12> rows_{};
    std::size_t row_count_ = 0;
    int iterations_ = 0;
    bool failed_ = false;                ///< no finite step was found
    double object_compliance_ = 0.0;     ///< for turns of the object
    double damping_ = 0.0;               ///< damping of the next step
    double pull_ = 1.0;                  ///< 0: the object only follows the hands
    glm::dvec3 shift_{0.0}, turn_{0.0};  ///< the object's move in a step
    RowEquations equations_{};
};

}  // namespace tendril::humanoid::detail
