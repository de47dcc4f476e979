#include "tendril/humanoid/spring_chain.hpp"

#include <algorithm>
#include <cmath>

#include "humanoid/anatomy.hpp"
#include "humanoid/direction.hpp"
#include "humanoid/input.hpp"
#include "humanoid/limb.hpp"
#include "rig/checks.hpp"
#include "signal/stepped.hpp"

namespace tendril::humanoid {
namespace {

using namespace rig::detail;
using tendril::detail::refused;

constexpr double shortest = 1e-9;
constexpr double unmoved = 1e-7;  // metres: rounding when a pose is recomputed
constexpr auto no_index = static_cast<std::size_t>(-1);

enum class Time : std::uint8_t { Passes, Stands, Jumps };

/// A node of the chain. Its tip is the mean position of its children.
struct ChainNode {
    std::size_t node = 0;
    std::size_t above = no_index;     // its parent's index in the chain; none for the first
    std::size_t mass = no_index;      // index of its tip's mass; none for a node without length
    double length = 0.0;              // from the chain's base to its tip, at rest
    std::vector<std::size_t> ends{};  // its children
    glm::dvec3 beyond{0.0};           // its tip in its own space, if it has no children
};

/// Deflection of a cantilever under its own weight at `part` (0 to 1) of its length, relative to its tip.
double beam(double part) noexcept {
    return part * part * (6.0 - 4.0 * part + part * part) / 3.0;
}

/// Advances the mass by one step, during which its target moves to `target` at constant velocity. Keeps it
/// within `reach` of the target.
void spring(SpringMass& mass, const glm::dvec3& target, double strength, double damping, double reach,
            double dt) noexcept {
    const glm::dvec3 pace = times(minus(target, mass.target), 1.0 / dt);
    const glm::dvec3 velocity = mass.has_velocity ? minus(mass.velocity, pace) : glm::dvec3(0.0);
    // NaN fails these comparisons too.
    const bool sound = length(pace) <= SpringChain::max_speed && length(velocity) <= SpringChain::max_speed &&
                       signal::is_input(minus(mass.position, mass.target));
    if (!sound) {
        mass = {.position = target, .target = target, .started = true};
        return;
    }
    signal::SpringState<glm::dvec3> offset{.value = minus(mass.position, mass.target),
                                           .velocity = velocity,
                                           .previous_target = {},
                                           .started = true};
    signal::step({.strength = strength, .critical_damping = damping}, offset, glm::dvec3(0.0), dt);
    const double away = length(offset.value);
    if (away > reach) {
        const glm::dvec3 out = times(offset.value, 1.0 / away);
        offset.value = times(out, reach);
        offset.velocity = minus(offset.velocity, times(out, std::max(0.0, dot(offset.velocity, out))));
    }
    mass = {.position = plus(target, offset.value),
            .velocity = plus(offset.velocity, pace),
            .target = target,
            .started = true,
            .has_velocity = true};
}

/// A mass's offset from its target, clamped to `reach`: a drag while paused, or a file, may set it anywhere.
glm::dvec3 clamped_offset(const SpringMass& mass, double reach) noexcept {
    const glm::dvec3 way = minus(mass.position, mass.target);
    if (!signal::is_input(way)) return glm::dvec3(0.0);
    const double away = length(way);
    return away > reach ? times(way, reach / away) : way;
}

/// The direction closest to `points` in which the tip of a bone of that length is outside all colliders. In
/// the plane of bone and collider the law of cosines gives the angle at the base. Overlapping colliders, and
/// the other end of a capsule, need more rounds.
glm::dvec3 push_out(std::span<const PlacedCapsule> colliders, double margin, const glm::dvec3& base,
                    double bone, glm::dvec3 points) noexcept {
    constexpr int rounds = 8;
    constexpr double tolerance = 1.0 - 1e-9;
    bool moved = true;
    for (int i = 0; i < rounds && moved; ++i) {
        moved = false;
        for (const PlacedCapsule& each : colliders) {
            const glm::dvec3 tip = plus(base, times(points, bone));
            const glm::dvec3 axis = minus(each.to, each.from);
            const double squared = dot(axis, axis),
                         part = squared > 0.0 ? dot(minus(tip, each.from), axis) / squared : 0.0;
            const glm::dvec3 centre = plus(each.from, times(axis, std::clamp(part, 0.0, 1.0)));
            const double radius = each.radius + margin;
            const glm::dvec3 way = minus(tip, centre);
            if (dot(way, way) >= radius * radius * tolerance) continue;
            const auto inwards = direction_of(minus(centre, base), shortest);
            if (!inwards) continue;
            const double away = length(minus(centre, base));
            const double cosine = std::max(
                -1.0, std::min(1.0, (bone * bone + away * away - radius * radius) / (2.0 * bone * away)));
            const glm::dvec3 aside =
                direction_of(across(points, *inwards), shortest).value_or(perpendicular(*inwards));
            points = plus(times(*inwards, cosine), times(aside, std::sqrt(1.0 - cosine * cosine)));
            moved = true;
        }
    }
    return points;
}
/// A tip's velocity after a collider turned its bone: without the parts along the bone and back inside.
glm::dvec3 deflected(const glm::dvec3& velocity, const glm::dvec3& inside, const glm::dvec3& free) noexcept {
    const glm::dvec3 left = across(velocity, free);
    const auto out = direction_of(across(minus(free, inside), free), 0.0);
    return out ? minus(left, times(*out, std::min(0.0, dot(left, *out)))) : left;
}
Result check(std::span<const PlacedCapsule> colliders) noexcept {
    for (std::size_t i = 0; i < colliders.size(); ++i) {
        const PlacedCapsule& each = colliders[i];
        if (!detail::is_within(each.from) || !detail::is_within(each.to) ||
            !(each.radius >= 0.0 && each.radius <= static_cast<double>(max_magnitude)))
            return refused("step", {"colliders", i}, "finite, at most 1e9, with a radius of at least 0",
                           "one that is not");
    }
    return {};
}

}  // namespace

struct SpringChain::Plan {
    std::size_t nodes = 0;
    std::vector<std::int32_t> path{};    // from the root to the parent of the chain
    std::vector<ChainNode> chain{};      // parents first
    std::vector<std::size_t> turning{};  // the node of each mass
    double longest = 0.0;                // from the base to the farthest tip
    double size = 1.0;                   // scratch: scale of the character's root
    // Scratch for each chain node: in the pose; swinging; the offset of its tip; its target's velocity.
    std::vector<Placement> before{}, after{};
    std::vector<glm::dvec3> swing{}, pace{};

