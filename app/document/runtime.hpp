// What a lab works with and nobody saves: solvers' scratch memory, plans, caches. Each lab has one runtime,
// kept from tick to tick, so that a solver is made once per chain and not once per solve.
//
// A runtime follows from the document. It is in no file, no undo step and no recording, and it can be thrown
// away between any two commands or ticks without changing a bit of what is seen: what a solver must remember
// from one solve to the next is a value, and belongs in the lab's part of the document.
#pragma once

#include <map>
#include <memory>
#include <string>

namespace tendril::app {

/// One lab's runtime; a lab derives its own, which can be made without arguments.
class Runtime {
  public:
    virtual ~Runtime() = default;
};

/// Those of all labs. A copy of a workspace shares none of them: it makes its own.
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

    /// The lab's runtime, made when it is first asked for. Const, so that what only looks at a workspace can
    /// use its caches too. Always ask for the same T; another throws std::bad_cast.
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

}  // namespace tendril::app
