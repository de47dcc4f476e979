// The Rig lab's share of the document: a rig, and the state that it is in.
//
// The state as a whole is the document's: input and current poses, control values, curves, and what units
// remember and last handed out. So undo, going back in time and a copy of the document bring back the very
// bits, and what plays is what bakes. The rig is the definition together with what the library made of it,
// which copies share.
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
#include "app/labs/kit/flips.hpp"
#include "app/labs/kit/motion.hpp"
#include "app/labs/kit/selection.hpp"

namespace tendril::app {

// A clip: the poses of a rig's bones, sixty a second, as an animation that is imported has them. And what a
// backward solve leaves of it: what the rig cannot express.

inline constexpr std::size_t max_clip_frames = 3'600, max_clip_poses = 100'000;

/// Within the nearest bone above, or within the world where there is none.
struct ClipPose {
    glm::vec3 translation{0.0f};
    glm::quat rotation{1.0f, 0.0f, 0.0f, 0.0f};
    glm::vec3 scale{1.0f};
    bool operator==(const ClipPose&) const = default;
};

struct RigClip {
    std::vector<std::string> bones;  ///< parents before their children
    std::vector<ClipPose> poses;     ///< frame after frame, one a bone
    std::uint64_t began = 0;         ///< the tick of the lab's time that the first frame is of

    std::size_t frames() const { return bones.empty() ? 0 : poses.size() / bones.size(); }
    bool operator==(const RigClip&) const = default;
};

/// What is left of a bone, and is less than that, nobody sees, and a clip's numbers do not tell.
inline constexpr double min_shown_mm = 0.1, min_shown_degrees = 0.01, min_shown_scale = 0.001;

/// Of the bone with the most left in a frame.
struct FrameLeft {
    float mm = 0.0f, degrees = 0.0f;
    std::uint32_t bone = 0;  ///< its place in RigClip::bones
    float scale = 0.0f;      ///< the largest difference of a component
    bool stopped = false;    ///< by the work it took: there may be values that come nearer
    bool expressed() const {
        return static_cast<double>(mm) <= min_shown_mm && static_cast<double>(degrees) <= min_shown_degrees &&
               static_cast<double>(scale) <= min_shown_scale;
    }
    bool operator==(const FrameLeft&) const = default;
};

/// A backward solve of the clip, frame by frame, each from the one before.
struct ClipSolve {
    bool running = true;
    std::vector<FrameLeft> left;       ///< of the frames so far
    std::vector<rig::Value> controls;  ///< of the last of them: where the next begins
    std::size_t done() const { return left.size(); }
    bool operator==(const ClipSolve&) const = default;
};

// The stretch of time that the Rig lab is in: a take. It begins with a state, and what comes after follows
// from that alone, from the paths that controls follow and from what was set of controls since, and where the
// rig was solved then. So any tick of it can be worked out anew, in any order, to the bit.
//
// A tick is tick_seconds long whatever the speed of the clock, which says how many of them pass: slow motion
// shows the very poses that real time shows.

/// Ten minutes. One that grows longer goes on as another.
inline constexpr std::uint32_t max_take_ticks = 36'000;
/// Likewise.
inline constexpr std::size_t max_take_keys = 3'600;

/// A control follows a path, which lies flat within the control's space: its y stays.
struct RigWalk {
    std::string control;  ///< a transform or position control
    Motion motion;        ///< `ticks`: how far round it is where the take begins
    bool turn = false;    ///< a transform control looks along the path, with its z axis
    bool operator==(const RigWalk&) const = default;
};

/// What was done after a tick, before the next: a control was set; or the rig was solved without any time
/// passing, as every drag does while the simulation is paused.
struct TakeKey {
    static constexpr std::uint32_t solve = ~0u;
    std::uint32_t tick = 0;
    std::uint32_t element = 0;  ///< its place in the definition, or solve
    rig::Value value{};         ///< within its limits
    bool operator==(const TakeKey&) const = default;
};

struct RigTake {
    std::shared_ptr<const rig::State> start;           ///< null until a tick has passed
    std::shared_ptr<const std::vector<TakeKey>> keys;  ///< by tick, in order; null where there are none
    std::uint32_t tick = 0;                            ///< that it is at
    std::uint32_t last = 0;                            ///< that it was played to
    std::uint64_t began = 0;                           ///< the tick of the lab's time where it begins

