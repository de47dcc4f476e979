// Analysing a solve. While the microscope or the race is open, every solve begins at the same start, so
// that moving the target shows another way from the same place.
#pragma once

#include <cstddef>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <tendril/chain/chain.hpp>
#include <vector>

#include "app/document/json.hpp"
#include "app/labs/chain/race.hpp"
#include "app/labs/chain/reach.hpp"
#include "app/labs/chain/trace.hpp"

namespace tendril::app {

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
