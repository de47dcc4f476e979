#include "app/document/history.hpp"

#include <utility>

namespace tendril::app {

History::History(std::size_t max_entries, std::size_t max_bytes)
    : max_entries_(max_entries), max_bytes_(max_bytes) {}

void History::push(const Document& before, const std::string& label, Gesture gesture) {
    drop(future_);
    const bool same_gesture = gesture != 0 && gesture == open_gesture_;
    open_gesture_ = gesture;
    if (same_gesture) return;
    append(past_, before, label);
    trim();
}

std::optional<Document> History::undo(const Document& current) {
    return move_across(past_, future_, current);
}

std::optional<Document> History::redo(const Document& current) {
    return move_across(future_, past_, current);
}

void History::clear() {
    drop(past_);
    drop(future_);
    open_gesture_ = 0;
}

std::optional<Document> History::move_across(Entries& from, Entries& to, const Document& current) {
    open_gesture_ = 0;
    if (from.empty()) return std::nullopt;
    Entry entry = std::move(from.back());
    from.pop_back();
    bytes_ -= entry.bytes;
    append(to, current, entry.label);
    trim();
    return std::move(entry.document);
}

void History::append(Entries& entries, const Document& document, const std::string& label) {
    const std::size_t bytes = own_bytes(document, entries.empty() ? nullptr : &entries.back().document);
    entries.push_back({document, label, bytes});
    bytes_ += bytes;
}

/// What `document` holds that `neighbour` does not.
std::size_t History::own_bytes(const Document& document, const Document* neighbour) {
    std::size_t bytes = sizeof(Entry);
    for (const auto& [lab, part] : document.parts()) {
        if (!part) continue;
        const auto shared = neighbour ? neighbour->parts().find(lab) : document.parts().end();
        if (!neighbour || shared == neighbour->parts().end() || shared->second != part)
            bytes += part->bytes();
    }
    return bytes;
}

void History::drop(Entries& entries) {
    for (const Entry& entry : entries) bytes_ -= entry.bytes;
    entries.clear();
}

void History::drop_front(Entries& entries) {
    bytes_ -= entries.front().bytes;
    entries.pop_front();
    // The next one now answers for what it shared with the one that went.
    Entry& front = entries.front();
    bytes_ -= front.bytes;
    front.bytes = own_bytes(front.document, nullptr);
    bytes_ += front.bytes;
}

/// Forgets what is farthest from now. The nearest step back (and forward) stays, however large it is.
void History::trim() {
    const auto too_much = [this] {
        return past_.size() + future_.size() > max_entries_ || bytes_ > max_bytes_;
    };
    while (too_much() && past_.size() > 1) drop_front(past_);
    while (too_much() && future_.size() > 1) drop_front(future_);
}

}  // namespace tendril::app
