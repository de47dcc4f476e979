// Foot IK: adapts the feet of an animation to the actual ground, and keeps them where they stand.
//
//     Expected<Feet> feet = Feet::make(skeleton, match_bones(skeleton));
//     if (!feet) return log(feet.message());
//     FeetState state;                                            // a value: save it, put it back
//     ... each frame:
//     sample(clip, skeleton, seconds, pose);                      // local transforms of all nodes
//     const FeetReport report = feet->step(pose, ground, dt, state);
//     if (report.feet[0].planted) ...                             // `pose` is now the corrected one
//
// A step, in this order:
//
//  1. The root follows the ground: the hips and everything below them move by the mean ground height over a
//     disc around them, smoothed by a critically damped spring.
//  2. A foot in stance (its sole low over the clip's own floor, and slow) is locked: its toe keeps its
//     horizontal position. Locked or not, rays from above the ankle, down through heel and toe, find the
//     ground. The foot turns by the mean of the two normals and keeps the clip's height over its floor,
//     measured from the supported one of the two (on level ground, the higher hit). A foot that brakes to
//     to land goes to a place where its whole sole has ground under it, or, where treads are too short for
//     that, as much of it as fits. When a lock is released, its offset eases out. A foot in the air is lifted
//     over the ground ahead, up to where it lands, early enough to rise steadily; it waits in front of a
//     riser until it is above it.
//  3. The pelvis is lowered until the legs reach, by a critically damped spring, or faster than the spring
//     if a foot on the ground needs it.
//  4. Legs are solved in closed form. A knee stays on the side where the clip has it; a straight one bends
//     towards the character's forward. No leg becomes straighter than `straightest`.
//
// If the ground is too steep, too far, missing or out of the leg's reach, the leg keeps the clip's pose and
// the report says why. Without any ground the pose stays bit-identical.
//
// Hips, and knees and feet in the air, move relative to the clip no faster than `max_speed`, except along a
// slope, which a foot follows at any speed; a jump of the ground eases in. A walk of 1 m/s passes no more
// than 10 mm through slopes of up to 40 degrees and stairs of up to 0.18 m on 0.28 m. Faster walks or steeper
// stairs may need more than `max_speed`: such a foot passes through the edges, and the report says how deep
// and how late it is (`FootReport::depth`). A foot that goes down stairs may be late: it is kept above the
// upper step until its heel is clear, and if the clip has put it down by then, the rest of the way down takes
// as long as `max_speed` requires, 5 frames for 0.16 m. It counts as planted once it arrives.
//
// Sources: R. S. Johansen, "Automated Semi-Procedural Animation for Character Locomotion", 2009 (feet on
// uneven ground); L. Kovar, J. Schreiner, M. Gleicher, "Footskate Cleanup for Motion Capture Editing", SCA
// 2002 (planting, legs that are never quite straight).
//
// Cost: about 4 µs per character and step on flat ground and on stairs, 6 on a mesh. Allocates nothing.
#pragma once

#include <memory>

#include "tendril/humanoid/ground.hpp"
#include "tendril/humanoid/soles.hpp"
#include "tendril/signal/spring.hpp"

namespace tendril::humanoid {

/// Metres, seconds, radians.
struct FeetOptions {
    double weight = 1.0;  ///< weight of the corrected pose, 0 to 1; 0: the clip's pose, bit-identical

    /// From the character's space to the ground's, Y up in both. If the program moves an in-place clip along,
    /// its movement belongs here.
    rig::Transform root{};
    /// Speed of an in-place clip that the program does not move: m/s in the ground's space. It is added to
    /// the feet's speed, and locked feet move backwards with the ground.
    glm::dvec3 root_velocity{0.0};
    /// Height of the clip's own floor, in the character's space (clip_floor()); unset: the rest pose's.
    std::optional<double> floor{};

    double enter_speed = 0.3;     ///< m/s: a low foot slower than this is locked; 0 to 1e3
    double leave_speed = 1.0;     ///< m/s: a faster foot is released; from enter_speed to 1e3
    double low = 0.05;            ///< maximum height of the sole over the clip's floor in stance; 0 to 1e3
    double break_distance = 0.2;  ///< a lock this far from the clip, horizontally, is released; 0 to 1e3
    double half_life = 0.05;      ///< for a released lock's offset and the foot's turn; 1e-6 to 10

