// The Rig lab's share of the document: a rig, and the state that it is in.
//
// The state as a whole is the document's: input and current poses, control values, curves, and what units
// remember and last handed out. So undo, going back in time and a copy of the document bring back the very
// bits, and what plays is what bakes. The rig is the definition together with what the library made of it,
// which copies share.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <tendril/rig/backward.hpp>
#include <tendril/rig/rig.hpp>
#include <vector>

#include "app/document/document.hpp"
#include "app/document/workspace.hpp"
#include "app/labs/kit/flip_rule.hpp"
#include "app/labs/kit/selection.hpp"
#include "app/labs/rig/rig_clip.hpp"
#include "app/labs/rig/rig_take.hpp"

namespace tendril::app {

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
