// Which of many things, counted from 0, are selected. One of them is the active one, taken last: an inspector
// shows its values, and sets them on all.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "app/document/json.hpp"
#include "app/document/json_place.hpp"

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
    /// In, and active; or out, where it is in.
    void toggle(std::size_t index);
    /// All of these, in any order, and with `add` what was selected before; the last one is active.
    void take(const std::vector<std::size_t>& indices, bool add);

    /// What was selected stays so where another comes in before it, or goes.
    void inserted(std::size_t at);
    void removed(std::size_t at);
    /// Without what is not there.
    void keep_below(std::size_t count);

    bool operator==(const Selection&) const = default;

    /// Null, one index, or {"active", "all"}.
    Json save() const;
    /// Fails, with the place, where an index is `count` or more, or the active one is not among all.
    static Selection load(const JsonPlace& place, std::size_t count);

  private:
    std::optional<std::size_t> active_;
    std::vector<std::size_t> all_;
};

}  // namespace tendril::app
