// The selected indices, 0-based. The one selected last is active: inspectors show it, and edit all.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "app/io/json.hpp"
#include "app/io/json_place.hpp"

namespace tendril::app {

class Selection {
  public:
    std::optional<std::size_t> active() const { return active_; }
    const std::vector<std::size_t>& all() const { return all_; }  ///< ascending; the active one is among them
    bool empty() const { return all_.empty(); }
    bool several() const { return all_.size() > 1; }
    bool has(std::size_t index) const;

    void clear();
    void only(std::size_t index);
    /// Adds and activates the index, or removes it if selected.
    void toggle(std::size_t index);
    /// Selects these, in any order; `add` keeps the previous selection. The last one becomes active.
    void take(const std::vector<std::size_t>& indices, bool add);

    /// Update the selection when an item is inserted or removed.
    void inserted(std::size_t at);
    void removed(std::size_t at);
    /// Deselects indices of `count` or more.
    void keep_below(std::size_t count);

    bool operator==(const Selection&) const = default;

    /// Null, one index, or {"active", "all"}.
    Json save() const;
    /// Fails, with the JSON path, if an index is `count` or more, or if the active one is not in "all".
    static Selection load(const JsonPlace& place, std::size_t count);

  private:
    std::optional<std::size_t> active_;
    std::vector<std::size_t> all_;
};

}  // namespace tendril::app
