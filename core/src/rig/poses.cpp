// Pending values, and when they are computed. hierarchy.hpp describes what each write does.
//
// Three invariants between calls, for each pose:
//  1. A stored global is valid if and only if its parent's is and parent_version is the parent's version.
//  2. While a local is pending, parent_version is the parent's version: the local is relative(the parent's
//     stored global, the element's stored global), whatever has been written above since.
//  3. If verified == change, the stored global is valid until the next write.
#include "tendril/rig/hierarchy.hpp"

namespace tendril::rig {
namespace {

/// A version that no transform has.
constexpr std::uint64_t never = ~std::uint64_t{0};

}  // namespace

std::uint64_t Hierarchy::parent_version(const Values& pose, Index at) const noexcept {
    const Index parent = nodes_[at].parent;
    return parent == none ? 0 : pose.stamps[parent].version;
}

// Reading.

/// Brings the stored globals of `at` and of its ancestors up to date.
void Hierarchy::refresh(Values& pose, Index at) noexcept {
    Index top = at;
    for (Index up = at; up != none && pose.stamps[up].verified != pose.change; up = nodes_[up].parent) {
        if (up != at) pose.stamps[up].down = top;
        top = up;
    }
    for (Index down = top;; down = pose.stamps[down].down) {
        refresh_from_parent(pose, down);
        if (down == at) return;
    }
}

/// Requires the parent to be up to date.
void Hierarchy::refresh_from_parent(Values& pose, Index at) noexcept {
    Stamp& stamp = pose.stamps[at];
    if (stamp.verified == pose.change) return;
    if (stamp.parent_version != parent_version(pose, at)) {
        resolve_children(pose, at);
        compose_global(pose, at);
    }
    stamp.verified = pose.change;
}

void Hierarchy::compose_global(Values& pose, Index at) noexcept {
    const Index parent = nodes_[at].parent;
    store_global(pose, at, parent == none ? pose.local[at] : compose(pose.global[parent], pose.local[at]));
    ++recomputations_;
}

void Hierarchy::store_global(Values& pose, Index at, const Transform& global) noexcept {
    Stamp& stamp = pose.stamps[at];
    pose.global[at] = global;
    stamp.version = ++pose.version;
    stamp.parent_version = parent_version(pose, at);
    stamp.verified = pose.change;
}

Transform Hierarchy::worked_out_local(const Values& pose, Index at) const noexcept {
    if (!pose.stamps[at].local_pending) return pose.local[at];
    const Index parent = nodes_[at].parent;
    return parent == none ? pose.global[at] : relative(pose.global[parent], pose.global[at]);
}

void Hierarchy::resolve_local(Values& pose, Index at) noexcept {
    if (!pose.stamps[at].local_pending) return;
    pose.local[at] = worked_out_local(pose, at);
    forget_pending(pose, at);
    ++recomputations_;
}

/// Called before the stored global of `at` is overwritten: the children's pending locals are relative to it.
void Hierarchy::resolve_children(Values& pose, Index at) noexcept {
    while (pose.stamps[at].first_pending != none) resolve_local(pose, pose.stamps[at].first_pending);
}

void Hierarchy::make_local_pending(Values& pose, Index at) noexcept {
    Stamp& stamp = pose.stamps[at];
    if (stamp.local_pending) return;
    stamp.local_pending = true;
    const Index parent = nodes_[at].parent;
    if (parent == none) return;
    Index& first = pose.stamps[parent].first_pending;
    stamp.next_pending = first;
    if (first != none) pose.stamps[first].previous_pending = at;
    first = at;
}

/// Clears a pending local that was computed or is being replaced.
void Hierarchy::forget_pending(Values& pose, Index at) noexcept {
    Stamp& stamp = pose.stamps[at];
    if (!stamp.local_pending) return;
    stamp.local_pending = false;
    const Index parent = nodes_[at].parent;
    if (parent == none) return;
    Index& before = stamp.previous_pending == none ? pose.stamps[parent].first_pending
                                                   : pose.stamps[stamp.previous_pending].next_pending;
    before = stamp.next_pending;
    if (stamp.next_pending != none) pose.stamps[stamp.next_pending].previous_pending = stamp.previous_pending;
    stamp.previous_pending = stamp.next_pending = none;
}

const Transform& Hierarchy::get(ElementId element, Space space, Pose pose_kind) noexcept {
    const Index at = required("get", element);
    Values& pose = values(pose_kind);
    if (space == Space::Local) {
        resolve_local(pose, at);
        return pose.local[at];
    }
    if (pose.stamps[at].verified != pose.change) refresh(pose, at);
    return pose.global[at];
}

void Hierarchy::copy_pose(Pose from, Pose to) noexcept {
    values(to) = values(from);
}

void Hierarchy::resolve_all() noexcept {
    for (Values& pose : values_) {
        for (Index at = 0; at < nodes_.size(); ++at) {
            if (nodes_[at].generation % 2 == 0) continue;
            resolve_local(pose, at);
            refresh(pose, at);
        }
    }
}

// Queries of pending values, which compute nothing.

bool Hierarchy::up_to_date(const Values& pose, Index at) const noexcept {
    for (; at != none && pose.stamps[at].verified != pose.change; at = nodes_[at].parent)
        if (pose.stamps[at].parent_version != parent_version(pose, at)) return false;
    return true;
}

Pending Hierarchy::pending(ElementId element, Pose pose_kind) const noexcept {
    const Index at = required("pending", element);
    const Values& pose = values(pose_kind);
    if (!up_to_date(pose, at)) return Pending::Global;
    return pose.stamps[at].local_pending ? Pending::Local : Pending::None;
}

std::optional<Transform> Hierarchy::known(ElementId element, Space space, Pose pose_kind) const noexcept {
    const Index at = required("known", element);
    const Values& pose = values(pose_kind);
    const Pending missing = pending(element, pose_kind);
    if (missing == (space == Space::Local ? Pending::Local : Pending::Global)) return std::nullopt;
    return space == Space::Local ? worked_out_local(pose, at) : pose.global[at];
}

// Writing.

void Hierarchy::start(Values& pose, Index at, const Transform& local) noexcept {
    pose.local[at] = local;
    pose.stamps[at].parent_version = never;
}

/// Called before a write that the children do not follow: brings their globals up to date.
void Hierarchy::refresh_children(Values& pose, Index at) noexcept {
    if (nodes_[at].first_child == none) return;
    refresh(pose, at);
    for (Index child = nodes_[at].first_child; child != none; child = nodes_[child].next)
        refresh_from_parent(pose, child);
}

/// Called after such a write: the children keep their globals, so their locals become pending.
void Hierarchy::make_children_pending(Values& pose, Index at) noexcept {
    for (Index child = nodes_[at].first_child; child != none; child = nodes_[child].next) {
        make_local_pending(pose, child);
        pose.stamps[child].parent_version = pose.stamps[at].version;
        pose.stamps[child].verified = pose.change;
    }
}

void Hierarchy::write_global(Values& pose, Index at, const Transform& global, Propagate propagate) noexcept {
    const Index parent = nodes_[at].parent;
    if (parent != none) refresh(pose, parent);
    if (propagate == Propagate::No)
        refresh_children(pose, at);
    else
        resolve_children(pose, at);
    ++pose.change;
    if (parent != none) pose.stamps[parent].verified = pose.change;
    store_global(pose, at, global);
    make_local_pending(pose, at);
    if (propagate == Propagate::No) make_children_pending(pose, at);
}

void Hierarchy::write_local(Values& pose, Index at, const Transform& local, Propagate propagate) noexcept {
    if (propagate == Propagate::No) {
        const Index parent = nodes_[at].parent;
        if (parent != none) refresh(pose, parent);
        refresh_children(pose, at);
    }
    forget_pending(pose, at);
    pose.local[at] = local;
    ++pose.change;
    if (propagate == Propagate::Yes) {
        pose.stamps[at].parent_version = never;
    } else {
        compose_global(pose, at);
        make_children_pending(pose, at);
    }
}

void Hierarchy::put(ElementId element, Space space, const Transform& transform, Propagate propagate,
                    Pose pose_kind) noexcept {
    const Index at = required("put", element);
    if (space == Space::Global)
        write_global(values(pose_kind), at, transform, propagate);
    else
        write_local(values(pose_kind), at, transform, propagate);
}

Result Hierarchy::set(ElementId element, Space space, const Transform& transform, Propagate propagate,
                      Pose pose_kind) noexcept {
    if (const Result bad = check(element, "set", "element"); !bad) return bad;
    const Expected<Transform> fit = checked(transform, "set", "transform");
    if (!fit) return fit.error();
    put(element, space, *fit, propagate, pose_kind);
    return {};
}

// Reparenting.

/// Resolves the transform to keep against the old parent, and drops the other.
void Hierarchy::before_reparent(Values& pose, Index at, Space keep) noexcept {
    if (keep == Space::Global) {
        refresh(pose, at);
        forget_pending(pose, at);
    } else {
        resolve_local(pose, at);
    }
}

void Hierarchy::after_reparent(Values& pose, Index at, Space keep) noexcept {
    Stamp& stamp = pose.stamps[at];
    const Index parent = nodes_[at].parent;
    if (keep == Space::Local) {
        stamp.parent_version = never;
        ++pose.change;
        return;
    }
    if (parent != none) refresh(pose, parent);
    make_local_pending(pose, at);
    stamp.parent_version = parent_version(pose, at);
}

}  // namespace tendril::rig
