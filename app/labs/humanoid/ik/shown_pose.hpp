// The one way from the lab's part to what is seen: the animation's pose, or the rest pose, and what changes
// it, in that order. Picture, state and handles all ask here, and a tick goes the same way.
#pragma once

#include <optional>
#include <vector>

#include "app/labs/humanoid/ik/ik_settings.hpp"
#include "app/labs/humanoid/ik/solvers.hpp"

namespace tendril::app {

struct ShownPose {
    std::vector<rig::Transform> local;
    std::vector<rig::Transform> before_springs;
    std::vector<humanoid::Placement> placed;
    /// Before anything changed it; empty where nothing does.
    std::vector<humanoid::Placement> before;
    std::optional<humanoid::BodyReport> body;     ///< where there is a target
    std::optional<humanoid::HandsReport> hands;   ///< where hand IK is on
    std::optional<humanoid::LookAtReport> look;   ///< where look-at is on
    std::optional<humanoid::FeetReport> feet;     ///< where foot IK is on
    std::vector<humanoid::SpringReport> springs;  ///< in the order of the part's
    std::array<humanoid::SolePoints, 2> soles{};  ///< left, right
    bool has_soles = false;
    std::array<bool, 2> hand_goes{};  ///< to its target by hand IK
    std::string refused;              ///< why targets are left alone, in the library's words

    /// What is left between an effector and its target, metres; nothing without one.
    std::optional<double> residual(humanoid::Effector effector) const;
    glm::vec3 point(std::size_t node) const { return glm::vec3(placed[node].position); }
};

/// `state` is what IK remembers; it becomes what it remembers then, `dt` seconds later. With 0 no time
/// passes: the same part gives the same pose again.
ShownPose solve_pose(const HumanoidPart& part, Solvers& solvers, double dt, IkState& state);

/// The pose was set, not reached in time: springs go along with it and swing on from there.
void carry_springs(Workspace& workspace);

/// Why a foot keeps to the clip though foot IK is on, in words; empty where it does not. `side`: 0 left.
std::string why_alone(const HumanoidPart& part, const ShownPose& shown, std::size_t side);

/// The lab's part as it is shown now, worked out once for each of its values. The reference holds until the
/// next call.
const ShownPose& shown_pose(const Workspace& workspace);
/// Where the character stands: below its hips, or its first node.
glm::vec3 standing_at(const Workspace& workspace);
/// For commands that change what IK does: it remembers where it is now. Throws std::invalid_argument where
/// the library refuses a target.
void solve_now(Workspace& workspace);

// What comes after a target is let go: the limb eases back to the clip, and the rest of the body gives up
// what only that target has asked of it.
//
// The pose that follows is worked out at once. While a clip plays, what the pose was beyond it is kept and
// fades out (inertialization: D. Bollo, "Inertialization: High-Performance Animation Transitions in Gears of
// War", GDC 2018), so that no joint leaps, whatever it was that changed. Where no clip plays the limb is back
// at once.

inline constexpr double release_seconds = 1.0;  ///< until all is settled
inline constexpr double fade_seconds = 0.2;     ///< of that, at its beginning: until the limb is back
/// Of a target, in m/s, with which the rest of the body comes nearer to the clip.
inline constexpr double settle_speed = 1.2;

/// What fades out: rotations and the hips' way from `now` to `before`, two poses of one character.
Release release_between(const std::vector<rig::Transform>& before, const std::vector<rig::Transform>& now,
                        std::optional<std::size_t> hips);
/// 1 just after the target was let go, 0 once it has faded out.
double fading(const Release& release);
void apply(const Release& release, std::vector<rig::Transform>& pose, std::optional<std::size_t> hips);
/// Some seconds later; empty when it is over.
void pass(Release& release, double seconds);
/// For a target that is new: what it reaches for is reached at once.
void forget_on_the_way_to(Release& release, const humanoid::Skeleton& skeleton, std::size_t node);

}  // namespace tendril::app
