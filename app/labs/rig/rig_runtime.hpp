// What the Rig lab works in from tick to tick: the workspace of its rig, how long each unit took, and what
// panels and picture need of the part, worked out once.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <tendril/rig/explain.hpp>
#include <tendril/rig/workspace.hpp>
#include <vector>

#include "app/document/runtime.hpp"
#include "app/labs/rig/clip.hpp"
#include "app/labs/rig/rig_part.hpp"

namespace tendril::app {

// States of a take, kept at some of its ticks so that going to any of them is quick. A cache: thrown away at
// any moment, no bit changes.

class TakeSnapshots {
  public:
    struct Snapshot {
        rig::State state;  ///< before what was set at that tick
        bool moving = false;
    };
    /// The part as it is at its tick; taken where it is one of those that are kept.
    void offer(const RigPart& part);
    /// Takes it in any case. What was set at its tick is to be no part of it yet.
    void keep(const RigPart& part);
    /// The last one at or before a tick, with its tick; null where there is none.
    const std::pair<const std::uint32_t, Snapshot>* nearest(const RigPart& part, std::uint32_t tick);
    std::size_t size() const { return by_tick_.size(); }

  private:
    void follow(const RigPart& part);

    std::map<std::uint32_t, Snapshot> by_tick_;
    std::uint32_t stride_ = 8;  ///< kept are the ticks that this divides
    std::size_t bytes_ = 0;
    // what they follow from
    std::shared_ptr<const rig::State> start_;
    std::shared_ptr<const std::vector<TakeKey>> keys_;
    std::vector<RigWalk> walks_;
    std::optional<rig::Rig> rig_;
};

class RigRuntime final : public Runtime {
  public:
    /// Of this rig and its copies; kept until another asks.
    rig::Workspace& workspace(const rig::Rig& rig);

    /// Solves forward. `measured`: takes the time of each unit.
    bool solve(RigPart& part, double dt, bool measured);

    /// Microseconds that each unit of the definition took when it was last measured; empty where that was
    /// another rig.
    std::vector<double> microseconds(const rig::Rig& rig) const;

    /// The elements of the lab's part with all poses worked out. The reference holds until the next call.
    const rig::Hierarchy& resolved(const Workspace& workspace);

    TakeSnapshots snapshots;
    RatesWork rates;

    /// Why an element of the lab's part is where it is; worked out anew where the part has changed. The
    /// reference holds until the next call.
    const rig::Explanation& explanation(const Workspace& workspace, std::size_t element);

    /// The interface's own: it follows from nothing, and nothing follows from it.
    struct Panel {
        std::array<char, 64> filter{};  ///< what names in the tree have to contain
        std::array<char, 64> choice{};  ///< what is looked for among what an input may be
        std::string shown{}, unit{};    ///< what the lists were last scrolled to
        bool all_units = false;         ///< whether those that did not touch the element are listed too
        /// Euler angles as a person last set them, of the rotation that they give: one has many.
        glm::dvec3 degrees{0.0};
        glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
    } panel;

  private:
    struct Read {
        std::shared_ptr<const Part> part;  ///< parts never change in place
        rig::Hierarchy elements;
    };
    struct Kept {
        rig::Rig rig;
        rig::Workspace workspace;
        std::vector<double> microseconds;
    };
    struct Why {
        std::shared_ptr<const Part> part;
        std::size_t element = 0;
        rig::Explanation explanation;
    };
    bool keeps(const rig::Rig& rig) const;

    std::optional<Kept> kept_;
    Read read_;
    Why why_;
};

}  // namespace tendril::app
