// Values computed from past versions of a lab's part, cached while the rewind holds those versions.
#pragma once

#include <cstddef>
#include <deque>
#include <map>
#include <memory>
#include <set>
#include <vector>

#include "app/document/rewind.hpp"

namespace tendril::app {

/// One holder's share of a shared object's bytes: all of them if it is the only holder.
template <class Shared>
std::size_t share_of(const std::shared_ptr<Shared>& shared, std::size_t bytes) {
    return shared ? bytes / static_cast<std::size_t>(shared.use_count()) : 0;
}

/// Memory of a value in bytes, beyond the value itself.
template <class Value>
std::size_t bytes_beyond(const Value&) {
    return 0;
}
template <class Element>
std::size_t bytes_beyond(const std::vector<Element>& list) {
    return list.size() * sizeof(Element);
}

/// Keyed by part. Parts never change in place, and the cache does not keep them alive. Evicts the oldest
/// values when it grows beyond `max_bytes`.
template <class Value>
class PartCache {
  public:
    explicit PartCache(std::size_t max_bytes = 16u << 20) : max_bytes_(max_bytes) {}

    /// Calls `make` on the first request. The reference is valid until the next call.
    template <class Make>
    const Value& of(const std::shared_ptr<const Part>& part, const Make& make) {
        if (const auto known = values_.find(part); known != values_.end()) return known->second;
        const auto made = values_.emplace(part, make()).first;
        order_.push_back(part);
        bytes_ += bytes_of(made->second);
        while (bytes_ > max_bytes_ && order_.size() > 1) {
            forget(order_.front());
            order_.pop_front();
        }
        return made->second;
    }
    bool has(const std::shared_ptr<const Part>& part) const { return values_.find(part) != values_.end(); }
    /// Forgets parts that the rewind has dropped, once they outnumber the parts that it holds.
    void trim(const Rewind& past) {
        if (values_.size() <= 2 * past.size() + 64) return;
        std::set<Key, std::owner_less<>> remembered;
        for (const Rewind::Moment& moment : past.moments()) remembered.insert(moment.part);
        std::erase_if(order_, [&](const Key& part) {
            const bool gone = !remembered.contains(part);
            if (gone) forget(part);
            return gone;
        });
    }
    void clear() {
        values_.clear();
        order_.clear();
        bytes_ = 0;
    }
    std::size_t size() const { return values_.size(); }
    /// Approximate memory use.
    std::size_t bytes() const { return bytes_; }

  private:
    using Key = std::weak_ptr<const Part>;

    static std::size_t bytes_of(const Value& value) {
        return sizeof(Key) + sizeof(Value) + bytes_beyond(value);
    }
    void forget(const Key& part) {
        const auto known = values_.find(part);
        bytes_ -= bytes_of(known->second);
        values_.erase(known);
    }

    std::map<Key, Value, std::owner_less<>> values_;
    std::deque<Key> order_;  ///< in order of insertion
    std::size_t max_bytes_, bytes_ = 0;
};

}  // namespace tendril::app
