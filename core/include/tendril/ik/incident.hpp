// Finds faults in a chain's recorded motion, frame by frame: flips, NaN, bones that change length, joints
// beyond their limits, tips that do not arrive, lag, jitter, repeated frames and jumps of the target. Needs
// only joint positions and inputs, so the motion may come from any solver in any engine.
//
// Frames are added one by one; memory is bounded by the number of joints and of incidents, not of frames. A
// lasting fault is one incident, from first frame to last. A frame without a target uses the tip as the
// target: flips, NaN, lengths, limits and repeats are still found, but never blamed on the target.
//
// Cost: O(joints) a frame. Nothing throws.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "tendril/fields.hpp"
#include "tendril/ik/flip.hpp"
#include "tendril/ik/observer.hpp"
#include "tendril/quat.hpp"
#include "tendril/vec3.hpp"

namespace tendril::ik {

enum class IncidentKind : std::uint8_t {
    /// A bone jumped, the chain changed the side to which it bends, or a bone rolled about itself while its
    /// ends hardly moved; amount: degrees that the bone turned.
    Flip,
    Nan,  ///< a joint, the target or the pole target is not finite; amount: 0
    /// A bone's length differs from the first frame's; amount: metres, negative if shorter. One incident for
    /// all bones scaled by one factor, and one, the larger, for the two bones of a joint that moved alone:
    /// they differ over the same frames, and the distance of their outer ends first changed under a quarter
    /// as much.
    Length,
    Limit,   ///< a joint is beyond its limit; amount: degrees beyond it
    Missed,  ///< the tip does not reach a target within its reach; amount: metres short
    /// From its first frame to its last, the tip is where the target was some frames earlier; amount: frames,
    /// 30 at most.
    Lag,
    Jitter,  ///< the tip swings while the target is still; amount: metres to either side
    /// Frames that repeat the one before in mid-motion; amount: frames. Evenly spaced repeats are one
    /// incident: the chain is updated at another rate than the log. None if the target repeats with them.
    Repeated,
    TargetJump,  ///< amount: metres
    PoleJump,    ///< the pole target jumps to another side of the root-target line; amount: metres
    /// One frame off the path of the frames around it, two frames in swapped order, or a root that jumps away
    /// from its target; amount: metres that the tip or the root is off.
    Misplaced
};
/// "flip", "nan", "length", "limit", "missed", "lag", "jitter", "repeated", "target_jump", "pole_jump",
/// "misplaced"
const char* name(IncidentKind kind) noexcept;
/// "degrees", "metres", "frames"; empty for Nan.
const char* unit(IncidentKind kind) noexcept;

struct ChainIncident {
    IncidentKind kind = IncidentKind::Flip;
    std::uint64_t frame = 0, last_frame = 0;  ///< from 0
    /// From 0 at the root. Flip: the end of the bone that turned most, the one that moved further. Length:
    /// the bone's end further from the root. no_joint if no single joint is concerned.
    std::size_t joint = no_joint;
    double amount = 0.0;
    double hertz = 0.0;      ///< Jitter: frequency; Repeated, evenly spaced: new poses a second; else 0
    const char* cause = "";  ///< for display, a clause
    FlipCause flip = FlipCause::Unexplained;  ///< a flip's cause
};

/// Range of the angle between the two bones at a joint, in degrees; 0 is straight.
struct BendLimit {
    std::size_t joint = 1;  ///< neither root nor tip
    float min = 0.0f, max = 180.0f;
};

struct IncidentOptions {
    float flip_degrees = 30.0f;  ///< a bone flips if it turns by more in a frame and outpaces its inputs
    /// Rounding error of a coordinate, metres: half a unit of the last digit written.
    float resolution = 0.0f;
    float fps = 60.0f;  ///< for frequencies
    std::vector<BendLimit> limits{};
    /// The joint that reaches for the target, from 1; empty or beyond the last: the last. The joints after it
    /// are carried along: checked for flips and lengths, but not for reaching the target.
    std::optional<std::size_t> end_effector{};
};

/// At least two joints, the same number in every frame. Values may be NaN or infinite.
struct TraceFrame {
    std::span<const glm::vec3> joints;  ///< from the root, metres
    std::optional<glm::vec3> target{}, pole{};
    std::span<const glm::quat> rotations{};  ///< unit, in the space of the joints, not of the
                                             ///< parent bone; empty, or at least one per bone
    std::optional<float> dt{};               ///< seconds since the frame before
    float resolution = 0.0f;                 ///< raises IncidentOptions::resolution from this frame on
};

class IncidentFinder {
  public:
    explicit IncidentFinder(IncidentOptions options = {});

