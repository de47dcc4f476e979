// States of a take, kept at some of its ticks so that going to any of them is quick. A cache: thrown away at
// any moment, no bit changes.
#pragma once

#include <map>

#include "app/labs/rig/rig_part.hpp"

namespace tendril::app {

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

}  // namespace tendril::app
