#include "tendril/humanoid/bent_chain.hpp"

#include <algorithm>

#include "humanoid/input.hpp"
#include "humanoid/limb.hpp"
#include "ik/curve/path.hpp"
#include "ik/solve/validate.hpp"
#include "math/checks.hpp"
#include "math/rotation.hpp"

namespace tendril::humanoid {
namespace {

using namespace rig::detail;
using math::narrow;
using math::wide;
using tendril::detail::refused;

constexpr double shortest_bone = 1e-9;

/// The parent of a chain in the space of the control points, where it has no rotation.
Placement seen_from_points(const Placement& above) noexcept {
    return placement(rig::Transform{.rotation = conjugate(above.rotation())}) *
           Placement{above.axes, glm::dvec3(0.0)};
}

}  // namespace

struct BentChain::Plan {
    std::size_t count = 0;             // number of the skeleton's nodes
    std::vector<std::int32_t> path{};  // from the root to the parent of the chain
    std::vector<std::size_t> nodes{};
    // Per bone at rest, in the space of the points.
    std::vector<glm::dvec3> directions{};
    std::vector<glm::dquat> rotations{};
    // Scratch. Joints and points are relative to the first joint.
    std::vector<Placement> placed{};
    std::vector<glm::vec3> joints{}, points{}, rest{};
    std::vector<float> lengths{};
    ik::State state{};

    std::size_t bones() const noexcept { return nodes.size() - 1; }
    Placement parent(std::span<const rig::Transform> pose) const noexcept {
        Placement at;
        for (const std::int32_t node : path) at = at * placement(pose[static_cast<std::size_t>(node)]);
        return at;
    }
    /// Places the chain's nodes in the space of the points. False if a number is too large.
    bool place_nodes(Placement at, std::span<const rig::Transform> pose,
                     std::span<Placement> to) const noexcept {
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            at = to[i] = at * placement(pose[nodes[i]]);
            if (!detail::is_moderate(at)) return false;
        }
        return true;
    }
    bool load_rest(const Skeleton& skeleton);
    ik::CurveReport bend(std::span<rig::Transform> pose, std::span<const glm::vec3> points,
                         const ik::CurveOptions& options, ik::CurveMemory& memory) noexcept;
    void pose_nodes(std::span<rig::Transform> pose, Placement at, const glm::dquat& swing,
                    const ik::CurveOptions& options, double factor) noexcept;
};

/// False if the chain has no length. A bone without length points like the previous one, or else the next.
bool BentChain::Plan::load_rest(const Skeleton& skeleton) {
    const std::vector<rig::Transform> pose = rest_pose(skeleton);
    if (!place_nodes(seen_from_points(parent(pose)), pose, placed)) return false;
    std::optional<glm::dvec3> last;
    for (std::size_t i = 0; i < bones(); ++i) {
        const glm::dvec3 way = minus(placed[i + 1].position, placed[i].position);
        if (const auto direction = direction_of(way, shortest_bone)) {
            if (!last) std::ranges::fill(directions, *direction);
            last = direction;
        }
        if (last) directions[i] = *last;
        rotations[i] = placed[i].rotation();
    }
    return last.has_value();
}

Expected<BentChain> BentChain::make(const Skeleton& skeleton, std::size_t first, std::size_t last) {
    constexpr const char* operation = "BentChain";
    for (const std::size_t node : {first, last})
        if (node >= skeleton.size())
            return tendril::detail::refused_index(operation, node, skeleton.size(), "the skeleton", "nodes");
    if (first == last || !skeleton.is_below(last, first))
        return refused(operation, "last", "a node below first", std::string_view(skeleton[last].name));
    auto plan = std::make_unique<Plan>();
    plan->count = skeleton.size();
    for (std::size_t node = last; node != first; node = static_cast<std::size_t>(skeleton[node].parent))
        plan->nodes.push_back(node);
    plan->nodes.push_back(first);
    std::ranges::reverse(plan->nodes);
    for (std::int32_t node = skeleton[first].parent; node >= 0;
         node = skeleton[static_cast<std::size_t>(node)].parent)
        plan->path.push_back(node);
    std::ranges::reverse(plan->path);

    const std::size_t bones = plan->bones();
    plan->directions.resize(bones);
    plan->rotations.resize(bones);
    plan->placed.resize(bones + 1);
    plan->joints.resize(bones + 1);
    plan->points.resize(max_points + 1);
    plan->rest.resize(bones);
    plan->lengths.resize(bones);
    plan->state = ik::State(bones);
    if (!plan->load_rest(skeleton))
        return refused(operation, "first", "the start of a chain that has a length",
                       std::string_view(skeleton[first].name));
    return BentChain(std::move(plan));
}

BentChain::BentChain(std::unique_ptr<Plan> plan) noexcept : plan_(std::move(plan)) {}
BentChain::~BentChain() = default;
BentChain::BentChain(BentChain&&) noexcept = default;
BentChain& BentChain::operator=(BentChain&&) noexcept = default;

std::span<const std::size_t> BentChain::nodes() const noexcept {
    return tendril::detail::held_or_empty(plan_, &Plan::nodes);
}

Placement BentChain::space(std::span<const Placement> placed) const noexcept {
    if (!plan_ || plan_->path.empty()) return {};
    const Placement& at = placed[static_cast<std::size_t>(plan_->path.back())];
    return placement(rig::Transform{.translation = at.position, .rotation = at.rotation()});
}

