// Analysing a solve with the microscope, or several with the race. While either is open, every solve begins
// at the same start, so that moving the target shows another path from the same pose. Both are played and
// scrubbed in the same way.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <tendril/chain/chain.hpp>
#include <tendril/ik/method.hpp>
#include <tendril/ik/observer.hpp>
#include <tendril/ik/report.hpp>
#include <vector>

#include "app/io/json.hpp"
#include "app/labs/chain/reach.hpp"

namespace tendril::app {

class ChainRuntime;

// A race: several solvers with the same start and target, and the pose of each after each of its iterations.

/// Which solvers take part, indexed by ik::Method.
using Racers = std::array<bool, ik::all_methods.size()>;

/// Poses after iterations 0, 1, 2, ... of a solve, in bounded memory: when it is full, every second pose is
/// dropped and from then on only every second is kept; then every fourth, and so on.
class KeptPoses {
  public:
    /// Positions, 3 MiB in all: every iteration of up to 26 joints, at least 256 iterations of 512 joints.
    static constexpr std::size_t default_most = 1u << 18;

    explicit KeptPoses(std::size_t most = default_most) : most_(most) {}

    /// The pose after the next iteration. All poses have the same number of joints.
    void add(std::span<const glm::vec3> pose);
    bool empty() const { return joints_.empty(); }
    /// The last kept iteration up to `iteration`.
    int kept(int iteration) const;
    /// The pose after kept(iteration). Must not be empty.
    std::span<const glm::vec3> at(int iteration) const;
    std::size_t bytes() const { return joints_.capacity() * sizeof(glm::vec3); }

  private:
    std::vector<glm::vec3> joints_;
    std::size_t most_, size_ = 0;         ///< joints in all, and per pose
    std::size_t added_ = 0, stride_ = 1;  ///< iterations so far, and from one kept pose to the next
};

struct Racer {
    ik::Method method = ik::Method::Fabrik;
    ik::Report report;
    std::vector<glm::vec3> joints;  ///< the final pose
    KeptPoses poses;                ///< after each iteration; 0 is the prepared start
    /// Metres, before the first iteration and after each; never empty. The last is the final one.
    std::vector<float> residuals;
    /// True if the solver finally restored an earlier, better pose; the report's residual is that pose's.
    bool restored = false;
    /// Time of the whole solve, the fastest of several runs. It varies from run to run, so it must not appear
    /// in --state or in compared pictures.
    double microseconds = 0.0;

    int iterations() const { return static_cast<int>(residuals.size()) - 1; }
};

/// A racer after an iteration of the race. Once finished, it stays at its end.
struct RacerAt {
    bool finished = false;
    int iteration = 0;                  ///< its own; in a long solve of a long chain, the last kept one
    std::span<const glm::vec3> joints;  ///< of the racer, or of its kept poses
    float error = 0.0f;                 ///< metres from the tip to the target
};
RacerAt racer_at(const Racer& racer, std::size_t iteration);

struct Race {
    std::vector<Racer> racers;
    float tolerance = 0.0f, root_to_target = 0.0f;  ///< metres

    /// The largest count of all racers.
    std::size_t iterations() const;
};

Race run_race(const Chain& chain, const ReachSettings& settings, glm::vec3 target, const Racers& racers,
              ChainRuntime& runtime);

/// "iteration 3", or "finished after 4"; "error 48.5 mm".
std::string progress_text(const RacerAt& at);
/// The same; if it ended short of the target, with the reason: "stopped after 12, out of reach".
std::string outcome_text(const Racer& racer, const RacerAt& at);
std::string error_reading(const RacerAt& at);
/// "48.5 mm from the target"; with its status once it has finished: "Stalled, 310 mm from the target".
std::string error_text(const Racer& racer, const RacerAt& at);
/// The end of a racer: "Stalled, 310 mm from the target"; or, if something besides the solver named above
/// ran, with that at the end: "Out of reach, 310 mm; solved in closed form".
std::string end_text(const Racer& racer);

// The trace of one solve: every elementary step that an observer saw, and the pose after each.

inline constexpr int max_trace_steps = 200'000;  ///< later ones are dropped, and `cut` is set

struct Trace {
    ik::Method method = ik::Method::Fabrik;
    ik::Report report;
    std::vector<glm::vec3> start;           ///< the initial pose
    std::vector<ik::Step> steps;            ///< in order of execution
    std::vector<std::size_t> frame_begins;  ///< the first step of each frame: a group of simultaneous steps
    std::vector<float> residuals;           ///< metres, at the start and after each iteration
    bool cut = false;

