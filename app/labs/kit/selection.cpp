#include "app/labs/kit/selection.hpp"

#include <algorithm>

#include "app/io/json_complete.hpp"

namespace tendril::app {

bool Selection::has(std::size_t index) const {
    return std::binary_search(all_.begin(), all_.end(), index);
}

void Selection::clear() {
    active_.reset();
    all_.clear();
}

void Selection::only(std::size_t index) {
    active_ = index;
    all_ = {index};
}

void Selection::toggle(std::size_t index) {
    const auto at = std::lower_bound(all_.begin(), all_.end(), index);
    if (at == all_.end() || *at != index) {
        all_.insert(at, index);
        active_ = index;
        return;
    }
    all_.erase(at);
    if (active_ != index) return;
    active_ = all_.empty() ? std::nullopt : std::optional(all_.back());
}

void Selection::take(const std::vector<std::size_t>& indices, bool add) {
    if (!add) clear();
    if (indices.empty()) return;
    all_.insert(all_.end(), indices.begin(), indices.end());
    std::sort(all_.begin(), all_.end());
    all_.erase(std::unique(all_.begin(), all_.end()), all_.end());
    active_ = indices.back();
}

void Selection::inserted(std::size_t at) {
    for (std::size_t& index : all_) index += index >= at ? 1u : 0u;
    if (active_ && *active_ >= at) ++*active_;
}

void Selection::removed(std::size_t at) {
    if (has(at)) toggle(at);
    for (std::size_t& index : all_) index -= index > at ? 1u : 0u;
    if (active_ && *active_ > at) --*active_;
}

void Selection::keep_below(std::size_t count) {
    all_.erase(std::lower_bound(all_.begin(), all_.end(), count), all_.end());
    if (active_ && *active_ >= count) active_ = all_.empty() ? std::nullopt : std::optional(all_.back());
}

Json Selection::save() const {
    if (!active_) return nullptr;
    if (!several()) return *active_;
    return {{"active", *active_}, {"all", all_}};
}

Selection Selection::load(const JsonPlace& place, std::size_t count) {
    Selection selection;
    if (count == 0 || place.json().is_null()) return selection;
    if (!place.json().is_object()) {
        selection.only(place.index(count - 1));
        return selection;
    }
    std::vector<std::size_t> all;
    place["all"].for_each("selected", count,
                          [&](const JsonPlace& each) { all.push_back(each.index(count - 1)); });
    const std::size_t active = place["active"].index(count - 1);
    selection.take(all, false);
    if (!selection.has(active)) place["active"].fail("is not in the selection");
    selection.active_ = active;
    return selection;
}

}  // namespace tendril::app
