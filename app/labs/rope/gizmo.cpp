// The gizmo of what is selected in the Rope lab, and what of several particles it drags at once.
#include <algorithm>

#include "app/document/json_complete.hpp"
#include "app/labs/rope/rope_edit.hpp"
#include "app/labs/rope/rope_lab.hpp"

namespace tendril::app {
namespace {

struct SelectedParticles {
    const rope::Body* body = nullptr;
    std::vector<std::size_t> movable;  ///< by their places in the body, ascending
    std::size_t attached = 0;          ///< those that go with a collider
};

SelectedParticles selected_particles(const RopePart& part) {
    SelectedParticles selected{part.world->find(part.selection->body), {}, 0};
    if (selected.body == nullptr) return selected;
    std::vector<bool> attached(part.world->size());
    for (const rope::Pin& pin : part.world->state().pins)
        attached[pin.particle] = part.world->holder(pin) != nullptr;
    for (const std::size_t each : part.selection->particles.all()) {
        if (attached[selected.body->first + each])
            ++selected.attached;
        else
            selected.movable.push_back(each);
    }
    return selected;
}

}  // namespace

/// Of a collider that is selected, or of several particles: one has hands enough.
std::optional<Handle> RopeLab::gizmo(const Workspace& workspace) const {
    const RopePart& part = rope_part(workspace);
    if (!part.selection) return std::nullopt;
    if (part.selection->particles.several()) {
        const SelectedParticles selected = selected_particles(part);
        if (selected.movable.empty()) return std::nullopt;
        const std::size_t active = part.selection->particle();
        const bool moves = std::ranges::binary_search(selected.movable, active);
        Handle shown = *handle(
            workspace, particle_pick(selected.body->first + (moves ? active : selected.movable.back())));
        shown.drag = Drag::Position | Drag::Rotation;
        return shown;
    }
    const auto& colliders = part.world->state().colliders;
    for (std::size_t i = 0; i < colliders.size(); ++i)
        if (part.world->name(colliders[i]) == part.selection->collider)
            return handle(workspace, collider_pick(i));
    return std::nullopt;
}

Together RopeLab::together(const Workspace& workspace, Drag) const {
    const RopePart& part = rope_part(workspace);
    Together together;
    if (!part.selection || !part.selection->particles.several()) return together;
    const SelectedParticles selected = selected_particles(part);
    for (const std::size_t each : selected.movable)
        together.handles.push_back(*handle(workspace, particle_pick(selected.body->first + each)));
    if (selected.attached > 0)
        together.staying = std::to_string(selected.attached) + " attached to a collider: move that.";
    return together;
}

/// All by one command: what is dragged while the simulation is paused then moves at once.
void RopeLab::drag_together(const Workspace& workspace, const std::vector<Handle>& handles,
                            Emit& emit) const {
    const RopePart& part = rope_part(workspace);
    const std::vector<std::size_t> held = held_particles(part);
    Json particles = Json::array(), points = Json::array();
    const rope::Body* body = nullptr;
    bool free = false;
    for (const Handle& each : handles) {
        const auto place = picked_particle(*part.world, each.pick);
        if (!place || (body != nullptr && body != place->body))
            continue;  // what was caught may have been cut
        body = place->body;
        const std::size_t particle = place->body->first + place->index;
        free = free || !part.world->pinned(particle) || std::ranges::binary_search(held, particle);
        particles.push_back(place->index);
        points.push_back(point(each.frame.position));
    }
    if (body == nullptr) return;
    emit.continuously(free ? "rope.hold" : "rope.pin", {{"rope", part.world->name(*body)},
                                                        {"particles", SharedJson(std::move(particles))},
                                                        {"points", SharedJson(std::move(points))}});
}

}  // namespace tendril::app
