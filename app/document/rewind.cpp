#include "app/document/rewind.hpp"

#include <algorithm>
#include <utility>

namespace tendril::app {

void Rewind::remember(std::uint64_t tick, std::uint64_t edition, std::shared_ptr<const Part> part,
                      std::uint64_t clock) {
    forget_from(tick);
    change_.reset();
    // Drop a moment that was kept only because it was the newest.
    if (!moments_.empty() && moments_.back().tick % stride_ != 0) drop_last();
    while (!moments_.empty() && moments_.front().tick + max_ticks < tick) drop_oldest();
    while (!incidents_.empty() && incidents_.front().tick + max_ticks < tick) incidents_.pop_front();
    // The history counts a character that all moments share, so do not count it here.
    const Part& beside = moments_.empty() ? *part : *moments_.back().part;
    const std::size_t size = part->bytes() - part->shared_bytes(beside);
    moments_.push_back({tick, edition, clock, std::move(part), size});
    bytes_ += size;
    thin();
}

void Rewind::forget_from(std::uint64_t tick) {
    // With no moments to forget, time was not rewound: keep the incidents of this tick.
    if (!moments_.empty() && newest() >= tick)
        std::erase_if(incidents_, [tick](const Incident& each) { return each.tick >= tick; });
    while (!moments_.empty() && moments_.back().tick >= tick) drop_last();
    if (moments_.empty()) stride_ = 1;
}

void Rewind::clear() {
    moments_.clear();
    change_.reset();
    incidents_.clear();
    bytes_ = 0;
    stride_ = 1;
}

void Rewind::begin_change(std::uint64_t edition, std::shared_ptr<const Part> part) {
    if (!change_) change_ = {edition, std::move(part)};
}

void Rewind::remember_change(std::uint64_t tick, std::uint64_t clock) {
    if (!change_) return;
    Change change = std::move(*change_);
    remember(tick, change.edition, std::move(change.part), clock);
}

void Rewind::note(Incident incident) {
    if (incidents_.size() == max_incidents) {
        const auto less = std::find_if(incidents_.begin(), incidents_.end(), [](const Incident& each) {
            return each.kind != Incident::Kind::Flip;
        });
        incidents_.erase(less == incidents_.end() ? incidents_.begin() : less);
    }
    const auto behind =
        std::upper_bound(incidents_.begin(), incidents_.end(), incident.tick,
                         [](std::uint64_t tick, const Incident& each) { return tick < each.tick; });
    incidents_.insert(behind, std::move(incident));
}

const Rewind::Moment& Rewind::at(std::uint64_t ticks_back) const {
    const std::uint64_t wanted = newest() - std::min(ticks_back, newest());
    const auto after =
        std::lower_bound(moments_.begin(), moments_.end(), wanted,
                         [](const Moment& moment, std::uint64_t tick) { return moment.tick < tick; });
    if (after == moments_.begin()) return *after;
    const auto before = std::prev(after);
    return after->tick - wanted <= wanted - before->tick ? *after : *before;
}

const Rewind::Moment* Rewind::find(const MomentId& id) const {
    const auto found =
        std::lower_bound(moments_.begin(), moments_.end(), id.tick,
                         [](const Moment& moment, std::uint64_t tick) { return moment.tick < tick; });
    const bool same = found != moments_.end() && found->tick == id.tick && found->edition == id.edition;
    return same ? &*found : nullptr;
}

/// Doubles the stride while over the memory bound; halves it again once a quarter of the bound suffices.
void Rewind::thin() {
    if (stride_ > 1 && 4 * bytes_ < max_bytes_) stride_ /= 2;
    while (bytes_ > max_bytes_ && moments_.size() > 2 && stride_ < max_ticks) {
        stride_ *= 2;
        std::erase_if(moments_, [&, last = newest()](const Moment& moment) {
            const bool dropped = moment.tick % stride_ != 0 && moment.tick != last;
            if (dropped) bytes_ -= moment.bytes;
            return dropped;
        });
    }
    while (bytes_ > max_bytes_ && moments_.size() > 1) drop_oldest();
}

void Rewind::drop_last() {
    bytes_ -= moments_.back().bytes;
    moments_.pop_back();
}

void Rewind::drop_oldest() {
    bytes_ -= moments_.front().bytes;
    moments_.pop_front();
}

}  // namespace tendril::app
