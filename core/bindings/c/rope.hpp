// Rope worlds in C: a world with its workspace, and calls that take another form there.
#pragma once

#include <optional>
#include <span>

#include "call.hpp"
#include "tendril/rope/edit.hpp"
#include "tendril/rope/world.hpp"

namespace tendril::door {

struct RopeWorld {
    rope::World world{};
    rope::Workspace workspace{};
    rope::Advance last{};  ///< its lists are the workspace's
    tendril_tasks tasks{};
};

/// The value of an Expected, or its error.
template <class Value>
Result into(Expected<Value> made, Value& to) {
    if (!made) return made.error();
    to = std::move(*made);
    return {};
}

/// A call's tasks; `given` must outlive it.
Tasks tasks_of(const tendril_tasks* given) noexcept;

Expected<RopeWorld> make_rope_world(const rope::Settings& settings);
Result copy_world(RopeWorld& world, const RopeWorld& from);
Result use_threads(RopeWorld& world, int threads, const tendril_tasks* tasks);
Result advance(RopeWorld& world, double seconds, bool impulses, rope::Advance& report);

Result find(const rope::World& world, rope::BodyId body, rope::Body& info);
Result body_at(const rope::World& world, std::size_t index, rope::BodyId& body) noexcept;
Result set_friction(rope::World& world, rope::BodyId body, float friction) noexcept;
Result cut_cloth(rope::World& world, rope::BodyId cloth, std::span<const glm::vec2> line,
                 std::size_t& pieces);
Result part(rope::World& world, rope::BodyId body, std::size_t& pieces);
Result tension(const rope::World& world, rope::TieId tie, float& newtons) noexcept;
Result centre(const rope::World& world, rope::ColliderId collider, glm::vec3& at) noexcept;
Result impulse(const RopeWorld& world, rope::ColliderId collider, glm::dvec3& linear,
               glm::dvec3& angular) noexcept;
Result torn_at(const RopeWorld& world, std::size_t index, rope::BodyId& body, std::size_t& a,
               std::size_t& b) noexcept;
Result contact_at(const rope::World& world, std::size_t index, std::size_t& a, std::size_t& b,
                  glm::dvec3& force) noexcept;
Result positions(const rope::World& world, rope::BodyId body, std::span<glm::dvec3> at) noexcept;
Result velocities(const rope::World& world, rope::BodyId body, std::span<glm::dvec3> of) noexcept;

/// A world's state as bytes with a checksum.
std::size_t saved_bytes(const rope::World& world) noexcept;
void save(Call& call, const rope::World& world, std::span<std::byte> bytes, std::size_t& used) noexcept;
/// Leaves the world as it is if it refuses the bytes.
Result load(RopeWorld& world, std::span<const std::byte> bytes);

}  // namespace tendril::door
