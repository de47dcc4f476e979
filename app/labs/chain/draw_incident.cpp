#include <glm/geometric.hpp>

#include "app/labs/chain/draw.hpp"
#include "app/labs/kit/incident_pen.hpp"

namespace tendril::app {

void draw_incident(const View& view, const ChainPart& part, DrawList& list) {
    const auto& incident = view.workspace.ui.incident;
    if (!incident) return;
    const auto before = std::dynamic_pointer_cast<const ChainPart>(view.workspace.around(*incident).before);
    if (!before || before->chain.size() != part.chain.size() || incident->joint >= part.chain.size()) return;
    const auto was = before->chain.segments(), is = part.chain.segments();
    const glm::vec4 ghost = faded(view.palette, view.palette.ghost, 0.9f);
    for (std::size_t i = 1; i < was.size(); ++i)
        list.line(was[i - 1].position, was[i].position, 2.5f * view.scale, ghost);
    for (const Segment& joint : was) list.sphere(joint.position, 4.5f * view.scale, Unit::Pixels, ghost);
    list.ring(before->target, 12.0f * view.scale, 1.5f * view.scale, ghost).layer = Layer::Overlay;
    if (incident->kind != Incident::Kind::Flip) return;
    const std::size_t joint = incident->joint;
    // About that neighbour which moved less.
    const auto moved = [&](std::size_t i) { return glm::distance(was[i].position, is[i].position); };
    const bool last = joint + 1 == is.size();
    const std::size_t about =
        joint == 0 || (!last && moved(joint + 1) < moved(joint - 1)) ? joint + 1 : joint - 1;
    draw_turn(view, was[joint].position, is[joint].position, is[about].position, list);
    draw_incident_mark(view, *incident, is[joint].position, list);
}

}  // namespace tendril::app
