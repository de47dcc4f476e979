// Undo and redo. An entry keeps the parts that a command changed, as they were before it; other labs' parts
// stay. One entry per gesture. Memory is bounded: the oldest entries are dropped first, and only the nearest
// entry may exceed the bound.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <optional>
#include <set>
#include <string>

#include "app/document/camera_pose.hpp"
#include "app/document/document.hpp"

namespace tendril::app {

/// Commands of one drag share a gesture and one undo entry; 0 is never shared.
using Gesture = std::uint64_t;

/// Identifies a moment of a lab's last ten seconds.
struct MomentId {
    std::uint64_t tick = 0, edition = 0;
};

/// Where to show a change: its lab and, if the change affected them, the file, camera, moment and openings.
struct Place {
    std::string lab{};
    std::optional<std::filesystem::path> path{};      ///< the scene's file
    std::optional<CameraPose> camera{};               ///< the lab's camera
    std::optional<MomentId> moment{};                 ///< set by time.seek only
    std::optional<std::set<std::string>> openings{};  ///< labs that move by themselves until they are changed
    std::optional<std::filesystem::path> recovered{};  ///< the autosave that holds this work
};

class History {
  public:
    explicit History(std::size_t max_entries = 1000, std::size_t max_bytes = 256u << 20);

    /// Remembers `before`, the old parts that the command `label` changed, and clears redo. Further pushes of
    /// the same nonzero gesture add nothing until the next undo or redo. `from` and `to` are the places
    /// before and after the command.
    void push(const Document& before, const std::string& label, Gesture gesture, const Place& from = {},
              const Place& to = {});
    /// The document to go back (forward) to from `current`; nothing at the end. `place`, if given, is the
    /// current place and becomes the one that shows the change.
    std::optional<Document> undo(const Document& current, Place* place = nullptr);
    std::optional<Document> redo(const Document& current, Place* place = nullptr);
    void clear();
    /// Drops the last entry.
    void forget_last() { take(past_); }

    /// True if undo would restore exactly these parts.
    bool leads_to(const Document& parts) const { return !past_.empty() && past_.back().document == parts; }
    bool can_undo() const { return !past_.empty(); }
    bool can_redo() const { return !future_.empty(); }
    /// The only lab whose part the next undo (or redo) replaces; empty if there are several, or at the end.
    std::string next_lab(bool back) const;
    /// Label of the next undo (redo); empty at the end.
    std::string undo_label() const { return past_.empty() ? std::string() : past_.back().label; }
    std::string redo_label() const { return future_.empty() ? std::string() : future_.back().label; }
    std::size_t size() const { return past_.size(); }
    /// True if the gesture's next command would join its entry.
    bool is_open(Gesture gesture) const { return gesture != 0 && gesture == open_gesture_; }
    /// Memory that the entries hold, shared parts counted once.
    std::size_t bytes() const { return bytes_; }

  private:
    struct Entry {
        Document document;  ///< the parts that changed
        std::string label;
        Place from, to;         ///< before and after the change
        std::size_t bytes = 0;  ///< bytes not shared with the document before it
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

    Entries past_, future_;  ///< the nearest at the back
    Gesture open_gesture_ = 0;
    std::size_t max_entries_, max_bytes_, bytes_ = 0;
};

}  // namespace tendril::app
