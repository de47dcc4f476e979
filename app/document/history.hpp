// Undo and redo: whole documents (they share what did not change), one entry per gesture, bounded memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "app/document/document.hpp"

namespace tendril::app {

/// Commands of one drag share a gesture and so one undo entry; 0 is a gesture of its own.
using Gesture = std::uint64_t;

class History {
  public:
    explicit History(std::size_t max_entries = 1000, std::size_t max_bytes = 256u << 20);

    /// Remembers `before`, the document as it was before the command `label` changed it.
    void push(const Document& before, const std::string& label, Gesture gesture);
    /// Gives the document to go back to (or forward to) from `current`; nothing at the end.
    std::optional<Document> undo(const Document& current);
    std::optional<Document> redo(const Document& current);
    void clear();

    bool can_undo() const { return !past_.empty(); }
    bool can_redo() const { return !future_.empty(); }
    /// What undo (redo) would take back (bring again); empty at the end.
    std::string undo_label() const { return past_.empty() ? std::string() : past_.back().label; }
    std::string redo_label() const { return future_.empty() ? std::string() : future_.back().label; }
    std::size_t size() const { return past_.size(); }
    std::size_t bytes() const { return bytes_; }

  private:
    struct Entry {
        Document document;
        std::string label;
        Gesture gesture = 0;
        std::size_t bytes = 0;
    };
    void trim();

    std::deque<Entry> past_, future_;
    std::size_t max_entries_, max_bytes_, bytes_ = 0;
};

}  // namespace tendril::app
