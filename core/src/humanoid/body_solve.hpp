// One solve of a body: steps of damped least squares, with joints kept within their limits. Not installed.
#pragma once

#include <optional>

#include "humanoid/balance.hpp"
#include "humanoid/body_tuning.hpp"
#include "humanoid/body_work.hpp"
#include "humanoid/joint_turn.hpp"

namespace tendril::humanoid::detail {

/// Symmetric positive definite equations, solved by Cholesky's method.
struct RowEquations {
    std::size_t count = 0;
    std::array<std::array<double, max_rows>, max_rows> a{};  ///< lower triangle; then its factor
    std::array<double, max_rows> b{};

    bool factorise() noexcept;
    /// Replaces b by the solution.
    void solve() noexcept;
};

class BodySolve {
  public:
    BodySolve(Body::Work& work, std::span<const BodyTarget> targets, const BodyOptions& options) noexcept;
    /// nullopt, with pose and state unchanged, if there is no finite pose.
    std::optional<BodyReport> run(std::span<rig::Transform> pose, BodyState& state) noexcept;

  private:
    /// The goal of an effector: a target, or the clip's position of a foot.
    struct Goal {
        std::size_t effector;
        glm::dvec3 position;
        double weight;
        const BodyTarget* target;  ///< null: a foot that stays
        const BodyLimb* limb;      ///< null: the head, the hips
        glm::dvec3 error{0.0};     ///< from effector to position, metres, corrected by BodyLimb::shortening()
        glm::dvec3 stalled{0.0};   ///< the part of `error` that the last step failed to reduce
    };
    /// Two capsules near each other.
    struct Contact {
        const Pair* pair;
        glm::dvec3 first, second;  ///< nearest points
        glm::dvec3 normal;         ///< unit, from the second to the first
        double gap;                ///< metres; negative: too near
        int row = -1;              ///< its equation; -1: inactive in this step
        bool released = false;     ///< its row would have pulled the two together
    };
    struct Row {
        glm::dvec3 shift;  ///< gradient with respect to the hips' position
        double error;      ///< metres
        double weight;
    };
    struct Step {
        unsigned rows = 0;         ///< a bit for each equation that its turn affects
        glm::dvec3 turn{0.0};      ///< a rotation vector in the character's space
        glm::dvec3 relaxing{0.0};  ///< the part of `turn` towards the clip's pose
        double compliance = 0.0;   ///< radians per unit torque
        TurnFreedom freedom{};
    };

    struct FootPlace {
        glm::dquat turn;  ///< Link::turn
        glm::dvec3 goal;  ///< for a foot that stays: moves along as it rolls
        SolePoints sole;
        SoleHeights heights;
        bool tilted;  ///< by the ankle's limit
    };

    void set_goals() noexcept;
    void start(std::span<const rig::Transform> pose, const BodyState& state) noexcept;
    /// Updates links, limbs, goals and contacts. Returns half the weighted sum of squared errors.
    double measure() noexcept;
    Link& end_of(std::size_t effector) const noexcept {
        return work_.links[static_cast<std::size_t>(work_.ends[effector])];
    }
    /// Distance that the goals have moved since the last solve, metres. Includes contacts, the clip's pose,
    /// and the movement that a change of weights can cause.
    double goals_moved(const BodyState& state) const noexcept;
    /// Maximum distance that a joint or tip has moved in this solve, metres.
    double travel() const noexcept;
    void cut_to(double limit, double part) noexcept;
    void find_step(double damping, const Relaxation& relaxation) noexcept;
    void solve_rows(double damping) noexcept;
    /// Blocks joints that this step would turn past their limits, activates contacts that it would press into
    /// each other and releases those that would pull. False if nothing changed.
    bool update_active_set() noexcept;
    bool block_limits() noexcept;
    bool update_contacts() noexcept;
    // Balance: body_balance.cpp.
    glm::dvec3 centre_of_mass() const noexcept;
    void roll_feet() noexcept;
    void start_balance() noexcept;
    double measure_balance() noexcept;
    void find_mass_arms() noexcept;
    void start_balance_step() noexcept;
    void add_balance_row(const glm::dvec3& out, double by) noexcept;
    static std::optional<std::size_t> side_of(const Goal& goal) noexcept;  ///< 0: left foot, 1: right
    FootPlace foot_at(const Goal& goal, std::size_t side, const glm::dquat& above) const noexcept;
    Support safe_support(const std::array<SolePoints, 2>& soles,
                         const std::array<SoleHeights, 2>& over) const noexcept;
    void add_support_columns(std::size_t goal_index, std::size_t side, const glm::dvec3& out) noexcept;
    bool update_balance() noexcept;

