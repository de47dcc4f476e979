// Foot IK: the feet of an animation brought to the ground that is there, and kept where they stand.
//
//     Expected<Feet> feet = Feet::make(skeleton, match_bones(skeleton));
//     if (!feet) return log(feet.message());
//     FeetState state;                                            // a value: save it, put it back
//     ... each frame:
//     sample(clip, skeleton, seconds, pose);                      // local transforms of all nodes
//     const FeetReport report = feet->step(pose, ground, dt, state);
//     if (report.feet[0].planted) ...                             // the pose is the corrected one now
//
// What a step does, in this order:
//
//  1. The root rides the ground: hips and all that hangs on them move by the height of the ground around
//     them (the mean over a disc), smoothed by a critically damped spring.
//  2. A foot is locked while it is in stance: its sole low over the clip's own floor, and slow. Its toe
//     then stays where it is, seen from above. Locked or not, a ray from above the ankle down through heel
//     and toe each finds the ground; the foot is turned by the mean of the two normals, and stands as high
//     over the ground as the clip has it over its floor, counted from whichever of the two is supported (on
//     level ground, the higher hit). What a lock moved it by eases out. Heel and toe of a foot in the air
//     also look ahead, so that each is over the edge of a step before it is there.
//  3. The pelvis is lowered by what a leg is short of, by a critically damped spring, but never later than
//     a foot needs that stands on the ground.
//  4. Legs are solved in closed form. Knees stay on the side where the clip has them, and go by the
//     character's forward where they are straight. No leg becomes straighter than `straightest`.
//
// Where the ground is too steep, too far or missing, or out of the leg's reach, the leg keeps the clip's
// pose, and the report says why. Without any ground the pose comes back to the bit.
//
// Hips, and knees and feet in the air, are moved against the clip no faster than `max_speed`; where the
// ground jumps, what it moves a foot by eases in. So a foot that goes down stairs may be late: until its heel
// is clear of the upper step it is kept over that, and what is left to go when the clip puts it down takes
// as long as `max_speed` lets it, 5 frames for 0.16 m. It counts as planted once it is there.
//
// Sources: R. S. Johansen, "Automated Semi-Procedural Animation for Character Locomotion", 2009 (feet on
// uneven ground); L. Kovar, J. Schreiner, M. Gleicher, "Footskate Cleanup for Motion Capture Editing", SCA
// 2002 (planting, legs that are never quite straight).
//
// Cost: some 4 µs a character and step on flat ground and on stairs, 6 on a mesh. Nothing is allocated.
#pragma once

#include <memory>

#include "tendril/humanoid/ground.hpp"
#include "tendril/humanoid/soles.hpp"
#include "tendril/signal/spring.hpp"

namespace tendril::humanoid {

/// Metres, seconds, radians.
struct FeetOptions {
    double weight = 1.0;  ///< 0 to 1, of the corrected pose against the clip's; 0: the clip's to the bit

    /// Where the character stands: its space in the ground's, Y up in both. A clip in place that the program
    /// moves along has its movement here.
    rig::Transform root{};
    /// The speed of a clip in place that moves nowhere: m/s in the ground's space. Feet count as that much
    /// faster, and what is locked moves backwards with the ground.
    glm::dvec3 root_velocity{0.0};
    /// Of the clip's own floor, in the character's space (clip_floor()); left out, that of the rest pose.
    std::optional<double> floor{};

    double enter_speed = 0.3;     ///< m/s: a foot slower than this, and low, is locked; 0 to 1e3
    double leave_speed = 1.0;     ///< one faster than this is let go; from enter_speed to 1e3
    double low = 0.05;            ///< height of the sole over the clip's floor in stance; 0 to 1e3
    double break_distance = 0.2;  ///< a lock so far from the clip, seen from above, is let go; 0 to 1e3
    double half_life = 0.05;      ///< in which what a lock did, and the foot's turn, eases; over 0, to 10

