#include "app/labs/humanoid/curves/curves.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "app/fields/fields.hpp"
#include "app/io/json_complete.hpp"
#include "app/labs/humanoid/humanoid_part.hpp"
#include "app/labs/humanoid/ik/shown_pose.hpp"
#include "app/labs/humanoid/ik/solvers.hpp"

namespace tendril::app {
namespace {

using humanoid::Bone;

/// Total length of the bones from `first` to `last` at rest, metres; negative if `last` is not below.
double length_between(const HumanoidPart& part, std::size_t first, std::size_t last) {
    double sum = 0.0;
    for (std::size_t at = last; at != first;) {
        const std::int32_t parent = part.skeleton()[at].parent;
        if (parent < 0) return -1.0;
        const auto above = static_cast<std::size_t>(parent);
        sum += glm::distance(part.loaded->rest[at].position, part.loaded->rest[above].position);
        at = above;
    }
    return sum;
}

/// For each node, the child that begins the longest path down, and the path's length.
struct LongestWays {
    std::vector<std::int32_t> child;
    std::vector<double> length;

    explicit LongestWays(const HumanoidPart& part)
        : child(part.skeleton().size(), -1), length(part.skeleton().size()) {
        const std::vector<std::int32_t>& order = part.skeleton().order();
        for (std::size_t i = order.size(); i-- > 0;) {
            const auto node = static_cast<std::size_t>(order[i]);
            for (const std::int32_t each : part.skeleton().children(node)) {
                const auto below = static_cast<std::size_t>(each);
                const double way = length[below] + glm::distance(part.loaded->rest[below].position,
                                                                 part.loaded->rest[node].position);
                if (child[node] < 0 || way > length[node]) child[node] = each, length[node] = way;
            }
        }
    }
    std::size_t end(std::size_t node) const {
        while (child[node] >= 0) node = static_cast<std::size_t>(child[node]);
        return node;
    }
};

/// For each node, whether it and all below it are outside the body, and not on a hand or a foot.
std::vector<bool> beside_body(const HumanoidPart& part) {
    const humanoid::Skeleton& skeleton = part.skeleton();
    std::vector<bool> beside(skeleton.size(), true);
    for (const humanoid::BoneMatch& match : part.map->bones)
        for (std::int32_t at = match.node; at >= 0; at = skeleton[static_cast<std::size_t>(at)].parent)
            beside[static_cast<std::size_t>(at)] = false;
    for (const Bone bone : {Bone::LeftHand, Bone::RightHand, Bone::LeftFoot, Bone::RightFoot})
        if (const auto node = part.node_of(bone))
            for (std::size_t i = 0; i < skeleton.size(); ++i)
                if (skeleton.is_below(i, *node)) beside[i] = false;
    return beside;
}

std::size_t bones_between(const humanoid::Skeleton& skeleton, const BoneChain& chain) {
    std::size_t bones = 0;
    for (std::size_t at = chain.last; at != chain.first; at = static_cast<std::size_t>(skeleton[at].parent))
        ++bones;
    return bones;
}

/// A node that both chains turn; empty if there is none.
std::optional<std::size_t> shared_node(const humanoid::Skeleton& skeleton, const BoneChain& a,
                                       const BoneChain& b) {
    for (std::size_t at = a.last; at != a.first;) {
        at = static_cast<std::size_t>(skeleton[at].parent);
        if (at != b.last && skeleton.is_below(at, b.first) && skeleton.is_below(b.last, at)) return at;
    }
    return std::nullopt;
}

// Pick ids: a block for each curve, its control points first, then its strokes.
constexpr PickId first_block = 2'000'000, block = 10'000;
/// The end of a curve at the head is on the head's ball: draw it over that.
constexpr std::int16_t over_effectors = 6;
constexpr PickId strokes_from = static_cast<PickId>(max_bone_curve_points);

PickId block_of(std::size_t curve) {
    return first_block + block * static_cast<PickId>(curve);
}

void emit_curve_points(const BoneCurve& curve, const std::vector<glm::vec3>& points, bool dragged,
                       Emit& emit) {
    const ArgumentList arguments{{"first", curve.first}, {"points", SharedJson(points_json(points))}};
    if (dragged)
        emit.continuously("humanoid.curve", arguments);
    else
        emit("humanoid.curve", arguments);
}

/// Converts to the space of the curve's points.
glm::vec3 into_space(const humanoid::Placement& space, glm::vec3 at) {
    return glm::vec3(glm::conjugate(space.rotation()) * (glm::dvec3(at) - space.position));
}

}  // namespace

std::optional<BoneChain> chain_of(const HumanoidPart& part, const BoneCurve& curve) {
    const auto first = part.skeleton().find(curve.first), last = part.skeleton().find(curve.last);
    if (!first || !last || *first == *last || !part.skeleton().is_below(*last, *first)) return std::nullopt;
    return BoneChain{*first, *last};
}

std::vector<BoneChain> bendable_chains(const HumanoidPart& part) {
    constexpr std::size_t fewest_bones = 2;
    const humanoid::Skeleton& skeleton = part.skeleton();
    std::vector<BoneChain> chains;
    const auto add = [&](std::size_t first, std::size_t last) {
        if (length_between(part, first, last) > 1e-6 &&
            bones_between(skeleton, {first, last}) >= fewest_bones)
            chains.push_back({first, last});
    };
    const auto spine = part.node_of(Bone::Spine), neck = part.node_of(Bone::Neck),
               head = part.node_of(Bone::Head);
    if (spine && neck && skeleton.is_below(*neck, *spine)) add(*spine, *neck);
    if (spine && head && skeleton.is_below(*head, *spine)) add(*spine, *head);
    const std::vector<bool> beside = beside_body(part);
    const LongestWays ways(part);
    for (const std::int32_t each : skeleton.order()) {
        const auto node = static_cast<std::size_t>(each);
        const std::int32_t parent = skeleton[node].parent;
        if (!beside[node] || parent < 0) continue;
        const auto above = static_cast<std::size_t>(parent);
        const bool goes_on = beside[above] && skeleton[above].parent >= 0 && ways.child[above] == each;
        if (!goes_on) add(node, ways.end(node));
    }
    return chains;
}

std::string title_of(const HumanoidPart& part, const BoneChain& chain) {
    return part.skeleton()[chain.first].name + " to " + part.skeleton()[chain.last].name;
}

std::size_t end_of_chain(const HumanoidPart& part, std::size_t first) {
    for (const BoneChain& each : bendable_chains(part))
        if (each.first == first) return each.last;
    return LongestWays(part).end(first);
}

std::optional<std::size_t> curve_from(const HumanoidPart& part, std::size_t first) {
    for (std::size_t i = 0; i < part.curves.size(); ++i)
        if (part.curves[i].first == part.skeleton()[first].name) return i;
    return std::nullopt;
}

std::optional<std::size_t> curve_through(const HumanoidPart& part, std::size_t node) {
    for (std::size_t i = 0; i < part.curves.size(); ++i)
        if (const auto chain = chain_of(part, part.curves[i]); chain &&
                                                               part.skeleton().is_below(node, chain->first) &&
                                                               part.skeleton().is_below(chain->last, node))
            return i;
    return std::nullopt;
}

std::string why_no_curve(const HumanoidPart& part, const BoneChain& chain) {
    for (const BoneCurve& each : part.curves) {
        const auto other = chain_of(part, each);
        if (!other || other->first == chain.first) continue;
        if (const auto node = shared_node(part.skeleton(), chain, *other))
            return part.skeleton()[*node].name + " already bends along the curve from " + each.first +
                   " to " + each.last;
    }
    return {};
}

std::vector<ik::CurveReport> bend(const HumanoidPart& part, const BentChains& chains,
                                  std::vector<rig::Transform>& pose) {
    std::vector<ik::CurveReport> reports(chains.size());
    for (std::size_t i = 0; i < chains.size(); ++i) {
        if (chains[i] == nullptr) continue;
        const CurveShape& shape = part.curves[i].shape;
        const std::vector<float> weights = curve_weights(shape, chains[i]->bones());
        reports[i] = chains[i]->bend(pose, shape.points, shape.with(weights));
    }
    return reports;
}

std::optional<std::size_t> jump_between(const HumanoidPart& part, humanoid::BentChain& chain,
                                        const CurveShape& before, const std::vector<glm::vec3>& points) {
    const std::vector<float> weights = curve_weights(before, chain.bones());
    const ik::CurveOptions options = before.with(weights);
    ik::CurveMemory memory(chain.bones());
    std::vector<rig::Transform> pose = unsolved_pose(part), again = pose;
    chain.bend(pose, before.points, options, memory);
    return chain.bend(again, points, options, memory).jumped;
}

// Files and --state.

Json curves_json(const HumanoidPart& part) {
    Json list = Json::array();
    for (const BoneCurve& each : part.curves) {
        Json json{{"first", each.first}, {"last", each.last}, {"points", points_json(each.shape.points)}};
        json.update(save_fields(each.shape));
        if (each.jumped) json["jumped"] = *each.jumped;
        list.push_back(std::move(json));
    }
    return list;
}

void read_curves(const JsonPlace& place, HumanoidPart& part) {
    place.for_each("curves", max_bone_curves, [&](const JsonPlace& each) {
        BoneCurve curve{.first = each["first"].text(), .last = each["last"].text(), .shape = {}};
        for (const char* const end : {"first", "last"})
            if (!part.skeleton().find(each[end].text()))
                each[end].fail("the character has no node \"" + each[end].text() + "\"");
        const auto chain = chain_of(part, curve);
        if (!chain) each["last"].fail(curve.last + " is not below " + curve.first);
        if (curve_from(part, chain->first)) each["first"].fail("there is a curve from " + curve.first);
        if (const std::string why = why_no_curve(part, *chain); !why.empty()) each["first"].fail(why);
        if (const auto made = humanoid::BentChain::make(part.skeleton(), chain->first, chain->last); !made)
            each["first"].fail(made.error().message());
        load_known_fields(each, curve.shape, {"first", "last", "points", "jumped"});
        curve.shape.points = read_control_points(each["points"], max_bone_curve_points);
        if (curve.shape.points.empty()) each["points"].fail("a curve needs a control point");
        if (const auto jumped = each.optional("jumped"))
            curve.jumped = jumped->index(bones_between(part.skeleton(), *chain));
        part.curves.push_back(std::move(curve));
    });
}

Json curves_state(const HumanoidPart& part, Solvers& solvers, const ShownPose& shown) {
    const BentChains& chains = solvers.curves(part);
    Json list = curves_json(part);
    for (std::size_t i = 0; i < list.size(); ++i) {
        Json& json = list[i];
        json["bones"] = Json::array();
        if (chains[i] == nullptr) continue;
        const std::span<const std::size_t> nodes = chains[i]->nodes();
        for (const std::size_t node : nodes.first(nodes.size() - 1))
            json["bones"].push_back(part.skeleton()[node].name);
        const ik::CurveReport& report = shown.curves[i];
        json["bones_past_end"] = report.bones_past_end;
        json["past_end"] = report.past_end;
        json["factor"] = report.factor;
        json["collapsed"] = report.collapsed;
        const auto& jumped = part.curves[i].jumped;
        json["jumped"] = jumped ? Json(part.skeleton()[nodes[*jumped]].name) : Json(nullptr);
    }
    return list;
}

// Curves of the Humanoid lab: picking and drawing.

std::vector<glm::vec3> shown_curve(const HumanoidPart& part, Solvers& solvers, const ShownPose& shown,
                                   std::size_t curve) {
    const humanoid::BentChain* const chain = solvers.curves(part)[curve].get();
    if (chain == nullptr) return {};
    const humanoid::Placement space = chain->space(shown.placed);
    std::vector<glm::vec3> points{shown.point(chain->nodes().front())};
    for (const glm::vec3& each : part.curves[curve].shape.points)
        points.push_back(glm::vec3(space.apply(glm::dvec3(each))));
    return points;
}

std::optional<PickedCurve> picked_curve(const HumanoidPart& part, PickId pick) {
    if (pick < first_block || pick >= block_of(part.curves.size())) return std::nullopt;
    const auto curve = static_cast<std::size_t>((pick - first_block) / block);
    const PickId within = pick - block_of(curve);
    const std::size_t points = part.curves[curve].shape.points.size();
    if (within < strokes_from) {
        if (static_cast<std::size_t>(within) >= points) return std::nullopt;
        return PickedCurve{.curve = curve, .control = static_cast<std::size_t>(within)};
    }
    const auto at = CurvePen::place(static_cast<std::size_t>(within - strokes_from), points + 1);
    return at ? std::optional(PickedCurve{.curve = curve, .at = *at}) : std::nullopt;
}

std::vector<Handle> curve_handles(const HumanoidPart& part, Solvers& solvers, const ShownPose& shown) {
    std::vector<Handle> handles;
    for (std::size_t i = 0; i < part.curves.size(); ++i) {
        const std::vector<glm::vec3> curve = shown_curve(part, solvers, shown, i);
        for (std::size_t k = 1; k < curve.size(); ++k)
            handles.push_back({"curve." + part.curves[i].first + '.' + std::to_string(k - 1),
                               block_of(i) + static_cast<PickId>(k - 1),
                               {curve[k]}});
    }
    return handles;
}

std::string curve_hint(const HumanoidPart& part, const PickedCurve& picked) {
    const BoneCurve& curve = part.curves[picked.curve];
    if (!picked.control) return "Curve of " + curve.first + ": click adds a control point.";
    return "Control point " + std::to_string(*picked.control + 1) + " of " + curve.first +
           ": drag bends the curve" + (curve.shape.points.size() > 1 ? ", double click removes it." : ".");
}

void draw_bone_curves(const View& view, DrawList& list, const HumanoidPart& part, Solvers& solvers,
                      const ShownPose& shown) {
    for (std::size_t i = 0; i < part.curves.size(); ++i) {
        const std::vector<glm::vec3> curve = shown_curve(part, solvers, shown, i);
        if (curve.size() < 2) continue;
        const CurvePen pen(view, curve, part.curves[i].shape.options.kind, block_of(i) + strokes_from,
                           curve_colour(view.palette), over_effectors, list);
        pen.line();
        for (std::size_t k = 1; k < curve.size(); ++k)
            pen.control(k, block_of(i) + static_cast<PickId>(k - 1));
    }
}

void drag_control(const HumanoidPart& part, Solvers& solvers, const ShownPose& shown,
                  const PickedCurve& picked, glm::vec3 to, Emit& emit) {
    const humanoid::BentChain* const chain = solvers.curves(part)[picked.curve].get();
    if (chain == nullptr || !picked.control) return;
    const BoneCurve& curve = part.curves[picked.curve];
    std::vector<glm::vec3> points = curve.shape.points;
    points[*picked.control] = into_space(chain->space(shown.placed), to);
    if (points != curve.shape.points) emit_curve_points(curve, points, true, emit);
}

void remove_control(const HumanoidPart& part, const PickedCurve& picked, Emit& emit) {
    const BoneCurve& curve = part.curves[picked.curve];
    std::vector<glm::vec3> points = curve.shape.points;
    if (!picked.control) return;
    points.erase(points.begin() + static_cast<std::ptrdiff_t>(*picked.control));
    emit_curve_points(curve, points, false, emit);
}

void click_curve(const HumanoidPart& part, Solvers& solvers, const ShownPose& shown,
                 const PickedCurve& picked, Emit& emit) {
    const BoneCurve& curve = part.curves[picked.curve];
    if (!picked.control) {
        const humanoid::BentChain* const chain = solvers.curves(part)[picked.curve].get();
        if (chain == nullptr) return;
        std::vector<glm::vec3> points = shown_curve(part, solvers, shown, picked.curve);
        for (glm::vec3& each : points) each = into_space(chain->space(shown.placed), each);
        points = with_point_at(points, curve.shape.options.kind, picked.at);
        points.erase(points.begin());
        emit_curve_points(curve, points, false, emit);
    }
    const bool shows =
        !part.selection.several() && active_name(part.selection, part.skeleton()) == curve.first;
    if (!shows) emit("humanoid.select", {{"node", curve.first}});
}

}  // namespace tendril::app
