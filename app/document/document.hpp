// What a person makes and saves: a plain value holding one part per lab. It knows no lab by name.
//
// Parts are shared between copies and never changed in place, so a copy of a document costs a few pointers.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <string>

#include "app/document/json.hpp"

namespace tendril::app {

/// One lab's share of the document: a value with a JSON form.
class Part {
  public:
    virtual ~Part() = default;
    virtual std::shared_ptr<Part> clone() const = 0;
    virtual Json save() const = 0;
    /// A new part from what save() gave, bit for bit. Throws std::runtime_error naming `where` and what is
    /// wrong.
    virtual std::shared_ptr<Part> load(const Json& json, const std::string& where) const = 0;
    /// Turns what a scene file of an older `version` has of this part into what save() writes today; load()
    /// comes after it. The file may be broken: what is not as it should be is left for load() to refuse.
    virtual void upgrade(Json& /*json*/, int /*version*/) const {}
    /// Itself as undo and redo bring it back, where that differs: nobody drags now what was dragged then.
    /// Null where it does not.
    virtual std::shared_ptr<const Part> brought_back() const { return nullptr; }
    /// `then`, this lab's part as it was at another moment, looked at as this one is: what is chosen and how
    /// it is shown does not go back in time.
    virtual std::shared_ptr<const Part> at_moment(std::shared_ptr<const Part> then) const { return then; }
    /// Rough size in memory, for the history's bound.
    virtual std::size_t bytes() const = 0;
};

class Document {
  public:
    void set(const std::string& lab, std::shared_ptr<const Part> part) { parts_[lab] = std::move(part); }
    const std::map<std::string, std::shared_ptr<const Part>>& parts() const { return parts_; }

    template <class T>
    const T& get(const std::string& lab) const {
        return dynamic_cast<const T&>(*parts_.at(lab));
    }
    /// A copy of the part to change, put in its place; the documents that shared it keep the old one.
    template <class T>
    T& edit(const std::string& lab) {
        auto copy = parts_.at(lab)->clone();
        T& part = dynamic_cast<T&>(*copy);
        parts_[lab] = std::move(copy);
        return part;
    }
    /// Those of its parts that are not the very same in another document.
    Document without(const Document& other) const {
        Document rest = *this;
        std::erase_if(rest.parts_, [&](const auto& entry) {
            const auto found = other.parts_.find(entry.first);
            return found != other.parts_.end() && found->second == entry.second;
        });
        return rest;
    }
    bool operator==(const Document&) const = default;  ///< the very same parts, not merely equal ones

  private:
    std::map<std::string, std::shared_ptr<const Part>> parts_;
};

}  // namespace tendril::app
