// Bones, nulls and controls in a tree. Each has an initial, an input and a current pose. Each pose has a
// local and a global transform, one of which may be pending: not yet computed from the other.
//
//     rig::Hierarchy tree;
//     const rig::ElementId arm = *tree.add(rig::ElementKind::Bone, {}, shoulder);
//     const rig::ElementId hand = *tree.add(rig::ElementKind::Bone, arm, wrist);
//     if (const Result set = tree.set(arm, rig::Space::Global, raised); !set) return log(set.message());
//     draw(tree.get(hand, rig::Space::Global));  // computed now, because the arm has moved
//
// Writing sets one transform and makes dependent ones pending:
//
//     write                    the element           its children
//     global, propagating      local pending         keep their local; global pending, and so on down
//     global, not propagating  local pending         keep their global; local pending, no deeper
//     local, propagating       global pending        keep their local; global pending, and so on down
//     local, not propagating   global composed now   keep their global; local pending, no deeper
//
// No write walks a subtree. An element stores the version of its parent's global transform that its own was
// composed with. Reading compares versions, starting below the nearest ancestor known to be up to date, and
// recomposes from the first that differs. A pending local transform is computed before the parent's stored
// global is overwritten. So *reading changes no result*: it only computes earlier what would be computed
// anyway, to the same bits. get() stores what it computes and is therefore not const; known() is const, and
// pending() names the transform that would have to be computed.
//
// Cost: reading a local transform is O(1). Reading a global one is O(1) if nothing was written since it or a
// descendant was last read, otherwise O(depth). Writing is O(depth), or O(depth + children) without
// propagation. Nothing recurses, so a chain of 100 000 elements is fine. get() and set() allocate nothing.
//
// A hierarchy is a value: a copy behaves like the original, bit for bit. About 750 bytes per element.
// Elements have no names; names belong to the document. Functions that return a Result refuse a stale handle;
// passing one to any other function is a bug in the calling program, which ends with a message.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "tendril/handle.hpp"
#include "tendril/result.hpp"
#include "tendril/rig/transform.hpp"

namespace tendril::rig {

enum class ElementKind : std::uint8_t { Bone, Null, Control };
/// The pose at rest, at the start of a solve, and now.
enum class Pose : std::uint8_t { Initial, Input, Current };
enum class Space : std::uint8_t { Local, Global };
/// Whether the children of a written element move with it (and keep their local transform) or stay.
enum class Propagate : std::uint8_t { No, Yes };
/// The transform that reading would have to compute first.
enum class Pending : std::uint8_t { None, Local, Global };

/// "bone", "null", "control"
const char* name(ElementKind kind) noexcept;
/// "none", "local", "global"
const char* name(Pending pending) noexcept;

using ElementId = Handle<struct ElementHandleKind>;

class Hierarchy {
  public:
    Hierarchy() = default;
    Hierarchy(const Hierarchy&) = default;
    /// Leaves `other` empty.
    Hierarchy(Hierarchy&& other) noexcept : Hierarchy() { swap(other); }
    Hierarchy& operator=(const Hierarchy&) = default;
    Hierarchy& operator=(Hierarchy&& other) noexcept {
        Hierarchy taken(std::move(other));
        return swap(taken), *this;
    }
    ~Hierarchy() = default;

    // Elements. An empty parent handle means none: an element without a parent is a root. Children are in the
    // order in which they were added.

    /// `local` becomes its transform in all three poses. Refuses a parent that does not exist, and a
    /// transform that checked() refuses. O(1).
    Expected<ElementId> add(ElementKind kind, ElementId parent, const Transform& local);
    /// Removes the element with everything below it. O(elements removed).
    Result remove(ElementId element) noexcept;
    /// Moves an element below another parent, after its existing children. In every pose it keeps its
    /// transform in the space `keep`. Refuses the element itself, or one below it, as parent. O(depth).
    Result set_parent(ElementId element, ElementId parent, Space keep = Space::Global) noexcept;
    void clear() noexcept;

    std::size_t size() const noexcept { return size_; }
    bool contains(ElementId element) const noexcept {
        return element.index < nodes_.size() && nodes_[element.index].generation == element.generation &&
               element.generation % 2 == 1;
    }
    /// Success if it exists; otherwise "OPERATION: ARGUMENT was removed (slot 7)", or is empty, or not of
    /// this hierarchy. For code built on a hierarchy.
    Result check(ElementId element, const char* operation, const char* argument) const noexcept;
    ElementKind kind(ElementId element) const noexcept;
    /// An empty handle if there is none, here and in the next four.
    ElementId parent(ElementId element) const noexcept;
    ElementId first_child(ElementId parent) const noexcept;  ///< for an empty handle: the first root
    ElementId last_child(ElementId parent) const noexcept;   ///< for an empty handle: the last root
    ElementId next_sibling(ElementId element) const noexcept;
    ElementId previous_sibling(ElementId element) const noexcept;
    std::size_t child_count(ElementId parent) const noexcept;  ///< for an empty handle: the number of roots
    /// Whether `element` is `ancestor` or below it. O(depth).
    bool is_within(ElementId element, ElementId ancestor) const noexcept;
    /// The next element in a depth-first walk through everything below `top`; empty at its end. Start with
    /// `top` itself. O(1) on average.
    ElementId next_depth_first(ElementId element, ElementId top) const noexcept;

    // Poses.

