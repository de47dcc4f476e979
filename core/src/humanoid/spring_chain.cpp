#include "tendril/humanoid/spring_chain.hpp"

#include <algorithm>
#include <cmath>

#include "humanoid/anatomy.hpp"
#include "humanoid/direction.hpp"
#include "humanoid/input.hpp"
#include "humanoid/limb.hpp"
#include "humanoid/option_ranges.hpp"
#include "rig/checks.hpp"
#include "signal/stepped.hpp"

namespace tendril::humanoid {
namespace {

using namespace rig::detail;
using tendril::detail::refused;

constexpr double shortest = 1e-9;
constexpr double unmoved = 1e-7;  // metres: rounding when the same pose is computed again
constexpr auto no_place = static_cast<std::size_t>(-1);

enum class Time : std::uint8_t { Passes, Stands, Jumps };

/// A node of the chain. Its tip is the mean position of its children.
struct ChainNode {
    std::size_t node = 0;
    std::size_t above = no_place;     // index in the chain of its parent; none for the first
    std::size_t mass = no_place;      // of its tip; none for a node without length
    double length = 0.0;              // from the base to its tip, along the chain at rest
    std::vector<std::size_t> ends{};  // its children
    glm::dvec3 beyond{0.0};           // its tip if it has no children, in its own space
};

/// Deflection of a cantilever under its own weight at `part` (0 to 1) of its length, relative to its tip.
double beam(double part) noexcept {
    return part * part * (6.0 - 4.0 * part + part * part) / 3.0;
}

/// Advances the mass by one step, in which its target moves to `target` at constant velocity. Keeps it within
/// `reach` of the target.
void spring(SpringMass& mass, const glm::dvec3& target, double strength, double damping, double reach,
            double dt) noexcept {
    const glm::dvec3 pace = times(minus(target, mass.target), 1.0 / dt);
    const glm::dvec3 velocity = mass.has_velocity ? minus(mass.velocity, pace) : glm::dvec3(0.0);
    // NaN fails these comparisons, too.
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
    mass = {plus(target, offset.value), plus(offset.velocity, pace), target, true, true};
}

/// A mass's offset from its target, at most `reach`: a drag while paused, or a file, may put it anywhere.
glm::dvec3 swing_of(const SpringMass& mass, double reach) noexcept {
    const glm::dvec3 way = minus(mass.position, mass.target);
    if (!signal::is_input(way)) return glm::dvec3(0.0);
    const double away = length(way);
    return away > reach ? times(way, reach / away) : way;
}

}  // namespace

struct SpringChain::Plan {
    std::size_t nodes = 0;
    std::vector<std::int32_t> path{};    // from the root to the parent of the chain
    std::vector<ChainNode> chain{};      // parents first
    std::vector<std::size_t> turning{};  // the node of each mass
    double longest = 0.0;                // from the base to the farthest tip
    double size = 1.0;                   // scratch: scale of the character's root
    // Scratch for each chain node: in the pose; swinging; the offset of its tip.
    std::vector<Placement> before{}, after{};
    std::vector<glm::dvec3> swing{};

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
              SpringChainState& state, SpringReport& report) const noexcept;
    void turn(std::span<rig::Transform> pose, const Placement& base, const SpringOptions& options,
              const SpringChainState& state, SpringReport& report) noexcept;
    SpringReport run(std::span<rig::Transform> pose, const SpringOptions& options, Time time, double dt,
                     SpringChainState& state) noexcept;
};

