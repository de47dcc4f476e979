#include "app/labs/humanoid/attachments/attachments.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <numeric>
#include <stdexcept>
#include <tendril/humanoid/t_pose.hpp>
#include <tendril/rope/hair_roots.hpp>

#include "app/labs/kit/arguments.hpp"

namespace tendril::app {
namespace {

constexpr float rope_density = 0.4f, hair_density = 0.02f, cloth_density = 0.3f;

/// The body of an attachment on the character at rest, and which of its particles are pinned.
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
    // Pins the particles inside the body and one more, so that a tail leaves it in its own direction.
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
                                                   .spread = static_cast<float>(0.5 * shape.width)}));
    made.world.add_hair("", hair);
    for (const rope::Pin& pin : made.world.state().pins) made.pinned.push_back(pin.particle);
    return made;
}

/// Each column hangs from its own point of the row, which for a cape curves around the body.
Made make_cloth(const AttachmentShape& shape, const Wearer& wearer, const glm::dvec3& middle) {
    Made made;
    const std::vector<glm::dvec3> row = cloth_row(wearer, shape, middle);
    double around = 0.0;
    for (std::size_t i = 1; i < row.size(); ++i) around += glm::distance(row[i], row[i - 1]);
    // The two directions only need to be perpendicular: particles are positioned below.
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
    // Fitted to the body: the initial shape is the rest shape.
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

/// Copies the single body of `from` into a world, applying `move` to each particle.
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
    // New handles are assigned: only the world stores any.
    for (rope::Body& each : all.bodies) each.id = {};
    for (rope::Collider& each : all.colliders) each.id = {};
    world = NamedWorld(std::move(all), bodies, colliders);
}

}  // namespace

std::shared_ptr<const NamedWorld> empty_world(rope::Settings settings) {
    settings.substep = attachment_settings.substep;
    NamedWorld world;
    world.set_settings(settings);
    return std::make_shared<const NamedWorld>(std::move(world));
}

std::vector<glm::dvec3> made_offsets(const Attachment& attachment, const Wearer& wearer) {
    const std::size_t node = *wearer.loaded.skeleton().find(attachment.node);
    const glm::dvec3 rest = wearer.loaded.rest[node].position;
    std::vector<glm::dvec3> offsets = make(attachment, wearer, rest).world.state().position;
    for (glm::dvec3& each : offsets) each -= rest;
    return offsets;
}

std::size_t torn_edges(const Attachments& attachments, const Attachment& attachment) {
    const rope::Body& body = *attachments.world->find(attachment.name);
    const rope::State& state = attachments.world->state();
    return static_cast<std::size_t>(std::ranges::count_if(state.links, [&](const rope::Link& link) {
        return link.kind == rope::Link::Kind::Stretch && link.a - body.first < body.count &&
               glm::distance(state.position[link.a], state.position[link.b]) >
                   (1.0 + torn_strain) * link.rest;
    }));
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
                                    " attachments already, the maximum");
    if (wanted.name.empty())
        wanted.name = free_name(attachment_kinds.name(wanted.kind),
                                [&](const std::string& name) { return attachments.find(name) != nullptr; });
    if (attachments.find(wanted.name) != nullptr)
        throw std::invalid_argument("name \"" + wanted.name + "\" is already used by another attachment");
    const std::size_t node = *wearer.loaded.skeleton().find(wanted.node);
    const glm::dvec3 rest = wearer.loaded.rest[node].position;
    const std::size_t there = attachments.world->size(), more = particles_of(wanted.kind, wanted.shape);
    if (more > max_attached_particles - std::min(there, max_attached_particles))
        throw std::invalid_argument("its " + std::to_string(more) + " particles and the " +
                                    std::to_string(there) + " already there would be more than " +
                                    std::to_string(max_attached_particles));
    const Made made = make(wanted, wearer, rest);
    wanted.frame = wearer.frame(node);
    const auto move = [&](const glm::dvec3& at) { return wanted.frame.apply(at - rest); };
    auto world = std::make_shared<NamedWorld>(*attachments.world);
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
    world->change(name, &rope::World::remove);
    attachments.world = std::move(world);
    std::erase_if(attachments.list, [&](const Attachment& each) { return each.name == name; });
    if (attachments.list.empty()) attachments.world = empty_world(attachments.world->settings());
}

