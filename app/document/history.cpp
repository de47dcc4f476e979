#include "app/document/history.hpp"

#include <utility>

namespace tendril::app {

History::History(std::size_t max_entries, std::size_t max_bytes)
    : max_entries_(max_entries), max_bytes_(max_bytes) {}

void History::push(const Document& before, const std::string& label, Gesture gesture, const Place& from,
                   const Place& to) {
    drop(future_);
    const bool same_gesture = gesture != 0 && gesture == open_gesture_;
    open_gesture_ = gesture;
    if (same_gesture) return;
    Entry entry{before, label, from, to};
    if (from.path == to.path) {
        entry.from.path.reset();
        entry.to.path.reset();
    }
    if (from.recovered == to.recovered) {
        entry.from.recovered.reset();
        entry.to.recovered.reset();
    }
    if (from.lab == to.lab && from.camera == to.camera) {
        entry.from.camera.reset();
        entry.to.camera.reset();
    }
    if (from.openings == to.openings) {
        entry.from.openings.reset();
        entry.to.openings.reset();
    }
    append(past_, std::move(entry), past_.empty() ? nullptr : &past_.back().document);
    trim();
}

std::optional<Document> History::undo(const Document& current, Place* place) {
    auto entry = take(past_);
    if (!entry) return std::nullopt;
    Document back = exchange(*entry, current);
    go(entry->from, entry->to, place);
    append(future_, std::move(*entry), &back);
    trim();
    return back;
}

std::optional<Document> History::redo(const Document& current, Place* place) {
    auto entry = take(future_);
    if (!entry) return std::nullopt;
    Document forward = exchange(*entry, current);
    go(entry->to, entry->from, place);
    append(past_, std::move(*entry), past_.empty() ? nullptr : &past_.back().document);
    trim();
    return forward;
}

/// Returns `current` with the entry's parts, and stores the parts they replace in the entry.
Document History::exchange(Entry& entry, const Document& current) {
    Document result = current;
    Document instead;
    for (const auto& [lab, part] : entry.document.parts()) {
        const auto now = current.parts().find(lab);
        if (now != current.parts().end()) instead.set(lab, now->second);
        result.set(lab, part);
    }
    entry.document = std::move(instead);
    return result;
}

/// Moves to `target`, which shows the change, and records the present place in `origin` for the way back.
void History::go(Place& target, Place& origin, Place* place) {
    if (place == nullptr) return;
    if (target.path) origin.path = place->path;
    if (target.recovered) origin.recovered = place->recovered;
    if (target.camera && place->lab == origin.lab) origin.camera = place->camera;
    if (target.moment && place->lab == origin.lab) origin.moment = place->moment;
    if (target.openings) origin.openings = place->openings;
    *place = target;
}

std::string History::next_lab(bool back) const {
    const Entries& entries = back ? past_ : future_;
    if (entries.empty() || entries.back().document.parts().size() != 1) return {};
    return entries.back().document.parts().begin()->first;
}

void History::clear() {
    drop(past_);
    drop(future_);
    open_gesture_ = 0;
}

std::optional<History::Entry> History::take(Entries& entries) {
    open_gesture_ = 0;
    if (entries.empty()) return std::nullopt;
    Entry entry = std::move(entries.back());
    entries.pop_back();
    bytes_ -= entry.bytes;
    return entry;
}

void History::append(Entries& entries, Entry entry, const Document* older) {
    entry.bytes = own_bytes(entry.document, older);
    bytes_ += entry.bytes;
    entries.push_back(std::move(entry));
}

/// Bytes of the parts that `document` does not share with `older`.
std::size_t History::own_bytes(const Document& document, const Document* older) {
    std::size_t bytes = sizeof(Entry);
    for (const auto& [lab, part] : document.parts()) {
        if (!part) continue;
        const auto shared = older ? older->parts().find(lab) : document.parts().end();
        if (!older || shared == older->parts().end() || shared->second != part) bytes += part->bytes();
    }
    return bytes;
}

void History::drop(Entries& entries) {
    for (const Entry& entry : entries) bytes_ -= entry.bytes;
    entries.clear();
}

void History::drop_oldest() {
    bytes_ -= past_.front().bytes;
    past_.pop_front();
    // The next entry now accounts for the parts it shared with the dropped one.
    Entry& oldest = past_.front();
    bytes_ -= oldest.bytes;
    oldest.bytes = own_bytes(oldest.document, nullptr);
    bytes_ += oldest.bytes;
}

void History::drop_last() {
    bytes_ -= future_.front().bytes;
    future_.pop_front();
}

/// Drops the entries farthest from the present. The nearest undo (and redo) entry stays, however large it is.
void History::trim() {
    const auto too_much = [this] {
        return past_.size() + future_.size() > max_entries_ || bytes_ > max_bytes_;
    };
    while (too_much() && past_.size() > 1) drop_oldest();
    while (too_much() && future_.size() > 1) drop_last();
}

}  // namespace tendril::app
