// Undo and redo: the parts that a command changed, as they were before; what other labs have become since
// stays. One entry per gesture, bounded memory: the oldest entries go first, and only the nearest step may
// exceed the bound alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <optional>
#include <string>

#include "app/document/camera_pose.hpp"
#include "app/document/document.hpp"

namespace tendril::app {

/// Commands of one drag share a gesture and so one undo entry; 0 is a gesture of its own.
using Gesture = std::uint64_t;

/// Identifies a moment of a lab's last ten seconds.
struct MomentId {
    std::uint64_t tick = 0, edition = 0;
};

/// Where a change is to be seen: its lab, and what else of these the change moved.
struct Place {
    std::string lab{};
    std::optional<std::filesystem::path> path{};  ///< the scene's file
    std::optional<CameraPose> camera{};           ///< of the lab
    std::optional<MomentId> moment{};             ///< set by time.seek only
};

class History {
  public:
    explicit History(std::size_t max_entries = 1000, std::size_t max_bytes = 256u << 20);

    /// Remembers `before`, the parts that the command `label` changed as they were before, and forgets what
    /// could be redone. Further pushes of the same nonzero gesture add nothing, until an undo or redo comes
    /// between. `from` and `to` are where things were before the command and after it.
    void push(const Document& before, const std::string& label, Gesture gesture, const Place& from = {},
              const Place& to = {});
    /// Gives the document to go back to (or forward to) from `current`; nothing at the end. `place`, if
    /// given, is where things are now, and becomes where the change is to be seen.
    std::optional<Document> undo(const Document& current, Place* place = nullptr);
    std::optional<Document> redo(const Document& current, Place* place = nullptr);
    void clear();
    /// Forgets the last change, as if it had been none.
    void forget_last() { take(past_); }

    /// Whether undo would bring back these very parts.
    bool leads_to(const Document& parts) const { return !past_.empty() && past_.back().document == parts; }
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
        Document document;  ///< of the parts that changed
        std::string label;
        Place from, to;         ///< before the change and after it
        std::size_t bytes = 0;  ///< of what it does not share with the document before it in time
    };
    using Entries = std::deque<Entry>;

    static std::size_t own_bytes(const Document& document, const Document* older);
    void append(Entries& entries, Entry entry, const Document* older);
    std::optional<Entry> take(Entries& entries);
    static Document exchange(Entry& entry, const Document& current);
    static void go(Place& target, Place& origin, Place* place);
    void drop(Entries& entries);
    void drop_oldest();
    void drop_last();
    void trim();

    Entries past_, future_;  ///< the nearest to now at the back
    Gesture open_gesture_ = 0;
    std::size_t max_entries_, max_bytes_, bytes_ = 0;
};

}  // namespace tendril::app