    void add(const TraceFrame& frame);
    /// Call after the last frame: closes open incidents. Add nothing afterwards.
    void finish();

    /// Complete, and sorted by frame, after finish(). At most max_incidents; further ones are only counted.
    const std::vector<ChainIncident>& incidents() const noexcept { return found_; }
    std::uint64_t left_off() const noexcept { return dropped_; }
    std::uint64_t frames() const noexcept { return frames_; }

    static constexpr std::size_t max_incidents = 100'000;

  private:
    static constexpr std::size_t max_lag = 30, still_window = 64;
    /// Paths are compared by position (0), and by steps over this many frames.
    static constexpr std::array<std::size_t, 3> spans{0, 1, 16};

    /// A fault that lasts several frames; `open` while it does.
    struct Episode {
        bool open = false;
        ChainIncident worst{};
    };

    void note(const ChainIncident& incident);
    void update_episode(Episode& episode, bool active, const ChainIncident& now);
    bool find_nan(const TraceFrame& frame);
    const char* nan_cause(const TraceFrame& frame) const noexcept;
    void find_lengths(const ReachPose& pose, bool aimed);
    void find_limits(const ReachPose& pose);
    void find_flips(const ReachPose& pose, bool jumped, bool aimed);
    FlipCause cause_of_flip(const ReachPose& before, const ReachPose& after, bool aimed) const;
    void find_rolls(const ReachPose& pose, std::span<const glm::quat> rotations);
    bool changed_side(const ReachPose& pose, bool jumped);
    struct Steps;
    bool detect_jump(Steps& steps, glm::vec3 was, glm::vec3 is, IncidentKind kind, const char* cause);
    bool find_jumps(const ReachPose& pose);
    void find_misplaced(const ReachPose& pose, bool aimed);
    void find_repeated(const ReachPose& pose);
    struct Repeat;
    void add_repeat(const Repeat& hold);
    void close_cadence();
    bool both_moved(const ReachPose& a, const ReachPose& b) const noexcept;
    bool resumes(const ReachPose& pose) const;
    float inner_reach() const noexcept;
    glm::vec3 within_reach(glm::vec3 target) const noexcept;  ///< clamped to the tip's reach, from the root
    /// The pose without the joints beyond the end effector.
    ReachPose reaching(const ReachPose& pose) const;
    /// True if the joint moved more than `times` as far as target and pole target did.
    static bool outpaces_input(const ReachPose& before, const ReachPose& after, std::size_t joint,
                               float times) noexcept;
    void find_missed(const ReachPose& pose);
    void find_late(const std::array<float, max_lag + 1>& errors, float allowed);
    void close_late();
    ChainIncident lag_of(std::size_t lag, std::uint64_t first, std::uint64_t last) const;
    void follow(const ReachPose& pose);
    void find_jitter(const ReachPose& pose);
    void judge_jitter();
    std::size_t find_lag() const;
    void finish_following();
    void forget_motion() noexcept;

    IncidentOptions options_;
    std::vector<ChainIncident> found_;
    std::uint64_t frames_ = 0, dropped_ = 0;
    float reach_ = 0.0f;   ///< length to the end effector, in the first finite frame
    std::size_t end_ = 0;  ///< the end effector
    std::vector<float> lengths_;
    Episode nan_, missed_;
    std::vector<Episode> length_, limit_;
    std::set<std::pair<std::uint64_t, std::size_t>> displaced_;  ///< frames and joints that moved alone

