// What was worked out of a lab's part as it was at a moment, kept while that moment is remembered.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <utility>

#include "app/document/rewind.hpp"

namespace tendril::app {

/// By part, which never changes in place; a part is not kept alive by it.
template <class Value>
class PartCache {
  public:
    /// Worked out by `make` when it is first asked for. The reference holds until trim() or clear().
    template <class Make>
    const Value& of(const std::shared_ptr<const Part>& part, const Make& make) {
        const auto known = values_.find(part);
        return known != values_.end() ? known->second : values_.emplace(part, make()).first->second;
    }
    bool has(const std::shared_ptr<const Part>& part) const { return values_.find(part) != values_.end(); }
    /// Forgets what is no longer remembered, once that is as much again.
    void trim(const Rewind& past) {
        if (values_.size() <= 2 * past.size() + 64) return;
        Values kept;
        for (const Rewind::Moment& moment : past.moments())
            if (const auto known = values_.find(moment.part); known != values_.end())
                kept.insert(values_.extract(known));
        values_ = std::move(kept);
    }
    void clear() { values_.clear(); }
    std::size_t size() const { return values_.size(); }

  private:
    using Values = std::map<std::weak_ptr<const Part>, Value, std::owner_less<>>;
    Values values_;
};

}  // namespace tendril::app
