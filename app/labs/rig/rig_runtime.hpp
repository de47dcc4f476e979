// Caches that the Rig lab keeps between ticks: the workspace of its rig, the time each unit took, take
// snapshots, and data derived from the part for panels and drawing.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <tendril/rig/explain.hpp>
#include <tendril/rig/workspace.hpp>
#include <vector>

#include "app/document/runtime.hpp"
#include "app/labs/rig/clip.hpp"
#include "app/labs/rig/rig_part.hpp"
#include "app/widgets/fields.hpp"

namespace tendril::app {

// Snapshots of the take's state at some of its ticks, which make it quick to go to any tick. A cache:
// discarding it changes no result.

class TakeSnapshots {
  public:
    struct Snapshot {
        SharedState state;  ///< before that tick's controls were set
        bool moving = false;
    };
    /// Keeps the part's current tick if a snapshot is due there.
    void offer(const RigPart& part);
    /// Keeps it in any case. The controls set at its tick must not be applied yet.
    void keep(const RigPart& part);
    /// The last snapshot at or before a tick, with its tick; null if there is none.
    const std::pair<const std::uint32_t, Snapshot>* nearest(const RigPart& part, std::uint32_t tick);
    std::size_t size() const { return by_tick_.size(); }

  private:
    void follow(const RigPart& part);

    std::map<std::uint32_t, Snapshot> by_tick_;
    static constexpr std::uint32_t first_stride = 8;
    std::uint32_t stride_ = first_stride;  ///< snapshots are kept at multiples of this
    std::size_t bytes_ = 0;
    // The data that the snapshots depend on.
    std::shared_ptr<const rig::State> start_;
    std::shared_ptr<const std::vector<TakeKey>> keys_;
    std::vector<RigWalk> walks_;
    std::optional<rig::Rig> rig_;
};

class RigRuntime final : public Runtime {
  public:
    /// The workspace for this rig and its copies. The reference is valid until another rig is asked for.
    rig::Workspace& workspace(const rig::Rig& rig);

    /// Solves forward. `measured`: times each unit.
    bool solve(RigPart& part, double dt, bool measured);

    /// Microseconds per unit of the definition in the last measured solve; empty if that was another rig.
    std::vector<double> microseconds(const rig::Rig& rig) const;

    /// The elements of the lab's part with nothing pending. The reference is valid until the next call.
    const rig::Hierarchy& resolved(const Workspace& workspace);

    TakeSnapshots snapshots;
    RatesWork rates;

    /// Why an element of the lab's part is where it is; recomputed when the part changes. The reference is
    /// valid until the next call.
    const rig::Explanation& explanation(const Workspace& workspace, std::size_t element);

    /// State of the interface only; nothing else depends on it.
    struct Panel {
        SearchText filter{};          ///< text that names in the tree must contain
        std::string shown{}, unit{};  ///< the items that the lists last scrolled to
        bool all_units = false;       ///< whether to list units that did not affect the element
        /// The last Euler angles entered for `rotation`, which has many equivalent ones.
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

inline RigRuntime& rig_runtime(const Workspace& workspace) {
    return workspace.runtimes.of<RigRuntime>(rig_lab);
}

}  // namespace tendril::app