    // The latest consecutive finite frames, newest last. A repeated frame keeps the inputs it was solved for.
    std::vector<ReachPose> recent_;
    ReachPose latest_;                  ///< the latest frame with its own inputs
    std::vector<glm::quat> rotations_;  ///< for the newest pose in recent_
    std::uint64_t flipped_at_ = 0;
    bool flipped_ = false;
    /// The side to which a chain of two bones last bent.
    struct Side {
        glm::vec3 line{0.0f}, normal{0.0f};
        std::optional<glm::vec3> pole{};  ///< relative to the root
        bool straight_since = false;
    };
    std::optional<Side> side_;
    /// Steps of the target or the pole target. A jump is confirmed one frame later.
    struct Steps {
        float latest = 0.0f, before = 0.0f;
        glm::vec3 from{0.0f};  ///< start of the latest step, from the root
        IncidentKind kind = IncidentKind::TargetJump;
        const char* cause = nullptr;  ///< set if the latest step may be a jump
    };
    Steps steps_, pole_steps_;
    bool root_jumped_ = false;  ///< the tip has not met its target since
    /// The latest frames in space, newest last: max_lag + 1.
    struct MotionSample {
        glm::vec3 root{0.0f}, tip{0.0f};
        std::optional<glm::vec3> target{};
    };
    std::vector<MotionSample> samples_;
    std::uint64_t disturbed_ = 0;  ///< the latest frame with a flip or a wrong length, from 1
    /// The current run of repeated frames.
    struct RepeatRun {
        std::uint64_t frames = 0;
        float earlier_step = 0.0f;  ///< the tip's step before the last one
        glm::vec3 step{0.0f};       ///< the last step of the tip
        bool moved = false;         ///< tip and target moved in that step
        glm::vec3 target{0.0f};     ///< at the start of the run
    };
    RepeatRun repeat_;
    struct Repeat {
        ChainIncident incident{};
        bool fault = false, rested = false;  ///< `rested`: the target stood still as well
    };
    std::vector<Repeat> cadence_;  ///< evenly spaced runs, newest last
    /// Sums over frames, for fitting the tip's path to the target's path some frames earlier.
    struct Following {
        struct Lagged {
            glm::dvec3 sum{0.0};
            double square = 0.0, product = 0.0;
        };
        std::array<Lagged, max_lag + 1> lags{};
        glm::dvec3 sum{0.0};
        double square = 0.0, count = 0.0;
        std::array<double, max_lag + 1> before{};  ///< residual squares of earlier fits
        std::uint64_t frames = 0;

        /// Starts a new fit and keeps the residual squares of the old one.
        void close() noexcept;
        /// For each lag, the fit's residual sum of squares.
        std::array<double, max_lag + 1> left() const noexcept;
    };
    std::vector<glm::vec3> targets_, followers_;  ///< targets and tips relative to the root, newest last
    /// A run of frames in which the tip may be late; by lag, its summed squared distances to earlier targets.
    struct Late {
        std::uint64_t first = 0, last = 0, frames = 0;
        std::array<double, max_lag + 1> squares{};
    };
    Late late_;
    std::vector<ChainIncident> lates_;
    /// By lag: number of frames with the tip on a target that was elsewhere that many frames before.
    std::array<std::uint64_t, max_lag + 1> prompt_{};
    std::array<Following, spans.size()> paths_{};
    glm::dvec3 origin_{0.0};
    std::optional<std::uint64_t> first_move_;
    float missed_before_ = 0.0f;
    std::size_t missed_frames_ = 0;
    // Tip positions since the target came to rest.
    std::vector<glm::vec3> tips_;
    std::uint64_t still_since_ = 0;
    bool jitter_judged_ = false;
};

}  // namespace tendril::ik

template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::BendLimit>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::IncidentOptions>() noexcept;
