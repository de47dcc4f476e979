#include "app/labs/humanoid/attachments/attachments.hpp"

#include <algorithm>
#include <glm/gtc/quaternion.hpp>
#include <numeric>
#include <stdexcept>
#include <tendril/rope/hair_roots.hpp>

#include "app/labs/humanoid/attachments/attachment_shape.hpp"
#include "app/labs/kit/require.hpp"

namespace tendril::app {
namespace {

constexpr float rope_density = 0.4f, hair_density = 0.02f, cloth_density = 0.3f;

/// The body as it is when the character rests, and what of it is pinned, as offsets from the node.
struct Made {
    NamedWorld world;
    std::vector<std::size_t> pinned;
};

Made make_rope(const AttachmentShape& shape, const Wearer& wearer, const glm::dvec3& root) {
    Made made;
    const double radius = 0.5 * shape.thickness, step = shape.length / shape.segments;
    made.world.add_rope("", {.from = glm::vec3(root),
                             .to = glm::vec3(root + shape.length * shape.direction),
                             .segments = shape.segments,
                             .radius = static_cast<float>(radius),
                             .density = rope_density});
    // What is inside the body is held, and one more: so a tail keeps its direction where it leaves the body.
    made.pinned = {0};
    const auto last = static_cast<std::size_t>(shape.segments);
    for (std::size_t i = 1; i < last; ++i) {
        made.pinned.push_back(i);
        if (!is_in_body(wearer, root + (step * static_cast<double>(i)) * shape.direction, radius)) break;
    }
    return made;
}

Made make_hair(const AttachmentShape& shape, const glm::dvec3& root) {
    Made made;
    rope::HairShape hair{.length = static_cast<float>(shape.length),
                         .segments = std::max(shape.segments, 2),
                         .radius = static_cast<float>(0.5 * shape.thickness),
                         .density = hair_density};
    hair.roots = require_value(rope::roots_around({.centre = glm::vec3(root),
                                                   .direction = glm::vec3(shape.direction),
                                                   .strands = shape.strands,
                                                   .radius = static_cast<float>(0.5 * shape.width)}));
    made.world.add_hair("", hair);
    for (const rope::Pin& pin : made.world.state().pins) made.pinned.push_back(pin.particle);
    return made;
}

/// Each column hangs from its own point of the row, which goes round the body where the cloth is a cape.
Made make_cloth(const AttachmentShape& shape, const Wearer& wearer, const glm::dvec3& middle) {
    Made made;
    const std::vector<glm::dvec3> row = cloth_row(wearer, shape, middle);
    double around = 0.0;
    for (std::size_t i = 1; i < row.size(); ++i) around += glm::distance(row[i], row[i - 1]);
    // The two directions only have to be square to each other: particles are placed below.
    made.world.add_cloth("", {.along = {static_cast<float>(around), 0.0f, 0.0f},
                              .down = {0.0f, -static_cast<float>(shape.length), 0.0f},
                              .columns = static_cast<int>(row.size()),
                              .rows = shape.segments + 1,
                              .radius = static_cast<float>(0.5 * shape.thickness),
                              .density = cloth_density,
                              .pins = rope::ClothShape::Pins::Row});
    rope::State state = made.world.state();
    const double step = shape.length / shape.segments;
    for (std::size_t i = 0; i < state.position.size(); ++i) {
        const auto down = static_cast<double>(i / row.size());
        const glm::dvec3 wider =
            (flare * down / shape.segments) * (row[i % row.size()] - row[row.size() / 2]);
        state.position[i] = row[i % row.size()] + wider + (step * down) * shape.direction;
    }
    for (rope::Pin& pin : state.pins) pin.goal = state.position[pin.particle];
    // Cut to the body: it rests as it is made.
    for (rope::Link& link : state.links)
        link.rest = static_cast<float>(glm::distance(state.position[link.a], state.position[link.b]));
    made.world.put(std::move(state));
    made.pinned.resize(row.size());
    std::iota(made.pinned.begin(), made.pinned.end(), std::size_t{0});
    return made;
}

Made make(const Attachment& wanted, const Wearer& wearer, const glm::dvec3& node) {
    const glm::dvec3 root = node + wanted.shape.offset;
    if (wanted.kind == AttachmentKind::Rope) return make_rope(wanted.shape, wearer, root);
    if (wanted.kind == AttachmentKind::Hair) return make_hair(wanted.shape, root);
    return make_cloth(wanted.shape, wearer, root);
}

/// Puts the world's one body into another world, each particle where `move` brings it.
template <class Move>
void append(NamedWorld& world, const std::string& name, const rope::State& from, Move move) {
    rope::State all = world.state();
    std::vector<std::string> bodies, colliders;
    for (const rope::Body& each : all.bodies) bodies.push_back(world.name(each));
    for (const rope::Collider& each : all.colliders) colliders.push_back(world.name(each));
    const std::size_t first = all.position.size();
    rope::Body body = from.bodies.front();
    body.first = first;
    all.bodies.push_back(body);
    bodies.push_back(name);
    for (const glm::dvec3& each : from.position) all.position.push_back(move(each));
    all.displacement.resize(all.position.size());
    all.mass.insert(all.mass.end(), from.mass.begin(), from.mass.end());
    for (rope::Link link : from.links) {
        link.a += static_cast<std::uint32_t>(first);
        link.b += static_cast<std::uint32_t>(first);
        all.links.push_back(link);
    }
    // Handles are numbered anew: nothing but the world itself holds any.
    for (rope::Body& each : all.bodies) each.id = {};
    for (rope::Collider& each : all.colliders) each.id = {};
    world = NamedWorld(std::move(all), bodies, colliders);
}

std::string free_name(const Attachments& attachments, AttachmentKind kind) {
    const std::string stem = attachment_kinds.name(kind);
    std::string name = stem;
    for (int i = 2; attachments.find(name) != nullptr; ++i) name = stem + " " + std::to_string(i);
    return name;
}

}  // namespace

std::vector<glm::dvec3> made_offsets(const Attachment& attachment, const Wearer& wearer) {
    const std::size_t node = *wearer.loaded.skeleton().find(attachment.node);
    const glm::dvec3 rest = wearer.loaded.rest[node].position;
    std::vector<glm::dvec3> offsets = make(attachment, wearer, rest).world.state().position;
    for (glm::dvec3& each : offsets) each -= rest;
    return offsets;
}

const Attachment* Attachments::find(const std::string& name) const {
    const auto found = std::ranges::find(list, name, &Attachment::name);
    return found == list.end() ? nullptr : &*found;
}

bool Attachments::operator==(const Attachments& other) const {
    return list == other.list && (world == other.world || world->state() == other.world->state());
}

NodeFrame Wearer::frame(std::size_t node) const {
    const humanoid::Placement& now = placed[node];
    return {now.position, glm::normalize(now.rotation() * glm::conjugate(loaded.rest[node].rotation()))};
}

void add_attachment(Attachments& attachments, const Wearer& wearer, Attachment wanted) {
    if (attachments.list.size() >= max_attachments)
        throw std::invalid_argument("there are " + std::to_string(max_attachments) +
                                    " attachments, as many as there may be");
    if (wanted.name.empty()) wanted.name = free_name(attachments, wanted.kind);
    if (attachments.find(wanted.name) != nullptr)
        throw std::invalid_argument("name \"" + wanted.name + "\" is another attachment's");
    const std::size_t node = *wearer.loaded.skeleton().find(wanted.node);
    const glm::dvec3 rest = wearer.loaded.rest[node].position;
    const std::size_t there = attachments.world->size(), more = particles_of(wanted.kind, wanted.shape);
    if (more > max_attached_particles - std::min(there, max_attached_particles))
        throw std::invalid_argument("its " + std::to_string(more) + " particles with the " +
                                    std::to_string(there) + " that there are would be more than " +
                                    std::to_string(max_attached_particles));
    const Made made = make(wanted, wearer, rest);
    wanted.frame = wearer.frame(node);
    const auto move = [&](const glm::dvec3& at) { return wanted.frame.apply(at - rest); };
    auto world = std::make_shared<NamedWorld>(*attachments.world);
    if (attachments.list.empty()) {
        *world = NamedWorld();
        world->set_settings(attachment_settings);
    }
    append(*world, wanted.name, made.world.state(), move);
    const std::size_t first = world->find(wanted.name)->first;
    wanted.pins.clear();
    for (const std::size_t particle : made.pinned) {
        wanted.pins.push_back({particle, made.world.state().position[particle] - rest});
        world->pin(first + particle, world->state().position[first + particle]);
    }
    attachments.world = std::move(world);
    attachments.list.push_back(std::move(wanted));
}

void remove_attachment(Attachments& attachments, const std::string& name) {
    if (attachments.find(name) == nullptr)
        throw std::invalid_argument("there is no attachment \"" + name + "\"");
    auto world = std::make_shared<NamedWorld>(*attachments.world);
    world->remove(name);
    attachments.world = std::move(world);
    std::erase_if(attachments.list, [&](const Attachment& each) { return each.name == name; });
    if (attachments.list.empty()) attachments.world = std::make_shared<const NamedWorld>();
}

Attachments remade(const Attachments& attachments, const Wearer& wearer, double scale) {
    Attachments all;
    for (Attachment each : attachments.list) {
        scale_lengths(each.shape, scale);
        each.shape.offset *= scale;
        add_attachment(all, wearer, std::move(each));
    }
    return all;
}

}  // namespace tendril::app