    std::uint64_t now() const { return began + tick; }
    bool operator==(const RigTake& other) const;
};

inline constexpr const char* rig_lab = "rig";
/// Units that a solve may run, those in bodies once an element.
inline constexpr std::size_t max_lab_runs = 100'000;

/// What the last backward solve left, until something is changed.
struct BackwardLeft {
    std::string bone;                     ///< the worst; empty in a rig without bones
    std::vector<rig::Residual> elements;  ///< in the order of the definition
    bool stopped = false;                 ///< by the work it took: there may be values that come nearer
    bool operator==(const BackwardLeft& other) const;

    double worst_mm() const;       ///< of all bones
    double worst_degrees() const;  ///< likewise
    double worst_scale() const;    ///< likewise
    bool expressed() const;        ///< all of them closer than shows
};
/// Metres, radians and scales together, as a backward solve weighs them for bones some 0.3 m long.
double amount(const rig::Residual& left);

/// How far apart the bones come at the usual frame rates, until something is changed.
struct RateDifference {
    double mm = 0.0, degrees = 0.0, scale = 0.0;  ///< the most of any bone
    std::string bone;                  ///< the one that is farthest apart; empty in a rig without bones
    std::string between;               ///< which rates: "15 Hz and 144 Hz"
    double seconds = 0.0;              ///< in the take, when it is
    double ticks = 0.0;                ///< of the take that are compared
    std::size_t frames = 0, done = 0;  ///< of the slowest rate: all, and those compared so far
    bool running = false;              ///< ticks go on with it
    bool operator==(const RateDifference&) const = default;
};

/// What the panel shows more of.
struct RigSelection {
    Selection elements;      ///< by their places in the definition
    std::string unit;        ///< by its name; empty: none
    bool unit_last = false;  ///< of both the unit was selected last: that is what Delete removes
    bool operator==(const RigSelection&) const = default;

    /// The one element that is selected; nothing where it is none or several.
    std::optional<std::size_t> only_element() const;
};

struct RigPart final : Part {
    RigPart();  ///< of an empty rig
    /// Of a rig at rest, after a tick: what remembers has started there, and trails whatever is set next.
    /// Throws std::invalid_argument as redefine does.
    explicit RigPart(rig::Definition definition);

    rig::Rig rig;
    rig::State state;
    /// Whether the next tick has anything to do: something was changed, or something that remembers moves.
    bool moving = false;
    std::optional<BackwardLeft> backward;
    RigTake take;                ///< `state` is its state at its tick
    std::vector<RigWalk> walks;  ///< of controls that the rig has
    std::optional<RateDifference> rates;
    std::shared_ptr<const RigClip> clip;         ///< null where none was recorded
    std::shared_ptr<const ClipSolve> clip_left;  ///< null where it was not solved
    RigSelection selected;
    FlipRule flips;

    // What no file has: it is of the moment between a change by hand and the next solve.
    /// As the rig was last solved, before controls were set; null where none has been set since.
    std::shared_ptr<const rig::State> last_solved;
    /// More than controls was changed since.
    bool edited = false;
    const rig::State& solved_state() const { return last_solved ? *last_solved : state; }

    /// The name of the active element; empty where none is selected.
    std::string selected_element() const;

    std::shared_ptr<Part> clone() const override { return std::make_shared<RigPart>(*this); }
    Json save() const override;
    std::shared_ptr<Part> load(const Json& json, const std::string& where) const override;
    std::shared_ptr<const Part> at_moment(std::shared_ptr<const Part> then) const override;
    std::size_t bytes() const override;
    bool operator==(const RigPart& other) const;
};

/// Roughly.
std::size_t state_bytes(const rig::State& state);

inline constexpr FlipWords rig_flip_words{"rig.flips", "control", "the control, as the bone sees it,", "size",
                                          "the size of the skeleton"};

/// What the lab starts with.
RigPart first_rig();

/// The lab's part of a workspace.
inline const RigPart& rig_part(const Workspace& workspace) {
    return workspace.document.get<RigPart>(rig_lab);
}

}  // namespace tendril::app