    std::size_t frames() const { return frame_begins.size(); }
    /// The steps from frame `frame - 1` to `frame`; empty for frame 0.
    std::span<const ik::Step> frame(std::size_t frame) const;
    /// The joints after `frame` frames.
    std::vector<glm::vec3> pose(std::size_t frame) const;
    /// The iteration of a frame; 0 before the first.
    int iteration(std::size_t frame) const;
    /// The last frame of an iteration.
    std::size_t end_of_iteration(int iteration) const;
};

/// The last frame before the first iteration, then the last frame of each iteration.
std::vector<int> iteration_ends(const Trace& trace);

/// Solves a copy of the chain and records its steps.
Trace record_trace(Chain chain, ReachSettings settings, glm::vec3 target, ChainRuntime& runtime);

/// "Forward reaching: joint 2 goes to 1.00 m from joint 3, on the line through where it was."
std::string describe_frame(const Trace& trace, std::size_t frame);

inline constexpr float slowest_pace = 0.1f, default_pace = 8.0f, fastest_pace = 600.0f;  ///< steps per second
/// Iterations per second: 4, or as many as make the whole race last 3 to 11 s.
float race_pace(std::size_t iterations);
/// Duration of race.record's film at that pace; the end is held for a second.
inline double race_film_seconds(std::size_t iterations) {
    return static_cast<double>(iterations) / static_cast<double>(race_pace(iterations)) + 1.0;
}
inline constexpr std::size_t max_studied_segments = 512;  ///< more would clutter the scene and take too long

struct Study {
    enum class Kind { None, Microscope, Race } kind = Kind::None;
    std::vector<glm::vec3> start;  ///< the start of every solve, one position per segment
    ik::State start_state;         ///< the solver's state at the start, as in ReachSettings
    /// The step shown. Microscope: the number of frames, 0 to all of them. Race: the iteration; race_end
    /// means the end of any race, however long it is.
    std::size_t step = 0;
    static constexpr std::size_t race_end = max_trace_steps;
    Racers racers{true, true, true, false, true, false, false};  ///< by ik::Method
    bool side_by_side = false;
    float pace = 0.0f;    ///< playback in steps or iterations per second; 0: paused
    double passed = 0.0;  ///< steps since playback began

    /// The pose before the last drag (or before the last solve outside a drag), where a study that is opened
    /// later can start. Saved with the result of that solve; empty for long chains.
    std::vector<glm::vec3> last_start;
    ik::State last_state;
    bool gesture_begins = true;  ///< the next solve is the first of its drag

    bool operator==(const Study& other) const;

    bool open() const { return kind != Kind::None; }
    /// The start: before the last drag, the present pose, or straight.
    enum class From { Last, Here, Straight };
    /// Throws std::invalid_argument if the chain is too short or too long. If a study is already open and
    /// `from` is empty, the start stays the same.
    void begin(Kind as, std::optional<From> from, const Chain& chain, const ReachSettings& settings);
    /// Call before each solve: records the start if the solve is the first of its drag.
    void note_start(const Chain& chain, const ReachSettings& settings);
    void close();
    /// Shows a step, at most `last`. A race at its last iteration stays at its end if its length changes.
    void go_to(std::size_t to, std::size_t last);
    /// Plays for `seconds`; stops at step `last`.
    void play(double seconds, std::size_t last);
    /// Moves the chain back to the start; does nothing if no study is open.
    void rewind(Chain& chain, ReachSettings& settings) const;
    std::size_t bytes() const;
};

/// The result of a study: a trace or a race. Never saved; the lab's runtime caches it.
struct Studied {
    std::shared_ptr<const Trace> trace;  ///< trace of the solve under the microscope, or null
    std::shared_ptr<const Race> race;    ///< null if there is none

    /// The last step of the microscope, or the last iteration of the race.
    std::size_t last() const { return trace ? trace->frames() : race ? race->iterations() : 0; }
};
Studied work_out(const Study& study, Chain chain, ReachSettings settings, glm::vec3 target,
                 ChainRuntime& runtime);

Json save_study(const Study& study);
Study load_study(const JsonPlace& place, const Chain& chain);
/// A start: one position per segment, and the solver's state there.
Json save_start(const std::vector<glm::vec3>& joints, const ik::State& state);
void load_start(const JsonPlace& place, const Chain& chain, std::vector<glm::vec3>& joints, ik::State& state);

}  // namespace tendril::app

/// The fields for how it is shown and played.
template <>
std::span<const tendril::Field> tendril::fields<tendril::app::Study>() noexcept;
