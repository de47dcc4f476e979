#include "tendril/humanoid/feet.hpp"

#include <initializer_list>

#include "humanoid/feet.hpp"
#include "humanoid/input.hpp"
#include "humanoid/option_ranges.hpp"
#include "rig/checks.hpp"

namespace tendril::humanoid {
namespace {

using tendril::detail::refused;

constexpr Bone upper_legs[]{Bone::LeftUpperLeg, Bone::RightUpperLeg},
    lower_legs[]{Bone::LeftLowerLeg, Bone::RightLowerLeg};

constexpr double small = 1e-6;
constexpr detail::OptionRange<FeetOptions> ranges[]{
    {"weight", &FeetOptions::weight, 0.0, 1.0, "from 0 to 1"},
    {"enter_speed", &FeetOptions::enter_speed, 0.0, 1e3, "from 0 to 1e3 m/s"},
    {"leave_speed", &FeetOptions::leave_speed, 0.0, 1e3, "from 0 to 1e3 m/s"},
    {"low", &FeetOptions::low, 0.0, 1e3, "from 0 to 1e3 m"},
    {"break_distance", &FeetOptions::break_distance, 0.0, 1e3, "from 0 to 1e3 m"},
    {"half_life", &FeetOptions::half_life, small, 10.0, "from 1e-6 to 10 s"},
    {"ray_start", &FeetOptions::ray_start, 0.0, 1e3, "from 0 to 1e3 m"},
    {"max_turn", &FeetOptions::max_turn, 0.0, 1.5, "from 0 to 1.5 radians"},
    {"max_slope", &FeetOptions::max_slope, 0.0, 1.5, "from 0 to 1.5 radians"},
    {"edge", &FeetOptions::edge, 0.0, 0.1, "from 0 to 0.1 m"},
    {"max_step", &FeetOptions::max_step, 0.0, 1e3, "from 0 to 1e3 m"},
    {"root_radius", &FeetOptions::root_radius, 0.0, 1e3, "from 0 to 1e3 m"},
    {"root_half_life", &FeetOptions::root_half_life, small, 10.0, "from 1e-6 to 10 s"},
    {"pelvis_drop", &FeetOptions::pelvis_drop, 0.0, 1e3, "from 0 to 1e3 m"},
    {"pelvis_half_life", &FeetOptions::pelvis_half_life, small, 10.0, "from 1e-6 to 10 s"},
    {"straightest", &FeetOptions::straightest, 0.5, 1.0, "from 0.5 to 1"},
    {"lift_half_life", &FeetOptions::lift_half_life, small, 10.0, "from 1e-6 to 10 s"},
    {"max_speed", &FeetOptions::max_speed, small, 1e3, "from 1e-6 to 1e3 m/s"},
};

/// Points spread evenly over a disc (H. Vogel, "A better way to construct the sunflower head", Mathematical
/// Biosciences 44, 1979): no two of them cross an edge at once, whichever way the character walks.
template <std::size_t count>
std::array<glm::dvec3, count> disc_of() noexcept {
    constexpr double golden_turn = 0.381966011250105;
    std::array<glm::dvec3, count> disc;
    for (std::size_t i = 0; i < count; ++i) {
        const double r = std::sqrt((static_cast<double>(i) + 0.5) / count);
        const auto [sine, cosine] = math::sine_cosine(golden_turn * static_cast<double>(i));
        disc[i] = {r * cosine, 0.0, r * sine};
    }
    return disc;
}

/// In the toes' space: between heel and toe, below where the toes begin; without toes, at three quarters.
glm::dvec3 ball_of(const Sole& sole, std::span<const Placement> rest) noexcept {
    using namespace rig::detail;
    const Placement &foot = rest[sole.foot], &toes = rest[sole.toes];
    const glm::dvec3 heel = foot.apply(sole.heel), way = minus(toes.apply(sole.toe), heel);
    const double along = way.x * way.x + way.z * way.z;
    double part = 0.75;
    if (sole.foot != sole.toes && along > 1e-12)
        part = std::clamp(((toes.position.x - heel.x) * way.x + (toes.position.z - heel.z) * way.z) / along,
                          0.0, 1.0);
    return detail::seen_from(toes, minus(plus(heel, times(way, part)), toes.position));
}

}  // namespace

Result check(const FeetOptions& options) noexcept {
    constexpr const char* operation = "feet";
    if (const Result bad = detail::check_ranges<FeetOptions>(operation, options, ranges); !bad) return bad;
    if (options.leave_speed < options.enter_speed)
        return refused(operation, "leave_speed", "at least enter_speed", options.leave_speed);
    if (options.floor)
        if (const Result bad = rig::detail::check_number(operation, "floor", *options.floor); !bad)
            return bad;
    if (const Result bad = rig::detail::check_vector(operation, "root_velocity", options.root_velocity); !bad)
        return bad;
    const Expected<rig::Transform> root = rig::checked(options.root, operation, "root");
    return root ? Result() : root.error();
}

Result check(const FeetState& state) noexcept {
    constexpr const char* operation = "feet";
    const auto check_all = [&](const tendril::detail::Argument& argument,
                               std::initializer_list<double> numbers) {
        for (const double number : numbers)
            if (const Result bad = rig::detail::check_number(operation, argument, number); !bad) return bad;
        return Result();
    };
    if (const Result bad =
            check_all("the root", {state.hips.x, state.hips.y, state.hips.z, state.base, state.drop,
                                   state.root.value, state.root.velocity, state.root.previous_target,
                                   state.pelvis.value, state.pelvis.velocity, state.pelvis.previous_target});
        !bad)
        return bad;
    for (std::size_t i = 0; i < state.feet.size(); ++i) {
        const FootState& f = state.feet[i];
        if (const Result bad = check_all(
                {"feet", i}, {f.heel.x, f.heel.y,     f.heel.z,     f.toe.x,         f.toe.y,
                              f.toe.z,  f.velocity.x, f.velocity.y, f.velocity.z,    f.lock_x,
                              f.lock_z, f.shift_x,    f.shift_z,    f.offset_x,      f.offset_z,
                              f.lift,   f.goal,       f.ease.value, f.ease.velocity, f.ease.previous_target,
                              f.knee.x, f.knee.y,     f.knee.z,     f.planting});
            !bad)
            return bad;
        if (!(std::abs(rig::detail::dot(f.turn, f.turn) - 1.0) <= 1e-6))
            return refused(operation, {"feet", i, "turn"}, "a unit quaternion", "one of another length");
    }
    return {};
}

const char* name(FootAlone why) noexcept {
    switch (why) {
        case FootAlone::No:
            return "";
        case FootAlone::NoHit:
            return "there is no ground below the foot";
        case FootAlone::TooSteep:
            return "the ground is too steep";
        case FootAlone::TooFar:
            return "the ground is too far above or below";
        case FootAlone::CannotReach:
            return "the leg cannot reach the ground";
    }
    return "";
}

Feet::Feet(std::unique_ptr<Plan> plan) noexcept : plan_(std::move(plan)) {}
Feet::~Feet() = default;
Feet::Feet(Feet&&) noexcept = default;
Feet& Feet::operator=(Feet&&) noexcept = default;

const Soles& Feet::soles() const noexcept {
    return tendril::detail::held_or_empty(plan_, &Plan::soles);
}

Expected<Feet> Feet::make(const Skeleton& skeleton, const BoneMap& map) {
    const Expected<Soles> soles = find_soles(skeleton, map);
    if (!soles) return soles.error();
    return make(skeleton, map, *soles);
}

Expected<Feet> Feet::make(const Skeleton& skeleton, const BoneMap& map, const Soles& soles) {
    if (const Expected<Soles> found = find_soles(skeleton, map); !found) return found.error();
    for (const Sole& sole : soles.feet)
        if (sole.foot >= skeleton.size() || sole.toes >= skeleton.size())
            return refused("Feet", "soles", "nodes of this skeleton", std::max(sole.foot, sole.toes));
    auto plan = std::make_unique<Plan>();
    plan->soles = soles;
    plan->nodes = skeleton.size();
    plan->hips = static_cast<std::size_t>(map[Bone::Hips].node);
    for (std::int32_t node = skeleton[plan->hips].parent; node >= 0;
         node = skeleton[static_cast<std::size_t>(node)].parent)
        plan->above_hips.insert(plan->above_hips.begin(), node);

    std::vector<Placement> rest(skeleton.size());
    place(skeleton, rest_pose(skeleton), rest);
    plan->disc = disc_of<std::tuple_size_v<decltype(plan->disc)>>();
    plan->hips_at_rest = rest[plan->hips].rotation();
    for (std::size_t i = 0; i < 2; ++i) {
        const Sole& sole = soles.feet[i];
        const std::int32_t upper = map[upper_legs[i]].node;
        auto leg =
            detail::Limb::make(skeleton, upper, map[lower_legs[i]].node, static_cast<std::int32_t>(sole.foot),
                               static_cast<std::int32_t>(sole.toes));
        if (!skeleton.is_below(static_cast<std::size_t>(upper), plan->hips))
            return detail::not_below_hips(skeleton, static_cast<std::size_t>(upper), upper_legs[i]);
        if (!leg)
            return refused("Feet", name(upper_legs[i]), "above its own shin, foot and toes, in that order",
                           std::string_view(skeleton[static_cast<std::size_t>(upper)].name));
        plan->leg_direction[i] =
            rig::detail::direction_of(
                rig::detail::minus(rest[sole.foot].position, rest[leg->node(leg->upper)].position), 1e-9)
                .value_or(glm::dvec3(0.0, -1.0, 0.0));
        plan->legs[i] = std::move(*leg);
        plan->balls[i] = ball_of(sole, rest);
    }
    return Feet(std::move(plan));
}

}  // namespace tendril::humanoid
