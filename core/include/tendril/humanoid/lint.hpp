// Finds the faults of a clip, each with its frame, node and amount.
//
//     const LintReport report = lint(skeleton, map, clip);
//     for (const Finding& finding : report.findings)
//         log(finding.text);  // "LeftFoot slides 62 mm over the ground while planted (frames 24 to 41)"
//     if (report.findings[0].has_cure) clip = *cure(skeleton, map, clip, report.findings[0]);
//
// A decent clip should have no findings: speeds are compared with the motion around them, heights with the
// clip's own floor, and if a foot's sole is not known, the tolerances are wider.
//
//     kind       fault                                                            node          unit
//     Skating    no point of a standing foot stays where it is                    foot          mm
//     Floating   a foot stands still above the floor                              foot          mm
//     Sinking    a foot is below the floor                                        foot          mm
//     KneePop    a knee jumps, or snaps straight or out of straight               lower leg     deg
//     SignFlip   keys' quaternions have the opposite sign of their neighbours':
//                without the short way a joint turns by the amount between two
//                keys; one finding for all joints of a clip                       the worst     deg
//     Limit      a joint is beyond its range, by the smallest turn that brings
//                it back; an elbow, if it bends to a side to which no shoulder can
//                twist it. Decent captures exceed the default limits, so 20
//                degrees are tolerated at knees, 34 at elbows, 65 at the head and
//                45 elsewhere                                                     its node      deg
//     Jump       a joint departs for a few frames, or jumps for good; a key
//                that steps on purpose is no jump                                 its node      deg or mm
//     Scale      implausible sizes: the clip's bones are a multiple of the
//                skeleton's, no human is that tall, scale keys are 0 or mirror    its node      times or m
//     Axis       the figure lies on its side, in the clip and not only at rest    hips          deg
//
// Feet and knees need a map with a leg; without one they are not judged. Stances are found from the foot's
// own speed and height, after L. Kovar, J. Schreiner, M. Gleicher, "Footskate Cleanup for Motion Capture
// Editing" (SCA 2002). The cure follows the same paper: the leg is solved in closed form and the correction
// blended out. A standing foot slides as far as the point of its sole that moves the least, so that rolling
// from heel to toe and turning on the ball do not count.
//
// Cost: O(frames * nodes), 0.5 to 1 µs for each; measured by tests/bench/humanoid_lint.cpp.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tendril/fields.hpp"
#include "tendril/humanoid/bone_map.hpp"
#include "tendril/humanoid/clip.hpp"
#include "tendril/humanoid/ground.hpp"
#include "tendril/humanoid/limits.hpp"

