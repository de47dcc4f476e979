#include "app/document/history.hpp"

#include <utility>

namespace tendril::app {

History::History(std::size_t max_entries, std::size_t max_bytes)
    : max_entries_(max_entries), max_bytes_(max_bytes) {}

void History::push(const Document& before, const std::string& label, Gesture gesture,
                   std::optional<std::filesystem::path> path) {
    drop(future_);
    const bool same_gesture = gesture != 0 && gesture == open_gesture_;
    open_gesture_ = gesture;
    if (same_gesture) return;
    append(past_, before, label, past_.empty() ? nullptr : &past_.back().document, std::move(path));
    trim();
}

std::optional<Document> History::undo(const Document& current, std::filesystem::path* path) {
    auto entry = take(past_);
    if (!entry) return std::nullopt;
    if (entry->path && path != nullptr) std::swap(*entry->path, *path);
    append(future_, current, entry->label, &entry->document, std::move(entry->path));
    trim();
    return std::move(entry->document);
}

std::optional<Document> History::redo(const Document& current, std::filesystem::path* path) {
    auto entry = take(future_);
    if (!entry) return std::nullopt;
    if (entry->path && path != nullptr) std::swap(*entry->path, *path);
    append(past_, current, entry->label, past_.empty() ? nullptr : &past_.back().document,
           std::move(entry->path));
    trim();
    return std::move(entry->document);
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

void History::append(Entries& entries, const Document& document, const std::string& label,
                     const Document* older, std::optional<std::filesystem::path> path) {
    const std::size_t bytes = own_bytes(document, older);
    entries.push_back({document, label, bytes, std::move(path)});
    bytes_ += bytes;
}

/// What `document` holds that the one before it in time does not.
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
    // The next one now answers for what it shared with the one that went.
    Entry& oldest = past_.front();
    bytes_ -= oldest.bytes;
    oldest.bytes = own_bytes(oldest.document, nullptr);
    bytes_ += oldest.bytes;
}

void History::drop_last() {
    bytes_ -= future_.front().bytes;
    future_.pop_front();
}

/// Forgets what is farthest from now. The nearest step back (and forward) stays, however large it is.
void History::trim() {
    const auto too_much = [this] {
        return past_.size() + future_.size() > max_entries_ || bytes_ > max_bytes_;
    };
    while (too_much() && past_.size() > 1) drop_oldest();
    while (too_much() && future_.size() > 1) drop_last();
}

}  // namespace tendril::app
