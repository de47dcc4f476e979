// Reads a trace, which says frame by frame what an engine's chains did, and solves its input again to explain
// a flip. JSON Lines, CSV, tables, or text with vectors in it; the space is converted to Tendril's. Streams:
// memory does not grow with the number of frames. The formats: `tendril trace --help`.
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

// Tendril's own solve of a trace's input, and what would have prevented a flip: small changes
// under which that solve has none. Each was tried by solving the frames around the flip.

bool is_finite_point(glm::vec3 p);

/// A frame of one chain in metres, right-handed, Y up.
struct TracedFrame {
    std::string chain;  ///< empty if it has no name
    std::vector<glm::vec3> joints;
    std::optional<glm::vec3> target, pole;
    std::vector<glm::quat> rotations;  ///< empty, or one a bone or a joint
    std::optional<float> dt;
    float resolution = 0.0f;  ///< how far a coordinate of a joint may be off by rounding
    std::size_t line = 0;
    std::optional<std::size_t> end{};  ///< the joint that reaches for the target; without it, the last

    std::size_t end_effector() const { return end.value_or(joints.size() - 1); }
    /// The end effector stands in where there is no target.
    glm::vec3 goal() const { return target.value_or(joints[end_effector()]); }
    /// Whether joints, target and pole target are finite.
    bool finite() const;
};

/// How the input is solved.
struct TraceSolve {
    ik::Method method = ik::Method::Fabrik;
    float soft_zone = 0.0f;   ///< fraction of the reach, 0 to 1
    glm::vec3 pole_by{0.0f};  ///< metres: moves the pole target or, without one, adds it, from the root
    int hinge = 0;            ///< this joint bends one way only, as in the first frame; 0: none

    bool operator==(const TraceSolve&) const = default;
    /// The pole target of a frame after the change.
    std::optional<glm::vec3> pole(const TracedFrame& frame) const;
    /// The hinge, for the joints of the first frame up to the end effector; empty without one. Throws
    /// std::invalid_argument if it is at the root or the tip.
    std::vector<ik::Limit> limits(std::span<const glm::vec3> joints) const;
    /// Without the hinge.
    ik::Options options(const TracedFrame& frame) const {
        return {.pole = pole(frame), .soft_zone = soft_zone};
    }
};

/// A chain that is led through frames, from the pose of the first. Joints beyond the end effector are carried
/// along.
class Retrace {
  public:
    explicit Retrace(const TraceSolve& how) : how_(how) {}
    /// The pose in that frame; where the frame is not finite, the one before. Throws std::invalid_argument
    /// for bones or a method that the solver does not take.
    const std::vector<glm::vec3>& follow(const TracedFrame& frame);

  private:
    void begin(const TracedFrame& frame);

    TraceSolve how_;
    std::optional<ik::Solver> solver_;
    ik::State state_;
    std::vector<ik::Limit> limits_;
    std::vector<glm::vec3> joints_;
};

/// A change to how the input is solved.
struct Prevention {
    enum class Kind { Method, Pole, SoftZone, Hinge };
    Kind kind = Kind::Method;
    TraceSolve solve;
    std::optional<glm::vec3> pole{};  ///< where the pole target then is, in the flip's frame
    bool adds_pole = false;           ///< the trace has none

    /// "pole target moved by 4.2 cm, to (30.0, -50.0, 140.0) cm"
    std::string text(const Conventions& space) const;
};
inline constexpr const char* prevention_names[]{"method", "pole", "soft_zone", "hinge"};

struct PreventedFlip {
    bool tried = false;
    std::optional<ik::Method> flips_in;  ///< the method of Tendril that flips on the same input, if one does
    std::vector<Prevention> by;          ///< at most one of each kind
    bool reaches = false;                ///< a method's tip comes as near to the target as the trace's
    bool has_pole = false;               ///< the trace
    /// For display, a clause about `flips_in`.
    std::string text() const;
};

inline constexpr std::size_t frames_before_flip = 24, frames_after_flip = 16;
/// Longer chains are not tried, nor are flips once the chains of those before have so many joints together:
/// it would take seconds.
inline constexpr std::size_t max_tried_joints = 64, max_joints_of_tries = 400;

/// `frames` are consecutive and of one chain; the flip is between `at` and the frame before it, and most of
/// it at `joint`. Some milliseconds.
PreventedFlip prevent_flip(std::span<const TracedFrame> frames, std::size_t at, std::size_t joint,
                           ik::FlipCause cause = ik::FlipCause::Unexplained);

/// The last digits of coordinates, which may have a number of decimals or of significant digits: learned for
/// each power of ten, where enough different ones were seen.
class Rounding {
  public:
    void add(double value);
    /// How far a coordinate may be off: half a unit of its last digit.
    double of(double value) const;

  private:
    static constexpr std::size_t enough = 4;  ///< that all end in 0 by chance: 1e-4
    struct Digits {
        int decimals = 0;
        std::set<double> values{};  ///< some
    };
    int all_ = 0;  ///< decimals, the most
    std::map<int, Digits> sizes_;
};

class TraceReader {
  public:
    /// Reads the first frames. Throws std::runtime_error if there are none, or they are damaged: "line 3:
    /// expected ...". `fps` overrides the file.
    explicit TraceReader(std::istream& in, const ConventionChoice& choice = {},
                         std::optional<double> fps = {});

    /// False after the last frame, and where the rest is damaged, which is then a note.
    bool next(TracedFrame& frame);

    const Conventions& conventions() const { return conventions_; }
    double fps() const { return fps_; }
    bool fps_known() const { return fps_known_; }  ///< given, or from the times
    const TraceHeader& header() const { return raw_->header; }
    /// For display: what was left out, where reading stopped.
    const std::vector<std::string>& notes() const { return notes_; }

  private:
    bool next_raw(RawFrame& frame);
    void find_rate();
    void find_end_effectors();

    std::unique_ptr<RawTrace> raw_;
    std::deque<RawFrame> first_;
    Conventions conventions_;
    std::map<std::string, std::size_t> joints_;  ///< of each chain
    std::optional<std::size_t> given_end_;       ///< of the chains that have so many joints
    std::map<std::string, std::size_t>
        ends_;  ///< the end effector of a chain, found, unless it is the last joint
    std::vector<std::string> notes_;
    double fps_ = 60.0;
    Rounding rounding_;
    bool fps_known_ = false, damaged_ = false;
};

struct TracedIncident : ik::ChainIncident {
    PreventedFlip prevented{};  ///< of a flip

    /// "Frame 60: flip at joint 1 (elbow), 128 degrees". Bones as in the header; may be empty.
    std::string title(const std::vector<std::string>& bones, const Conventions& space) const;
    /// The title, and why.
    std::string text(const std::vector<std::string>& bones, const Conventions& space) const {
        return title(bones, space) + ": " + cause;
    }
};

/// What was found in a trace, chain by chain.
struct TraceFindings {
    struct Chain {
        std::string name;  ///< empty if it has none
        std::vector<TracedIncident> incidents;
        std::uint64_t frames = 0, left_off = 0;
    };
    std::vector<Chain> chains;
    std::size_t count() const;
};
/// Reads to the end. Calls `progress` now and then.
TraceFindings find_incidents(TraceReader& reader, const std::function<void()>& progress = {});

}  // namespace tendril::app
