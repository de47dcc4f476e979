// What the mouse takes hold of in this lab, and what comes of it.
#include <algorithm>

#include "app/labs/rope/rope_edit.hpp"
#include "app/labs/rope/rope_lab.hpp"

namespace tendril::app {
namespace {

constexpr std::size_t most_handles = 400;

ArgumentList of_particle(const NamedWorld& world, const ParticlePlace& place) {
    return {{"rope", world.name(*place.body)}, {"particle", place.index}};
}

/// The collider that a particle is attached to; null where there is none.
const rope::Collider* holder_of(const NamedWorld& world, std::size_t particle) {
    for (const rope::Pin& pin : world.state().pins)
        if (pin.particle == particle) return world.holder(pin);
    return nullptr;
}

Handle particle_handle(const NamedWorld& world, const ParticlePlace& place) {
    const std::size_t particle = place.body->first + place.index;
    return {world.name(*place.body) + "." + std::to_string(place.index),
            particle_pick(particle),
            {world.position(particle)}};
}

}  // namespace

const rope::Collider* picked_collider(const NamedWorld& world, PickId pick) {
    const auto& colliders = world.state().colliders;
    if (!is_collider_pick(pick)) return nullptr;
    const std::size_t index = static_cast<std::size_t>(pick) - max_lab_particles;
    return index < colliders.size() ? &colliders[index] : nullptr;
}

std::optional<ParticlePlace> picked_particle(const NamedWorld& world, PickId pick) {
    if (pick < 0 || is_collider_pick(pick)) return std::nullopt;
    const auto particle = static_cast<std::size_t>(pick);
    for (const rope::Body& body : world.state().bodies)
        if (particle >= body.first && particle < body.first + body.count)
            return ParticlePlace{&body, particle - body.first};
    return std::nullopt;
}

std::size_t handle_stride(const NamedWorld& world) {
    return world.size() / most_handles + 1;
}

std::vector<Handle> RopeLab::handles(const Workspace& workspace) const {
    const NamedWorld& world = *rope_part(workspace).world;
    const std::size_t stride = handle_stride(world);
    std::vector<bool> shown(world.size());
    for (const rope::Pin& pin : world.state().pins)
        shown[pin.particle] = world.state().pins.size() <= most_handles;
    std::vector<Handle> handles;
    for (const rope::Body& body : world.state().bodies) {
        for (std::size_t i = 0; i < body.count; ++i) {
            const bool end = body.kind == rope::Body::Kind::Rope && (i == 0 || i + 1 == body.count);
            if (i % stride == 0 || end || shown[body.first + i])
                handles.push_back(particle_handle(world, {&body, i}));
        }
    }
    for (std::size_t i = 0; i < world.state().colliders.size(); ++i)
        handles.push_back(*handle(workspace, collider_pick(i)));
    return handles;
}

std::optional<Handle> RopeLab::handle(const Workspace& workspace, PickId pick) const {
    const NamedWorld& world = *rope_part(workspace).world;
    if (const auto* collider = picked_collider(world, pick))
        return Handle{"collider." + world.name(*collider), pick, {rope::centre(collider->shape)}};
    if (const auto place = picked_particle(world, pick)) return particle_handle(world, *place);
    return std::nullopt;
}

void RopeLab::drag(const Workspace& workspace, PickId pick, const Handle::Frame& frame, Emit& emit) const {
    const glm::vec3 to = frame.position;
    const RopePart& part = rope_part(workspace);
    if (const auto* collider = picked_collider(*part.world, pick)) {
        emit.continuously("rope.collider.move", {{"name", part.world->name(*collider)}, {"to", to}});
        return;
    }
    const auto place = picked_particle(*part.world, pick);
    if (!place) return;
    if (const rope::Collider* holder = holder_of(*part.world, place->body->first + place->index)) {
        // What is attached moves with what holds it.
        const glm::vec3 by = to - part.world->position(place->body->first + place->index);
        emit.continuously("rope.collider.move",
                          {{"name", part.world->name(*holder)}, {"to", rope::centre(holder->shape) + by}});
        return;
    }
    const bool held = part.hold == Hold{part.world->name(*place->body), place->index};
    const bool pinned = !held && part.world->pinned(place->body->first + place->index);
    ArgumentList arguments = of_particle(*part.world, *place);
    arguments.push_back({"at", to});
    emit.continuously(pinned ? "rope.pin" : "rope.hold", arguments);
}

void RopeLab::drop(const Workspace& workspace, PickId, Emit& emit) const {
    if (rope_part(workspace).hold) emit.continuously("rope.let_go");
}

void RopeLab::click(const Workspace& workspace, PickId pick, Emit& emit) const {
    const RopePart& part = rope_part(workspace);
    const NamedWorld& world = *part.world;
    if (const auto* collider = picked_collider(world, pick)) {
        emit("rope.select", {{"collider", world.name(*collider)}});
        return;
    }
    const auto place = picked_particle(world, pick);
    if (!place) {
        if (part.selection) emit("rope.select");
        return;
    }
    emit("rope.select", of_particle(world, *place));
    if (part.tool == RopeTool::Pin) {
        const bool pinned = world.pinned(place->body->first + place->index);
        emit(pinned ? "rope.unpin" : "rope.pin", of_particle(world, *place));
    } else if (part.tool == RopeTool::Cut) {  // of what cannot be cut the command says so
        const std::size_t segment = std::min(place->index, std::max<std::size_t>(place->body->count, 2) - 2);
        emit("rope.cut", {{"rope", world.name(*place->body)}, {"segment", segment}});
    }
}

std::string RopeLab::hint(const Workspace& workspace, PickId pick) const {
    const RopePart& part = rope_part(workspace);
    if (const auto* collider = picked_collider(*part.world, pick)) {
        return part.world->name(*collider) + " (" + rope::kind(collider->shape) +
               "): drag moves it, and it pushes what it meets. Click selects it.";
    }
    const auto place = picked_particle(*part.world, pick);
    if (!place) return {};
    const std::string name = part.world->name(*place->body) + ", particle " + std::to_string(place->index);
    switch (part.tool) {
        case RopeTool::Move:
            break;
        case RopeTool::Pin:
            return name + ": click pins or unpins it.";
        case RopeTool::Cut:
            if (place->body->kind != rope::Body::Kind::Rope) return name + ": only ropes can be cut.";
            if (place->body->count > 1) return name + ": click cuts here.";
            break;
    }
    if (const rope::Collider* holder = holder_of(*part.world, place->body->first + place->index))
        return name + " (attached to " + part.world->name(*holder) + "): drag moves both.";
    const std::size_t particle = place->body->first + place->index;
    const bool pinned = part.world->pinned(particle) && held_particle(part) != particle;
    return name + (pinned ? " (pinned): drag moves its pin." : ": drag pulls it. Click selects it.");
}

}  // namespace tendril::app
