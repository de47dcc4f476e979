#include <algorithm>
#include <glm/geometric.hpp>

#include "app/labs/chain/draw.hpp"
#include "app/labs/kit/incident_pen.hpp"

namespace tendril::app {

LabSetting ghost_setting() {
    return {.key = "chain ghosts",
            .command = "view.chain_ghosts",
            .title = "Show or hide past poses",
            .argument = "of",
            .help = "Shows the poses of the last ten seconds of the Chain lab, one for each half second",
            .choices = {{"nothing", "none"}, {"past", "every half second"}}};
}

void draw_ghosts(const View& view, const ChainPart& part, DrawList& list) {
    if (ghost_setting().chosen(view.workspace.settings) == 0) return;
    if (part.study.open() || part.chain.size() > max_studied_segments) return;
    constexpr std::uint64_t apart = 30;  // ticks
    const Rewind& past = view.workspace.rewind;
    for (const Rewind::Moment& moment : past.moments()) {
        if (moment.tick % apart != 0) continue;
        const auto segments = dynamic_cast<const ChainPart&>(*moment.part).chain.segments();
        if (segments.size() > max_studied_segments) continue;
        const auto age =
            static_cast<float>(past.newest() - moment.tick) / static_cast<float>(Rewind::most_ticks);
        const glm::vec4 colour = faded(view.palette, view.palette.ghost, 0.75f - 0.55f * age);
        for (std::size_t i = 1; i < segments.size(); ++i)
            list.line(segments[i - 1].position, segments[i].position, 1.5f * view.scale, colour);
    }
}

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
