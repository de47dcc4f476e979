// Unsaved working data: a lab's solvers' scratch memory, plans and caches; and the window's pace and drawn
// sections. Each lab has one runtime, kept from tick to tick, so that a solver is created once per chain and
// not once per solve.
//
// A runtime is derived from the document. It is in no file, undo entry or recording, and can be discarded
// between any two commands or ticks without changing a bit of the result: state that a solver must keep from
// one solve to the next is a value and belongs in the lab's part of the document.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>

namespace tendril::app {

/// One lab's runtime; a lab derives its own, which must be default-constructible.
class Runtime {
  public:
    virtual ~Runtime() = default;
};

/// All labs' runtimes. A copied workspace starts without them and creates its own.
class Runtimes {
  public:
    Runtimes() = default;
    Runtimes(const Runtimes&) noexcept {}
    Runtimes& operator=(const Runtimes&) noexcept {
        clear();
        return *this;
    }
    Runtimes(Runtimes&&) noexcept = default;
    Runtimes& operator=(Runtimes&&) noexcept = default;
    ~Runtimes() = default;

    /// The lab's runtime, created on first use. Const, so that readers of a workspace can use its caches too.
    /// Always use the same T for a lab; another throws std::bad_cast.
    template <class T>
    T& of(const std::string& lab) const {
        std::unique_ptr<Runtime>& runtime = by_lab_[lab];
        if (!runtime) runtime = std::make_unique<T>();
        return dynamic_cast<T&>(*runtime);
    }
    void clear() const noexcept { by_lab_.clear(); }

  private:
    mutable std::map<std::string, std::unique_ptr<Runtime>> by_lab_;
};

// Shows labs whether the machine keeps up with real time. In a live window only.

/// Seconds that the window catches up after a stall; the rest of a longer one is dropped.
inline constexpr double max_stall = 0.25;

struct Pace final : Runtime {
    double kept = 1.0;  ///< fraction of the last second that the ticks kept up with
};
inline Pace& pace_of(const Runtimes& runtimes) {
    return runtimes.of<Pace>("pace");
}

/// The folding sections that the panels have drawn, so that a command can offer them by name.
struct DrawnSections final : Runtime {
    std::set<std::string> names;  ///< "chain: Target"
};

}  // namespace tendril::app
