// What changes a world's shape. How it moves is in advance.cpp.
#include "tendril/rope/world.hpp"

#include <algorithm>
#include <stdexcept>

#include "chain/checks.hpp"
#include "rope/build.hpp"
#include "rope/check_state.hpp"
#include "rope/geometry.hpp"
#include "rope/scratch.hpp"

namespace tendril::rope {
namespace {

using tendril::detail::refuse;

std::string quoted(std::string_view name) {
    std::string text(1, '"');
    return text.append(name).append(1, '"');
}

template <class List>
auto named(List& list, std::string_view name) {
    return std::find_if(list.begin(), list.end(), [&](const auto& each) { return each.name == name; });
}

/// `wanted`, if it is free; where none is wanted, the first that is: "rope", "rope 2", ...
std::string free_name(const State& state, const char* operation, const std::string& wanted,
                      const std::string& kind) {
    const auto is_free = [&](const std::string& name) {
        return named(state.bodies, name) == state.bodies.end();
    };
    if (!wanted.empty()) {
        if (!is_free(wanted)) refuse(operation, "name", "one that no other body has", quoted(wanted));
        return wanted;
    }
    std::string name = kind;
    for (int i = 2; !is_free(name); ++i) name = kind + " " + std::to_string(i);
    return name;
}

auto pin_of(std::vector<Pin>& pins, std::size_t particle) {
    return std::lower_bound(pins.begin(), pins.end(), particle,
                            [](const Pin& pin, std::size_t number) { return pin.particle < number; });
}

void require_time(const char* operation, double seconds) {
    if (seconds >= 0.0 && seconds <= max_magnitude) return;
    refuse(operation, "seconds", "0 or more", tendril::detail::text(static_cast<float>(seconds)));
}

/// Takes out of `list` what is from `first` on.
template <class T>
void erase_range(std::vector<T>& list, std::size_t first, std::size_t count) {
    const auto from = list.begin() + static_cast<std::ptrdiff_t>(first);
    list.erase(from, from + static_cast<std::ptrdiff_t>(count));
}

}  // namespace

World::World() = default;
World::World(State state) : state_(std::move(state)) {
    detail::check(state_);
}
World::World(const World& other) : state_(other.state_), plan_(other.plan_) {
    if (other.scratch_ && !other.scratch_->unit_name.empty()) use_vector_unit(other.scratch_->unit_name);
}
World::World(World&&) noexcept = default;
World& World::operator=(const World& other) {
    World copy(other);
    return *this = std::move(copy);
}
World& World::operator=(World&&) noexcept = default;
World::~World() = default;

void World::built() noexcept {
    const double stretch = length_error(state_.bodies.back());
    state_.bodies.back().stretch = static_cast<float>(std::min(stretch, static_cast<double>(max_magnitude)));
    reshaped();
}

void World::reshaped() noexcept {
    plan_.reset();
    if (scratch_) scratch_->fresh = true;
}

void World::set_settings(const Settings& settings) {
    require("set_settings", settings);
    state_.settings = settings;
}

void World::use_vector_unit(std::string_view name) {
    const bool single = name == "none";
    const detail::VectorUnit unit = detail::vector_unit(single ? "" : name);
    if (unit.solve == nullptr)
        refuse("use_vector_unit", "name", "one of ik::vector_units(), or \"none\"", quoted(name));
    if (!scratch_) scratch_ = std::make_unique<Scratch>();
    scratch_->unit = single ? detail::VectorUnit{unit.single, unit.single, 1} : unit;
    scratch_->unit_name = name;
    scratch_->fresh = true;
}

void World::trim() noexcept {
    if (!scratch_) return;
    const std::string name = scratch_->unit_name;
    const detail::VectorUnit unit = scratch_->unit;
    *scratch_ = Scratch{};
    scratch_->unit_name = name;
    scratch_->unit = unit;
}

void World::clear() noexcept {
    const Settings settings = state_.settings;
    state_ = State{};
    state_.settings = settings;
    reshaped();
}

std::string World::add_rope(const RopeShape& shape) {
    std::string name = free_name(state_, "add_rope", shape.name, "rope");
    detail::build(state_, shape, name);
    built();
    return name;
}

std::string World::add_sheet(const SheetShape& shape) {
    std::string name = free_name(state_, "add_sheet", shape.name, "sheet");
    detail::build(state_, shape, name);
    built();
    return name;
}

std::string World::add_lock(const LockShape& shape) {
    std::string name = free_name(state_, "add_lock", shape.name, "lock");
    detail::build(state_, shape, name);
    built();
    return name;
}

void World::remove(std::string_view body) {
    const auto found = named(state_.bodies, body);
    if (found == state_.bodies.end()) refuse("remove", "body", "the name of one", quoted(body));
    const std::size_t first = found->first, count = found->count, end = first + count;
    erase_range(state_.position, first, count);
    erase_range(state_.moved, first, count);
    erase_range(state_.before, first, count);
    erase_range(state_.mass, first, count);
    const auto inside = [&](std::size_t particle) { return particle >= first && particle < end; };
    std::erase_if(state_.links, [&](const Link& link) { return inside(link.a) || inside(link.b); });
    std::erase_if(state_.pins, [&](const Pin& pin) { return inside(pin.particle); });
    const auto renumber = [&](auto& particle) {
        if (particle >= end) particle -= static_cast<std::remove_reference_t<decltype(particle)>>(count);
    };
    for (Link& link : state_.links) renumber(link.a), renumber(link.b);
    for (Pin& pin : state_.pins) renumber(pin.particle);
    state_.bodies.erase(found);
    for (Body& each : state_.bodies) renumber(each.first);
    reshaped();
}

const Body* World::find(std::string_view body) const noexcept {
    const auto found = named(state_.bodies, body);
    return found == state_.bodies.end() ? nullptr : &*found;
}

std::size_t World::particle(std::string_view body, std::size_t index) const {
    const Body* found = find(body);
    if (found == nullptr) refuse("particle", "body", "the name of one", quoted(body));
    tendril::detail::require_index("particle", index, found->count);
    return found->first + index;
}

void World::pin(std::size_t particle, const glm::vec3& at, double seconds) {
    tendril::detail::require_index("pin", particle, size());
    tendril::detail::require_point("pin", "at", at);
    require_time("pin", seconds);
    const auto place = pin_of(state_.pins, particle);
    const Pin pin{.particle = particle, .goal = glm::dvec3(at), .seconds = seconds, .collider = {}};
    if (place != state_.pins.end() && place->particle == particle) {
        *place = pin;
    } else {
        state_.pins.insert(place, pin);
    }
}

void World::attach(std::size_t particle, std::string_view collider) {
    tendril::detail::require_index("attach", particle, size());
    const Collider* holder = find_collider(collider);
    if (holder == nullptr) refuse("attach", "collider", "the name of one", quoted(collider));
    const glm::dvec3 offset = state_.position[particle] - glm::dvec3(centre(holder->shape));
    pin(particle, position(particle));
    const auto place = pin_of(state_.pins, particle);
    place->goal = offset;
    place->collider = holder->name;  // the argument may be the name of a pin, which has moved
}

void World::unpin(std::size_t particle) {
    tendril::detail::require_index("unpin", particle, size());
    const auto place = pin_of(state_.pins, particle);
    if (place == state_.pins.end() || place->particle != particle) {
        refuse("unpin", "particle", "a pinned one", std::to_string(particle));
    }
    state_.pins.erase(place);
}

bool World::pinned(std::size_t particle) const noexcept {
    const auto place =
        std::lower_bound(state_.pins.begin(), state_.pins.end(), particle,
                         [](const Pin& pin, std::size_t number) { return pin.particle < number; });
    return place != state_.pins.end() && place->particle == particle;
}

std::string World::cut(std::string_view rope, std::size_t segment) {
    const auto found = named(state_.bodies, rope);
    if (found == state_.bodies.end()) refuse("cut", "rope", "the name of one", quoted(rope));
    if (found->kind != Body::Kind::Rope) refuse("cut", "rope", "a rope, not a sheet or a lock", quoted(rope));
    tendril::detail::require_index("cut", segment, found->count - 1);
    std::string name;
    for (int i = 2; name.empty() || find(name) != nullptr; ++i) name = found->name + " " + std::to_string(i);

    const std::size_t kept = segment + 1;
    Body rest = *found;
    rest.name = name;
    rest.first += kept;
    rest.count -= kept;
    rest.row = rest.count;
    const auto at = static_cast<std::uint32_t>(found->first + segment);
    found->count = found->row = kept;
    state_.bodies.insert(found + 1, rest);
    std::erase_if(state_.links, [&](const Link& link) { return link.a == at && link.b == at + 1; });
    reshaped();
    return name;
}

void World::add_collider(std::string name, const Shape& shape) {
    if (name.empty()) refuse("add_collider", "name", "a name", quoted(name));
    if (find_collider(name) != nullptr) {
        refuse("add_collider", "name", "one that no other collider has", quoted(name));
    }
    require("add_collider", shape);
    state_.colliders.push_back(
        {.name = std::move(name), .shape = shape, .goal = glm::dvec3(centre(shape)), .seconds = 0.0});
    reshaped();
}

Collider& World::collider(const char* operation, std::string_view name) {
    const auto found = named(state_.colliders, name);
    if (found == state_.colliders.end()) refuse(operation, "name", "that of a collider", quoted(name));
    return *found;
}

void World::move_collider(std::string_view name, const glm::vec3& to, double seconds) {
    Collider& moving = collider("move_collider", name);
    tendril::detail::require_point("move_collider", "to", to);
    require("move_collider", moved(moving.shape, to));
    require_time("move_collider", seconds);
    moving.goal = glm::dvec3(to);
    moving.seconds = seconds;
}

void World::set_collider(std::string_view name, const Shape& shape) {
    Collider& there = collider("set_collider", name);
    require("set_collider", shape);
    there.shape = shape;
    there.goal = glm::dvec3(centre(shape));
    there.seconds = 0.0;
}

void World::remove_collider(std::string_view name) {
    const std::string gone = collider("remove_collider", name).name;  // `name` may be part of what is erased
    std::erase_if(state_.pins, [&](const Pin& pin) { return pin.collider == gone; });
    std::erase_if(state_.colliders, [&](const Collider& each) { return each.name == gone; });
    reshaped();
}

const Collider* World::find_collider(std::string_view name) const noexcept {
    const auto found = named(state_.colliders, name);
    return found == state_.colliders.end() ? nullptr : &*found;
}

}  // namespace tendril::rope
