// Reads a trace, which records frame by frame what an engine's chains did, and solves its input again to
// explain a flip. JSON Lines, CSV, tables, or text with vectors in it; the space is converted to Tendril's.
// Streams: memory does not grow with the number of frames. The formats: `tendril trace --help`.
#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <glm/vec3.hpp>
#include <istream>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <tendril/ik/flip.hpp>
#include <tendril/ik/incident.hpp>
#include <tendril/ik/limit.hpp>
#include <tendril/ik/method.hpp>
#include <tendril/ik/solver.hpp>
#include <vector>

#include "app/io/trace/conventions.hpp"
#include "app/io/trace/raw.hpp"

namespace tendril::app {

// Tendril's own solve of a trace's input, and small changes that prevent a flip. Each change was tried by
// solving the frames around the flip.

bool is_finite_point(glm::vec3 p);

/// A frame of one chain in metres, right-handed, Y up.
struct TracedFrame {
    std::string chain;  ///< empty if unnamed
    std::vector<glm::vec3> joints;
    std::optional<glm::vec3> target, pole;
    std::vector<glm::quat> rotations;  ///< empty, or one per bone or per joint
    std::optional<float> dt;
    float resolution = 0.0f;  ///< maximum rounding error of a joint's coordinate
    std::size_t line = 0;
    std::optional<std::size_t> end{};  ///< the joint that reaches for the target; empty: the last

    std::size_t end_effector() const { return end.value_or(joints.size() - 1); }
    /// The end effector's position if there is no target.
    glm::vec3 goal() const { return target.value_or(joints[end_effector()]); }
    /// True if joints, target and pole target are finite.
    bool finite() const;
};

/// How Tendril solves the input.
struct TraceSolve {
    ik::Method method = ik::Method::Fabrik;
    float soft_zone = 0.0f;   ///< fraction of the reach, 0 to 1
    glm::vec3 pole_by{0.0f};  ///< metres: moves the pole target or, without one, adds it there
    int hinge = 0;            ///< this joint only bends one way, as in the first frame; 0: none

    bool operator==(const TraceSolve&) const = default;
    /// The pole target of a frame after the change.
    std::optional<glm::vec3> pole(const TracedFrame& frame) const;
    /// The hinge as limits for the joints of the first frame, up to the end effector; empty without a hinge.
    /// Throws std::invalid_argument if it is at the root or the tip.
    std::vector<ik::Limit> limits(std::span<const glm::vec3> joints) const;
    /// Without the limits.
    ik::Options options(const TracedFrame& frame) const {
        return {.pole = pole(frame), .soft_zone = soft_zone};
    }
};

/// Solves a chain through frames, from the pose of the first one. Joints beyond the end effector are carried
/// along.
class Retrace {
  public:
    explicit Retrace(const TraceSolve& how) : how_(how) {}
    /// The pose in that frame; if the frame is not finite, the previous pose. Throws std::invalid_argument if
    /// the solver refuses the bones or the method.
    const std::vector<glm::vec3>& follow(const TracedFrame& frame);

  private:
    void begin(const TracedFrame& frame);

    TraceSolve how_;
    std::optional<ik::Solver> solver_;
    ik::State state_;
    std::vector<ik::Limit> limits_;
    std::vector<glm::vec3> joints_;
};

/// A change to the solver's settings or input.
struct Prevention {
    enum class Kind { Method, Pole, SoftZone, Hinge };
    Kind kind = Kind::Method;
    TraceSolve solve;
    std::optional<glm::vec3> pole{};  ///< its position then, in the flip's frame
    bool adds_pole = false;           ///< the trace has no pole target

