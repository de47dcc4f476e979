// A lab's last ten seconds, for going back in time: its part at each tick that was simulated or changed by
// hand (every second, fourth, ... tick if that grows too large), and the incidents among them. Not part of
// the document and not saved.
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
    static constexpr std::uint64_t max_ticks = 600;
    static constexpr std::size_t max_incidents = 256;

    struct Moment {
        std::uint64_t tick = 0;     ///< number of the moment
        std::uint64_t edition = 0;  ///< the workspace's edition then
        std::uint64_t clock = 0;    ///< ticks simulated until then
        std::shared_ptr<const Part> part;
        std::size_t bytes = 0;
    };

    explicit Rewind(std::size_t max_bytes = 64u << 20) : max_bytes_(max_bytes) {}

    /// Remembers the part at a tick and discards that tick and later ones: time continues from here.
    void remember(std::uint64_t tick, std::uint64_t edition, std::shared_ptr<const Part> part,
                  std::uint64_t clock = 0);
    void forget_from(std::uint64_t tick);
    void clear();

    /// Keeps the part as it was before a change by hand. Only the first change since the last moment counts.
    void begin_change(std::uint64_t edition, std::shared_ptr<const Part> part);
    bool changed() const { return change_.has_value(); }
    /// Remembers the part that begin_change() kept.
    void remember_change(std::uint64_t tick, std::uint64_t clock = 0);

    /// Incidents older than ten seconds are dropped; if there are too many, the oldest that is not a flip.
    void note(Incident incident);
    void forget_incidents() { incidents_.clear(); }
    const std::deque<Incident>& incidents() const { return incidents_; }

    bool empty() const { return moments_.empty(); }
    /// Must not be empty.
    std::uint64_t oldest() const { return moments_.front().tick; }
    std::uint64_t newest() const { return moments_.back().tick; }
    /// The moment nearest to `ticks_back` before the newest.
    const Moment& at(std::uint64_t ticks_back) const;
    /// Null if that moment was discarded or overwritten.
    const Moment* find(const MomentId& id) const;

    /// In order of tick.
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
    std::uint64_t stride_ = 1;        ///< only ticks divisible by this, and the newest, are kept
    std::size_t max_bytes_, bytes_ = 0;
};

}  // namespace tendril::app
