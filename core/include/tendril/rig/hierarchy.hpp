// Bones, nulls and controls in a tree: each with an initial, an input and a current pose, and of each pose a
// local and a global transform, of which one may be pending, waiting to be worked out from the other.
//
//     rig::Hierarchy tree;
//     const rig::ElementId arm = *tree.add(rig::ElementKind::Bone, {}, shoulder);
//     const rig::ElementId hand = *tree.add(rig::ElementKind::Bone, arm, wrist);
//     if (const Result set = tree.set(arm, rig::Space::Global, raised); !set) return log(set.message());
//     draw(tree.get(hand, rig::Space::Global));  // worked out now, because the arm has moved
//
// Writing sets one transform and makes the other pending where that follows:
//
//     write                    the element           its children
//     global, propagating      local pending         keep their local; global pending, and so on down
//     global, not propagating  local pending         keep their global; local pending, no deeper
//     local, propagating       global pending        keep their local; global pending, and so on down
//     local, not propagating   global composed now   keep their global; local pending, no deeper
//
// No write walks a subtree. An element stores the version of its parent's global transform that its own was
// composed with; reading compares versions from the nearest ancestor known to be up to date downwards, and
// composes anew from the first that differs. A pending local transform is worked out before the parent's
// stored global is overwritten. So *reading changes no answer*: it only brings forward what would be worked
// out anyway, to the same bits. As it stores what it worked out, get() is not const; known() is, and
// pending() tells which of the two it would have to work out.
//
// Cost: reading a local transform O(1); a global one O(1) while nothing was written since it or something
// below it was last read, else O(depth). Writing O(depth), or O(depth + children) where it does not
// propagate. Nothing recurses: a line of 100 000 elements is as good as any tree. get() and set() allocate
// nothing.
//
// A hierarchy is a value: a copy goes on as the original does, bit for bit. About 750 bytes an element.
// Elements have no names, names are the document's business. A handle that points at nothing is refused where
// an answer is a Result; given to anything else it is a bug in the calling program, which ends with a
// message.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "tendril/handle.hpp"
#include "tendril/result.hpp"
#include "tendril/rig/transform.hpp"

namespace tendril::rig {

enum class ElementKind : std::uint8_t { Bone, Null, Control };
/// At rest; where a solve begins, before anything moved it; and now.
enum class Pose : std::uint8_t { Initial, Input, Current };
enum class Space : std::uint8_t { Local, Global };
/// Whether the children of what is set move with it (and keep their local transform) or stay where they are.
enum class Propagate : std::uint8_t { No, Yes };
/// Which transform reading would have to work out.
enum class Pending : std::uint8_t { None, Local, Global };

/// "bone", "null", "control"
const char* name(ElementKind kind) noexcept;
/// "none", "local", "global"
const char* name(Pending pending) noexcept;

using ElementId = Handle<struct ElementHandleKind>;

class Hierarchy {
  public:
    // Elements. Where a parent is asked for, an empty handle means none: what has no parent is a root.
    // Children are in the order in which they were added.

    /// `local` becomes its pose, all three. Refused: a parent that is not there, a transform
    /// that checked() refuses. O(1).
    Expected<ElementId> add(ElementKind kind, ElementId parent, const Transform& local);
    /// With everything below it. O(what goes).
    Result remove(ElementId element) noexcept;
    /// Puts an element below another parent, after the children that are there; in every pose it keeps its
    /// transform in that space. Refused: a parent that is the element itself or below it. O(depth).
    Result set_parent(ElementId element, ElementId parent, Space keep = Space::Global) noexcept;
    void clear() noexcept;

    std::size_t size() const noexcept { return size_; }
    bool contains(ElementId element) const noexcept {
        return element.index < nodes_.size() && nodes_[element.index].generation == element.generation &&
               element.generation % 2 == 1;
    }
    /// Fine where it is there; else "OPERATION: ARGUMENT must be the handle of an element that is there, got
    /// slot 7". For what is built upon a hierarchy.
    Result check(ElementId element, const char* operation, const char* argument) const noexcept;
    ElementKind kind(ElementId element) const noexcept;
    /// Empty handle where there is none, here and in the next four.
    ElementId parent(ElementId element) const noexcept;
    ElementId first_child(ElementId parent) const noexcept;  ///< of an empty handle: the first root
    ElementId last_child(ElementId parent) const noexcept;   ///< of an empty handle: the last root
    ElementId next_sibling(ElementId element) const noexcept;
    ElementId previous_sibling(ElementId element) const noexcept;
    std::size_t child_count(ElementId parent) const noexcept;  ///< of an empty handle: the number of roots
    /// Whether `element` is `ancestor` or below it. O(depth).
    bool is_within(ElementId element, ElementId ancestor) const noexcept;
    /// What follows in a walk through everything below `top`, depth first; empty at its end. Begins with
    /// `top` itself. O(1) on average.
    ElementId next_depth_first(ElementId element, ElementId top) const noexcept;