Attachments remade(const Attachments& attachments, const Wearer& wearer, double scale) {
    Attachments all{{}, empty_world(attachments.world->settings())};
    for (Attachment each : attachments.list) {
        scale_lengths(each.shape, scale);
        each.shape.offset *= scale;
        add_attachment(all, wearer, std::move(each));
    }
    return all;
}

namespace {

using glm::dvec3;
using humanoid::Bone;

constexpr double clearance = 0.002;  ///< metres between the body at rest and what is attached to it

/// Distance from a point to the body at rest, metres; negative inside.
double distance_to_body(const Wearer& wearer, const dvec3& point) {
    double nearest = 1e9;
    for (const humanoid::BodyCapsule& each : wearer.capsules) {
        const humanoid::PlacedCapsule at = humanoid::place(each, wearer.map, wearer.loaded.rest);
        nearest = std::min(nearest, humanoid::gap(at, {point, point, 0.0}));
    }
    return nearest;
}

/// Distance along the unit vector `way` after which a ball of that radius clears the body.
double way_off(const Wearer& wearer, const dvec3& from, const dvec3& way, double radius) {
    constexpr int max_steps = 200;
    double far = 0.0;
    for (int i = 0; i < max_steps; ++i) {
        const double inside = radius + clearance - distance_to_body(wearer, from + far * way);
        if (inside <= 0.0) break;
        far += std::max(inside, 0.5 * clearance);
    }
    return far;
}

std::optional<Bone> bone_of(const Wearer& wearer, std::size_t node) {
    for (std::size_t i = 0; i < humanoid::bone_count; ++i)
        if (wearer.map.bones[i].node == static_cast<std::int32_t>(node)) return static_cast<Bone>(i);
    return std::nullopt;
}

const dvec3* joint(const Wearer& wearer, Bone bone) {
    const std::int32_t node = wearer.map[bone].node;
    return node < 0 ? nullptr : &wearer.loaded.rest[static_cast<std::size_t>(node)].position;
}

double height_of(const Wearer& wearer) {
    const double height = wearer.loaded.height();
    return height > 1e-3 && height < 1e3 ? height : 1.8;
}

int columns_of(const AttachmentShape& shape) {
    const double cells = (1.0 + 0.5 * flare) * shape.width * shape.segments / shape.length;
    return 1 + static_cast<int>(std::clamp(std::round(cells), 1.0, double{max_attached_segments}));
}

/// `count` points from end to end of a curve, evenly spaced by arc length.
std::vector<dvec3> evenly_along(const std::vector<dvec3>& curve, int count) {
    std::vector<double> way{0.0};
    for (std::size_t i = 1; i < curve.size(); ++i)
        way.push_back(way.back() + glm::distance(curve[i], curve[i - 1]));
    std::vector<dvec3> points;
    std::size_t at = 1;
    for (int i = 0; i < count; ++i) {
        const double wanted = way.back() * i / (count - 1);
        while (at + 1 < curve.size() && way[at] < wanted) ++at;
        const double step = way[at] - way[at - 1];
        const double part = step > 0.0 ? std::clamp((wanted - way[at - 1]) / step, 0.0, 1.0) : 0.0;
        points.push_back(curve[at - 1] + part * (curve[at] - curve[at - 1]));
    }
    return points;
}

}  // namespace

std::size_t particles_of(AttachmentKind kind, const AttachmentShape& shape) {
    const auto row = static_cast<std::size_t>(shape.segments) + 1;
    if (kind == AttachmentKind::Rope) return row;
    if (kind == AttachmentKind::Hair)
        return std::max(row, std::size_t{3}) * static_cast<std::size_t>(shape.strands);
    return row * static_cast<std::size_t>(columns_of(shape));
}

