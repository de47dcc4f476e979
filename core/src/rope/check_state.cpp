#include "rope/check_state.hpp"

#include <algorithm>
#include <cmath>

#include "math/checks.hpp"
#include "math/ranges.hpp"
#include "rope/slots.hpp"

namespace tendril::rope::detail {
namespace {

using tendril::detail::Argument;
using tendril::detail::check_length;
using tendril::detail::refused;

const char* const op = "World";

bool is_within(const glm::dvec3& p, double limit) {
    return std::abs(p.x) <= limit && std::abs(p.y) <= limit && std::abs(p.z) <= limit;
}
bool is_point(const glm::dvec3& p) {
    return is_within(p, max_magnitude);
}
/// For displacements between two points.
bool is_offset(const glm::dvec3& p) {
    return is_within(p, max_displacement);
}
/// The out-of-range coordinate, for the message.
double worst(const glm::dvec3& p) {
    for (int i = 0; i < 3; ++i)
        if (!std::isfinite(p[i])) return p[i];
    return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
}
Result bad_point(const char* list, std::size_t index, const glm::dvec3& p) {
    return refused(op, Argument(list, index), "finite and at most 1e9 m from the origin along each axis",
                   worst(p));
}

Result check_particles(const State& state) {
    const std::size_t size = state.position.size();
    if (size > max_particles) return refused(op, "particles", "at most 1000000", size);
    for (const std::size_t other : {state.displacement.size(), state.mass.size()}) {
        if (other == size) continue;
        return refused(op, "displacement and mass", "as long as position", other);
    }
    for (std::size_t i = 0; i < size; ++i) {
        if (!is_point(state.position[i])) return bad_point("position", i, state.position[i]);
        if (!is_offset(state.displacement[i])) return bad_point("displacement", i, state.displacement[i]);
        // 1e9 kg/m on 1e9 m, or the square of that, is allowed.
        if (!(state.mass[i] > 0.0 && state.mass[i] <= 1e30))
            return refused(op, Argument("mass", i), "over 0 and finite", state.mass[i]);
    }
    return {};
}

/// Checks the numbers of an element by its table.
template <class Row>
Result check_row(const Row& row, const char* list, std::size_t index) {
    return check_fields(op, row) ? Result() : tendril::detail::refused_element(op, list, index, row);
}

/// Every taken slot belongs to exactly one element of the list.
template <class List>
Result check_handles(const List& list, const std::vector<std::uint32_t>& slots, const char* name) {
    std::vector<bool> seen(slots.size(), false);
    for (std::size_t i = 0; i < list.size(); ++i) {
        const auto id = list[i].id;
        const bool valid = id.index < slots.size() && slots[id.index] == id.generation &&
                           id.generation % 2 == 1 && !seen[id.index];
        if (!valid) {
            return refused(op, Argument(name, i, "id"), "an occupied slot of its own",
                           static_cast<std::size_t>(id.index));
        }
        seen[id.index] = true;
    }
    for (std::size_t i = 0; i < slots.size(); ++i) {
        if (slots[i] % 2 == 1 && !seen[i]) return refused(op, Argument(name), "in every occupied slot", i);
    }
    return {};
}

/// For a cloth with gaps.
Result check_cells(std::size_t number, const Body& body) {
    const std::vector<std::uint32_t>& cells = body.cells;
    if (cells.empty()) return {};
    const auto bad = [&](const char* rule, std::size_t value) {
        return refused(op, Argument("bodies", number, "cells"), rule, value);
    };
    if (body.kind != Body::Kind::Cloth) return bad("empty for all but cloth", cells.size());
    if (cells.size() != body.count) return bad("one for each particle", cells.size());
    for (std::size_t k = 1; k < cells.size(); ++k)
        if (cells[k] <= cells[k - 1]) return bad("ascending", cells[k]);
    // Bounds the memory of its grid.
    if (body.row > max_particles || cells.back() >= max_particles) return bad("below 1000000", cells.back());
    return {};
}

Result check_body(const State& state, std::size_t i, std::size_t next) {
    const Body& body = state.bodies[i];
    const auto bad = [&](const char* member, const char* rule, std::size_t value) {
        return refused(op, Argument("bodies", i, member), rule, value);
    };
    if (body.first != next) return bad("first", "where the previous body ends", body.first);
    if (body.count == 0 || body.count > state.position.size() - next)
        return bad("count", "from 1 to the number of particles", body.count);
    if (body.row == 0 || (body.cells.empty() && body.count % body.row != 0))
        return bad("row", "a divisor of count", body.row);
    if (const Result r = check_cells(i, body); !r) return r;
    if (const Result r = check_row(body, "bodies", i); !r) return r;
    if (body.bending > 0.0f && body.kind != Body::Kind::Rope)
        return refused(op, Argument("bodies", i, "bending"), "0 for all but ropes", body.bending);
    return {};
}

Result check_bodies(const State& state) {
    std::size_t next = 0;
    for (std::size_t i = 0; i < state.bodies.size(); ++i) {
        if (const Result r = check_body(state, i, next); !r) return r;
        next += state.bodies[i].count;
    }
    if (next != state.position.size())
        return refused(op, "particles", "as many as the bodies have", state.position.size());
    return check_handles(state.bodies, state.body_slots, "bodies");
}

Result check_links(const State& state) {
    for (std::size_t i = 0; i < state.links.size(); ++i) {
        const Link& link = state.links[i];
        const std::size_t end = std::max(link.a, link.b);
        if (end >= state.position.size() || link.a == link.b)
            return refused(op, Argument("links", i), "between two existing particles", end);
        if (static_cast<int>(link.kind) > static_cast<int>(Link::Kind::Bend))
            return refused(op, Argument("links", i, "kind"), "one of the three", static_cast<int>(link.kind));
        if (const Result r = check_length(op, Argument("links", i, "rest"), link.rest); !r) return r;
        const Result soft = check_length(op, Argument("links", i, "compliance"), link.compliance);
        if (!soft) return soft;
        if (!std::isfinite(link.tension))
            return refused(op, Argument("links", i, "tension"), "finite", link.tension);
    }
    return {};
}

Result check_pins(const State& state) {
    std::size_t next = 0;
    for (std::size_t i = 0; i < state.pins.size(); ++i) {
        const Pin& pin = state.pins[i];
        if (pin.particle < next || pin.particle >= state.position.size()) {
            return refused(op, Argument("pins", i, "particle"),
                           "an existing particle, in ascending order, with one pin each", pin.particle);
        }
        if (!pin.collider && !is_point(pin.goal))
            return refused(op, Argument("pins", i, "goal"), "finite", worst(pin.goal));
        if (const Result r = check_row(pin, "pins", i); !r) return r;
        if (pin.collider && find_in(state.colliders, pin.collider) == nullptr)
            return missing(op, "the collider of a pin", pin.collider, state);
        next = pin.particle + 1;
    }
    return {};
}

Result check_colliders(const State& state) {
    for (std::size_t i = 0; i < state.colliders.size(); ++i) {
        const Collider& collider = state.colliders[i];
        if (const Result r = rope::check(op, collider.shape); !r) return r;
        if (const Result r = check_row(collider, "colliders", i); !r) return r;
        if (collider.half_goal && !std::holds_alternative<Capsule>(collider.shape))
            return refused(op, Argument("colliders", i, "half_goal"), "set on capsules only",
                           kind(collider.shape));
    }
    return check_handles(state.colliders, state.collider_slots, "colliders");
}

Result check_ties(const State& state) {
    for (std::size_t i = 0; i < state.ties.size(); ++i) {
        const Tie& tie = state.ties[i];
        const std::size_t end = std::max(tie.a, tie.b);
        if (end >= state.position.size() || tie.a == tie.b)
            return refused(op, Argument("ties", i), "between two existing particles", end);
        if (const Result r = check_row(tie, "ties", i); !r) return r;
    }
    return check_handles(state.ties, state.tie_slots, "ties");
}

Result check_collisions(const State& state) {
    for (std::size_t i = 0; i < state.collisions.size(); ++i) {
        const Collision& each = state.collisions[i];
        for (const BodyId id : {each.a, each.b}) {
            const Body* const body = find_in(state.bodies, id);
            if (body == nullptr) return missing(op, "a body of a collision", id, state);
            if (body->kind == Body::Kind::Hair)
                return refused(op, Argument("collisions", i), "between ropes and cloth",
                               static_cast<std::size_t>(id.index));
        }
        const bool ascends = i == 0 || before(state.collisions[i - 1], each);
        if (!ascends || each.b.index < each.a.index)
            return refused(op, Argument("collisions", i), "in the order of slots",
                           static_cast<std::size_t>(each.a.index));
    }
    const auto key = [](const BodyContact& each) { return std::pair(each.a, each.b); };
    for (std::size_t i = 0; i < state.contacts.size(); ++i) {
        const BodyContact& each = state.contacts[i];
        if (each.a >= each.b || each.b >= state.position.size())
            return refused(op, Argument("contacts", i), "between two existing particles",
                           static_cast<std::size_t>(each.b));
        if (i > 0 && !(key(state.contacts[i - 1]) < key(each)))
            return refused(op, Argument("contacts", i), "in the order of particles",
                           static_cast<std::size_t>(each.a));
        if (!is_offset(each.force))
            return refused(op, Argument("contacts", i, "force"), "finite", worst(each.force));
    }
    return {};
}

}  // namespace

Result check(const State& state) {
    if (const Result r = rope::check(op, state.settings); !r) return r;
    for (const auto part : {check_particles, check_bodies, check_links, check_colliders, check_pins,
                            check_ties, check_collisions})
        if (const Result r = part(state); !r) return r;
    for (const auto& [name, value] :
         {std::pair{"remainder", state.remainder}, {"displaced_in", state.displaced_in}}) {
        if (!(value >= 0.0 && value <= max_substep))
            return refused(op, name, "0 to the longest substep", value);
    }
    if (!is_point(state.drift))
        return refused(op, "drift", "finite and at most 1e9 m along each axis", worst(state.drift));
    return {};
}

}  // namespace tendril::rope::detail
