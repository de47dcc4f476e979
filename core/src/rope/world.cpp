// Edits of a world. For its motion see advance.cpp.
#include "tendril/rope/world.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <type_traits>

#include "math/checks.hpp"
#include "rope/build.hpp"
#include "rope/check_state.hpp"
#include "rope/contact_shape.hpp"
#include "rope/geometry.hpp"
#include "rope/slots.hpp"

namespace tendril::rope {
namespace {

using detail::missing;
using tendril::detail::check_index;
using tendril::detail::check_point;
using tendril::detail::refused;

auto pin_of(std::vector<Pin>& pins, std::size_t particle) {
    return std::lower_bound(pins.begin(), pins.end(), particle,
                            [](const Pin& pin, std::size_t number) { return pin.particle < number; });
}

Result check_time(const char* operation, double seconds) {
    if (seconds >= 0.0 && seconds <= static_cast<double>(max_magnitude)) return {};
    return refused(operation, "seconds", "0 or more", seconds);
}

Result check_particle(const char* operation, std::size_t particle, std::size_t size) {
    return check_index(operation, particle, size, "the world", "particle");
}

/// Removes `count` elements from `first` on.
template <class T>
void erase_range(std::vector<T>& list, std::size_t first, std::size_t count) {
    const auto from = list.begin() + static_cast<std::ptrdiff_t>(first);
    list.erase(from, from + static_cast<std::ptrdiff_t>(count));
}

/// Numbers the elements from slot 0, unless they have handles.
template <class List>
void number(List& list, std::vector<std::uint32_t>& slots) {
    if (list.empty() || list.front().id) return;
    slots.assign(list.size(), 1);
    for (std::uint32_t i = 0; i < list.size(); ++i) list[i].id = {i, 1};
}

}  // namespace

void number_slots(State& state) {
    number(state.bodies, state.body_slots);
    number(state.colliders, state.collider_slots);
    number(state.ties, state.tie_slots);
}

World& World::operator=(const World& other) {
    const State &to = state_, &from = other.state_;
    const auto fit = [&](auto... lists) { return (((to.*lists).capacity() >= (from.*lists).size()) && ...); };
    bool fits = fit(&State::bodies, &State::links, &State::position, &State::displacement, &State::mass,
                    &State::pins, &State::colliders, &State::body_slots, &State::collider_slots, &State::ties,
                    &State::tie_slots, &State::collisions, &State::contacts);
    for (std::size_t i = 0; fits && i < from.bodies.size(); ++i)
        fits = from.bodies[i].cells.size() <= (i < to.bodies.size() ? to.bodies[i].cells.capacity() : 0);
    if (fits)
        state_ = from;  // needs no memory
    else
        state_ = State(from);
    return *this;
}

Expected<World> World::from_state(State state) {
    if (const Result bad = detail::check(state); !bad) return bad;
    World world;
    world.state_ = std::move(state);
    return world;
}

Result World::set_settings(const Settings& settings) noexcept {
    const Result result = check("set_settings", settings);
    if (result) state_.settings = settings;
    return result;
}

void World::clear() noexcept {
    for (const Body& body : state_.bodies) detail::free_slot(state_.body_slots, body.id);
    for (const Collider& collider : state_.colliders) detail::free_slot(state_.collider_slots, collider.id);
    for (const Tie& tie : state_.ties) detail::free_slot(state_.tie_slots, tie.id);
    State empty;
    empty.settings = state_.settings;
    empty.body_slots = std::move(state_.body_slots);
    empty.collider_slots = std::move(state_.collider_slots);
    empty.tie_slots = std::move(state_.tie_slots);
    state_ = std::move(empty);
}

void World::take_stretch(Body& body) noexcept {
    body.stretch = static_cast<float>(std::min(length_error(body), static_cast<double>(max_magnitude)));
}

Expected<BodyId> World::add_rope(const RopeShape& shape) {
    detail::Draft draft;
    if (const Result bad = detail::draft_rope(state_, shape, draft); !bad) return bad;
    Expected<BodyId> added = detail::append(state_, "add_rope", std::move(draft));
    if (added) take_stretch(state_.bodies.back());
    return added;
}

Expected<BodyId> World::add_cloth(const ClothShape& shape) {
    detail::Draft draft;
    if (const Result bad = detail::draft_cloth(state_, shape, draft); !bad) return bad;
    Expected<BodyId> added = detail::append(state_, "add_cloth", std::move(draft));
    if (added) take_stretch(state_.bodies.back());
    return added;
}

Expected<BodyId> World::add_hair(const HairShape& shape) {
    detail::Draft draft;
    if (const Result bad = detail::draft_hair(state_, shape, draft); !bad) return bad;
    Expected<BodyId> added = detail::append(state_, "add_hair", std::move(draft));
    if (added) take_stretch(state_.bodies.back());
    return added;
}

Result World::remove(BodyId body) noexcept {
    const Body* removed = found(body);
    if (removed == nullptr) return missing("remove", "body", body, state_);
    const std::size_t first = removed->first, count = removed->count, end = first + count;
    erase_range(state_.position, first, count);
    erase_range(state_.displacement, first, count);
    erase_range(state_.mass, first, count);
    const auto inside = [&](std::size_t particle) { return particle >= first && particle < end; };
    std::erase_if(state_.links, [&](const Link& link) { return inside(link.a) || inside(link.b); });
    std::erase_if(state_.pins, [&](const Pin& pin) { return inside(pin.particle); });
    detail::erase_ties(state_, [&](const Tie& tie) { return inside(tie.a) || inside(tie.b); });
    const auto renumber = [&](auto& particle) {
        if (particle >= end) particle -= static_cast<std::remove_reference_t<decltype(particle)>>(count);
    };
    for (Link& link : state_.links) renumber(link.a), renumber(link.b);
    for (Pin& pin : state_.pins) renumber(pin.particle);
    for (Tie& tie : state_.ties) renumber(tie.a), renumber(tie.b);
    std::erase_if(state_.contacts, [&](const BodyContact& each) { return inside(each.a) || inside(each.b); });
    for (BodyContact& each : state_.contacts) renumber(each.a), renumber(each.b);
    std::erase_if(state_.collisions, [&](const Collision& each) { return each.a == body || each.b == body; });
    detail::free_slot(state_.body_slots, body);
    erase_range(state_.bodies, static_cast<std::size_t>(removed - state_.bodies.data()), 1);
    for (Body& each : state_.bodies) renumber(each.first);
    return {};
}

Body* World::found(BodyId body) noexcept {
    return detail::find_in(state_.bodies, body);
}
const Body* World::find(BodyId body) const noexcept {
    return detail::find_in(state_.bodies, body);
}
Collider* World::found(ColliderId collider) noexcept {
    return detail::find_in(state_.colliders, collider);
}
const Collider* World::find(ColliderId collider) const noexcept {
    return detail::find_in(state_.colliders, collider);
}

Expected<std::size_t> World::particle(BodyId body, std::size_t index) const noexcept {
    const Body* of = find(body);
    if (of == nullptr) return missing("particle", "body", body, state_);
    if (const Result bad = check_index("particle", index, of->count, "the body", "particle"); !bad)
        return bad;
    return of->first + index;
}

Result World::pin(std::size_t particle, const glm::dvec3& at, double seconds) {
    if (const Result bad = check_particle("pin", particle, size()); !bad) return bad;
    if (const Result bad = check_point("pin", "at", glm::vec3(at)); !bad) return bad;
    if (const Result bad = check_time("pin", seconds); !bad) return bad;
    const auto slot = pin_of(state_.pins, particle);
    const Pin pin{.particle = particle, .goal = at, .seconds = seconds, .collider = {}};
    if (slot != state_.pins.end() && slot->particle == particle) {
        *slot = pin;
    } else {
        state_.pins.insert(slot, pin);
    }
    return {};
}

Result World::attach(std::size_t particle, ColliderId collider) {
    if (const Result bad = check_particle("attach", particle, size()); !bad) return bad;
    const Collider* holder = find(collider);
    if (holder == nullptr) return missing("attach", "collider", collider, state_);
    if (const Result bad = pin(particle, position(particle)); !bad) return bad;
    const auto slot = pin_of(state_.pins, particle);
    slot->goal = state_.position[particle] - glm::dvec3(centre(holder->shape));
    slot->collider = collider;
    return {};
}

Result World::unpin(std::size_t particle) noexcept {
    if (const Result bad = check_particle("unpin", particle, size()); !bad) return bad;
    const auto slot = pin_of(state_.pins, particle);
    if (slot == state_.pins.end() || slot->particle != particle)
        return refused("unpin", "particle", "a pinned particle", particle);
    state_.pins.erase(slot);
    return {};
}

bool World::pinned(std::size_t particle) const noexcept {
    const auto slot =
        std::lower_bound(state_.pins.begin(), state_.pins.end(), particle,
                         [](const Pin& pin, std::size_t number) { return pin.particle < number; });
    return slot != state_.pins.end() && slot->particle == particle;
}

Expected<BodyId> World::cut(BodyId rope, std::size_t segment) {
    const Body* const whole = find(rope);
    if (whole == nullptr) return missing("cut", "rope", rope, state_);
    if (whole->kind != Body::Kind::Rope)
        return Result(ErrorCode::InvalidArgument, "only ropes can be cut, not cloth or hair");
    if (const Result bad = check_index("cut", segment, whole->count - 1, "the rope", "segment"); !bad)
        return bad;
    const std::size_t kept = segment + 1;
    Body rest = *whole;
    rest.first += kept;
    rest.count -= kept;
    rest.row = rest.count;
    const auto at = static_cast<std::uint32_t>(whole->first + segment);
    const auto number = whole - state_.bodies.data();
    detail::reserve_more(state_.collisions, state_.collisions.size() + 1);
    const BodyId id = rest.id = detail::take_slot(state_.body_slots, state_.bodies);
    Body& front = state_.bodies[static_cast<std::size_t>(number)];
    front.count = front.row = kept;
    state_.bodies.insert(state_.bodies.begin() + number + 1, std::move(rest));
    std::erase_if(state_.links, [&](const Link& link) { return link.a == at && link.b == at + 1; });
    std::erase_if(state_.contacts, [&](const BodyContact& each) { return each.a == at || each.b == at; });
    detail::copy_collisions(state_, rope, id);
    return id;
}

Result World::move(BodyId body, const glm::dvec3& by) noexcept {
    const Body* const moved = find(body);
    if (moved == nullptr) return missing("move", "body", body, state_);
    const auto inside = [&](std::size_t particle) { return particle - moved->first < moved->count; };
    for (std::size_t i = moved->first; i < moved->first + moved->count; ++i) {
        const glm::dvec3 to = glm::abs(state_.position[i] + by);
        if (!(to.x <= max_magnitude && to.y <= max_magnitude && to.z <= max_magnitude))
            return refused("move", "by", "such that every coordinate stays within 1e9 m", detail::length(by));
    }
    for (const Pin& pin : state_.pins)
        if (inside(pin.particle) && pin.collider)
            return refused("move", "body", "not attached to a collider, with which it moves", pin.particle);
    for (std::size_t i = moved->first; i < moved->first + moved->count; ++i) state_.position[i] += by;
    for (Pin& pin : state_.pins)
        if (inside(pin.particle))
            pin.goal = glm::clamp(pin.goal + by, glm::dvec3(-max_magnitude), glm::dvec3(max_magnitude));
    for (Tie& tie : state_.ties) {
        if (inside(tie.a) == inside(tie.b)) continue;
        const double apart = detail::length(position(tie.b) - position(tie.a));
        tie.now = static_cast<float>(std::min(apart, static_cast<double>(max_magnitude)));
    }
    return {};
}

Expected<TieId> World::tie(std::size_t a, std::size_t b, const TieShape& shape) {
    if (const Result bad = check_particle("tie", a, size()); !bad) return bad;
    if (const Result bad = check_particle("tie", b, size()); !bad) return bad;
    if (a == b) return refused("tie", "b", "another particle than a", b);
    if (const Result bad = check_fields("tie", shape); !bad) return bad;
    const auto id = detail::take_slot(state_.tie_slots, state_.ties);
    const double apart = detail::length(position(b) - position(a));
    state_.ties.push_back({.id = id,
                           .a = static_cast<std::uint32_t>(a),
                           .b = static_cast<std::uint32_t>(b),
                           .length = shape.length,
                           .strength = shape.strength,
                           .now = static_cast<float>(std::min(apart, static_cast<double>(max_magnitude))),
                           .tension = 0.0f});
    return id;
}

Result World::set_tie(TieId tie, const TieShape& shape) noexcept {
    Tie* const there = detail::find_in(state_.ties, tie);
    if (there == nullptr) return missing("set_tie", "tie", tie, state_);
    if (const Result bad = check_fields("set_tie", shape); !bad) return bad;
    there->length = shape.length;
    there->strength = shape.strength;
    return {};
}

Result World::untie(TieId tie) noexcept {
    if (find(tie) == nullptr) return missing("untie", "tie", tie, state_);
    detail::erase_ties(state_, [&](const Tie& each) { return each.id == tie; });
    return {};
}

const Tie* World::find(TieId tie) const noexcept {
    return detail::find_in(state_.ties, tie);
}

Result World::set_collides(BodyId a, BodyId b, bool on) {
    for (const BodyId each : {a, b}) {
        const Body* const body = find(each);
        if (body == nullptr) return missing("set_collides", each == a ? "a" : "b", each, state_);
        if (body->kind == Body::Kind::Hair)
            return Result(ErrorCode::InvalidArgument,
                          "set_collides: hair cannot collide, only ropes and cloth");
    }
    const Collision wanted = detail::ordered(a, b);
    if (on) {
        detail::insert_collision(state_.collisions, wanted);
    } else {
        std::erase(state_.collisions, wanted);
    }
    return {};
}

bool World::collides(BodyId a, BodyId b) const noexcept {
    const Collision sought = detail::ordered(a, b);
    return std::find(state_.collisions.begin(), state_.collisions.end(), sought) != state_.collisions.end();
}

Expected<ColliderId> World::add_collider(const Shape& shape) {
    if (const Result bad = check("add_collider", shape); !bad) return bad;
    const auto id = detail::take_slot(state_.collider_slots, state_.colliders);
    state_.colliders.push_back({.id = id, .shape = shape, .goal = glm::dvec3(centre(shape)), .seconds = 0.0});
    return id;
}

Result World::move_collider(ColliderId collider, const glm::vec3& to, double seconds) noexcept {
    Collider* const moving = found(collider);
    if (moving == nullptr) return missing("move_collider", "collider", collider, state_);
    if (const Result bad = check_point("move_collider", "to", to); !bad) return bad;
    if (const Result bad = check("move_collider", moved(moving->shape, to)); !bad) return bad;
    if (const Result bad = check_time("move_collider", seconds); !bad) return bad;
    moving->goal = glm::dvec3(to);
    moving->seconds = seconds;
    moving->half_goal.reset();
    return {};
}

Result World::move_capsule(ColliderId capsule, const Capsule& to, double seconds) noexcept {
    Collider* const moving = found(capsule);
    if (moving == nullptr) return missing("move_capsule", "capsule", capsule, state_);
    auto* const shape = std::get_if<Capsule>(&moving->shape);
    if (shape == nullptr) return refused("move_capsule", "capsule", "a capsule", kind(moving->shape));
    if (const Result bad = check("move_capsule", to); !bad) return bad;
    if (const Result bad = check_time("move_capsule", seconds); !bad) return bad;
    shape->radius = to.radius;
    moving->goal = detail::middle_of(to);
    moving->half_goal = detail::half_of(to);
    moving->seconds = seconds;
    return {};
}

Result World::drive_collider(ColliderId collider, const Drive& drive) noexcept {
    Collider* const driven = found(collider);
    if (driven == nullptr) return missing("drive_collider", "collider", collider, state_);
    if (const Result bad = check_fields("drive_collider", drive); !bad) return bad;
    driven->drive = drive;
    return {};
}

Result World::set_collider(ColliderId collider, const Shape& shape) noexcept {
    Collider* const there = found(collider);
    if (there == nullptr) return missing("set_collider", "collider", collider, state_);
    if (const Result bad = check("set_collider", shape); !bad) return bad;
    there->shape = shape;
    there->goal = glm::dvec3(centre(shape));
    there->seconds = 0.0;
    there->half_goal.reset();
    return {};
}

Result World::remove_collider(ColliderId collider) noexcept {
    const Collider* const removed = find(collider);
    if (removed == nullptr) return missing("remove_collider", "collider", collider, state_);
    std::erase_if(state_.pins, [&](const Pin& pin) { return pin.collider == collider; });
    detail::free_slot(state_.collider_slots, collider);
    erase_range(state_.colliders, static_cast<std::size_t>(removed - state_.colliders.data()), 1);
    return {};
}

}  // namespace tendril::rope