Result check(const SpringOptions& options) noexcept {
    constexpr const char* operation = "SpringOptions";
    constexpr detail::OptionRange<SpringOptions> ranges[]{
        {"strength", &SpringOptions::strength, 0.01, 100.0, "from 0.01 to 100 Hz"},
        {"critical_damping", &SpringOptions::critical_damping, 0.0, 10.0, "from 0 to 10"},
        {"weight", &SpringOptions::weight, 0.0, 1.0, "from 0 to 1"},
        {"max_angle", &SpringOptions::max_angle, 0.0, 3.14, "from 0 to 3.14 radians"}};
    if (const Result bad = detail::check_ranges<SpringOptions>(operation, options, ranges); !bad) return bad;
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
    std::vector<std::size_t> place_of(skeleton.size(), no_place);
    for (const std::int32_t each : skeleton.order()) {
        const auto node = static_cast<std::size_t>(each);
        const auto parent = static_cast<std::size_t>(skeleton[node].parent);
        if (node != root && (skeleton[node].parent < 0 || place_of[parent] == no_place)) continue;
        if (const auto bone = detail::bone_of(map, each))
            return refused(operation, "root", "a node with no bone of the body at or below it",
                           std::string_view(std::string(named) + " with " + name(*bone)));
        const ChainNode* const above = node == root ? nullptr : &plan->chain[place_of[parent]];
        const std::span<const std::int32_t> children = skeleton.children(node);
        const glm::dvec3 way = minus(rest[node].position, rest[parent].position);
        // A leaf is as long as the way from its parent to it.
        ChainNode added{.node = node,
                        .above = above == nullptr ? no_place : place_of[parent],
                        .ends = {children.begin(), children.end()},
                        .beyond = detail::seen_from(rest[node], way)};
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
    return SpringChain(std::move(plan));
}

SpringChain::SpringChain(std::unique_ptr<Plan> plan) noexcept : plan_(std::move(plan)) {}
SpringChain::~SpringChain() = default;
SpringChain::SpringChain(SpringChain&&) noexcept = default;
SpringChain& SpringChain::operator=(SpringChain&&) noexcept = default;

std::span<const std::size_t> SpringChain::bones() const noexcept {
    return plan_->turning;
}

void SpringChain::Plan::move(std::span<const rig::Transform> pose, const SpringOptions& options, Time time,
                             double dt, SpringChainState& state, SpringReport& report) const noexcept {
    for (std::size_t i = 0; i < chain.size(); ++i) {
        const ChainNode& each = chain[i];
        if (each.mass == no_place) continue;
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
        if (!mass.has_velocity) continue;
        const glm::dvec3 pace = times(minus(target, was), 1.0 / signal::detail::bounded_dt(dt));
        report.speed = std::max(report.speed, length(minus(mass.velocity, pace)));
    }
}

void SpringChain::Plan::turn(std::span<rig::Transform> pose, const Placement& base,
                             const SpringOptions& options, const SpringChainState& state,
                             SpringReport& report) noexcept {
    for (std::size_t i = 0; i < chain.size(); ++i) {
        const ChainNode& each = chain[i];
        const Placement& above = i == 0 ? base : after[each.above];
        rig::Transform swung = pose[each.node];
        after[i] = above * placement(swung);
        const glm::dvec3 swing_above = i == 0 ? glm::dvec3(0.0) : swing[each.above];
        swing[i] = swing_above;
        if (each.mass == no_place || !state.masses[each.mass].started) continue;
        swing[i] = swing_of(state.masses[each.mass], size * each.length);
        const glm::dvec3 end = tip(each, pose);
        const glm::dvec3 bone = minus(before[i].apply(end), before[i].position);
        const auto rest = direction_of(bone, shortest);
        const auto carried = direction_of(minus(after[i].apply(end), after[i].position), shortest);
        if (!rest || !carried) continue;
        const glm::dvec3 leads = plus(bone, minus(swing[i], swing_above));
        const glm::dvec3 points = direction_of(leads, shortest).value_or(*rest);
        const glm::dvec3 now = detail::turned_toward(*rest, points, options.max_angle);
        report.angle = std::max(report.angle, detail::angle_between(*rest, now));
        detail::turn(swung, above, minimal_rotation(*carried, now));
        after[i] = above * placement(swung);
        if (options.weight > 0.0)
            pose[each.node].rotation = slerp(pose[each.node].rotation, swung.rotation, options.weight);
    }
}

SpringReport SpringChain::Plan::run(std::span<rig::Transform> pose, const SpringOptions& options, Time time,
                                    double dt, SpringChainState& state) noexcept {
    if (pose.size() != nodes || !detail::is_sane(pose) || !check(options)) return {.valid = false};
    const glm::dvec3& scale = options.root.scale;
    size = std::max({std::abs(scale.x), std::abs(scale.y), std::abs(scale.z)});
    Placement base = placement(options.root);
    for (const std::int32_t node : path) base = base * placement(pose[static_cast<std::size_t>(node)]);
    if (!detail::is_moderate(base) || !place_all(base, pose)) return {.valid = false};
    if (state.masses.size() != turning.size()) {
        if (time != Time::Passes) return {};
        state.masses.assign(turning.size(), {});
    }
    SpringReport report;
    move(pose, options, time, dt, state, report);
    turn(pose, base, options, state, report);
    return report;
}

SpringReport SpringChain::step(std::span<rig::Transform> pose, const SpringOptions& options, double dt,
                               SpringChainState& state) noexcept {
    return plan_->run(pose, options, signal::is_step(dt) ? Time::Passes : Time::Stands, dt, state);
}

SpringReport SpringChain::teleport(std::span<rig::Transform> pose, const SpringOptions& options,
                                   SpringChainState& state) noexcept {
    return plan_->run(pose, options, Time::Jumps, 0.0, state);
}

}  // namespace tendril::humanoid
