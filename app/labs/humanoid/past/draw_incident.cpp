// The body as it was before an incident, over what came of it.
#include "app/labs/humanoid/humanoid_runtime.hpp"
#include "app/labs/humanoid/past/past.hpp"
#include "app/labs/kit/incident_pen.hpp"

namespace tendril::app {

void draw_humanoid_incident(const View& view, const ShownPose& shown, DrawList& list) {
    const auto& incident = view.workspace.ui.incident;
    if (!incident) return;
    const HumanoidPart& part = humanoid_part(view.workspace);
    const std::shared_ptr<const Part> before = view.workspace.around(*incident).before;
    const auto was = std::dynamic_pointer_cast<const HumanoidPart>(before);
    if (!was || was->loaded != part.loaded || incident->joint >= part.skeleton().size()) return;
    const PoseLines lines = humanoid_lines(view.workspace, before);
    const glm::vec4 ghost = faded(view.palette, view.palette.ghost, 0.9f);
    if (lines.size() <= max_ghost_lines)
        for (const auto& [from, to] : lines)
            list.line(from, to, 2.5f * view.scale, ghost).layer = Layer::Overlay;
    const glm::vec3 at = shown.point(incident->joint);
    if (incident->kind == Incident::Kind::Flip) {
        IkState state = was->ik_state;
        const ShownPose first = solve_pose(*was, humanoid_runtime(view.workspace).solvers, 0.0, state);
        for (const std::int32_t each : part.skeleton().children(incident->joint))
            if (const auto child = static_cast<std::size_t>(each); part.bone_of(child))
                draw_turn(view, first.point(child), shown.point(child), at, list);
    }
    draw_incident_mark(view, *incident, at, list);
}

}  // namespace tendril::app
