// The tree: slots, handles, parents and the order of children.
#include "tendril/rig/hierarchy.hpp"

#include <algorithm>

#include "math/checks.hpp"

namespace tendril::rig {

using tendril::detail::no_value;
using tendril::detail::refused;
using tendril::detail::refused_handle;
using tendril::detail::Shown;

const char* name(Pending pending) noexcept {
    constexpr const char* texts[] = {"none", "local", "global"};
    const auto index = static_cast<std::size_t>(pending);
    return index < std::size(texts) ? texts[index] : "";
}

// Handles.

ElementId Hierarchy::handle(Index index) const noexcept {
    return index == none ? ElementId{} : ElementId{index, nodes_[index].generation};
}

Result Hierarchy::check(ElementId element, const char* operation, const char* argument) const noexcept {
    if (contains(element)) return {};
    const std::uint32_t uses = element.index < nodes_.size() ? nodes_[element.index].generation : 0;
    return refused_handle(operation, argument, element.index, element.generation, uses, "hierarchy");
}

void Hierarchy::stop(const char* operation, ElementId element) const noexcept {
    no_value(check(element, operation, "element").message());
}

Hierarchy::Index Hierarchy::required_or_none(const char* operation, ElementId element) const noexcept {
    return element ? required(operation, element) : none;
}

// Slots and links.

Hierarchy::Index Hierarchy::take_slot() {
    Index at = free_;
    if (at != none) {
        free_ = nodes_[at].next;
        nodes_[at].next = none;
    } else {
        at = static_cast<Index>(nodes_.size());
        nodes_.emplace_back();
        for (Values& pose : values_) {
            pose.local.emplace_back();
            pose.global.emplace_back();
            pose.stamps.emplace_back();
        }
    }
    ++nodes_[at].generation;
    ++size_;
    return at;
}

void Hierarchy::free_slot(Index at) noexcept {
    const Index generation = nodes_[at].generation + 1;
    nodes_[at] = Node{};
    nodes_[at].generation = generation;
    nodes_[at].next = free_;
    for (Values& pose : values_) {
        pose.local[at] = pose.global[at] = Transform{};
        pose.stamps[at] = Stamp{};
    }
    free_ = at;
    --size_;
}

void Hierarchy::link(Index at, Index parent) noexcept {
    Node& above = siblings_of(parent);
    Node& node = nodes_[at];
    node.parent = parent;
    node.previous = above.last_child;
    node.next = none;
    (node.previous == none ? above.first_child : nodes_[node.previous].next) = at;
    above.last_child = at;
    ++above.children;
}

void Hierarchy::unlink(Index at) noexcept {
    Node& node = nodes_[at];
    Node& above = siblings_of(node.parent);
    (node.previous == none ? above.first_child : nodes_[node.previous].next) = node.next;
    (node.next == none ? above.last_child : nodes_[node.next].previous) = node.previous;
    --above.children;
    node.parent = node.previous = node.next = none;
}

// Editing.

Expected<ElementId> Hierarchy::add(ElementKind kind, ElementId parent, const Transform& local) {
    if (parent)
        if (const Result bad = check(parent, "add", "parent"); !bad) return bad;
    const Expected<Transform> fit = checked(local, "add", "local");
    if (!fit) return fit.error();

    const Index at = take_slot();
    nodes_[at].kind = kind;
    link(at, parent.index);
    for (Values& pose : values_) start(pose, at, *fit);
    return handle(at);
}

Result Hierarchy::remove(ElementId element) noexcept {
    if (const Result bad = check(element, "remove", "element"); !bad) return bad;
    const Index top = element.index;
    for (Values& pose : values_) forget_pending(pose, top);
    unlink(top);
    // From the bottom up: always the first remaining leaf.
    for (Index at = top;;) {
        while (nodes_[at].first_child != none) at = nodes_[at].first_child;
        const Index parent = nodes_[at].parent, next = nodes_[at].next;
        free_slot(at);
        if (at == top) return {};
        nodes_[parent].first_child = next;
        at = next != none ? next : parent;
    }
}

Result Hierarchy::set_parent(ElementId element, ElementId parent, Space keep) noexcept {
    if (const Result bad = check(element, "set_parent", "element"); !bad) return bad;
    if (parent) {
        if (const Result bad = check(parent, "set_parent", "parent"); !bad) return bad;
        if (is_within(parent, element))
            return refused("set_parent", "parent", "neither the element itself nor below it",
                           Shown("slot", parent.index));
    }
    const Index at = element.index;
    if (nodes_[at].parent == parent.index) return {};
    for (Values& pose : values_) before_reparent(pose, at, keep);
    unlink(at);
    link(at, parent.index);
    for (Values& pose : values_) after_reparent(pose, at, keep);
    return {};
}

void Hierarchy::swap(Hierarchy& other) noexcept {
    std::swap(nodes_, other.nodes_);
    std::swap(roots_, other.roots_);
    std::swap(values_, other.values_);
    std::swap(free_, other.free_);
    std::swap(size_, other.size_);
    std::swap(recomputations_, other.recomputations_);
}

void Hierarchy::clear() noexcept {
    while (roots_.first_child != none) static_cast<void>(remove(handle(roots_.first_child)));
}

// Queries.

ElementKind Hierarchy::kind(ElementId element) const noexcept {
    return nodes_[required("kind", element)].kind;
}
ElementId Hierarchy::parent(ElementId element) const noexcept {
    return handle(nodes_[required("parent", element)].parent);
}
ElementId Hierarchy::first_child(ElementId parent) const noexcept {
    return handle(siblings_of(required_or_none("first_child", parent)).first_child);
}
ElementId Hierarchy::last_child(ElementId parent) const noexcept {
    return handle(siblings_of(required_or_none("last_child", parent)).last_child);
}
ElementId Hierarchy::next_sibling(ElementId element) const noexcept {
    return handle(nodes_[required("next_sibling", element)].next);
}
ElementId Hierarchy::previous_sibling(ElementId element) const noexcept {
    return handle(nodes_[required("previous_sibling", element)].previous);
}
std::size_t Hierarchy::child_count(ElementId parent) const noexcept {
    return siblings_of(required_or_none("child_count", parent)).children;
}

bool Hierarchy::is_within(ElementId element, ElementId ancestor) const noexcept {
    const Index top = required("is_within", ancestor);
    Index at = required("is_within", element);
    while (at != top && at != none) at = nodes_[at].parent;
    return at == top;
}

ElementId Hierarchy::next_depth_first(ElementId element, ElementId top) const noexcept {
    Index at = required("next_depth_first", element);
    const Index end = required("next_depth_first", top);
    if (nodes_[at].first_child != none) return handle(nodes_[at].first_child);
    while (at != end && at != none && nodes_[at].next == none) at = nodes_[at].parent;
    return at == end || at == none ? ElementId{} : handle(nodes_[at].next);
}

bool operator==(const Hierarchy& a, const Hierarchy& b) {
    if (a.nodes_ != b.nodes_ || a.roots_ != b.roots_ || a.free_ != b.free_) return false;
    if (std::equal(a.values_, a.values_ + 3, b.values_)) return true;
    Hierarchy x = a, y = b;
    x.resolve_all();
    y.resolve_all();
    return std::equal(x.values_, x.values_ + 3, y.values_, [](const auto& one, const auto& other) {
        return one.local == other.local && one.global == other.global;
    });
}

}  // namespace tendril::rig
