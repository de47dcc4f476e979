// A lab's last ten seconds, to go back in time: its part at every tick in which it was simulated or
// changed by hand, or, where they grow too large, at every second, fourth, ... of them; and what happened in
// them. They are none of the document's, and no file holds them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>

#include "app/document/document.hpp"
#include "app/document/history.hpp"
#include "app/document/incident.hpp"

namespace tendril::app {

class Rewind {
  public:
    static constexpr std::uint64_t most_ticks = 600;
    static constexpr std::size_t most_incidents = 256;

    struct Moment {
        std::uint64_t tick = 0;     ///< counts the moments
        std::uint64_t edition = 0;  ///< the workspace's then
        std::uint64_t clock = 0;    ///< ticks that were simulated until then
        std::shared_ptr<const Part> part;
        std::size_t bytes = 0;
    };

    explicit Rewind(std::size_t max_bytes = 64u << 20) : max_bytes_(max_bytes) {}

    /// The part as it is at a tick. What was remembered of that tick and of later ones is forgotten: time
    /// goes on from here.
    void remember(std::uint64_t tick, std::uint64_t edition, std::shared_ptr<const Part> part,
                  std::uint64_t clock = 0);
    void forget_from(std::uint64_t tick);
    void clear();

    /// The part as it was before it was changed by hand. The first change since the last moment counts.
    void begin_change(std::uint64_t edition, std::shared_ptr<const Part> part);
    bool changed() const { return change_.has_value(); }
    /// Remembers what the change began from.
    void remember_change(std::uint64_t tick, std::uint64_t clock = 0);

    /// Where there are too many, the oldest goes that is no flip; after ten seconds, each.
    void note(Incident incident);
    const std::deque<Incident>& incidents() const { return incidents_; }

    bool empty() const { return moments_.empty(); }
    /// Not of an empty one.
    std::uint64_t oldest() const { return moments_.front().tick; }
    std::uint64_t newest() const { return moments_.back().tick; }
    /// The moment nearest to so many ticks before the newest.
    const Moment& at(std::uint64_t ticks_back) const;
    /// Null if that moment was discarded or overwritten.
    const Moment* find(const MomentId& id) const;

    /// By tick.
    const std::deque<Moment>& moments() const { return moments_; }
    std::size_t size() const { return moments_.size(); }
    std::size_t bytes() const { return bytes_; }

  private:
    void drop_last();
    void drop_oldest();
    void thin();

    struct Change {
        std::uint64_t edition = 0;
        std::shared_ptr<const Part> part;
    };

    std::deque<Moment> moments_;  ///< by tick
    std::optional<Change> change_;
    std::deque<Incident> incidents_;  ///< by tick
    std::uint64_t stride_ = 1;        ///< kept are the ticks that this divides, and the newest
    std::size_t max_bytes_, bytes_ = 0;
};

}  // namespace tendril::app
