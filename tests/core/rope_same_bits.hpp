// Bitwise equality of rope states: every field of every struct. Structured bindings list the fields, so that
// a new field does not compile until it is added here.
#pragma once

#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

#include "tendril/rope/state.hpp"

namespace tendril::test {

/// All numbers of a state, concatenated.
class StateBits {
  public:
    explicit StateBits(const rope::State& state) {
        const auto& [settings, bodies, links, position, displacement, mass, pins, colliders, body_slots,
                     collider_slots, ties, tie_slots, collisions, contacts, remainder, displaced_in, substeps,
                     dropped, drift] = state;
        add(settings, bodies, links, position, displacement, mass, pins, colliders, body_slots,
            collider_slots, remainder, displaced_in, substeps, dropped);
        if (!tie_slots.empty()) add(ties, tie_slots);
        if (drift != glm::dvec3(0.0)) put(drift);
        if (!collisions.empty()) add(collisions, contacts);
    }
    bool operator==(const StateBits&) const = default;

  private:
    template <class... Fields>
    void add(const Fields&... fields) {
        (put(fields), ...);
    }

    template <class Number>
    requires std::is_arithmetic_v<Number> || std::is_enum_v<Number>
    void put(const Number& number) { bytes_.append(reinterpret_cast<const char*>(&number), sizeof number); }
    template <class T>
    void put(const std::vector<T>& list) {
        put(list.size());
        for (const T& each : list) put(each);
    }
    template <glm::length_t size, class T>
    void put(const glm::vec<size, T>& point) {
        for (glm::length_t i = 0; i < size; ++i) put(point[i]);
    }
    void put(const glm::quat& rotation) { add(rotation.x, rotation.y, rotation.z, rotation.w); }
    template <class Kind>
    void put(const Handle<Kind>& handle) {
        const auto& [index, generation] = handle;
        add(index, generation);
    }
    void put(const rope::Settings& settings) {
        const auto& [substep, iterations, solver, damping, gravity, gravity_scale, external, wind, gusts,
                     still_air, compliance, friction, longest_frame] = settings;
        add(substep, iterations, solver, damping, gravity, gravity_scale, external, compliance, friction,
            longest_frame);
        if (wind != glm::vec3(0.0f)) add(wind, gusts);
        if (still_air) add(still_air);
    }
    void put(const rope::Collision& collision) { add(collision.a, collision.b); }
    void put(const rope::BodyContact& contact) { add(contact.a, contact.b, contact.force); }
    void put(const rope::Body& body) {
        const auto& [id, kind, first, count, row, cells, radius, tear, bending, friction, stretch] = body;
        add(id, kind, first, count, row, radius, tear, stretch);
        if (!cells.empty()) put(cells);
        if (friction) add(*friction);
        if (bending != 0.0f) add(bending);
    }
    void put(const rope::Link& link) {
        const auto& [a, b, rest, kind, compliance, tension] = link;
        add(a, b, rest, kind, compliance, tension);
    }
    void put(const rope::Tie& tie) {
        const auto& [id, a, b, length, strength, now, tension] = tie;
        add(id, a, b, length, strength, now, tension);
    }
    void put(const rope::Pin& pin) {
        const auto& [particle, goal, seconds, collider] = pin;
        add(particle, goal, seconds, collider);
    }
    void put(const rope::Collider& collider) {
        const auto& [id, shape, goal, seconds, half_goal, drive] = collider;
        add(id, shape.index(), goal, seconds);
        if (half_goal) add(*half_goal);
        if (drive.any()) put(drive);
        std::visit([&](const auto& each) { put(each); }, shape);
    }
    void put(const rope::Drive& drive) {
        const auto& [velocity, axis, spin] = drive;
        add(velocity, axis, spin);
    }
    void put(const rope::Sphere& sphere) {
        const auto& [centre, radius] = sphere;
        add(centre, radius);
    }
    void put(const rope::Capsule& capsule) {
        const auto& [a, b, radius] = capsule;
        add(a, b, radius);
    }
    void put(const rope::Plane& plane) {
        const auto& [point, normal] = plane;
        add(point, normal);
    }
    void put(const rope::Box& box) {
        const auto& [centre, half_extents, rotation] = box;
        add(centre, half_extents, rotation);
    }

    std::string bytes_;
};

/// Whether two states are bitwise equal: zeros of different sign differ.
inline bool same_bits(const rope::State& a, const rope::State& b) {
    return StateBits(a) == StateBits(b);
}

}  // namespace tendril::test
