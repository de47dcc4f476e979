#include "tendril/humanoid/feet.hpp"

#include "humanoid/feet.hpp"
#include "humanoid/input.hpp"
#include "rig/checks.hpp"
#include "tendril/elementary.hpp"

namespace tendril::humanoid {
namespace {

using tendril::detail::refused;

constexpr Bone upper_legs[]{Bone::LeftUpperLeg, Bone::RightUpperLeg},
    lower_legs[]{Bone::LeftLowerLeg, Bone::RightLowerLeg};

/// Points spread evenly over a disc (H. Vogel, "A better way to construct the sunflower head", Mathematical
/// Biosciences 44, 1979): no two of them cross an edge at once, in whichever direction the character walks.
template <std::size_t count>
std::array<glm::dvec3, count> disc_of() noexcept {
    constexpr double golden_turn = 0.381966011250105;
    std::array<glm::dvec3, count> disc;
    for (std::size_t i = 0; i < count; ++i) {
        const double r = std::sqrt((static_cast<double>(i) + 0.5) / count);
        const auto [sine, cosine] = math::sine_cosine_of_turns(golden_turn * static_cast<double>(i));
        disc[i] = {r * cosine, 0.0, r * sine};
    }
    return disc;
}

/// The ball in the toes' space: between heel and toe, below the start of the toes; without toes, at 3/4.
glm::dvec3 ball_of(const Sole& sole, std::span<const Placement> rest) noexcept {
    using namespace rig::detail;
    const Placement &foot = rest[sole.foot], &toes = rest[sole.toes];
    const glm::dvec3 heel = foot.apply(sole.heel), way = minus(toes.apply(sole.toe), heel);
    const double along = way.x * way.x + way.z * way.z;
    double part = 0.75;
    if (sole.foot != sole.toes && along > 1e-12)
        part = std::clamp(((toes.position.x - heel.x) * way.x + (toes.position.z - heel.z) * way.z) / along,
                          0.0, 1.0);
    return detail::to_local(toes, minus(plus(heel, times(way, part)), toes.position));
}

}  // namespace

Result check(const FeetOptions& options) noexcept {
    constexpr const char* operation = "feet";
    if (const Result bad = check_fields(operation, options); !bad) return bad;
    if (options.leave_speed < options.enter_speed)
        return refused(operation, "leave_speed", "at least enter_speed", options.leave_speed);
    const Expected<rig::Transform> root = rig::checked(options.root, operation, "root");
    return root ? Result() : root.error();
}

const char* name(FootAlone why) noexcept {
    constexpr const char* texts[] = {"", "there is no ground below the foot", "the ground is too steep",
                                     "the ground is too far above or below",
                                     "the leg cannot reach the ground"};
    const auto index = static_cast<std::size_t>(why);
    return index < std::size(texts) ? texts[index] : "";
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
