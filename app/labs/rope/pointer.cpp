// Mouse input in the Rope lab: handles, drags, clicks, selection and the gizmo.
#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "app/io/json_complete.hpp"
#include "app/labs/rope/rope_edit.hpp"
#include "app/labs/rope/rope_lab.hpp"
#include "app/labs/rope/rope_time.hpp"

namespace tendril::app {
namespace {

constexpr std::size_t max_handles = 400;

/// The world of the picked pane.
const NamedWorld& picked_world(const RopePart& part, PickId pick) {
    return world_in(part, static_cast<std::size_t>(std::max(pick, 0) / picks_in_pane));
}

/// The picked element of the list, whose picks begin with `first`; null if something else is picked, or the
/// world has changed since.
template <class Thing>
const Thing* picked_of(const std::vector<Thing>& all, PickId first, PickId pick) {
    const PickId index = pick % picks_in_pane - first;
    return index >= 0 && static_cast<std::size_t>(index) < all.size() ? &all[static_cast<std::size_t>(index)]
                                                                      : nullptr;
}
const rope::Collider* picked_collider(const NamedWorld& world, PickId pick) {
    return picked_of(world.state().colliders, collider_pick(0), pick);
}
const rope::Tie* picked_tie(const NamedWorld& world, PickId pick) {
    return picked_of(world.state().ties, tie_pick(0), pick);
}
const rope::Body* picked_body(const NamedWorld& world, PickId pick) {
    return picked_of(world.state().bodies, body_pick(0), pick);
}

ArgumentList of_particle(const NamedWorld& world, const ParticlePlace& place) {
    return {{"rope", world.name(*place.body)}, {"particle", place.index}};
}

/// The collider that a particle is attached to; null if there is none.
const rope::Collider* holder_of(const NamedWorld& world, std::size_t particle) {
    for (const rope::Pin& pin : world.state().pins)
        if (pin.particle == particle) return world.holder(pin);
    return nullptr;
}

/// True if the picked particle is pinned, and not only held by a drag.
bool is_pinned(const RopePart& part, PickId pick) {
    const auto pane = static_cast<std::size_t>(pick / picks_in_pane),
               particle = static_cast<std::size_t>(pick % picks_in_pane);
    const RopeRacer& racer = racer_in(part, pane);
    return racer.world->pinned(particle) && !is_held(racer, particle);
}

constexpr glm::vec3 along_x(1.0f, 0.0f, 0.0f), upright(0.0f, 1.0f, 0.0f);

/// A shape's rotation: for a capsule from the x axis to its axis, for a plane from the y axis to its normal.
glm::quat turn_of(const rope::Shape& shape) {
    const auto from = [](glm::vec3 axis, glm::vec3 direction) {
        const float length = glm::length(direction);
        return length > 1e-6f ? glm::quat(axis, direction / length) : glm::quat(1, 0, 0, 0);
    };
    if (const auto* box = std::get_if<rope::Box>(&shape)) return box->rotation;
    if (const auto* capsule = std::get_if<rope::Capsule>(&shape))
        return from(along_x, capsule->b - capsule->a);
    if (const auto* plane = std::get_if<rope::Plane>(&shape)) return from(upright, plane->normal);
    return {1.0f, 0.0f, 0.0f, 0.0f};
}

/// Arguments of rope.collider.set for the shape with that rotation.
ArgumentList turned(const rope::Shape& shape, glm::quat turn) {
    if (const auto* capsule = std::get_if<rope::Capsule>(&shape)) {
        const glm::vec3 middle = rope::centre(shape);
        const glm::vec3 half = 0.5f * glm::distance(capsule->a, capsule->b) * (turn * along_x);
        return {{"a", middle - half}, {"b", middle + half}};
    }
    if (std::holds_alternative<rope::Plane>(shape)) return {{"normal", turn * upright}};
    return {{"rotation", glm::normalize(turn)}};
}

Handle collider_handle(const NamedWorld& world, const rope::Collider& collider, PickId pick) {
    const rope::Shape shape = world.shape(collider);
    const bool turns = !std::holds_alternative<rope::Sphere>(shape);
    return {"collider." + world.name(collider),
            pick,
            {rope::centre(shape), turn_of(shape)},
            turns ? Drag::Position | Drag::Rotation : Drag::Position};
}

/// A handle that moves the body as a whole and rotates it by its particles.
Handle body_handle(const NamedWorld& world, const rope::Body& body, PickId pick) {
    return {world.name(body), pick, {grip_of(world, body)}, Drag::Position | Drag::Rotation};
}

/// The body whose particles are all selected; null if there is none.
const rope::Body* whole_body(const RopePart& part) {
    if (!part.selection || !part.selection->of_particles()) return nullptr;
    const rope::Body* const body = part.world->find(part.selection->body);
    const bool whole =
        body != nullptr && body->count > 1 && part.selection->particles.all().size() == body->count;
    return whole ? body : nullptr;
}

Handle particle_handle(const NamedWorld& world, const ParticlePlace& place, PickId pick) {
    return {world.name(*place.body) + "." + std::to_string(place.index),
            pick,
            {world.position(place.body->first + place.index)}};
}

}  // namespace

glm::vec3 grip_of(const NamedWorld& world, const rope::Body& body) {
    glm::dvec3 pinned(0.0), all(0.0);
    double pins = 0.0;
    for (const rope::Pin& pin : world.state().pins) {
        if (pin.particle - body.first >= body.count) continue;
        pinned += glm::dvec3(world.position(pin.particle));
        ++pins;
    }
    if (pins > 0.0) return glm::vec3(pinned / pins);
    for (std::size_t i = 0; i < body.count; ++i) all += glm::dvec3(world.position(body.first + i));
    return glm::vec3(all / static_cast<double>(body.count));
}

bool is_attached(const NamedWorld& world, const rope::Body& body) {
    return std::ranges::any_of(world.state().pins, [&](const rope::Pin& pin) {
        return pin.particle - body.first < body.count && pin.collider;
    });
}

std::optional<ParticlePlace> picked_particle(const NamedWorld& world, PickId pick) {
    pick %= picks_in_pane;
    if (pick < 0 || pick >= collider_pick(0)) return std::nullopt;
    const auto particle = static_cast<std::size_t>(pick);
    for (const rope::Body& body : world.state().bodies)
        if (particle >= body.first && particle < body.first + body.count)
            return ParticlePlace{&body, particle - body.first};
    return std::nullopt;
}

std::vector<Handle> RopeLab::handles(const Workspace& workspace) const {
    const NamedWorld& world = *rope_part(workspace).world;
    // Every n-th particle has a handle. Rope ends and pinned particles always have one.
    const std::size_t stride = world.size() / max_handles + 1;
    std::vector<bool> shown(world.size());
    for (const rope::Pin& pin : world.state().pins)
        shown[pin.particle] = world.state().pins.size() <= max_handles;
    std::vector<Handle> handles;
    for (const rope::Body& body : world.state().bodies) {
        for (std::size_t i = 0; i < body.count; ++i) {
            const bool end = body.kind == rope::Body::Kind::Rope && (i == 0 || i + 1 == body.count);
            if (i % stride == 0 || end || shown[body.first + i])
                handles.push_back(particle_handle(world, {&body, i}, particle_pick(body.first + i)));
        }
    }
    for (std::size_t i = 0; i < world.state().colliders.size(); ++i)
        handles.push_back(*handle(workspace, collider_pick(i)));
    return handles;
}

std::optional<Handle> RopeLab::handle(const Workspace& workspace, PickId pick) const {
    const NamedWorld& world = picked_world(rope_part(workspace), pick);
    if (const auto* collider = picked_collider(world, pick)) return collider_handle(world, *collider, pick);
    if (const auto* body = picked_body(world, pick)) return body_handle(world, *body, pick);
    if (const auto place = picked_particle(world, pick)) return particle_handle(world, *place, pick);
    return std::nullopt;
}

void RopeLab::drag(const Workspace& workspace, PickId pick, const Handle::Frame& frame, Emit& emit) const {
    const glm::vec3 to = frame.position;
    const RopePart& part = rope_part(workspace);
    const NamedWorld& world = picked_world(part, pick);
    if (const auto* collider = picked_collider(world, pick)) {
        const Handle::Frame now = collider_handle(world, *collider, pick).frame;
        const std::string& name = world.name(*collider);
        // Rotation about the axis of a capsule or the normal of a plane has no effect.
        const glm::quat by = frame.rotation * glm::inverse(now.rotation);
        const bool box = std::holds_alternative<rope::Box>(collider->shape);
        const glm::vec3 axis =
            now.rotation * (std::holds_alternative<rope::Plane>(collider->shape) ? upright : along_x);
        const bool turns = frame.rotation != now.rotation && (box || glm::distance(by * axis, axis) > 1e-6f);
        if (turns) {
            ArgumentList arguments = turned(world.shape(*collider), frame.rotation);
            arguments.push_back({"name", name});
            emit.continuously("rope.collider.set", arguments);
        }
        if (to != now.position || frame.rotation == now.rotation)
            emit.continuously("rope.collider.move", {{"name", name}, {"to", to}});
        return;
    }
    if (const auto* body = picked_body(world, pick)) {
        emit.continuously("rope.move",
                          {{"rope", world.name(*body)}, {"by", to - grip_of(world, *body)}, {"hold", true}});
        return;
    }
    const auto place = picked_particle(world, pick);
    if (!place) return;
    if (const rope::Collider* holder = holder_of(world, place->body->first + place->index)) {
        // An attached particle moves with its collider.
        const glm::vec3 by = to - world.position(place->body->first + place->index);
        emit.continuously("rope.collider.move",
                          {{"name", world.name(*holder)}, {"to", rope::centre(world.shape(*holder)) + by}});
        return;
    }
    const bool pinned = is_pinned(part, pick);
    ArgumentList arguments = of_particle(world, *place);
    arguments.push_back({"at", to});
    emit.continuously(pinned ? "rope.pin" : "rope.hold", arguments);
}

void RopeLab::drop(const Workspace& workspace, PickId, Emit& emit) const {
    if (holds(rope_part(workspace))) emit.continuously("rope.let_go");
}

namespace {

/// With this action, a click on a second particle continues from the selected one.
std::optional<ParticlePlace> from_selected(RopeTool tool, const RopePart& part, const NamedWorld& world,
                                           const ParticlePlace& to) {
    if (part.tool != tool || !part.selection || !part.selection->of_particles()) return std::nullopt;
    const ParticlePlace from{world.find(part.selection->body), part.selection->particle()};
    // The selection belongs to the part's own world: in a rival's world the body may lack the particle.
    if (from.body == nullptr || from.index >= from.body->count) return std::nullopt;
    if (from.body == to.body && from.index == to.index) return std::nullopt;
    return from;
}
std::optional<ParticlePlace> tied_from(const RopePart& part, const NamedWorld& world,
                                       const ParticlePlace& to) {
    return from_selected(RopeTool::Tie, part, world, to);
}
/// Where a cut of a cloth would begin.
std::optional<ParticlePlace> cut_from(const RopePart& part, const NamedWorld& world,
                                      const ParticlePlace& to) {
    const auto from = from_selected(RopeTool::Cut, part, world, to);
    const bool cuts = from && from->body == to.body && to.body->kind == rope::Body::Kind::Cloth;
    return cuts && !part.selection->particles.several() ? from : std::nullopt;
}

void cut_between(const NamedWorld& world, const ParticlePlace& from, const ParticlePlace& to, Emit& emit) {
    const auto at = [](const ParticlePlace& place) {
        const std::size_t cell = place.body->cell(place.index);
        return Json{cell % place.body->row, cell / place.body->row};
    };
    emit("rope.cloth.cut", {{"rope", world.name(*to.body)}, {"points", SharedJson(Json{at(from), at(to)})}});
}

/// Selects the tie, so that its length and strength can be set.
void tie_places(const NamedWorld& world, const ParticlePlace& a, const ParticlePlace& b, Emit& emit) {
    const std::string name = free_name("tie", [&](const auto& n) { return world.find_tie(n) != nullptr; });
    emit("rope.tie", {{"a", world.name(*a.body)},
                      {"a_particle", a.index},
                      {"b", world.name(*b.body)},
                      {"b_particle", b.index},
                      {"name", name}});
    emit("rope.select", {{"tie", name}});
}

}  // namespace

void RopeLab::click(const Workspace& workspace, PickId pick, Emit& emit) const {
    const RopePart& part = rope_part(workspace);
    const NamedWorld& world = picked_world(part, pick);
    if (const auto* collider = picked_collider(world, pick)) {
        if (part.tool == RopeTool::Tie && part.selection && part.selection->of_particles())
            emit("rope.tie", {{"a", part.selection->body},  // the command says why not
                              {"a_particle", part.selection->particle()},
                              {"b", world.name(*collider)},
                              {"b_particle", 0}});
        else
            emit("rope.select", {{"collider", world.name(*collider)}});
        return;
    }
    if (const auto* tie = picked_tie(world, pick)) {
        emit("rope.select", {{"tie", world.name(*tie)}});
        return;
    }
    const auto place = picked_particle(world, pick);
    if (!place) {
        // A tie keeps its first end after a click that misses; Escape forgets it.
        const bool tying = part.tool == RopeTool::Tie && part.selection && part.selection->of_particles();
        if (part.selection && !tying) emit("rope.select");
        return;
    }
    if (const auto from = tied_from(part, world, *place)) return tie_places(world, *from, *place, emit);
    emit("rope.select", of_particle(world, *place));
    if (const auto from = cut_from(part, world, *place)) cut_between(world, *from, *place, emit);
    if (part.tool == RopeTool::Pin) {
        const bool pinned = world.pinned(place->body->first + place->index);
        emit(pinned ? "rope.unpin" : "rope.pin", of_particle(world, *place));
    } else if (part.tool == RopeTool::Cut &&
               place->body->kind != rope::Body::Kind::Cloth) {  // the command refuses uncuttable bodies
        const std::size_t segment = std::min(place->index, std::max<std::size_t>(place->body->count, 2) - 2);
        emit("rope.cut", {{"rope", world.name(*place->body)}, {"segment", segment}});
    }
}

/// Selects the whole body: its gizmo then moves it.
void RopeLab::double_click(const Workspace& workspace, PickId pick, Emit& emit) const {
    const RopePart& part = rope_part(workspace);
    const NamedWorld& world = picked_world(part, pick);
    const auto place = picked_particle(world, pick);
    if (!place || part.tool != RopeTool::Move) return click(workspace, pick, emit);
    emit("rope.select", {{"rope", world.name(*place->body)}});
}

void RopeLab::click_more(const Workspace& workspace, PickId pick, Emit& emit) const {
    const NamedWorld& world = picked_world(rope_part(workspace), pick);
    const auto place = picked_particle(world, pick);
    if (!place) {
        if (pick != no_pick) click(workspace, pick, emit);
        return;
    }
    ArgumentList arguments = of_particle(world, *place);
    arguments.push_back({"add", true});
    emit("rope.select", arguments);
}

/// Every particle of the pane's world, even those without a handle.
std::vector<Handle> RopeLab::selectable(const Workspace& workspace, std::size_t pane) const {
    std::vector<Handle> all;
    for (const glm::vec3& at : world_in(rope_part(workspace), pane).positions())
        all.push_back({{}, pick_in(pane, particle_pick(all.size())), {at}});
    return all;
}

/// Selects in the body with the most particles in the box, or in the selected body when adding.
void RopeLab::select(const Workspace& workspace, const std::vector<PickId>& picks, bool add,
                     Emit& emit) const {
    const RopePart& part = rope_part(workspace);
    const NamedWorld& world = picked_world(part, picks.empty() ? no_pick : picks.front());
    std::vector<std::size_t> boxed;
    for (const PickId pick : picks) boxed.push_back(static_cast<std::size_t>(pick % picks_in_pane));
    std::sort(boxed.begin(), boxed.end());
    const rope::Body* most = nullptr;
    std::vector<std::size_t> inside;
    for (const rope::Body& body : world.state().bodies) {
        std::vector<std::size_t> here;
        const auto first = std::lower_bound(boxed.begin(), boxed.end(), body.first);
        for (auto at = first; at != boxed.end() && *at < body.first + body.count; ++at)
            here.push_back(*at - body.first);
        const bool added_to = add && part.selection && part.selection->body == world.name(body);
        if (here.size() <= inside.size() && !(added_to && !here.empty())) continue;
        most = &body;
        inside = std::move(here);
        if (added_to) break;
    }
    const bool replaces =
        add && part.selection && most != nullptr && part.selection->body != world.name(*most);
    if (most != nullptr && !replaces) {
        emit("rope.select",
             {{"rope", world.name(*most)}, {"particles", SharedJson(Json(inside))}, {"add", add}});
    } else if (!add && part.selection) {
        emit("rope.select");
    }
}

void RopeLab::deselect(const Workspace& workspace, Emit& emit) const {
    if (rope_part(workspace).selection) emit("rope.select");
}

std::string RopeLab::hint(const Workspace& workspace, PickId pick) const {
    const RopePart& part = rope_part(workspace);
    const NamedWorld& world = picked_world(part, pick);
    if (const auto* collider = picked_collider(world, pick)) {
        return world.name(*collider) + " (" + rope::kind(collider->shape) +
               "): drag moves it, and it pushes bodies in its way. Click selects it.";
    }
    if (const auto* tie = picked_tie(world, pick)) return world.name(*tie) + ": click selects it.";
    const auto place = picked_particle(world, pick);
    if (!place) {
        if (part.tool == RopeTool::Pin) return "Click a particle to pin or unpin it.";
        if (part.tool == RopeTool::Cut) return "Drag across ropes and cloths to cut them.";
        if (part.tool != RopeTool::Tie) return {};
        if (!part.selection || !part.selection->of_particles())
            return "Click a particle, then another to tie it to.";
        return part.selection->body + ", particle " + std::to_string(part.selection->particle()) +
               ": click the particle to tie it to. Escape cancels.";
    }
    const std::string name = world.name(*place->body) + ", particle " + std::to_string(place->index);
    switch (part.tool) {
        case RopeTool::Move:
            break;
        case RopeTool::Pin:
            return name + ": click pins or unpins it.";
        case RopeTool::Cut:
            if (cut_from(part, world, *place))
                return name + ": click cuts from the selected particle to here.";
            if (place->body->kind == rope::Body::Kind::Cloth)
                return name + ": click it, then the end of the cut.";
            if (place->body->kind == rope::Body::Kind::Hair) return name + ": hair cannot be cut.";
            if (place->body->count > 1) return name + ": click cuts here.";
            break;
        case RopeTool::Tie:
            if (tied_from(part, world, *place)) return name + ": click ties it to the selected particle.";
            return name + ": click it, then the particle to tie it to.";
    }
    if (const rope::Collider* holder = holder_of(world, place->body->first + place->index))
        return name + " (attached to " + world.name(*holder) + "): drag moves both.";
    const bool pinned = is_pinned(part, pick);
    return name + (pinned ? " (pinned): drag moves its pin."
                          : ": drag pulls it. Click selects it, double-click the whole.");
}

// The gizmo of the selection, and dragging several particles with it.

namespace {

struct SelectedParticles {
    const rope::Body* body = nullptr;
    std::vector<std::size_t> movable;  ///< indices in the body, ascending
    std::size_t attached = 0;          ///< number of particles that move with a collider
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

/// For a selected collider, a whole body, pins or several particles. A single free one is pulled directly.
std::optional<Handle> RopeLab::gizmo(const Workspace& workspace) const {
    const RopePart& part = rope_part(workspace);
    if (!part.selection) return std::nullopt;
    if (const SelectedParticles selected = selected_particles(part); selected.body != nullptr) {
        // No arrows while tying: they would take the click on the second particle.
        if (selected.movable.empty() || part.tool == RopeTool::Tie) return std::nullopt;
        if (whole_body(part) != nullptr && !is_attached(*part.world, *selected.body)) {
            const auto index = static_cast<std::size_t>(selected.body - part.world->state().bodies.data());
            return body_handle(*part.world, *selected.body, body_pick(index));
        }
        const std::size_t active = part.selection->particle();
        const bool pinned = is_pinned(part, particle_pick(selected.body->first + active));
        if (!pinned && !part.selection->particles.several()) return std::nullopt;
        const bool moves = std::ranges::binary_search(selected.movable, active);
        Handle shown = *handle(
            workspace, particle_pick(selected.body->first + (moves ? active : selected.movable.back())));
        if (selected.movable.size() > 1) shown.drag = Drag::Position | Drag::Rotation;
        return shown;
    }
    const auto& colliders = part.world->state().colliders;
    for (std::size_t i = 0; i < colliders.size(); ++i)
        if (part.world->name(colliders[i]) == part.selection->collider)
            return handle(workspace, collider_pick(i));
    return std::nullopt;
}

/// A whole body is moved by drag() instead.
Together RopeLab::together(const Workspace& workspace, Drag what) const {
    const RopePart& part = rope_part(workspace);
    Together together;
    const rope::Body* const whole = whole_body(part);
    if (what == Drag::Position && whole != nullptr && !is_attached(*part.world, *whole)) return together;
    if (!part.selection || !part.selection->particles.several()) return together;
    const SelectedParticles selected = selected_particles(part);
    for (const std::size_t each : selected.movable)
        together.handles.push_back(*handle(workspace, particle_pick(selected.body->first + each)));
    if (selected.attached > 0)
        together.staying = std::to_string(selected.attached) + " attached to a collider: move that.";
    return together;
}

/// Uses one command, so that all move simultaneously even while the simulation is paused.
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
            continue;  // the particle may have been cut off
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
