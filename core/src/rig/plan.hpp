// The data that Rig::make compiles from a definition. Not installed.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "rig/resolve.hpp"
#include "tendril/rig/rig.hpp"

namespace tendril::rig::detail {

/// One element visited by a for-each.
struct Visit {
    std::uint32_t element = 0;
    std::uint32_t index = 0, count = 0;  ///< index among the visits of its root, and their number
};

/// The compiled data of one unit, including those in bodies.
struct UnitPlan {
    std::vector<Visit> visits;            ///< for-each only: in order
    std::vector<std::uint32_t> bones;     ///< units of a chain only: the elements from root to tip
    std::vector<std::uint32_t> points;    ///< splines only: the elements that the curve passes through
    std::optional<std::size_t> for_each;  ///< units in a body only: the for-each around them
    std::size_t top = 0;                  ///< its index in Definition::units; in a body, its for-each's
    std::vector<Output> outputs;
};

/// A constant value that copies share. Not std::shared_ptr: with sanitizers that check its virtual functions
/// it needs RTTI, which the library lacks.
template <class T>
class Shared {
  public:
    explicit Shared(T value) : counted_(new Counted{std::move(value)}) {}
    Shared(const Shared& other) noexcept : counted_(other.counted_) {
        counted_->owners.fetch_add(1, std::memory_order_relaxed);
    }
    Shared& operator=(const Shared&) = delete;
    ~Shared() {
        if (counted_->owners.fetch_sub(1, std::memory_order_acq_rel) == 1) delete counted_;
    }
    const T* operator->() const noexcept { return &counted_->value; }
    const T& operator*() const noexcept { return counted_->value; }
    bool operator==(const Shared& other) const noexcept { return counted_ == other.counted_; }

  private:
    struct Counted {
        T value;
        std::atomic<std::uint32_t> owners{1};
    };
    Counted* counted_;
};

/// The data that does not depend on the values of inputs. Rigs that differ only in values share it.
struct Layout {
    Names elements, curves, units_by_name;
    std::vector<std::int64_t> parents;  ///< per element: the index of its parent, or -1
    std::vector<ElementId> ids;
    std::vector<std::string> unit_names;
    std::vector<UnitPlan> units;  ///< one per name
    State initial;
    std::uint64_t work = 0;  ///< work of one solve, see Rig::work
};

struct Plan {
    Definition definition;  ///< with names resolved
    Shared<Layout> layout;
    mutable std::atomic<std::uint32_t> owners{1};  ///< rigs

    Plan(Definition of, Shared<Layout> with) : definition(std::move(of)), layout(std::move(with)) {}
};

}  // namespace tendril::rig::detail
