// Computes the displayed pose from the lab's part: the clip's pose or the rest pose, then everything that
// modifies it, in order. Drawing, state, handles and ticks all use this.
#pragma once

#include <optional>
#include <string>
#include <tendril/humanoid/balance.hpp>
#include <vector>

#include "app/labs/humanoid/ik/ik_settings.hpp"
#include "app/labs/humanoid/ik/solvers.hpp"

namespace tendril::app {

struct ShownPose {
    std::vector<rig::Transform> local;
    std::vector<rig::Transform> before_springs;
    std::vector<humanoid::Placement> placed;
    /// The clip's pose before anything modified it; empty if nothing did.
    std::vector<humanoid::Placement> before;
    std::vector<humanoid::Placement> ghost;       ///< `before`, and without the clip's fixes
    std::optional<humanoid::BodyReport> body;     ///< if there is a target
    std::optional<humanoid::HoldReport> hold;     ///< if the hands hold an object
    humanoid::ObjectPose hips;                    ///< before IK of the body, turned from rest
    std::optional<humanoid::HandsReport> hands;   ///< if hand IK is on
    std::optional<humanoid::LookAtReport> look;   ///< if look-at is on
    std::optional<humanoid::FeetReport> feet;     ///< if foot IK is on
    humanoid::FeetState feet_state;               ///< the state of foot IK after it
    FeetHistory::Deepest deepest{};               ///< the deepest that a foot was in the ground lately
    std::vector<ik::CurveReport> curves;          ///< in the order of the part's curves
    std::vector<humanoid::SpringReport> springs;  ///< in the order of the part's springs
    std::array<humanoid::SolePoints, 2> soles{};  ///< left, right
    bool has_soles = false;
    struct Balance {
        humanoid::Support support;
        glm::dvec3 centre{0.0};  ///< the centre of mass
        double margin = 0.0;     ///< Support::margin() of the centre, metres
    };
    std::optional<Balance> balance;   ///< if balance is on
    std::array<bool, 2> hand_goes{};  ///< whether hand IK moves it to its target
    std::string refused;              ///< why targets are ignored: the library's message

    /// Distance between an effector and its target, metres; empty if it has none.
    std::optional<double> residual(humanoid::Effector effector) const;
    glm::vec3 point(std::size_t node) const { return glm::vec3(placed[node].position); }
};

/// Solves the pose `dt` seconds after `state` and updates `state`. With a dt of 0 no time passes, and the
/// same part gives the same pose again. Feet on the ground depend on settings and clip time alone.
ShownPose solve_pose(const HumanoidPart& part, Solvers& solvers, double dt, IkState& state);

// Input of the solvers, also for exported code.

/// The clip's pose, or the rest pose, before anything modifies it.
std::vector<rig::Transform> unsolved_pose(const HumanoidPart& part);
/// Without targets of hands that hand IK moves.
std::vector<humanoid::BodyTarget> body_targets(const IkSettings& ik);
/// Without the stepping feet.
humanoid::BodyOptions body_options(const HumanoidPart& part, Solvers& solvers);
/// True if full-body IK runs before gaze and hands: for a target, a held object or a foot that stepped away.
bool body_acts(const HumanoidPart& part, const IkState& state);
humanoid::FeetOptions feet_options(const HumanoidPart& part, Solvers& solvers);
/// `body_solved`: targets hold the body, so only neck and head turn.
humanoid::LookAtOptions look_options(const HumanoidPart& part, bool body_solved);
humanoid::HandTargets hand_targets(const HumanoidPart& part);

/// Moves the springs rigidly with a pose that was set, not reached over time.
void carry_springs(Workspace& workspace);

/// Why a foot follows the clip although foot IK is on; empty if the ground moves it. `side`: 0 is left.
std::string why_alone(const HumanoidPart& part, const ShownPose& shown, std::size_t side);

/// The centre of mass in words: "4 cm inside the feet", "7 cm ahead of the feet", "stepping". Needs balance.
std::string balance_text(const HumanoidPart& part, const ShownPose& shown, Solvers& solvers);
/// Why balance is on but does nothing, or a foot does not step; empty if it acts.
std::string why_no_balance(const HumanoidPart& part, const ShownPose& shown, Solvers& solvers);

/// Why foot IK hardly ever plants a foot in this clip; empty if it does, or if the foot is planted now.
std::string why_in_air(const HumanoidPart& part, const ShownPose& shown, Solvers& solvers, std::size_t side);

/// How deep a foot was in the ground lately, and why; empty up to `max_depth`.
std::optional<FeetHistory::Deepest> foot_in_ground(const ShownPose& shown);
std::string why_in_ground(const HumanoidPart& part, const FeetHistory::Deepest& deepest);
inline constexpr double max_depth = 0.01;  ///< metres

/// The displayed pose of the lab's part, cached until the part changes. Valid until the next call.
const ShownPose& shown_pose(const Workspace& workspace);
/// For commands on IK: solves, and stores the state. Throws std::invalid_argument for a refused target.
void solve_now(Workspace& workspace);

// Releasing a target: its limb eases back to the clip, and so does the body where only that target held it.
//
// The new pose is computed at once. While a clip plays, the difference to the old pose is stored and fades
// out (inertialization: D. Bollo, "Inertialization: High-Performance Animation Transitions in Gears of War",
// GDC 2018), so no joint jumps, whatever changed. Without a playing clip the limb returns at once.

inline constexpr double release_seconds = 1.0;  ///< until everything has settled
inline constexpr double fade_seconds = 0.2;     ///< until the limb is back
/// Speed at which the rest of the body approaches the clip, m/s of a target.
inline constexpr double settle_speed = 1.2;

/// The fading difference: rotations and hips translation from `now` to `before`.
Release release_between(const std::vector<rig::Transform>& before, const std::vector<rig::Transform>& now,
                        std::optional<std::size_t> hips);
/// 1 right after the release, 0 once it has faded out.
double fading(const Release& release);
void apply(const Release& release, std::vector<rig::Transform>& pose, std::optional<std::size_t> hips);
/// Advances time; becomes empty at the end.
void pass(Release& release, double seconds);
/// For a new target: drops any fading that would keep its limb from reaching it at once.
void forget_on_the_way_to(Release& release, const humanoid::Skeleton& skeleton, std::size_t node);

}  // namespace tendril::app
