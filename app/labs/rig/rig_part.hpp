// The Rig lab's part of the document: a rig and its state.
//
// The document owns the whole state: input and current poses, control values, curves, and the memory and last
// outputs of the units. So undo, rewind and copies restore it bit for bit, and baking matches playback. The
// rig is the definition with the library's compiled data; copies share it.
#pragma once

#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <tendril/rig/backward.hpp>
#include <tendril/rig/rig.hpp>
#include <vector>

#include "app/document/document.hpp"
#include "app/document/workspace.hpp"
#include "app/fields/fields.hpp"
#include "app/labs/kit/flips.hpp"
#include "app/labs/kit/motion.hpp"
#include "app/labs/kit/selection.hpp"

namespace tendril::app {

// A clip: the poses of a rig's bones at 60 frames per second, like an imported animation. Solving it backward
// finds poses that the rig cannot express.

inline constexpr std::size_t max_clip_frames = 3'600, max_clip_poses = 100'000;

/// Relative to the nearest bone above, or to the world if there is none.
struct ClipPose {
    glm::vec3 translation{0.0f};
    glm::quat rotation{1.0f, 0.0f, 0.0f, 0.0f};
    glm::vec3 scale{1.0f};
    bool operator==(const ClipPose&) const = default;
};

struct RigClip {
    std::vector<std::string> bones;  ///< parents before their children
    std::vector<ClipPose> poses;     ///< frame by frame, one pose per bone
    std::uint64_t began = 0;         ///< the tick of the lab's time of the first frame

    std::size_t frames() const { return bones.empty() ? 0 : poses.size() / bones.size(); }
    bool operator==(const RigClip&) const = default;
};

/// Residuals below these are invisible, and finer than a clip's float precision.
inline constexpr double min_shown_mm = 0.1, min_shown_degrees = 0.01, min_shown_scale = 0.001;

/// The bone with the largest residual in a frame.
struct FrameLeft {
    float mm = 0.0f, degrees = 0.0f;
    std::uint32_t bone = 0;  ///< index in RigClip::bones
    float scale = 0.0f;      ///< the largest difference of any component
    bool stopped = false;    ///< stopped by the work limit: better values may exist
    bool expressed() const {
        return static_cast<double>(mm) <= min_shown_mm && static_cast<double>(degrees) <= min_shown_degrees &&
               static_cast<double>(scale) <= min_shown_scale;
    }
    bool operator==(const FrameLeft&) const = default;
};

/// A backward solve of the clip, frame by frame; each starts from the previous one.
struct ClipSolve {
    bool running = true;
    std::vector<FrameLeft> left;       ///< one per solved frame
    std::vector<rig::Value> controls;  ///< values in the last frame solved; the next one starts there
    std::size_t done() const { return left.size(); }
    bool operator==(const ClipSolve&) const = default;
};

// A take: the stretch of time that the Rig lab is in. It begins with a state. Everything after follows from
// that state, the paths of the controls, and the keys: when controls were set and the rig was solved. So any
// tick can be recomputed, in any order, bit for bit.
//
// A tick lasts tick_seconds at any clock speed; the clock only decides how many pass. So slow motion shows
// exactly the poses of real time.

/// Ten minutes. A longer take continues as a new one.
inline constexpr std::uint32_t max_take_ticks = 36'000;
/// A take with more keys also continues as a new one.
inline constexpr std::size_t max_take_keys = 3'600;

/// A control that follows a horizontal path within its space: y is constant.
struct RigWalk {
    std::string control;  ///< a transform or position control
    Motion motion;        ///< `ticks` is the phase at the start of the take
    bool turn = false;    ///< a transform control rotates its z axis along the path
    bool operator==(const RigWalk&) const = default;
};

/// An action after a tick and before the next: a control was set, or the rig was solved with a zero time
/// step, as every drag does while the simulation is paused.
struct TakeKey {
    static constexpr std::uint32_t solve = ~0u;
    std::uint32_t tick = 0;
    std::uint32_t element = 0;  ///< index in the definition, or `solve`
    rig::Value value{};         ///< within the limits of the control
    bool operator==(const TakeKey&) const = default;
};

struct RigTake {
    std::shared_ptr<const rig::State> start;           ///< null until a tick has passed
    std::shared_ptr<const std::vector<TakeKey>> keys;  ///< in tick order; null if there are none
    std::uint32_t tick = 0;                            ///< the current tick
    std::uint32_t last = 0;                            ///< the last tick played
    std::uint64_t began = 0;                           ///< the tick of the lab's time where the take begins
    bool recording = false;                            ///< until rig.clip.record makes it a clip