    glm::dvec3 tip(const ChainNode& each, std::span<const rig::Transform> pose) const noexcept {
        if (each.ends.empty()) return each.beyond;
        glm::dvec3 sum(0.0);
        for (const std::size_t end : each.ends) sum = plus(sum, pose[end].translation);
        return times(sum, 1.0 / static_cast<double>(each.ends.size()));
    }
    double strength_of(const ChainNode& each, const SpringOptions& options) const noexcept {
        return std::min(options.strength / std::sqrt(beam(each.length / longest)), signal::max_strength);
    }
    bool place_all(const Placement& base, std::span<const rig::Transform> pose) noexcept {
        for (std::size_t i = 0; i < chain.size(); ++i) {
            const Placement& hangs_on = i == 0 ? base : before[chain[i].above];
            before[i] = hangs_on * placement(pose[chain[i].node]);
            if (!detail::is_moderate(before[i])) return false;
        }
        return true;
    }
    void move(std::span<const rig::Transform> pose, const SpringOptions& options, Time time, double dt,
              SpringChainState& state) noexcept;
    void turn(std::span<rig::Transform> pose, const Placement& base, const SpringOptions& options, Time time,
              SpringChainState& state, std::span<const PlacedCapsule> colliders,
              SpringReport& report) noexcept;
    SpringReport run(std::span<rig::Transform> pose, const SpringOptions& options, Time time, double dt,
                     SpringChainState& state, std::span<const PlacedCapsule> colliders) noexcept;
};

Result check(const SpringOptions& options) noexcept {
    constexpr const char* operation = "SpringOptions";
    if (const Result bad = check_fields(operation, options); !bad) return bad;
    const Expected<rig::Transform> root = rig::checked(options.root, operation, "root");
    return root ? Result() : root.error();
}

Expected<SpringChain> SpringChain::make(const Skeleton& skeleton, const BoneMap& map, std::size_t root) {
    constexpr const char* operation = "SpringChain";
    if (const Result bad = detail::check_map(operation, map, skeleton); !bad) return bad;
    if (root >= skeleton.size())
        return tendril::detail::refused_index(operation, root, skeleton.size(), "the skeleton", "nodes");
    const std::string_view named = skeleton[root].name;
    if (skeleton[root].parent < 0) return refused(operation, "root", "a node with a parent", named);
    auto plan = std::make_unique<Plan>();
    plan->nodes = skeleton.size();
    for (std::int32_t node = skeleton[root].parent; node >= 0;
         node = skeleton[static_cast<std::size_t>(node)].parent)
        plan->path.insert(plan->path.begin(), node);

    const std::vector<rig::Transform> pose = rest_pose(skeleton);
    std::vector<Placement> rest(skeleton.size());
    place(skeleton, pose, rest);
    std::vector<std::size_t> place_of(skeleton.size(), no_index);
    for (const std::int32_t each : skeleton.order()) {
        const auto node = static_cast<std::size_t>(each);
        const auto parent = static_cast<std::size_t>(skeleton[node].parent);
        if (node != root && (skeleton[node].parent < 0 || place_of[parent] == no_index)) continue;
        if (const auto bone = detail::bone_of(map, each))
            return refused(operation, "root", "a node with no bone of the body at or below it",
                           std::string_view(std::string(named) + " with " + name(*bone)));
        const ChainNode* const above = node == root ? nullptr : &plan->chain[place_of[parent]];
        const std::span<const std::int32_t> children = skeleton.children(node);
        const glm::dvec3 way = minus(rest[node].position, rest[parent].position);
        // A leaf's length is its distance from its parent.
        ChainNode added{.node = node,
                        .above = above == nullptr ? no_index : place_of[parent],
                        .ends = {children.begin(), children.end()},
                        .beyond = detail::to_local(rest[node], way)};
        if (above != nullptr) added.length = above->length;
        const double reach = length(minus(rest[node].apply(plan->tip(added, pose)), rest[node].position));
        if (reach > shortest) {
            added.mass = plan->turning.size();
            added.length += reach;
            plan->longest = std::max(plan->longest, added.length);
            plan->turning.push_back(node);
        }
        place_of[node] = plan->chain.size();
        plan->chain.push_back(std::move(added));
    }
    if (plan->turning.empty())
        return refused(operation, "root", "the start of a chain that has a length", named);
    plan->before.resize(plan->chain.size());
    plan->after.resize(plan->chain.size());
    plan->swing.resize(plan->chain.size());
    plan->pace.resize(plan->chain.size());
    return SpringChain(std::move(plan));
}

SpringChain::SpringChain(std::unique_ptr<Plan> plan) noexcept : plan_(std::move(plan)) {}
SpringChain::~SpringChain() = default;
SpringChain::SpringChain(SpringChain&&) noexcept = default;
SpringChain& SpringChain::operator=(SpringChain&&) noexcept = default;

std::span<const std::size_t> SpringChain::bones() const noexcept {
    return tendril::detail::held_or_empty(plan_, &Plan::turning);
}

void SpringChain::Plan::move(std::span<const rig::Transform> pose, const SpringOptions& options, Time time,
                             double dt, SpringChainState& state) noexcept {
    for (std::size_t i = 0; i < chain.size(); ++i) {
        const ChainNode& each = chain[i];
        if (each.mass == no_index) continue;
        SpringMass& mass = state.masses[each.mass];
        const glm::dvec3 target = before[i].apply(tip(each, pose));
        const bool jumped = length(minus(target, mass.target)) > unmoved;
        if (time == Time::Jumps && mass.started && jumped) {
            mass.position = plus(target, minus(mass.position, mass.target));
            mass.target = target;
            mass.has_velocity = false;
        }
        if (time != Time::Passes) continue;
        const glm::dvec3 was = mass.target;
        if (mass.started)
            spring(mass, target, strength_of(each, options), options.critical_damping, size * each.length,
                   signal::detail::bounded_dt(dt));
        else
            mass = {.position = target, .target = target, .started = true};
        pace[i] = times(minus(target, was), 1.0 / signal::detail::bounded_dt(dt));
    }
}

void SpringChain::Plan::turn(std::span<rig::Transform> pose, const Placement& base,
                             const SpringOptions& options, Time time, SpringChainState& state,
                             std::span<const PlacedCapsule> colliders, SpringReport& report) noexcept {
    for (std::size_t i = 0; i < chain.size(); ++i) {
        const ChainNode& each = chain[i];
        const Placement& above = i == 0 ? base : after[each.above];
        rig::Transform swung = pose[each.node];
        after[i] = above * placement(swung);
        const glm::dvec3 swing_above = i == 0 ? glm::dvec3(0.0) : swing[each.above];
        swing[i] = swing_above;
        if (each.mass == no_index || !state.masses[each.mass].started) continue;
        swing[i] = clamped_offset(state.masses[each.mass], size * each.length);
        const glm::dvec3 end = tip(each, pose);
        const glm::dvec3 bone = minus(before[i].apply(end), before[i].position);
        const auto rest = direction_of(bone, shortest);
        const auto carried = direction_of(minus(after[i].apply(end), after[i].position), shortest);
        if (!rest || !carried) continue;
        const glm::dvec3 leads = plus(bone, minus(swing[i], swing_above));
        const glm::dvec3 points = direction_of(leads, shortest).value_or(*rest);
        glm::dvec3 now = detail::turned_toward(*rest, points, options.max_angle);
        if (!colliders.empty()) {
            const double reach = length(minus(after[i].apply(end), after[i].position));
            const glm::dvec3 free =
                push_out(colliders, size * options.hit_radius, after[i].position, reach, now);
            if (time == Time::Passes && free != now) {
                SpringMass& mass = state.masses[each.mass];
                swing[i] = plus(swing_above, minus(times(free, length(bone)), bone));
                mass.position = plus(mass.target, swing[i]);
                if (mass.has_velocity)
                    mass.velocity = plus(pace[i], deflected(minus(mass.velocity, pace[i]), now, free));
                mass.held = true;
            }
            now = free;
        }
        report.angle = std::max(report.angle, detail::angle_between(*rest, now));
        detail::turn(swung, above, minimal_rotation(*carried, now));
        after[i] = above * placement(swung);
        if (options.weight > 0.0)
            pose[each.node].rotation = slerp(pose[each.node].rotation, swung.rotation, options.weight);
    }
}

SpringReport SpringChain::Plan::run(std::span<rig::Transform> pose, const SpringOptions& options, Time time,
                                    double dt, SpringChainState& state,
                                    std::span<const PlacedCapsule> colliders) noexcept {
    if (const Result bad = detail::check_pose("step", pose, nodes); !bad) return {.accepted = bad};
    if (const Result bad = check(options); !bad) return {.accepted = bad};
    if (const Result bad = check(colliders); !bad) return {.accepted = bad};
    const glm::dvec3& scale = options.root.scale;
    size = std::max({std::abs(scale.x), std::abs(scale.y), std::abs(scale.z)});
    Placement base = placement(options.root);
    for (const std::int32_t node : path) base = base * placement(pose[static_cast<std::size_t>(node)]);
    if (!detail::is_moderate(base) || !place_all(base, pose))
        return {.accepted = detail::refused_bones("step")};
    if (state.masses.size() != turning.size()) {
        if (time != Time::Passes) return {};
        state.masses.assign(turning.size(), {});
    }
    SpringReport report;
    move(pose, options, time, dt, state);
    turn(pose, base, options, time, state, colliders, report);
    for (std::size_t i = 0; time == Time::Passes && i < chain.size(); ++i)
        if (chain[i].mass != no_index && state.masses[chain[i].mass].has_velocity)
            report.speed =
                std::max(report.speed, length(minus(state.masses[chain[i].mass].velocity, pace[i])));
    return report;
}

SpringReport SpringChain::step(std::span<rig::Transform> pose, const SpringOptions& options, double dt,
                               SpringChainState& state, std::span<const PlacedCapsule> colliders) noexcept {
    if (!plan_) return {.accepted = tendril::detail::moved_from("step", "spring_chain")};
    return plan_->run(pose, options, signal::is_step(dt) ? Time::Passes : Time::Stands, dt, state, colliders);
}

SpringReport SpringChain::teleport(std::span<rig::Transform> pose, const SpringOptions& options,
                                   SpringChainState& state) noexcept {
    if (!plan_) return {.accepted = tendril::detail::moved_from("teleport", "spring_chain")};
    return plan_->run(pose, options, Time::Jumps, 0.0, state, {});
}

}  // namespace tendril::humanoid
