// The user's document: a value with one part per lab, independent of which labs exist.
//
// Copies share parts, which are never changed in place, so a copy costs a few pointers.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "app/io/json.hpp"

namespace tendril::app {

/// Bytes of the elements of some lists, for Part::bytes().
std::size_t bytes_in(const auto&... lists) {
    return ((lists.size() * sizeof(lists[0])) + ... + 0);
}

/// One lab's part of the document: a value with a JSON form.
class Part {
  public:
    virtual ~Part() = default;
    virtual std::shared_ptr<Part> clone() const = 0;
    virtual Json save() const = 0;
    /// Restores what save() wrote, bit for bit. Throws std::runtime_error that begins with the JSON path,
    /// under `where`.
    virtual std::shared_ptr<Part> load(const Json& json, const std::string& where) const = 0;
    /// Converts the part of a scene file of an older `version` to the present format, before load(). The JSON
    /// may be invalid: leave that for load() to refuse.
    virtual void upgrade(Json& /*json*/, int /*version*/) const {}
    /// The part as undo and redo restore it, if that differs, else null: undo must not restore an active
    /// drag.
    virtual std::shared_ptr<const Part> after_undo() const { return nullptr; }
    /// `then`, the part at another moment, with this part's selection and view: rewinding keeps them.
    virtual std::shared_ptr<const Part> at_moment(std::shared_ptr<const Part> then) const { return then; }
    /// The part without the members that only its past explains; null if it has none.
    virtual std::shared_ptr<const Part> without_past() const { return nullptr; }
    /// Rough size in memory, for the history's bound.
    virtual std::size_t bytes() const = 0;
    /// Bytes shared with `other`, a part of the same lab: a character's, for example.
    virtual std::size_t shared_bytes(const Part& /*other*/) const { return 0; }
    /// Files that load() reads besides the JSON; the program never writes over them.
    virtual std::vector<std::filesystem::path> files() const { return {}; }

    /// The scene's JSON for this lab, if a file that it names kept it from being read; else null. Saved in
    /// place of save() until a command edits the part, which then replaces it.
    std::shared_ptr<const Json> unread{};
    std::string unread_why{};  ///< "hero.glb is missing, at ..."
    bool replaces_unread = false;
    std::shared_ptr<const Json> unread_stand_in{};  ///< the edited lab's, if also unreadable
};

class Document {
  public:
    void set(const std::string& lab, std::shared_ptr<const Part> part) { parts_[lab] = std::move(part); }
    const std::map<std::string, std::shared_ptr<const Part>>& parts() const { return parts_; }

    template <class T>
    const T& get(const std::string& lab) const {
        return dynamic_cast<const T&>(*parts_.at(lab));
    }
    /// Replaces the part by a copy and returns it; documents that shared the old part keep it.
    template <class T>
    T& edit(const std::string& lab) {
        auto copy = parts_.at(lab)->clone();
        T& part = dynamic_cast<T&>(*copy);
        parts_[lab] = std::move(copy);
        return part;
    }
    /// The parts that `other` does not share.
    Document without(const Document& other) const {
        Document rest = *this;
        std::erase_if(rest.parts_, [&](const auto& entry) {
            const auto found = other.parts_.find(entry.first);
            return found != other.parts_.end() && found->second == entry.second;
        });
        return rest;
    }
    bool operator==(const Document&) const = default;  ///< whether all parts are shared, not merely equal

  private:
    std::map<std::string, std::shared_ptr<const Part>> parts_;
};

}  // namespace tendril::app