    double ray_start = 0.5;  ///< over the ankle; 0 to 1e3
    double max_turn =
        0.610865238198015;  ///< 35 degrees: a foot is turned by the ground by at most this; 0 to 1.5
    double max_slope = 0.785398163397448;  ///< 45 degrees: steeper ground is left alone; 0 to 1.5
    double edge = 0.012;    ///< a foot that is locked with heel or toe so near to the edge of a step is set
                            ///< that much away from it; 0 to 0.1
    double max_step = 0.5;  ///< ground so far above or below that under the root is left alone; 0 to 1e3
    double root_radius = 0.3;        ///< of the disc whose mean height the root rides; 0 to 1e3
    double root_half_life = 0.05;    ///< over 0, to 10
    double pelvis_drop = 0.4;        ///< lowered by at most this; 0 to 1e3
    double pelvis_half_life = 0.05;  ///< over 0, to 10
    double straightest = 0.995;      ///< of a leg's full length; 0.5 to 1
    double lift_half_life = 0.03;    ///< in which a jump of the ground below a foot eases in; over 0, to 10
    double max_speed = 2.2;          ///< m/s; over 0, to 1e3
};
/// Names the member that is out of its range: "feet: low must be from 0 to 1e3 m, got nan".
Result check(const FeetOptions& options) noexcept;

/// Why a leg keeps the clip's pose.
enum class FootAlone : std::uint8_t { No, NoHit, TooSteep, TooFar, CannotReach };
/// A sentence for people: "the ground is too steep"; empty of No.
const char* name(FootAlone why) noexcept;

struct FootState {
    bool locked = false;
    bool speed_known = false;               ///< since it was locked
    bool standing = false;                  ///< locked, and on the ground: planted
    glm::dvec3 heel{0.0}, toe{0.0};         ///< of the clip, in the ground's space
    glm::dvec3 velocity{0.0};               ///< of the clip's toe, level
    double lock_x = 0.0, lock_z = 0.0;      ///< where the toe is locked
    double shift_x = 0.0, shift_z = 0.0;    ///< how far that still is from where it is clear of edges
    bool edges_known = false;               ///< since it was locked
    double offset_x = 0.0, offset_z = 0.0;  ///< what the toe is moved by against the clip
    double lift = 0.0;                      ///< what the ankle is
    double goal = 0.0;                      ///< what it would be without the ease
    signal::SpringState<double> ease{};     ///< from the goal
    glm::dvec3 knee{0.0};                   ///< what the knee is moved by
    double planting = 0.0;                  ///< 0: as high over the ground as in the clip; 1: on it
    glm::dquat turn{1.0, 0.0, 0.0, 0.0};    ///< by the ground
    FootAlone alone = FootAlone::No;
    bool operator==(const FootState&) const = default;
};

/// All that is remembered from frame to frame. A fresh one starts on the ground at once.
struct FeetState {
    bool started = false;
    glm::dvec3 hips{0.0};  ///< of the clip, in the ground's space
    double base = 0.0;     ///< what the root is moved up by
    double drop = 0.0;     ///< what the pelvis is lowered by from there
    signal::SpringState<double> root{}, pelvis{};
    std::array<FootState, 2> feet{};  ///< left, right
    bool operator==(const FeetState&) const = default;
};

/// For a state that comes from a file: refuses numbers that are not finite or over 1e9, and turns that are no
/// unit quaternions. "feet: feet[1] must be finite and at most 1e9 in magnitude, got nan"
Result check(const FeetState& state) noexcept;

struct FootReport {
    bool planted = false;  ///< locked, and standing on the ground
    FootAlone alone = FootAlone::No;
    glm::dvec3 heel{0.0}, toe{0.0};  ///< of the corrected pose, in the ground's space
};

struct FeetReport {
    /// False: a pose that is not finite or has the wrong number of transforms, a state that check() refuses,
    /// options out of their ranges, or bones too long or too short for a finite answer; pose and state are as
    /// they were.
    bool valid = true;
    std::array<FootReport, 2> feet{};  ///< left, right
    double base = 0.0;                 ///< metres, what the root is moved up by
    double drop = 0.0;                 ///< what the pelvis is lowered by from there
};

/// What is known of a character's legs. Made once, then only read: many characters of one kind, and many
/// threads, use one.
class Feet {
  public:
    /// Refuses what find_soles() refuses. `soles` where they are known better, from a mesh.
    static Expected<Feet> make(const Skeleton& skeleton, const BoneMap& map);
    static Expected<Feet> make(const Skeleton& skeleton, const BoneMap& map, const Soles& soles);
    ~Feet();
    Feet(Feet&&) noexcept;
    Feet& operator=(Feet&&) noexcept;

    const Soles& soles() const noexcept;

    /// `pose` comes as the clip has it and is corrected in place: local transforms of all nodes. A dt that is
    /// not over 0 lets no time pass: the same pose again gives the same answer again, and another one (a clip
    /// that is scrubbed) starts anew, as one does that is elsewhere at once.
    FeetReport step(std::span<rig::Transform> pose, const Ground& ground, double dt, FeetState& state,
                    const FeetOptions& options = {}) const noexcept;

  private:
    struct Plan;
    explicit Feet(std::unique_ptr<Plan> plan) noexcept;
    std::unique_ptr<Plan> plan_;
};

}  // namespace tendril::humanoid