bool is_in_body(const Wearer& wearer, const dvec3& point, double radius) {
    return distance_to_body(wearer, point) < radius + clearance;
}

std::vector<dvec3> cloth_row(const Wearer& wearer, const AttachmentShape& shape, const dvec3& middle) {
    const humanoid::Facing facing = humanoid::facing(wearer.loaded.skeleton(), wearer.map);
    const dvec3 back = -facing.forward, half = 0.5 * shape.width * facing.left;
    const double radius = 0.5 * shape.thickness;
    const auto off = [&](const dvec3& from) { return way_off(wearer, from, back, radius); };
    const double deep = off(middle), side = std::max(off(middle - half), off(middle + half));
    // Half an ellipse round the back.
    constexpr int fine = 256;
    std::vector<dvec3> curve;
    for (int i = 0; i <= fine; ++i) {
        const double s = 1.0 - 2.0 * i / fine;
        const double far = side + (deep - side) * std::sqrt(std::max(0.0, 1.0 - s * s));
        const dvec3 at = middle + s * half + far * back;
        curve.push_back(at + off(at) * back);
    }
    return evenly_along(curve, columns_of(shape));
}

namespace {

AttachmentShape fitting_shape(const Wearer& wearer, AttachmentKind kind, std::size_t node) {
    const humanoid::Facing facing = humanoid::facing(wearer.loaded.skeleton(), wearer.map);
    const double height = height_of(wearer), unit = height / 1.8;
    const dvec3 rest = wearer.loaded.rest[node].position, back = -facing.forward;
    const std::optional<Bone> bone = bone_of(wearer, node);
    const dvec3* const left = joint(wearer, Bone::LeftUpperArm);
    const dvec3* const right = joint(wearer, Bone::RightUpperArm);
    const bool trunk = bone && *bone >= Bone::Hips && *bone <= Bone::Head;
    AttachmentShape shape;
    shape.direction = -facing.up;
    if (kind == AttachmentKind::Cloth) {
        shape = {.length = 0.5 * height,
                 .width = 0.22 * height,
                 .thickness = 0.012 * unit,
                 .segments = 18,
                 .direction = -facing.up};
        if (!trunk || left == nullptr || right == nullptr) return shape;
        shape.width = std::clamp(0.7 * glm::distance(*left, *right), 0.05 * height, height);
        shape.offset = 0.5 * (*left + *right) - rest;
        return shape;
    }
    if (kind == AttachmentKind::Rope) {
        shape.length = (bone == Bone::Hips ? 0.45 : 0.3) * height;
        shape.thickness = 0.03 * unit;
        shape.segments = 20;
        if (trunk) shape.direction = glm::normalize(0.9 * back - 0.45 * facing.up);
        return shape;
    }
    shape.length = 0.2 * height;
    shape.width = 0.03 * unit;
    shape.thickness = 0.006 * unit;
    shape.segments = 10;
    shape.strands = 24;
    if (trunk) shape.direction = glm::normalize(0.8 * back - 0.6 * facing.up);
    const dvec3 from = bone == Bone::Head ? 0.09 * unit * facing.up : dvec3(0.0);
    const dvec3 way = trunk ? back : shape.direction;
    shape.offset = from + way_off(wearer, rest + from, way, 0.5 * shape.thickness) * way;
    return shape;
}

}  // namespace

void scale_lengths(AttachmentShape& shape, double by) {
    for (double* length : {&shape.length, &shape.width, &shape.thickness})
        *length = std::clamp(*length * by, min_attachment, max_attachment);
}

AttachmentShape default_shape(const Wearer& wearer, AttachmentKind kind, std::size_t node) {
    AttachmentShape shape = fitting_shape(wearer, kind, node);
    scale_lengths(shape, 1.0);
    return shape;
}

}  // namespace tendril::app