    void find_contacts() noexcept;
    double contact_cost() const noexcept;
    /// Deepest overlap of two capsules, metres.
    double deepest() const noexcept;
    void add_goal_rows() noexcept;
    void add_contact_row(Contact& contact) noexcept;
    /// Gradient of the gap with respect to a link's turn; zero if the turn moves both capsules or neither.
    glm::dvec3 contact_column(const Contact& contact, std::size_t link) const noexcept;
    glm::dvec3 allowed_torque(std::size_t link, const glm::dvec3& torque) const noexcept;
    double step_size() const noexcept;
    void save_turns() noexcept;
    void restore_turns() noexcept;
    void apply(double part) noexcept;
    bool has_rotations() const noexcept;
    void turn_ends() noexcept;
    bool write_pose(std::span<rig::Transform> pose) noexcept;
    /// The rotation that a goal requires of its bone, before clamping to the limit.
    glm::dquat rotation_of_end(const Goal& goal, const Link& link) const noexcept;
    void turn_end(const Goal& goal) noexcept;
    void report(std::span<const rig::Transform> pose, BodyReport& report) noexcept;

    Body::Work& work_;
    std::span<const BodyTarget> targets_;
    const BodyOptions& options_;
    bool collides_;  ///< keep capsules apart
    std::array<Goal, effector_count> goals_{};
    std::size_t count_ = 0;
    std::array<glm::dvec3, effector_count> clip_{};  ///< the effectors' positions in the clip
    bool hips_given_ = false;                        ///< a target sets the hips' rotation
    double relaxation_ = 0.0;                        ///< the step's maximum turn back, radians
    glm::dvec3 shift_{0.0}, shift_step_{0.0}, shift_relaxation_{0.0};
    std::array<Step, bone_count> steps_{};
    std::array<std::array<glm::dvec3, max_rows>, bone_count> columns_{};  ///< Jacobian: link, row
    std::array<Row, max_rows> rows_{};
    std::size_t row_count_ = 0;
    std::array<Contact, max_contacts> contacts_{};
    std::size_t contact_count_ = 0;
    bool balances_ = false;
    std::array<SolePoints, 2> clip_soles_{};
    std::array<SoleHeights, 2> clip_heights_{};
    std::array<SolePoints, 2> soles_{};  ///< in the pose being solved, as are their heights
    std::array<SoleHeights, 2> heights_{};
    std::array<bool, 2> tilted_{};        ///< FootPlace::tilted
    bool foot_target_ = false;            ///< a foot has a target
    Support safe_{};                      ///< where the centre of mass should be
    double allowed_ = 0.0;                ///< the clip's distance outside of it, metres
    double outside_ = 0.0;                ///< the distance outside beyond that, metres
    glm::dvec3 centre_{0.0}, away_{0.0};  ///< the centre of mass; unit, horizontal, away from the safe part
    int balance_row_ = -1;                ///< its equation; -1: inactive in this step
    bool balance_released_ = false;
    std::array<glm::dvec3, bone_count> mass_arms_{};  ///< from a link to the mass it moves, times that mass
    RowEquations equations_{};
    std::array<double, max_rows> forces_{};
};

}  // namespace tendril::humanoid::detail
