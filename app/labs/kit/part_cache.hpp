// What was worked out of a lab's part as it was at a moment, kept while that moment is remembered.
#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <vector>

#include "app/document/rewind.hpp"

namespace tendril::app {

/// Of memory, beyond the value itself.
template <class Value>
std::size_t bytes_beyond(const Value&) {
    return 0;
}
template <class Element>
std::size_t bytes_beyond(const std::vector<Element>& list) {
    return list.size() * sizeof(Element);
}

/// By part, which never changes in place; a part is not kept alive by it. Where it grows beyond its bound,
/// what was worked out first is forgotten.
template <class Value>
class PartCache {
  public:
    explicit PartCache(std::size_t max_bytes = 16u << 20) : max_bytes_(max_bytes) {}

    /// Worked out by `make` when it is first asked for. The reference holds until anything else is.
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
    /// Forgets what is no longer remembered, once that is as much again.
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
    /// Of memory, roughly.
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
    std::deque<Key> order_;  ///< in which they were worked out
    std::size_t max_bytes_, bytes_ = 0;
};

}  // namespace tendril::app