namespace tendril::humanoid {

enum class Fault : std::uint8_t { Skating, Floating, Sinking, KneePop, SignFlip, Limit, Jump, Scale, Axis };
inline constexpr std::size_t fault_count = 9;
/// "skating", "floating", "sinking", "knee_pop", "sign_flip", "limit", "jump", "scale", "axis"
const char* name(Fault fault) noexcept;

struct Finding {
    Fault fault = Fault::Jump;
    std::int32_t node = -1;  ///< -1: the whole figure
    std::size_t frame = 0;   ///< the worst one; 0 is time 0
    std::size_t first = 0;   ///< the first frame affected
    std::size_t last = 0;    ///< the last frame affected
    double time = 0.0;       ///< time of `frame`, seconds
    double amount = 0.0;     ///< see the table above
    const char* unit = "";   ///< "mm", "deg", "m" or "times"
    bool goes_on = false;    ///< a jump after which the motion does not return
    bool snaps = false;      ///< a knee that becomes straight, or stops being straight, within a frame
    bool has_cure = false;   ///< cure() can repair it
    std::string text{};      ///< all of this as a sentence
};

struct LintSettings {
    double rate = 0.0;        ///< frames per second, up to 1000; 0: the clip's own
    double skating = 0.02;    ///< metres that a standing foot may slide
    double floating = 0.025;  ///< metres that a standing foot may be above the floor
    double sinking = 0.02;    ///< metres that a foot may be below it
    double knee = 6.0;        ///< degrees that a knee may jump, at 60 frames per second
    double turn = 15.0;       ///< maximum jump of any other joint in degrees, at 60 frames per second
    double shift = 0.02;      ///< maximum jump of positions, times the figure's height at rest
    /// Joint limits, owned by the caller. Null: the default limits with wide tolerances, which report only
    /// poses that no human clip should have, above all knees that bend the wrong way.
    const BodyLimits* limits = nullptr;
    double beyond = 2.0;  ///< degrees that a joint may exceed `limits`
    /// The ground under the feet, owned by the caller: heights are measured from it. Null, or no ground: a
    /// level floor, found in the clip.
    const Ground* ground = nullptr;
};

namespace lint_detail {

/// A point of the sole: a node of the foot, lowered by its height above the ground when the foot stands flat.
/// The offset does not turn with the foot, so that errors in the sole do not grow when the foot tilts. The
/// heel and toe of find_soles() are not used: foot IK must turn them along, but they are guesses from the
/// rest pose, and a clip must not be blamed for a guess.
struct SolePoint {
    std::size_t node;
    double above;  ///< metres
};

/// How the feet of a whole clip stand.
struct KnownFeet {
    struct Foot {
        std::int32_t node = -1;
        std::vector<SolePoint> points{};  ///< ankle, ball and tip, if present
        glm::dvec3 flat{0.0, 1.0, 0.0};   ///< up, in the foot's own space, when it stands flat
    };
    std::vector<Foot> feet{};   ///< none, one or two
    glm::dvec3 treadmill{0.0};  ///< the ground's velocity under a figure that walks in place, m/s
    bool are_known = false, always_slides = false, rests_on_ground = false, has_soles = false;
    std::optional<double> floor{};
};

}  // namespace lint_detail

/// Frames beyond this are not judged.
inline constexpr std::size_t max_lint_frames = 500'000;

struct LintReport {
    double rate = 30.0;      ///< frames per second
    std::size_t frames = 0;  ///< number of frames judged
    bool has_floor = false;  ///< feet stand in this clip, and were judged
    double floor = 0.0;      ///< height of the clip's floor, metres; from the ground, if given
    /// Velocity of the ground under a figure that walks in place, m/s: how its standing feet move. 0 if the
    /// clip travels.
    glm::dvec3 treadmill{0.0};
    double skating = 0.0;             ///< maximum slide of a standing foot, metres, even if tolerated
    std::vector<Finding> findings{};  ///< by frame
    /// How the clip's feet stand, for cure().
    lint_detail::KnownFeet feet{};
};

/// Frames per second, as the clip's file says (1 to 1000), or from the spacing of its keys; rounded if within
/// 0.1 % of an integer. 60 if there are too few keys, or if they give a rate outside 20 to 1000 (5 to 1000 if
/// a track has a key at every frame and none is on a curve).
double frame_rate(const Clip& clip) noexcept;

/// `clip` must have passed check().
LintReport lint(const Skeleton& skeleton, const BoneMap& map, const Clip& clip,
                const LintSettings& settings = {});

/// The findings of `after` that `before` lacks: another kind, another node, or other frames.
std::vector<Finding> new_findings(const LintReport& before, const LintReport& after);

/// The clip without that fault, otherwise unchanged:
///   SignFlip: all keys of each track are brought to one hemisphere; joints turn as before.
///   Skating: the foot stands still, midway along its slide. Floating, Sinking: it is moved vertically onto
///   the floor. They blend into the clip within 0.15 s before and after (0.6 s at most), and into the same
///   fault of that foot if it is as near; the hips are lowered if the leg is too short.
///   KneePop of a leg that snaps straight: as it nears its full length it straightens ever more slowly, for
///   which the foot is brought nearer to the hip by at most 5 mm ("soft IK": A. Nicholas, 2009).
///   Jump, other KneePops: keys that depart for a few frames are interpolated from their neighbours; a jump
///   that does not come back is spread over a quarter of a second. Scale of a clip: its translations are
///   scaled to the skeleton's size. Axis of a clip: its roots are turned upright.
/// The result has fewer findings than the clip, and no new ones: faults that the cure itself causes are cured
/// with it. Refuses a finding without such a cure, or one of another clip. Cost: two to twenty calls of
/// lint(). With a `report` of the clip at the same rate, or of the clip before other cures, only the seconds
/// around the finding are judged, and the cost does not depend on the clip's length.
Expected<Clip> cure(const Skeleton& skeleton, const BoneMap& map, const Clip& clip, const Finding& finding,
                    const LintSettings& settings = {}, const LintReport* report = nullptr);

}  // namespace tendril::humanoid

template <>
std::span<const tendril::Field> tendril::fields<tendril::humanoid::LintSettings>() noexcept;