std::vector<glm::vec3> BentChain::points_through(std::span<const rig::Transform> pose,
                                                 std::size_t count) const {
    std::vector<glm::vec3> points;
    std::vector<Placement> placed(nodes().size());
    if (!plan_ || pose.size() != plan_->count || !detail::is_sane(pose) ||
        !plan_->place_nodes(seen_from_points(plan_->parent(pose)), pose, placed))
        return points;
    count = std::min(std::min(count, max_points), bones());
    for (std::size_t i = 1; i <= count; ++i) points.push_back(narrow(placed[i * bones() / count].position));
    return points;
}

ik::CurveReport BentChain::Plan::bend(std::span<rig::Transform> pose, std::span<const glm::vec3> given,
                                      const ik::CurveOptions& options, ik::CurveMemory& memory) noexcept {
    const auto no = [](const Result& why) { return ik::detail::refusal<ik::CurveReport>(why); };
    if (const Result bad = detail::check_pose("bend", pose, count); !bad) return no(bad);
    static_assert(max_points == 256);
    if (given.empty() || given.size() > max_points)
        return no(refused("bend", "points", "1 to 256 in number", given.size()));
    for (std::size_t i = 0; i < given.size(); ++i)
        if (const Result bad = tendril::detail::check_point("bend", {"points", i}, given[i]); !bad)
            return no(bad);
    const Placement above = parent(pose);
    if (!detail::is_moderate(above)) return no(detail::refused_bones("bend"));
    const Placement at = seen_from_points(above);
    if (!place_nodes(at, pose, placed)) return no(detail::refused_bones("bend"));

    double reach = 0.0;
    const glm::dvec3 root = placed[0].position;
    joints[0] = glm::vec3(0.0f);
    for (std::size_t i = 0; i < bones(); ++i) {
        const double bone = length(minus(placed[i + 1].position, placed[i].position));
        joints[i + 1] = narrow(minus(placed[i + 1].position, root));
        lengths[i] = static_cast<float>(bone);
        reach += bone;
    }
    // A point meant to be on the first joint may be off by rounding; it must not set a direction.
    const double nothing = 1e-6 * reach + 1e-7 * length(root);
    const std::span<glm::vec3> curve = std::span(points).first(given.size() + 1);
    curve[0] = glm::vec3(0.0f);
    for (std::size_t i = 0; i < given.size(); ++i) {
        const glm::dvec3 way = minus(wide(given[i]), root);
        curve[i + 1] = length(way) > nothing ? narrow(way) : glm::vec3(0.0f);
    }
    ik::detail::Path along(curve, options.kind, directions[0]);
    const glm::dquat swing = minimal_rotation(directions[0], along.sample({}, directions[0]).tangent);
    for (std::size_t i = 0; i < bones(); ++i) {
        const glm::dquat straight = math::compose(swing, rotations[i]);
        rest[i] = narrow(rotated(swing, directions[i]));
        state.rotations[i] = narrow(math::compose(placed[i].rotation(), conjugate(straight)));
    }
    ik::CurveOptions upright = options;
    upright.up = narrow(rotated(swing, perpendicular(directions[0])));
    ik::CurveReport report = ik::place_along(curve, {lengths, rest}, joints, state, memory, upright);
    // A tip on the last control point may be past it by rounding.
    if (report.status == ik::Status::Converged) report.bones_past_end = 0, report.past_end = 0.0f;
    if (report.accepted) pose_nodes(pose, at, swing, options, static_cast<double>(report.factor));
    return report;
}

/// Turns the nodes as the solve turned the bones, then each by the shortest arc to its bone's required
/// direction: a pose may move a node within its parent, and a scale may shear it.
void BentChain::Plan::pose_nodes(std::span<rig::Transform> pose, Placement at, const glm::dquat& swing,
                                 const ik::CurveOptions& options, double factor) noexcept {
    bool moved = false;  // bones before the first one with a weight keep their bits
    for (std::size_t i = 0; i < bones(); ++i) {
        rig::Transform& local = pose[nodes[i]];
        glm::dvec3& end = pose[nodes[i + 1]].translation;
        const double weight =
            static_cast<double>(options.weight * (options.weights.empty() ? 1.0f : options.weights[i]));
        moved = moved || weight > 0.0;
        if (moved) {
            const glm::dquat turned =
                math::compose(math::compose(wide(state.rotations[i]), swing), rotations[i]);
            detail::turn(local, at, math::compose(turned, conjugate((at * placement(local)).rotation())));
            const Placement now = at * placement(local);
            const auto is = direction_of(minus(now.apply(end), now.position), shortest_bone);
            const auto target = direction_of(minus(wide(joints[i + 1]), wide(joints[i])), shortest_bone);
            if (is && target) detail::turn(local, at, minimal_rotation(*is, *target));
            if (factor != 1.0) end = times(end, 1.0 + weight * (factor - 1.0));
        }
        at = at * placement(local);
    }
}

ik::CurveReport BentChain::bend(std::span<rig::Transform> pose, std::span<const glm::vec3> points,
                                const ik::CurveOptions& options, ik::CurveMemory& memory) noexcept {
    if (!plan_) return ik::detail::refusal<ik::CurveReport>(tendril::detail::moved_from("bend", "chain"));
    return plan_->bend(pose, points, options, memory);
}

ik::CurveReport BentChain::bend(std::span<rig::Transform> pose, std::span<const glm::vec3> points,
                                const ik::CurveOptions& options) noexcept {
    ik::CurveMemory none;
    return bend(pose, points, options, none);
}

}  // namespace tendril::humanoid