    std::uint64_t now() const { return began + tick; }
    bool operator==(const RigTake& other) const;
};

inline constexpr const char* rig_lab = "rig";
/// Units that a solve may run; those in bodies count once per element.
inline constexpr std::size_t max_lab_runs = 100'000;

/// The residuals of the last backward solve; reset by any change.
struct BackwardLeft {
    std::string bone;                     ///< the worst bone; empty if the rig has none
    std::vector<rig::Residual> elements;  ///< in definition order
    bool stopped = false;                 ///< stopped by the work limit: better values may exist
    bool operator==(const BackwardLeft& other) const;

    double worst_mm() const;       ///< maximum over all elements
    double worst_degrees() const;  ///< likewise
    double worst_scale() const;    ///< likewise
    bool expressed() const;        ///< all residuals are too small to see
};
/// Combines metres, radians and scale with a backward solve's weights, for bones about 0.3 m long.
double amount(const rig::Residual& left);

/// The largest distances between the bones at the usual frame rates; reset by any change.
struct RateDifference {
    double mm = 0.0, degrees = 0.0, scale = 0.0;  ///< maximum over all bones
    std::string bone;                             ///< bone with the largest distance; empty without bones
    std::string between;                          ///< the two rates: "15 Hz and 144 Hz"
    double seconds = 0.0;                         ///< when in the take
    double ticks = 0.0;                           ///< number of ticks compared
    std::size_t frames = 0, done = 0;             ///< frames of the slowest rate: total, and compared so far
    bool running = false;                         ///< more ticks will continue it
    bool operator==(const RateDifference&) const = default;
};

/// The items that the panel shows in detail.
struct RigSelection {
    Selection elements;      ///< by index in the definition
    std::string unit;        ///< by name; empty: none
    bool unit_last = false;  ///< the unit was selected after the elements, so Delete removes the unit
    bool operator==(const RigSelection&) const = default;

    /// The selected element; empty if none or several are selected.
    std::optional<std::size_t> only_element() const;
};

/// A state that copies share until one of them is edited, so that dragging a slider copies nothing.
class SharedState {
  public:
    SharedState(rig::State state) : state_(std::make_shared<rig::State>(std::move(state))) {}
    operator const rig::State&() const { return *state_; }
    const rig::State& operator*() const { return *state_; }
    const rig::State* operator->() const { return state_.get(); }
    /// The reference is valid until this is copied or edited again.
    rig::State& edit() {
        if (state_.use_count() > 1) state_ = std::make_shared<rig::State>(*state_);
        return *state_;
    }
    std::shared_ptr<const rig::State> share() const { return state_; }
    bool operator==(const SharedState& other) const { return state_ == other.state_ || *this == *other; }
    bool operator==(const rig::State& other) const { return *state_ == other; }

  private:
    std::shared_ptr<rig::State> state_;
};

struct RigPart final : Part {
    RigPart();  ///< an empty rig
    /// A rig at rest, after one tick: units with memory have started, and will follow later changes. Throws
    /// std::invalid_argument as redefine does.
    explicit RigPart(rig::Definition definition);

    rig::Rig rig;
    SharedState state;
    /// True if the next tick changes anything: there was an edit, or a unit with memory still moves.
    bool moving = false;
    std::optional<BackwardLeft> backward;
    RigTake take;                ///< `state` is its state at `take.tick`
    std::vector<RigWalk> walks;  ///< walks of existing controls only
    std::optional<RateDifference> rates;
    std::shared_ptr<const RigClip> clip;         ///< null if none was recorded
    std::shared_ptr<const ClipSolve> clip_left;  ///< null if it was not solved
    RigSelection selected;
    FlipRule flips;

    // Not saved: matters only between an edit by hand and the next solve.
    /// The state of the last solve, before controls were set; null if none was set since then.
    std::shared_ptr<const rig::State> last_solved;
    /// Something other than a control value has changed since the last solve.
    bool edited = false;
    const rig::State& solved_state() const { return last_solved ? *last_solved : *state; }

    /// The name of the active element; empty where none is selected.
    std::string selected_element() const;

    std::shared_ptr<Part> clone() const override { return std::make_shared<RigPart>(*this); }
    Json save() const override;
    std::shared_ptr<Part> load(const Json& json, const std::string& where) const override;
    std::shared_ptr<const Part> at_moment(std::shared_ptr<const Part> then) const override;
    std::size_t bytes() const override;
    bool operator==(const RigPart& other) const;
};

/// Approximate memory of a state.
std::size_t state_bytes(const rig::State& state);

/// The part that the lab starts with.
RigPart first_rig();

/// The lab's part of a workspace.
inline const RigPart& rig_part(const Workspace& workspace) {
    return workspace.document.get<RigPart>(rig_lab);
}

}  // namespace tendril::app

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::RateDifference>() noexcept;
