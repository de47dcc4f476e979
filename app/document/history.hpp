// Undo and redo: whole documents (they share what did not change), one entry per gesture, bounded memory: the
// oldest entries go first, and only the nearest step may exceed the bound alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <optional>
#include <string>

#include "app/document/document.hpp"

namespace tendril::app {

/// Commands of one drag share a gesture and so one undo entry; 0 is a gesture of its own.
using Gesture = std::uint64_t;

class History {
  public:
    explicit History(std::size_t max_entries = 1000, std::size_t max_bytes = 256u << 20);

    /// Remembers `before`, the document as it was before the command `label` changed it, and forgets what
    /// could be redone. Further pushes of the same nonzero gesture add nothing, until an undo or redo comes
    /// between.
    /// `path` is the file that the scene had before, where the command changed that as well.
    void push(const Document& before, const std::string& label, Gesture gesture,
              std::optional<std::filesystem::path> path = std::nullopt);
    /// Gives the document to go back to (or forward to) from `current`; nothing at the end. `path`, if given,
    /// is the scene's file now, and becomes what it was.
    std::optional<Document> undo(const Document& current, std::filesystem::path* path = nullptr);
    std::optional<Document> redo(const Document& current, std::filesystem::path* path = nullptr);
    void clear();

    bool can_undo() const { return !past_.empty(); }
    bool can_redo() const { return !future_.empty(); }
    /// What undo (redo) would take back (bring again); empty at the end.
    std::string undo_label() const { return past_.empty() ? std::string() : past_.back().label; }
    std::string redo_label() const { return future_.empty() ? std::string() : future_.back().label; }
    std::size_t size() const { return past_.size(); }
    /// Whether this gesture has an entry that its next command would join.
    bool is_open(Gesture gesture) const { return gesture != 0 && gesture == open_gesture_; }
    /// Memory that the entries hold on to, what they share counted once.
    std::size_t bytes() const { return bytes_; }

  private:
    struct Entry {
        Document document;
        std::string label;
        std::size_t bytes = 0;  ///< of what it does not share with the document before it in time
        std::optional<std::filesystem::path> path{};
    };
    using Entries = std::deque<Entry>;

    static std::size_t own_bytes(const Document& document, const Document* older);
    void append(Entries& entries, const Document& document, const std::string& label, const Document* older,
                std::optional<std::filesystem::path> path);
    std::optional<Entry> take(Entries& entries);
    void drop(Entries& entries);
    void drop_oldest();
    void drop_last();
    void trim();

    Entries past_, future_;  ///< the nearest to now at the back
    Gesture open_gesture_ = 0;
    std::size_t max_entries_, max_bytes_, bytes_ = 0;
};

}  // namespace tendril::app