    /// Computes pending transforms and stores them. The reference is valid until an element is added or
    /// removed, and its value is unchanged until the next write: other reads do not affect it, and it may be
    /// passed to a write.
    const Transform& get(ElementId element, Space space, Pose pose = Pose::Current) noexcept;
    /// Refuses a stale handle, and a transform that checked() refuses. Normalises the rotation.
    Result set(ElementId element, Space space, const Transform& transform,
               Propagate propagate = Propagate::Yes, Pose pose = Pose::Current) noexcept;
    /// set() without checks, for transforms computed by the functions of tendril/rig: accepts a scale of 0
    /// that results from a blend or a product.
    void put(ElementId element, Space space, const Transform& transform, Propagate propagate = Propagate::Yes,
             Pose pose = Pose::Current) noexcept;

    /// The transform that get() would have to compute; changes nothing. A pending local transform below an
    /// ancestor that has moved since is reported as global: the ancestor's global comes first. O(1) if get()
    /// is, otherwise O(depth).
    Pending pending(ElementId element, Pose pose = Pose::Current) const noexcept;
    /// The transform that get() would return; nullopt if pending() names that space. Changes nothing.
    std::optional<Transform> known(ElementId element, Space space, Pose pose = Pose::Current) const noexcept;
    /// Copies all transforms of one pose to another, including which are pending. O(n), a plain copy of
    /// memory.
    void copy_pose(Pose from, Pose to) noexcept;
    /// Computes everything pending, in every pose. O(n).
    void resolve_all() noexcept;
    /// Number of transforms computed from others since this hierarchy was made; a copy continues the count.
    std::uint64_t recomputations() const noexcept { return recomputations_; }

    /// The same elements under the same handles, in the same order, with the same transforms in every pose
    /// once nothing is pending: every further call gives the same result on both. O(n); copies both if their
    /// pending transforms differ.
    friend bool operator==(const Hierarchy& a, const Hierarchy& b);

  private:
    using Index = std::uint32_t;
    static constexpr Index none = ElementId::none;

    struct Node {
        Index generation = 0;  ///< odd while the slot is taken
        Index parent = none, first_child = none, last_child = none, previous = none;
        Index next = none;  ///< sibling; for a free slot: the next free one
        Index children = 0;
        ElementKind kind = ElementKind::Bone;
        bool operator==(const Node&) const = default;
    };
    /// The bookkeeping of one element in one pose.
    struct Stamp {
        std::uint64_t version = 0;         ///< version of the stored global; unique
        std::uint64_t parent_version = 0;  ///< the parent's, when the stored global was composed or set
        std::uint64_t verified = 0;        ///< `change` when the stored global was last valid
        Index first_pending = none;        ///< head of the list of children whose local is pending
        Index previous_pending = none, next_pending = none;  ///< its neighbours in the parent's list
        Index down = none;                                   ///< scratch of refresh()
        bool local_pending = false;                          ///< then parent_version is the parent's version
        bool operator==(const Stamp&) const = default;
    };
    struct Values {
        std::vector<Transform> local, global;
        std::vector<Stamp> stamps;
        std::uint64_t change = 1;   ///< counts writes
        std::uint64_t version = 0;  ///< the last one assigned
        bool operator==(const Values&) const = default;
    };

    void swap(Hierarchy& other) noexcept;
    const Values& values(Pose pose) const noexcept { return values_[static_cast<std::size_t>(pose)]; }
    Values& values(Pose pose) noexcept { return values_[static_cast<std::size_t>(pose)]; }
    const Node& siblings_of(Index parent) const noexcept { return parent == none ? roots_ : nodes_[parent]; }
    Node& siblings_of(Index parent) noexcept { return parent == none ? roots_ : nodes_[parent]; }
    ElementId handle(Index index) const noexcept;
    Index required(const char* operation, ElementId element) const noexcept {
        if (!contains(element)) stop(operation, element);
        return element.index;
    }
    [[noreturn]] void stop(const char* operation, ElementId element) const noexcept;  ///< prints why, ends
    Index required_or_none(const char* operation, ElementId element) const noexcept;

    Index take_slot();
    void free_slot(Index at) noexcept;
    void link(Index at, Index parent) noexcept;
    void unlink(Index at) noexcept;

    void start(Values& pose, Index at, const Transform& local) noexcept;
    void before_reparent(Values& pose, Index at, Space keep) noexcept;
    void after_reparent(Values& pose, Index at, Space keep) noexcept;

    std::uint64_t parent_version(const Values& pose, Index at) const noexcept;
    bool up_to_date(const Values& pose, Index at) const noexcept;
    Transform worked_out_local(const Values& pose, Index at) const noexcept;
    void refresh(Values& pose, Index at) noexcept;
    void refresh_from_parent(Values& pose, Index at) noexcept;
    void compose_global(Values& pose, Index at) noexcept;
    void store_global(Values& pose, Index at, const Transform& global) noexcept;
    void resolve_local(Values& pose, Index at) noexcept;
    void resolve_children(Values& pose, Index at) noexcept;
    void make_local_pending(Values& pose, Index at) noexcept;
    void forget_pending(Values& pose, Index at) noexcept;
    void refresh_children(Values& pose, Index at) noexcept;
    void make_children_pending(Values& pose, Index at) noexcept;
    void write_global(Values& pose, Index at, const Transform& global, Propagate propagate) noexcept;
    void write_local(Values& pose, Index at, const Transform& local, Propagate propagate) noexcept;

    std::vector<Node> nodes_;
    Node roots_;         ///< not an element: the roots are its children
    Values values_[3];   ///< indexed by Pose
    Index free_ = none;  ///< the first free slot
    std::size_t size_ = 0;
    std::uint64_t recomputations_ = 0;
};

}  // namespace tendril::rig
