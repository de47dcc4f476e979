#include "app/labs/humanoid/attachments/attachment_motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <tendril/magnitude.hpp>

#include "app/document/workspace.hpp"
#include "app/labs/humanoid/hold/hold_setting.hpp"
#include "tendril/elementary.hpp"

namespace tendril::app {
namespace {

using glm::dvec3;

constexpr double longest_substep = 1.0 / 240.0;
/// Moving by more of the character's height per tick, 27 m/s for an adult, or turning further, is a jump.
constexpr double longest_way = 0.25, largest_turn = glm::radians(100.0);
constexpr double resting_speed = 5e-3;  ///< m/s

struct NamedShape {
    std::string name;
    rope::Shape shape;
};

/// Clamps to the bounds of the world; replaces values that are not finite by 0.
dvec3 kept_in(const dvec3& point) {
    constexpr double edge = 0.5 * static_cast<double>(max_magnitude);
    dvec3 kept(0.0);
    for (int i = 0; i < 3; ++i)
        if (std::isfinite(point[i])) kept[i] = std::clamp(point[i], -edge, edge);
    return kept;
}

/// Fraction of a limb's capsule, from its start, that overlaps the trunk in any pose; empty for other bones.
std::optional<double> joined_part(humanoid::Bone bone) {
    using enum humanoid::Bone;
    static constexpr std::array joined{LeftUpperArm, RightUpperArm, LeftUpperLeg, RightUpperLeg};
    static constexpr std::array limbs{LeftLowerArm, RightLowerArm, LeftHand, RightHand,
                                      LeftLowerLeg, RightLowerLeg, LeftFoot, RightFoot};
    if (std::ranges::find(joined, bone) != joined.end()) return 0.5;
    return std::ranges::find(limbs, bone) != limbs.end() ? std::optional(0.0) : std::nullopt;
}

/// Limbs and held things are soft: pressed on the trunk they get thinner, to leave room for cloth in between.
std::vector<NamedShape> colliders_of(const Wearer& wearer, const rope::State& worn) {
    double room = 0.0;
    for (const rope::Body& each : worn.bodies) room = std::max(room, 2.0 * static_cast<double>(each.radius));
    std::vector<humanoid::PlacedCapsule> placed, hard;
    for (const humanoid::BodyCapsule& each : wearer.capsules) {
        placed.push_back(humanoid::place(each, wearer.map, wearer.placed));
        if (!joined_part(each.bone)) hard.push_back(placed.back());
    }
    std::vector<NamedShape> all;
    const auto add = [&](std::string name, const humanoid::PlacedCapsule& at, std::optional<double> from) {
        double radius = at.radius;
        if (from)
            for (const humanoid::PlacedCapsule& each : hard)
                radius = std::min(radius,
                                  humanoid::gap({glm::mix(at.from, at.to, *from), at.to, 0.0}, each) - room);
        all.push_back({std::move(name), rope::Capsule{glm::vec3(kept_in(at.from)), glm::vec3(kept_in(at.to)),
                                                      static_cast<float>(std::clamp(radius, 0.0, 1e6))}});
    };
    for (std::size_t i = 0; i < placed.size(); ++i)
        add(humanoid::name(wearer.capsules[i].bone), placed[i], joined_part(wearer.capsules[i].bone));
    // A rising slope is the union of two half spaces. A falling one is their intersection, which separate
    // colliders cannot express.
    const GroundSetting& ground = wearer.ground;
    const bool rises = ground.kind == humanoid::GroundKind::Slope && ground.angle_deg >= 0.0;
    if (ground.kind == humanoid::GroundKind::Flat || rises) all.push_back({"ground", rope::Plane{}});
    if (rises) {
        const double angle = glm::radians(ground.angle_deg);
        all.push_back({"slope", rope::Plane{.normal = {0.0f, static_cast<float>(math::cosine(angle)),
                                                       static_cast<float>(-math::sine(angle))}}});
    }
    for (std::size_t i = 0; i < wearer.held.size(); ++i)
        add("held " + std::to_string(i), wearer.held[i], 0.0);
    return all;
}

/// Number of colliders at the start of the world's list that match, in this order. Positions may differ.
std::size_t count_shared(const NamedWorld& world, const std::vector<NamedShape>& wanted) {
    const std::vector<rope::Collider>& there = world.state().colliders;
    std::size_t i = 0;
    while (i < std::min(there.size(), wanted.size()) && world.name(there[i]) == wanted[i].name &&
           there[i].shape.index() == wanted[i].shape.index())
        ++i;
    return i;
}
bool has(const NamedWorld& world, const std::vector<NamedShape>& wanted) {
    return world.state().colliders.size() == wanted.size() && count_shared(world, wanted) == wanted.size();
}

/// Removes and adds colliders until the world has exactly these.
void match_colliders(NamedWorld& world, const std::vector<NamedShape>& wanted) {
    const std::size_t shared = count_shared(world, wanted);
    while (world.state().colliders.size() > shared) {
        const std::string name = world.name(world.state().colliders.back());
        world.change(name, &rope::World::remove_collider);
    }
    for (std::size_t i = shared; i < wanted.size(); ++i) world.add_collider(wanted[i].name, wanted[i].shape);
}

void place_colliders(NamedWorld& world, const std::vector<NamedShape>& wanted) {
    match_colliders(world, wanted);
    for (const NamedShape& each : wanted) world.change(each.name, &rope::World::set_collider, each.shape);
}

void move_colliders(NamedWorld& world, const std::vector<NamedShape>& wanted, double seconds) {
    match_colliders(world, wanted);
    for (const NamedShape& each : wanted) {
        if (const auto* capsule = std::get_if<rope::Capsule>(&each.shape))
            world.change(each.name, &rope::World::move_capsule, *capsule, seconds);
        else
            world.change(each.name, &rope::World::set_collider, each.shape);
    }
}

void move_pins(NamedWorld& world, const Attachment& attachment, const NodeFrame& to, double seconds) {
    const std::size_t first = world.find(attachment.name)->first;
    for (const AttachmentPin& pin : attachment.pins)
        world.pin(first + pin.particle, kept_in(to.apply(pin.offset)), seconds);
}

/// The distance between two frames, metres, and the angle, radians.
double way(const NodeFrame& a, const NodeFrame& b) {
    return glm::distance(a.position, b.position);
}
double turned(const NodeFrame& a, const NodeFrame& b) {
    const double along = std::abs(glm::dot(a.turn, b.turn));
    return along < 1.0 ? 2.0 * math::arccosine(along) : 0.0;
}

NodeFrame frame_of(const Attachment& attachment, const Wearer& wearer) {
    NodeFrame frame = wearer.frame(*wearer.loaded.skeleton().find(attachment.node));
    frame.position = kept_in(frame.position);
    if (!std::isfinite(glm::dot(frame.turn, frame.turn))) frame.turn = glm::dquat(1.0, 0.0, 0.0, 0.0);
    return frame;
}

/// True if a node or a capsule moved farther than is plausible in that time.
bool has_jumped(const Attachments& attachments, const Wearer& wearer,
                const std::vector<NamedShape>& colliders, double seconds) {
    const double ticks = std::max(1.0, seconds / tick_seconds);
    const double far = ticks * longest_way * std::clamp(wearer.loaded.height(), 0.1, 1e6);
    for (const Attachment& each : attachments.list) {
        const NodeFrame to = frame_of(each, wearer);
        if (!(way(each.frame, to) <= far) || !(turned(each.frame, to) <= ticks * largest_turn)) return true;
    }
    if (!has(*attachments.world, colliders)) return false;
    for (std::size_t i = 0; i < colliders.size(); ++i) {
        const rope::Shape& before = attachments.world->state().colliders[i].shape;
        // Hands are fast: capsules may move twice as far as nodes that carry attachments.
        if (glm::distance(dvec3(rope::centre(before)), dvec3(rope::centre(colliders[i].shape))) > 2.0 * far)
            return true;
    }
    return false;
}

/// True if the world already matches the wearer's pose.
bool in_place(const Attachments& attachments, const Wearer& wearer,
              const std::vector<NamedShape>& colliders) {
    constexpr double metres = 1e-4, radians = 1e-4;
    for (const Attachment& each : attachments.list) {
        const NodeFrame to = frame_of(each, wearer);
        if (!(way(each.frame, to) < metres) || !(turned(each.frame, to) < radians)) return false;
    }
    if (!has(*attachments.world, colliders)) return false;
    const auto near = [](const glm::vec3& a, const glm::vec3& b) { return glm::distance(a, b) < metres; };
    for (std::size_t i = 0; i < colliders.size(); ++i) {
        const rope::Shape& now = attachments.world->state().colliders[i].shape;
        const auto* capsule = std::get_if<rope::Capsule>(&now);
        if (capsule == nullptr ? !(now == colliders[i].shape)
                               : !near(capsule->a, std::get<rope::Capsule>(colliders[i].shape).a) ||
                                     !near(capsule->b, std::get<rope::Capsule>(colliders[i].shape).b))
            return false;
    }
    return true;
}

/// The rigid motion from one frame to another.
struct Carrier {
    NodeFrame from, to;
    glm::dquat turn;
    Carrier(const NodeFrame& before, const NodeFrame& after)
        : from(before), to(after), turn(glm::normalize(after.turn * glm::conjugate(before.turn))) {}
    dvec3 point(const dvec3& at) const { return kept_in(to.position + turn * (at - from.position)); }
    dvec3 way(const dvec3& by) const { return kept_in(turn * by); }
};

void carry_bodies(NamedWorld& world, const Attachments& attachments, const std::vector<Carrier>& carriers) {
    rope::State state = world.state();
    for (std::size_t k = 0; k < carriers.size(); ++k) {
        const rope::Body& body = *world.find(attachments.list[k].name);
        for (std::size_t i = body.first; i < body.first + body.count; ++i) {
            state.position[i] = carriers[k].point(state.position[i]);
            state.displacement[i] = carriers[k].way(state.displacement[i]);
        }
    }
    world.put(std::move(state));
}

/// Moves the body to its new pose and pushes aside everything in its way; the rest is frozen.
void push_aside(NamedWorld& world, const std::vector<NamedShape>& colliders, rope::Workspace& workspace) {
    constexpr int substeps = 24;
    const rope::State before = world.state();
    rope::State still = before;
    std::ranges::fill(still.displacement, dvec3(0.0));
    still.settings.damping = rope::max_rate;
    still.settings.gravity = still.settings.wind = glm::vec3(0.0f);
    still.settings.substep = longest_substep;
    still.displaced_in = still.remainder = 0.0;
    world.put(std::move(still));
    move_colliders(world, colliders, substeps * longest_substep);
    world.advance(substeps * longest_substep, workspace, substeps);
    rope::State after = world.state();
    after.settings = before.settings;
    after.displacement = before.displacement;
    after.displaced_in = before.displaced_in;
    after.remainder = 0.0;
    world.put(std::move(after));
    place_colliders(world, colliders);
}

/// Resets attachments that are caught in the body to their initial shape: those badly stretched, and those
/// that stay stretched while hardly moving.
void untangle(NamedWorld& world, const Attachments& attachments, const Wearer& wearer) {
    constexpr double largest_error = 0.5, largest_at_rest = 0.05;
    for (const Attachment& each : attachments.list) {
        const rope::Body body = *world.find(each.name);
        const double error = world.length_error(body);
        if (error < largest_at_rest) continue;
        double fastest = 0.0;
        for (std::size_t i = body.first; i < body.first + body.count; ++i)
            fastest = std::max(fastest, glm::length(world.world().velocity(i)));
        if (error < largest_error && fastest > 10.0 * resting_speed) continue;
        const std::vector<dvec3> offsets = made_offsets(each, wearer);
        rope::State state = world.state();
        for (std::size_t i = 0; i < body.count && i < offsets.size(); ++i) {
            state.position[body.first + i] = kept_in(each.frame.apply(offsets[i]));
            state.displacement[body.first + i] = dvec3(0.0);
        }
        world.put(std::move(state));
    }
}

}  // namespace

void carry(Attachments& attachments, const Wearer& wearer, rope::Workspace& workspace) {
    if (attachments.list.empty()) return;
    const std::vector<NamedShape> colliders = colliders_of(wearer, attachments.world->state());
    if (in_place(attachments, wearer, colliders)) return;
    std::vector<Carrier> carriers;
    for (const Attachment& each : attachments.list) carriers.emplace_back(each.frame, frame_of(each, wearer));
    auto world = std::make_shared<NamedWorld>(*attachments.world);
    carry_bodies(*world, attachments, carriers);
    for (std::size_t k = 0; k < carriers.size(); ++k) {
        move_pins(*world, attachments.list[k], carriers[k].to, 0.0);
        attachments.list[k].frame = carriers[k].to;
    }
    // The capsules first move rigidly with the first attachment, in their old pose, then to the new pose.
    for (const rope::Collider& each : attachments.world->state().colliders)
        if (const auto* capsule = std::get_if<rope::Capsule>(&each.shape))
            world->change(
                world->name(each), &rope::World::set_collider,
                rope::Capsule{glm::vec3(carriers.front().point(dvec3(capsule->a))),
                              glm::vec3(carriers.front().point(dvec3(capsule->b))), capsule->radius});
    push_aside(*world, colliders, workspace);
    untangle(*world, attachments, wearer);
    attachments.world = std::move(world);
}

void advance(Attachments& attachments, const Wearer& wearer, rope::Workspace& workspace, double seconds) {
    if (attachments.list.empty() || !(seconds > 0.0)) return;
    const std::vector<NamedShape> colliders = colliders_of(wearer, attachments.world->state());
    if (has_jumped(attachments, wearer, colliders, seconds)) carry(attachments, wearer, workspace);
    auto world = std::make_shared<NamedWorld>(*attachments.world);
    // Whole substeps, so that everything has reached the character's pose when the tick ends.
    const double substeps = std::ceil(seconds / longest_substep - 1e-6);
    rope::Settings settings = world->settings();
    settings.substep = std::clamp(seconds / substeps, rope::min_substep, longest_substep);
    if (settings != world->settings()) world->set_settings(settings);
    for (Attachment& each : attachments.list) {
        each.frame = frame_of(each, wearer);
        move_pins(*world, each, each.frame, seconds);
    }
    move_colliders(*world, colliders, seconds);
    world->advance(seconds, workspace, static_cast<std::uint64_t>(substeps));
    untangle(*world, attachments, wearer);
    attachments.world = std::move(world);
}

bool at_rest(const Attachments& attachments) {
    const rope::World& world = attachments.world->world();
    if (world.size() > 0 && world.settings().wind != glm::vec3(0.0f) && world.settings().gusts > 0.0f)
        return false;
    for (std::size_t i = 0; i < world.size(); ++i)
        if (glm::length(world.velocity(i)) > resting_speed) return false;
    return true;
}

namespace {

void carry_attachments(Workspace& workspace) {
    if (humanoid_part(workspace).attachments.list.empty()) return;
    HumanoidRuntime& runtime = humanoid_runtime(workspace);
    const ShownPose shown = shown_pose(workspace);
    Attachments attachments = humanoid_part(workspace).attachments;
    carry(attachments, wearer_of(humanoid_part(workspace), runtime.solvers, shown), runtime.ropes);
    if (attachments == humanoid_part(workspace).attachments) return;
    workspace.document.edit<HumanoidPart>(humanoid_lab).attachments = std::move(attachments);
}

}  // namespace

Wearer wearer_of(const HumanoidPart& part, Solvers& solvers, const ShownPose& shown) {
    Wearer wearer{*part.loaded, *part.map, solvers.volume(part), shown.placed, part.ik.ground};
    if (!part.ik.hold || !shown.hold) return wearer;
    const humanoid::ObjectPose& at = shown.hold->object;
    const auto placed = [&](const dvec3& point) { return at.position + at.rotation * point; };
    for (const HeldBar& bar : held_shape(*part.ik.hold, part.loaded->height()))
        wearer.held.push_back({placed(bar.from), placed(bar.to), bar.radius});
    return wearer;
}

Command carrying(Command command) {
    if (command.effect != Effect::Edit) return command;
    const bool drags = command.name == "humanoid.target" || command.name == "humanoid.look_at" ||
                       command.name == "humanoid.curve" || command.name == "humanoid.hold_move";
    command.apply = [drags, apply = command.apply](Workspace& workspace, const Arguments& given) {
        apply(workspace, given);
        if (drags && workspace.clock.playing) return;
        carry_springs(workspace);
        carry_attachments(workspace);
    };
    return command;
}

void remake_attachments(Workspace& workspace, double scale) {
    if (humanoid_part(workspace).attachments.list.empty()) return;
    HumanoidRuntime& runtime = humanoid_runtime(workspace);
    const ShownPose shown = shown_pose(workspace);
    const HumanoidPart& part = humanoid_part(workspace);
    Attachments all = remade(part.attachments, wearer_of(part, runtime.solvers, shown), scale);
    workspace.document.edit<HumanoidPart>(humanoid_lab).attachments = std::move(all);
}

}  // namespace tendril::app