    /// "pole target moved by 4.2 cm, to (30.0, -50.0, 140.0) cm"
    std::string text(const Conventions& space) const;
};
inline constexpr const char* prevention_names[]{"method", "pole", "soft_zone", "hinge"};

struct PreventedFlip {
    bool tried = false;
    std::optional<ik::Method> flips_in;  ///< the Tendril method that flips on the same input, if any
    std::vector<Prevention> by;          ///< at most one of each kind
    bool reaches = false;                ///< some method's tip gets as close to the target as the trace's
    bool has_pole = false;               ///< whether the trace has a pole target
    /// For display, a clause about `flips_in`.
    std::string text() const;
};

inline constexpr std::size_t frames_before_flip = 24, frames_after_flip = 16;
/// Longer chains are not tried, nor are any flips once the chains tried have this many joints together: it
/// would take seconds.
inline constexpr std::size_t max_tried_joints = 64, max_joints_of_tries = 400;

/// `frames` are consecutive frames of one chain; the flip is between frame `at` and the one before, mostly at
/// `joint`. Takes some milliseconds.
PreventedFlip prevent_flip(std::span<const TracedFrame> frames, std::size_t at, std::size_t joint,
                           ik::FlipCause cause = ik::FlipCause::Unexplained);

/// The rounding of coordinates, to a number of decimals or of significant digits: learned for each power of
/// ten that has enough different values.
class Rounding {
  public:
    void add(double value);
    /// Maximum rounding error of a coordinate: half a unit of its last digit.
    double of(double value) const;

  private:
    static constexpr std::size_t enough = 4;  ///< the chance that so many all end in 0 is 1e-4
    struct Digits {
        int decimals = 0;
        std::set<double> values{};  ///< a few of them
    };
    int all_ = 0;  ///< the maximum number of decimals
    std::map<int, Digits> sizes_;
};

class TraceReader {
  public:
    /// Reads the first frames. Throws std::runtime_error if there are none, or they are damaged: "line 3:
    /// expected ...". `fps` overrides the file.
    explicit TraceReader(std::istream& in, const ConventionChoice& choice = {},
                         std::optional<double> fps = {});

    /// False after the last frame, or where the rest is damaged; a note then says so.
    bool next(TracedFrame& frame);

    const Conventions& conventions() const { return conventions_; }
    double fps() const { return fps_; }
    bool fps_known() const { return fps_known_; }  ///< given, or derived from the times
    const TraceHeader& header() const { return raw_->header; }
    /// For display: what was omitted, and where reading stopped.
    const std::vector<std::string>& notes() const { return notes_; }

  private:
    bool next_raw(RawFrame& frame);
    void find_rate();
    void find_end_effectors();

    std::unique_ptr<RawTrace> raw_;
    std::deque<RawFrame> first_;
    Conventions conventions_;
    std::map<std::string, std::size_t> joints_;  ///< joints of each chain
    std::optional<std::size_t> given_end_;       ///< from the header, for chains with that many joints
    std::map<std::string, std::size_t>
        ends_;  ///< the end effectors found, by chain, unless they are the last joint
    std::vector<std::string> notes_;
    double fps_ = 60.0;
    Rounding rounding_;
    bool fps_known_ = false, damaged_ = false;
};

struct TracedIncident : ik::ChainIncident {
    PreventedFlip prevented{};  ///< if a flip: how to prevent it

    /// "Frame 60: flip at joint 1 (elbow), 128 degrees". Bones as in the header; may be empty.
    std::string title(const std::vector<std::string>& bones, const Conventions& space) const;
    /// The title and the cause.
    std::string text(const std::vector<std::string>& bones, const Conventions& space) const {
        return title(bones, space) + ": " + cause;
    }
};

/// The incidents found in a trace, by chain.
struct TraceFindings {
    struct Chain {
        std::string name;  ///< empty if unnamed
        std::vector<TracedIncident> incidents;
        std::uint64_t frames = 0, left_off = 0;
    };
    std::vector<Chain> chains;
    std::size_t count() const;
};
/// Reads to the end. Calls `progress` from time to time.
TraceFindings find_incidents(TraceReader& reader, const std::function<void()>& progress = {});

}  // namespace tendril::app
