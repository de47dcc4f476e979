#include "rope.hpp"

#include <algorithm>
#include <cstdio>

namespace tendril::door {

namespace {

Result missing(const char* operation, const char* what) noexcept {
    char text[Result::max_message];
    std::snprintf(text, sizeof text, "%s: %s is not in this world; it was removed, or is another world's",
                  operation, what);
    return {ErrorCode::OutOfRange, text};
}

Result check_index(const char* operation, std::size_t index, std::size_t count) noexcept {
    if (index < count) return {};
    char text[Result::max_message];
    std::snprintf(text, sizeof text, "%s: index must be under %zu, got %zu", operation, count, index);
    return {ErrorCode::OutOfRange, text};
}

Result check_size(const char* operation, const char* list, std::size_t size, std::size_t needed) noexcept {
    if (size == needed) return {};
    char text[Result::max_message];
    std::snprintf(text, sizeof text, "%s: %s must have %zu elements, the body's particles, got %zu",
                  operation, list, needed, size);
    return {ErrorCode::InvalidArgument, text};
}

void run_tasks(void* user, TaskFunction task, void* context, std::uint32_t count) {
    const auto& tasks = *static_cast<const tendril_tasks*>(user);
    tasks.run(tasks.user, task, context, count);
}

}  // namespace

Tasks tasks_of(const tendril_tasks* given) noexcept {
    if (given == nullptr || given->run == nullptr) return {};
    return {run_tasks, const_cast<tendril_tasks*>(given)};
}

Expected<RopeWorld> make_rope_world(const rope::Settings& settings) {
    RopeWorld made;
    if (const Result bad = made.world.set_settings(settings); !bad) return bad;
    return made;
}

Result copy_world(RopeWorld& world, const RopeWorld& from) {
    world.world = from.world;
    world.last = {};
    return {};
}

Result use_threads(RopeWorld& world, int threads, const tendril_tasks* tasks) {
    const tendril_tasks kept = tasks != nullptr ? *tasks : tendril_tasks{};
    const tendril_tasks before = world.tasks;
    world.last = {};
    world.tasks = kept;
    const Result done = world.workspace.use_threads(threads, tasks_of(&world.tasks));
    if (!done) world.tasks = before;
    return done;
}

Result advance(RopeWorld& world, double seconds, bool impulses, rope::Advance& report) {
    world.last = {};
    report = world.last = world.world.advance(seconds, world.workspace, {.impulses = impulses});
    return report.accepted;
}

Result find(const rope::World& world, rope::BodyId body, rope::Body& info) {
    const rope::Body* const found = world.find(body);
    if (found == nullptr) return missing("rope_find_body", "body");
    info = *found;
    return {};
}

Result body_at(const rope::World& world, std::size_t index, rope::BodyId& body) noexcept {
    const auto& bodies = world.state().bodies;
    if (const Result bad = check_index("rope_body_at", index, bodies.size()); !bad) return bad;
    body = bodies[index].id;
    return {};
}

Result set_friction(rope::World& world, rope::BodyId body, float friction) noexcept {
    return world.set_friction(body, friction != friction ? std::nullopt : std::optional(friction));
}

namespace {

Result take(rope::World& world, Expected<rope::Edited> edited, std::size_t& pieces) {
    if (!edited) return edited.error();
    pieces = edited->pieces.size();
    world = std::move(edited->world);
    return {};
}

}  // namespace

Result cut_cloth(rope::World& world, rope::BodyId cloth, std::span<const glm::vec2> line,
                 std::size_t& pieces) {
    const rope::ClothLine lines[] = {{line.begin(), line.end()}};
    return take(world, rope::cut_cloth(world, cloth, lines), pieces);
}

Result part(rope::World& world, rope::BodyId body, std::size_t& pieces) {
    return take(world, rope::part_body(world, body), pieces);
}

Result tension(const rope::World& world, rope::TieId tie, float& newtons) noexcept {
    const rope::Tie* const found = world.find(tie);
    if (found == nullptr) return missing("rope_tie_tension", "tie");
    newtons = found->tension;
    return {};
}

Result centre(const rope::World& world, rope::ColliderId collider, glm::vec3& at) noexcept {
    const rope::Collider* const found = world.find(collider);
    if (found == nullptr) return missing("rope_collider_centre", "collider");
    at = rope::centre(world.pose(*found));
    return {};
}

Result impulse(const RopeWorld& world, rope::ColliderId collider, glm::dvec3& linear,
               glm::dvec3& angular) noexcept {
    if (world.world.find(collider) == nullptr) return missing("rope_collider_impulse", "collider");
    for (const rope::ColliderImpulse& each : world.last.impulses)
        if (each.collider == collider) linear = each.linear, angular = each.angular;
    return {};
}

Result torn_at(const RopeWorld& world, std::size_t index, rope::BodyId& body, std::size_t& a,
               std::size_t& b) noexcept {
    if (const Result bad = check_index("rope_torn_at", index, world.last.torn.size()); !bad) return bad;
    const rope::TornLink& torn = world.last.torn[index];
    body = torn.body, a = torn.link.a, b = torn.link.b;
    return {};
}

Result contact_at(const rope::World& world, std::size_t index, std::size_t& a, std::size_t& b,
                  glm::dvec3& force) noexcept {
    const auto& contacts = world.state().contacts;
    if (const Result bad = check_index("rope_contact_at", index, contacts.size()); !bad) return bad;
    a = contacts[index].a, b = contacts[index].b, force = contacts[index].force;
    return {};
}

Result positions(const rope::World& world, rope::BodyId body, std::span<glm::dvec3> at) noexcept {
    const rope::Body* const found = world.find(body);
    if (found == nullptr) return missing("rope_positions", "body");
    if (const Result bad = check_size("rope_positions", "positions", at.size(), found->count); !bad)
        return bad;
    world.pose(at, found->first);
    return {};
}

Result velocities(const rope::World& world, rope::BodyId body, std::span<glm::dvec3> of) noexcept {
    const rope::Body* const found = world.find(body);
    if (found == nullptr) return missing("rope_velocities", "body");
    if (const Result bad = check_size("rope_velocities", "velocities", of.size(), found->count); !bad)
        return bad;
    for (std::size_t i = 0; i < of.size(); ++i) of[i] = world.velocity(found->first + i);
    return {};
}

}  // namespace tendril::door
