// What the Rig lab works in from tick to tick: the workspace of its rig, and how long each unit took.
#pragma once

#include <optional>
#include <tendril/rig/workspace.hpp>
#include <vector>

#include "app/document/runtime.hpp"
#include "app/labs/rig/rig_part.hpp"

namespace tendril::app {

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
    bool keeps(const rig::Rig& rig) const;

    std::optional<Kept> kept_;
    Read read_;
};

}  // namespace tendril::app