    double ray_start = 0.5;                 ///< above the ankle; 0 to 1e3
    double max_turn = 0.6108652381980153;   ///< 35 degrees: the ground turns a foot by at most this
    double max_slope = 0.7853981633974483;  ///< 45 degrees: steeper ground is ignored; both 0 to 85 degrees
    double edge = 0.012;    ///< distance of a sole from the edges of the step that it stands on, 0 to 0.1; 0:
                            ///< it stays where the clip puts it
    double max_step = 0.5;  ///< ground this far above or below the root's is ignored; 0 to 1e3
    double root_radius = 0.3;        ///< radius of the disc whose mean height the root follows; 0 to 1e3
    double root_half_life = 0.05;    ///< 1e-6 to 10
    double pelvis_drop = 0.4;        ///< the pelvis is lowered by at most this; 0 to 1e3
    double pelvis_half_life = 0.05;  ///< 1e-6 to 10
    double straightest = 0.995;      ///< maximum part of a leg's full length; 0.5 to 1
    double lift_half_life = 0.03;    ///< for easing when the ground below a foot jumps; 1e-6 to 10
    double max_speed = 2.2;          ///< m/s; 1e-6 to 1e3
    bool operator==(const FeetOptions&) const = default;
};
/// Names the member that is out of range: "feet: low must be 0 to 1000 m, got nan".
Result check(const FeetOptions& options) noexcept;

/// Why a leg keeps the clip's pose.
enum class FootAlone : std::uint8_t { No, NoHit, TooSteep, TooFar, CannotReach };
/// For users: "the ground is too steep"; empty for No.
const char* name(FootAlone why) noexcept;

struct FootState {
    bool locked = false;
    bool speed_known = false;               ///< a speed has been measured since the foot was locked
    bool standing = false;                  ///< locked, and on the ground
    glm::dvec3 heel{0.0}, toe{0.0};         ///< in the clip, in the ground's space
    glm::dvec3 velocity{0.0};               ///< horizontal velocity of the toe in the clip
    double lock_x = 0.0, lock_z = 0.0;      ///< where the toe is locked
    double shift_x = 0.0, shift_z = 0.0;    ///< remaining shift to where the whole sole stands
    bool edges_known = false;               ///< the foothold has been chosen since the foot was locked
    double offset_x = 0.0, offset_z = 0.0;  ///< offset of the toe from the clip
    double lift = 0.0;                      ///< lift of the ankle from the clip
    double goal = 0.0;                      ///< the lift without the ease
    signal::SpringState<double> ease{};     ///< offset of the lift from the goal; eases to 0
    glm::dvec3 knee{0.0};                   ///< offset of the knee from the clip
    double planting = 0.0;                  ///< 0: as high over the ground as in the clip; 1: on the ground
    glm::dquat turn{1.0, 0.0, 0.0, 0.0};    ///< rotation due to the ground
    FootAlone alone = FootAlone::No;
    bool operator==(const FootState&) const = default;
};

/// Persists from frame to frame. A default-constructed state puts the feet on the ground at once.
struct FeetState {
    bool started = false;
    glm::dvec3 hips{0.0};  ///< in the clip, in the ground's space
    double base = 0.0;     ///< how far the root is raised
    double drop = 0.0;     ///< how far the pelvis is lowered from there
    signal::SpringState<double> root{}, pelvis{};
    std::array<FootState, 2> feet{};  ///< left, right
    bool operator==(const FeetState&) const = default;
};

/// For a state read from a file: refuses numbers that are not finite or over 1e9, and turns that are not unit
/// quaternions (to 1e-3). "feet: feet.right.lift must be -1e9 to 1e9 m, got nan"
Result check(const FeetState& state) noexcept;

struct FootReport {
    bool planted = false;  ///< locked, and standing on the ground
    FootAlone alone = FootAlone::No;
    glm::dvec3 heel{0.0}, toe{0.0};  ///< in the corrected pose, in the ground's space
    double depth = 0.0;  ///< how far heel, ball or toe is below the ground, metres; at full weight
    double late = 0.0;   ///< metres that the foot still has to rise, held back by max_speed
};

struct FeetReport {
    std::array<FootReport, 2> feet{};  ///< left, right
    double base = 0.0;                 ///< metres that the root is raised
    double drop = 0.0;                 ///< metres that the pelvis is lowered from there
    /// Why nothing has changed: a pose that is not finite or has the wrong number of transforms, a state that
    /// check() refuses, options out of range, or bones too long or too short for a finite result.
    Result accepted{};
};

/// A character's legs, precomputed. Immutable: many characters of one kind, and many threads, can share one.
class Feet {
  public:
    /// Refuses what find_soles() refuses, and legs that are not a chain from the hips to the toes. Pass
    /// `soles` if they are known better: from the clip (clip_soles()), or from a mesh.
    static Expected<Feet> make(const Skeleton& skeleton, const BoneMap& map);
    static Expected<Feet> make(const Skeleton& skeleton, const BoneMap& map, const Soles& soles);
    ~Feet();
    Feet(Feet&&) noexcept;
    Feet& operator=(Feet&&) noexcept;

    const Soles& soles() const noexcept;

    /// `pose` is the clip's, local transforms of all nodes, and is corrected in place. If dt is not over 0,
    /// no time passes: the same pose gives the same result again, and a different one (a clip that is
    /// scrubbed) resets the state, as does a character that is suddenly elsewhere.
    FeetReport step(std::span<rig::Transform> pose, const Ground& ground, double dt, FeetState& state,
                    const FeetOptions& options = {}) const noexcept;

  private:
    struct Plan;
    explicit Feet(std::unique_ptr<Plan> plan) noexcept;
    std::unique_ptr<Plan> plan_;
};

}  // namespace tendril::humanoid

template <>
std::span<const tendril::Field> tendril::fields<tendril::humanoid::FeetOptions>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::humanoid::FootState>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::humanoid::FeetState>() noexcept;
