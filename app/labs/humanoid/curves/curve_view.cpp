// Curves of the Humanoid lab under the mouse and in the picture.
#include <glm/gtc/quaternion.hpp>

#include "app/document/json_complete.hpp"
#include "app/labs/humanoid/curves/curves.hpp"
#include "app/labs/humanoid/draw.hpp"
#include "app/labs/humanoid/humanoid_part.hpp"
#include "app/labs/humanoid/ik/shown_pose.hpp"
#include "app/labs/humanoid/ik/solvers.hpp"

namespace tendril::app {
namespace {

// Pick ids: a block for each curve, its control points first, then its strokes.
constexpr PickId first_block = 2'000'000, block = 10'000;
/// Where the curve ends at the head, its end is on the head's ball.
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
