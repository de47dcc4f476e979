// What is wrong with a clip, each fault with its frame, its node and an amount.
//
//     const LintReport report = lint(skeleton, map, clip);
//     for (const Finding& finding : report.findings)
//         log(finding.text);  // "LeftFoot slides 62 mm over the ground while it stands (frame 24 to 41)"
//     if (report.findings[0].has_cure) clip = *cure(skeleton, map, clip, report.findings[0]);
//
// Made so that a decent clip has no findings: what is fast is compared with the motion around it, what is low
// with the clip's own floor, and where a foot's sole is not known what follows from it is not judged.
//
//     kind       what                                                             node          unit
//     Skating    no point of a standing foot stays where it is                    foot          mm
//     Floating   a foot stands still above the floor                              foot          mm
//     Sinking    a foot is below the floor                                        foot          mm
//     KneePop    a knee jumps, or snaps straight or out of straight               lower leg     deg
//     SignFlip   a key is the negative of what its neighbours say: programs that
//                do not take the short way turn by the amount between two keys    its node      deg
//     Limit      a joint is beyond its range                                      its node      deg
//     Jump       in one frame a joint is elsewhere than before and after          its node      deg or mm
//     Scale      sizes that cannot be meant: the clip's bones are a multiple of
//                the skeleton's, a person is no person's size, keys are 0         its node      times or m
//     Axis       the figure lies on its side                                      hips          deg
//
// Feet and knees need a map with a leg; without one the rest is judged. Stances are found by the foot's own
// speed and height, after L. Kovar, J. Schreiner, M. Gleicher, "Footskate Cleanup for Motion Capture Editing"
// (SCA 2002), whose cure is also this one's model: the leg is solved in closed form and the correction
// blended out; how far a standing foot slides is the motion of that point of its sole that moves the least,
// so that rolling from heel to toe and turning on the ball are no sliding.
//
// Cost: O(frames * nodes), half a microsecond to one for each; tests/bench/humanoid_lint.cpp measures it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tendril/humanoid/bone_map.hpp"
#include "tendril/humanoid/clip.hpp"
#include "tendril/humanoid/limits.hpp"

namespace tendril::humanoid {

enum class Fault : std::uint8_t { Skating, Floating, Sinking, KneePop, SignFlip, Limit, Jump, Scale, Axis };
inline constexpr std::size_t fault_count = 9;
/// "skating", "floating", "sinking", "knee_pop", "sign_flip", "limit", "jump", "scale", "axis"
const char* name(Fault fault) noexcept;

struct Finding {
    Fault fault = Fault::Jump;
    std::int32_t node = -1;  ///< -1: the whole figure
    std::size_t frame = 0;   ///< where it is worst; 0 is time 0
    std::size_t first = 0;   ///< frames that it lasts
    std::size_t last = 0;    ///<
    double time = 0.0;       ///< of `frame`, seconds
    double amount = 0.0;     ///< see the table above
    const char* unit = "";   ///< "mm", "deg", "m" or "times"
    bool goes_on = false;    ///< a jump after which the motion goes on from there
    bool has_cure = false;   ///< cure() can mend it
    std::string text{};      ///< a sentence with all of that
};

struct LintSettings {
    double rate = 0.0;        ///< frames a second, up to 1000; 0: the clip's own, which its keys tell
    double skating = 0.02;    ///< metres that a standing foot may slide
    double floating = 0.025;  ///< metres that a standing foot may be above the floor
    double sinking = 0.02;    ///< metres that a foot may be below it
    double knee = 6.0;        ///< degrees that a knee may jump, at 60 frames a second
    double turn = 15.0;       ///< the same for other joints
    double shift = 0.02;      ///< that positions may jump, times the figure's height at rest
    /// Of the joints, kept by the caller. Null: the default ones, of which only what no clip of a human
    /// should do is told, knees that bend the wrong way above all.
    const BodyLimits* limits = nullptr;
    double beyond = 2.0;  ///< degrees by which a joint may be beyond limits that are given
};

/// A longer clip is judged up to there.
inline constexpr std::size_t max_lint_frames = 500'000;

struct LintReport {
    double rate = 30.0;               ///< frames a second
    std::size_t frames = 0;           ///< that were judged
    bool has_floor = false;           ///< feet stand in this clip, and were judged
    double floor = 0.0;               ///< height of the clip's floor, metres
    double skating = 0.0;             ///< the furthest that a standing foot slides, metres, however little
    std::vector<Finding> findings{};  ///< by frame
};

/// Frames a second as the keys of a clip are spaced: a whole number where it is one to 0.1 %. 60 where keys
/// do not tell, or stand further apart than a 20th of a second.
double frame_rate(const Clip& clip) noexcept;

/// `clip` has passed check().
LintReport lint(const Skeleton& skeleton, const BoneMap& map, const Clip& clip,
                const LintSettings& settings = {});

/// The clip without that fault, and as it was otherwise:
///   SignFlip: all keys of the track on one hemisphere; it turns as before.
///   Skating, Floating, Sinking: the foot stands where it stood midway, on the floor, and goes over into its
///   motion within 0.15 s before and after; the hips are lowered where its leg is too short for that.
///   Jump, KneePop: keys that stand apart for a frame or two go between their neighbours; a step is spread
///   over a quarter of a second.
///   Scale of a clip: its translations take the skeleton's size. Axis of a clip: its roots are turned
///   upright.
/// Refuses a finding without a cure, or one that is of another clip.
Expected<Clip> cure(const Skeleton& skeleton, const BoneMap& map, const Clip& clip, const Finding& finding,
                    const LintSettings& settings = {});

}  // namespace tendril::humanoid