    // Poses.

    /// Works out what is pending and stores it. The reference is valid until something is added or removed,
    /// and shows what it shows until the next write: other reads leave it as it is, and it may be passed to a
    /// write.
    const Transform& get(ElementId element, Space space, Pose pose = Pose::Current) noexcept;
    /// Refused: a handle of nothing, a transform that checked() refuses. The rotation is made unit length.
    Result set(ElementId element, Space space, const Transform& transform,
               Propagate propagate = Propagate::Yes, Pose pose = Pose::Current) noexcept;
    /// set() for what the functions of this folder answered with: nothing is checked, so that a scale of 0
    /// that comes of a blend or a product is taken.
    void put(ElementId element, Space space, const Transform& transform, Propagate propagate = Propagate::Yes,
             Pose pose = Pose::Current) noexcept;

    /// What get() would have to work out; changes nothing. A local transform that waits below an ancestor
    /// that moved since counts as global: the ancestor's global comes first. O(1) where get() is, else
    /// O(depth).
    Pending pending(ElementId element, Pose pose = Pose::Current) const noexcept;
    /// What get() would answer, where it has not got to work out the rest of the tree for it: none where
    /// pending() names that space. Changes nothing.
    std::optional<Transform> known(ElementId element, Space space, Pose pose = Pose::Current) const noexcept;
    /// All transforms of one pose become those of another, what is pending with them. O(n), a plain copy of
    /// memory.
    void copy_pose(Pose from, Pose to) noexcept;
    /// Works out all that is pending, in every pose. O(n).
    void resolve_all() noexcept;
    /// How many transforms were worked out from others since this hierarchy was made, copies counting on from
    /// where the original was.
    std::uint64_t recomputations() const noexcept { return recomputations_; }

    /// The same elements under the same handles, in the same order, at the same transforms in every pose once
    /// nothing is pending: whatever is called from here on, both answer the same. O(n); copies both where one
    /// of them was read and the other was not.
    friend bool operator==(const Hierarchy& a, const Hierarchy& b);

  private:
    using Index = std::uint32_t;
    static constexpr Index none = ElementId::none;

    struct Node {
        Index generation = 0;  ///< odd while the slot is taken
        Index parent = none, first_child = none, last_child = none, previous = none;
        Index next = none;  ///< sibling; of a free slot: the next free one
        Index children = 0;
        ElementKind kind = ElementKind::Bone;
        bool operator==(const Node&) const = default;
    };
    /// What is known about one element in one pose.
    struct Stamp {
        std::uint64_t version = 0;         ///< of the stored global; no two are given the same
        std::uint64_t parent_version = 0;  ///< that the stored global was composed with, or set against
        std::uint64_t verified = 0;        ///< `change` of the pose when the stored global was last true
        Index first_pending = none;        ///< children whose local is pending, as a list
        Index previous_pending = none, next_pending = none;  ///< its neighbours in the parent's list
        Index down = none;                                   ///< scratch of refresh()
        bool local_pending = false;                          ///< then parent_version is the parent's version
        bool operator==(const Stamp&) const = default;
    };
    struct Values {
        std::vector<Transform> local, global;
        std::vector<Stamp> stamps;
        std::uint64_t change = 1;   ///< counts writes
        std::uint64_t version = 0;  ///< the last one given out
        bool operator==(const Values&) const = default;
    };

    const Values& values(Pose pose) const noexcept { return values_[static_cast<std::size_t>(pose)]; }
    Values& values(Pose pose) noexcept { return values_[static_cast<std::size_t>(pose)]; }
    const Node& siblings_of(Index parent) const noexcept { return parent == none ? roots_ : nodes_[parent]; }
    Node& siblings_of(Index parent) noexcept { return parent == none ? roots_ : nodes_[parent]; }
    ElementId handle(Index index) const noexcept;
    Index required(const char* operation, ElementId element) const noexcept {
        if (!contains(element)) stop(operation, element);
        return element.index;
    }
    [[noreturn]] void stop(const char* operation, ElementId element) const noexcept;  ///< says why, and ends
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
    Node roots_;         ///< a node that is no element: the roots are its children
    Values values_[3];   ///< by Pose
    Index free_ = none;  ///< the first free slot
    std::size_t size_ = 0;
    std::uint64_t recomputations_ = 0;
};

}  // namespace tendril::rig
