// Analysing a solve. While the microscope or the race is open, every solve begins at the same start, so
// that moving the target shows another way from the same place.
#pragma once

#include <array>
#include <cstddef>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <tendril/chain/chain.hpp>
#include <tendril/ik/observer.hpp>
#include <vector>

#include "app/document/json.hpp"
#include "app/labs/chain/reach.hpp"

namespace tendril::app {

// The same start and the same target for several solvers.

/// Who takes part, by ik::Method.
using Racers = std::array<bool, ik::all_methods.size()>;

struct Racer {
    ik::Method method = ik::Method::Fabrik;
    ik::Report report;
    std::vector<glm::vec3> joints;  ///< where they ended
    /// Metres, before the first iteration and after each; never empty. The last is where the iterations
    /// ended.
    std::vector<float> residuals;
    /// Whether that was not the best pose, so that the best came back: the report's residual is the best's.
    bool restored = false;
    /// Of the whole solve, the fastest of several; measured here and now, so it differs from run to run:
    /// never in a state, nor in a picture that is compared.
    double microseconds = 0.0;
};

struct Race {
    std::vector<Racer> racers;
    float tolerance = 0.0f;  ///< metres
    bool within_limits = false;
};

Race run_race(const Chain& chain, const ReachSettings& settings, glm::vec3 target, const Racers& racers,
              ChainRuntime& runtime);

/// How a racer ended, in words: "Stalled, 310 mm from the target"; where the best pose was restored, "best
/// pose restored: 230 mm" beside it, else empty.
std::string end_text(const Racer& racer);
std::string restored_text(const Racer& racer);

/// A line for each iteration of each solver: solver, iteration, residual, microseconds, and on its last line
/// status, ran (ran_text's words), and restored: the best pose's residual where that came back.
std::string race_csv(const Race& race);

// The inside of one solve: every elementary step that an observer saw, and the pose after each.

inline constexpr int max_trace_steps = 200'000;  ///< what comes later is left out, and said to be

struct Trace {
    ik::Method method = ik::Method::Fabrik;
    ik::Report report;
    std::vector<glm::vec3> start;           ///< the joints before anything moved
    std::vector<ik::Step> steps;            ///< in the order in which they happened
    std::vector<std::size_t> frame_begins;  ///< where each group of steps that happen at once begins
    std::vector<float> residuals;           ///< metres, at the start and after each iteration
    bool cut = false;

    std::size_t frames() const { return frame_begins.size(); }
    /// The steps that take frame `frame - 1` to `frame`; none for frame 0.
    std::span<const ik::Step> frame(std::size_t frame) const;
    /// The joints after `frame` frames.
    std::vector<glm::vec3> pose(std::size_t frame) const;
    /// The iteration that a frame belongs to; 0 before the first.
    int iteration(std::size_t frame) const;
    /// The last frame of an iteration.
    std::size_t end_of_iteration(int iteration) const;
};

/// The last frame of what comes before the first iteration, and of each iteration.
std::vector<int> iteration_ends(const Trace& trace);

/// Solves a copy of the chain, and watches.
Trace record_trace(Chain chain, ReachSettings settings, glm::vec3 target, ChainRuntime& runtime);

/// "Forward reaching: joint 2 goes to 1.00 m from joint 3, on the line through where it was."
std::string describe_frame(const Trace& trace, std::size_t frame);

inline constexpr float slowest_pace = 0.1f, default_pace = 8.0f, fastest_pace = 600.0f;  ///< steps a second
inline constexpr std::size_t max_studied_segments = 512;  ///< more would drown a picture and take too long

struct Study {
    enum class Kind { None, Microscope, Race } kind = Kind::None;
    std::vector<glm::vec3> start;  ///< where each solve begins, one a segment
    ik::State start_state;         ///< and what the solver remembers there, as in ReachSettings
    std::size_t step = 0;          ///< microscope: how many elementary steps are shown, 0 to all of them
    Racers racers{true, true, true, false, true, false, false};  ///< by ik::Method
    bool side_by_side = false;
    float pace = 0.0f;    ///< microscope: steps a second that it goes on by itself; 0: it stands
    double passed = 0.0;  ///< steps since it began to

    /// Where the last drag began (or the last solve, where nobody dragged), for a study that is opened after
    /// it; not saved, nothing for long chains.
    std::vector<glm::vec3> last_start;
    ik::State last_state;
    bool gesture_begins = true;  ///< the next solve is the first of its drag

    bool operator==(const Study& other) const;

    bool open() const { return kind != Kind::None; }
    /// What each solve starts from: where the last drag began, where the chain is now, or all in line.
    enum class From { Last, Here, Straight };
    /// Throws std::invalid_argument for a chain that is too short or long. One study follows another from the
    /// same start, unless told otherwise.
    void begin(Kind as, std::optional<From> from, const Chain& chain, const ReachSettings& settings);
    /// A solve is about to begin, the first of a drag or another of it.
    void note_start(const Chain& chain, const ReachSettings& settings);
    void close();
    /// Lets a tick pass while the microscope plays; it stands at the `last` step.
    void play(double seconds, std::size_t last);
    /// Puts the chain back to the start; nothing while nothing is studied.
    void rewind(Chain& chain, ReachSettings& settings) const;
    std::size_t bytes() const;
};

/// What a study comes to: the trace of the solve under the microscope, or the race. Worked out, never saved:
/// the lab's runtime has it.
struct Studied {
    std::shared_ptr<const Trace> trace;
    std::shared_ptr<const Race> race;
};
Studied work_out(const Study& study, Chain chain, ReachSettings settings, glm::vec3 target,
                 ChainRuntime& runtime);

Json save_study(const Study& study);
Study load_study(const JsonPlace& place, const Chain& chain);

}  // namespace tendril::app
