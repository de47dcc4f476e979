// Slots of handles. Not installed.
#pragma once

#include <algorithm>
#include <type_traits>
#include <vector>

#include "math/checks.hpp"
#include "tendril/rope/body.hpp"
#include "tendril/rope/handle.hpp"
#include "tendril/rope/state.hpp"

namespace tendril::rope::detail {

/// Capacity for `more` elements. An edit reserves all memory before it changes anything: if memory runs out,
/// the world is unchanged.
template <class T>
void reserve_more(std::vector<T>& list, std::size_t more) {
    if (list.size() + more > list.capacity()) list.reserve(std::max(list.size() + more, 2 * list.capacity()));
}

/// Takes the first free slot for the next element of `list`, so that the same calls give the same handles.
/// Adding the element then needs no more memory.
template <class T>
auto take_slot(std::vector<std::uint32_t>& slots, std::vector<T>& list) {
    reserve_more(list, 1);
    reserve_more(slots, 1);
    auto free = slots.end();
    if (list.size() < slots.size())
        free = std::find_if(slots.begin(), slots.end(), [](std::uint32_t uses) { return uses % 2 == 0; });
    const auto index = static_cast<std::uint32_t>(free - slots.begin());
    if (free == slots.end()) slots.push_back(0);
    return decltype(T::id){index, ++slots[index]};
}

template <class Id>
void free_slot(std::vector<std::uint32_t>& slots, Id id) noexcept {
    ++slots[id.index];
}

/// Null if there is no such element. O(1) if the list is in slot order, as most are.
template <class List, class Id>
auto* find_in(List& list, const Id& id) noexcept {
    if (id.index < list.size() && list[id.index].id == id) return &list[id.index];
    const auto found =
        std::find_if(list.begin(), list.end(), [&](const auto& each) { return each.id == id; });
    return found == list.end() || !id ? nullptr : &*found;
}

template <class IsRemoved>
std::size_t erase_ties(State& state, IsRemoved is_removed) noexcept {
    return std::erase_if(state.ties, [&](const Tie& tie) {
        const bool removed = is_removed(tie);
        if (removed) free_slot(state.tie_slots, tie.id);
        return removed;
    });
}

inline Collision ordered(BodyId a, BodyId b) noexcept {
    return b.index < a.index ? Collision{b, a} : Collision{a, b};
}
inline bool before(const Collision& a, const Collision& b) noexcept {
    return a.a.index != b.a.index ? a.a.index < b.a.index : a.b.index < b.b.index;
}
/// Inserts in order; no duplicates.
inline void insert_collision(std::vector<Collision>& list, const Collision& each) {
    const auto at = std::lower_bound(list.begin(), list.end(), each, before);
    if (at == list.end() || !(*at == each)) list.insert(at, each);
}

/// Makes `rest`, split off `whole`, collide with the same bodies. At most doubles the list, plus one entry.
inline void copy_collisions(State& state, BodyId whole, BodyId rest) {
    for (std::size_t i = 0, count = state.collisions.size(); i < count; ++i) {
        const Collision each = state.collisions[i];
        if (each.a != whole && each.b != whole) continue;
        state.collisions.push_back(ordered(each.a == whole ? rest : each.a, each.b == whole ? rest : each.b));
        if (each.a == each.b) state.collisions.push_back(ordered(whole, rest));
    }
    std::sort(state.collisions.begin(), state.collisions.end(), before);
}

inline bool owns(const Body& body, const Link& link) noexcept {
    return link.a >= body.first && link.a - body.first < body.count;
}
/// Whether both ends are in the body. A state's links may join any two particles.
inline bool is_within(const Body& body, const Link& link) noexcept {
    return owns(body, link) && link.b >= body.first && link.b - body.first < body.count;
}

/// Why a handle finds nothing: `remove: body was removed (slot 7)`
template <class Id>
Result missing(const char* operation, const char* argument, Id id, const State& state) noexcept {
    const auto& slots = std::is_same_v<Id, BodyId>  ? state.body_slots
                        : std::is_same_v<Id, TieId> ? state.tie_slots
                                                    : state.collider_slots;
    const std::uint32_t uses = id.index < slots.size() ? slots[id.index] : 0;
    return tendril::detail::refused_handle(operation, argument, id.index, id.generation, uses, "world");
}

}  // namespace tendril::rope::detail
