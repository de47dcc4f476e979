// One solve of a body: steps of damped least squares, joints kept within their limits. Not installed.
#pragma once

#include <optional>

#include "humanoid/body_work.hpp"

namespace tendril::humanoid::detail {

/// Symmetric positive definite equations, and Cholesky's method for them.
struct RowEquations {
    std::size_t count = 0;
    std::array<std::array<double, max_rows>, max_rows> a{};  ///< the lower half
    std::array<double, max_rows> b{};

    bool factorise() noexcept;
    /// Leaves the answer in b.
    void solve() noexcept;
};

class BodySolve {
  public:
    BodySolve(Body::Work& work, std::span<const BodyTarget> targets, const BodyOptions& options) noexcept;
    /// None, and nothing has changed, where no finite pose comes of it.
    std::optional<BodyReport> run(std::span<rig::Transform> pose, BodyState& state) noexcept;

  private:
    /// What an effector is to reach: a person's target, or where the clip has a foot.
    struct Goal {
        std::size_t effector;
        glm::dvec3 position;
        double weight;
        const BodyTarget* target;  ///< null: a foot that stays
        const BodyLimb* limb;      ///< null: the head, the hips
        glm::dvec3 left{0.0};      ///< metres to go, as the solve takes its limb to be
        glm::dvec3 stuck{0.0};     ///< of that, what the last step did not bring nearer
    };
    /// Two capsules that are near each other.
    struct Contact {
        const Pair* pair;
        glm::dvec3 first, second;  ///< where they come nearest
        glm::dvec3 apart;          ///< unit, from the second to the first
        double gap;                ///< metres; negative: too near
        int row = -1;              ///< of the equations, where it holds in this step
        bool let_go = false;       ///< it would have held them together
    };
    struct Row {
        glm::dvec3 shift;  ///< what it gains by the hips' way
        double left;       ///< metres to go
        double weight;
    };
    struct Step {
        unsigned rows = 0;        ///< a bit for each that its turn moves
        glm::dvec3 turn{0.0};     ///< a rotation vector in the character's space
        glm::dvec3 back{0.0};     ///< the one towards the clip's pose
        glm::dvec3 hinge{0.0};    ///< the axis of one, in the character's space
        double compliance = 0.0;  ///< radians for a torque
        int blocked = 0;
        std::array<glm::dvec3, 3>
            outward{};  ///< at right angles to each other: where its limit does not let it turn
    };

    void set_goals() noexcept;
    void start(std::span<const rig::Transform> pose, const BodyState& state) noexcept;
    /// Where the links are for their turns; half the weighed squares of what is left.
    double measure() noexcept;
    Link& end_of(std::size_t effector) const noexcept {
        return work_.links[static_cast<std::size_t>(work_.ends[effector])];
    }
    /// How far the goals are from where the last solve took them to be, metres; what a change of weights may
    /// move counts as such a way.
    double goals_moved(const BodyState& state) const noexcept;
    /// How far a joint has come in this solve, metres.
    double farthest() const noexcept;
    void slow_down(double part, double pace) noexcept;
    void find_step(double damping, double part_back, double budget) noexcept;
    void solve_rows(double damping) noexcept;
    /// Blocks what would leave its limit in this step, and lets capsules touch that would pass into each
    /// other; false where nothing new does.
    bool update_active_set() noexcept;
    bool block_limits() noexcept;
    bool hold_contacts() noexcept;
    void find_contacts() noexcept;
    double contact_cost() const noexcept;
    /// Metres, of capsules in each other.
    double deepest() const noexcept;
    void add_goal_rows() noexcept;
    void add_contact_row(Contact& contact) noexcept;
    /// What the gap gains by a turn of a link; zero where that moves both or none.
    glm::dvec3 contact_column(const Contact& contact, std::size_t link) const noexcept;
    glm::dvec3 let(std::size_t link, const glm::dvec3& torque) const noexcept;
    double step_size() const noexcept;
    void keep() noexcept;
    void put_back() noexcept;
    void apply(double part) noexcept;
    void turn_ends() noexcept;
    bool give(std::span<rig::Transform> pose) noexcept;
    void turn_end(const Goal& goal) noexcept;
    void report(std::span<const rig::Transform> pose, BodyReport& report) noexcept;

    Body::Work& work_;
    std::span<const BodyTarget> targets_;
    const BodyOptions& options_;
    bool touches_;  ///< capsules are kept apart
    std::array<Goal, effector_count> goals_{};
    std::size_t count_ = 0;
    std::array<glm::dvec3, effector_count> clip_{};  ///< where the clip has the effectors
    bool hips_given_ = false;                        ///< their rotation is a target's
    double back_ = 0.0;                              ///< the largest turn back of the step, radians
    glm::dvec3 shift_{0.0}, shift_step_{0.0}, shift_back_{0.0};
    std::array<Step, bone_count> steps_{};
    std::array<std::array<glm::dvec3, max_rows>, bone_count>
        columns_{};  ///< what a row gains by a turn of a link
    std::array<Row, max_rows> rows_{};
    std::size_t row_count_ = 0;
    std::array<Contact, max_contacts> contacts_{};
    std::size_t contact_count_ = 0;
    RowEquations equations_{};
    std::array<double, max_rows> pull_{};
};

}  // namespace tendril::humanoid::detail
