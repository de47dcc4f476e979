// The Rig lab from tick to tick.
#include "app/labs/rig/clip.hpp"
#include "app/labs/rig/incidents.hpp"
#include "app/labs/rig/rig_lab.hpp"
#include "app/labs/rig/take.hpp"

namespace tendril::app {
namespace {

RigRuntime& rig_runtime(const Workspace& workspace) {
    return workspace.runtimes.of<RigRuntime>(rig_lab);
}

}  // namespace

bool RigLab::moving(const Workspace& workspace) const {
    return time_moves(rig_part(workspace));
}

void RigLab::step(Workspace& workspace) const {
    const int due = workspace.clock.whole_ticks();
    if (due == 0) return;
    const bool modified = workspace.modified();
    RigPart& part = workspace.document.edit<RigPart>(rig_lab);
    for (int i = 0; i < due; ++i) pass_tick(part, rig_runtime(workspace), workspace.clock.measured);
    if (!modified) workspace.saved = workspace.document;  // time does not mark the scene as modified
}

std::uint64_t RigLab::tick_work(const Workspace& workspace) const {
    return rig_part(workspace).rig.work();
}

double RigLab::seconds(const Workspace& workspace) const {
    return static_cast<double>(rig_part(workspace).take.now()) * tick_seconds;
}

std::vector<Incident> RigLab::review(const Workspace&, const Part& before, const Part& after) const {
    return rig_incidents(dynamic_cast<const RigPart&>(before), dynamic_cast<const RigPart&>(after));
}

bool RigLab::working(const Workspace& workspace) const {
    const RigPart& part = rig_part(workspace);
    return (part.clip_left && part.clip_left->running) || (part.rates && part.rates->running);
}

void RigLab::work(Workspace& workspace) const {
    const bool modified = workspace.modified();
    RigPart& part = workspace.document.edit<RigPart>(rig_lab);
    RigRuntime& runtime = rig_runtime(workspace);
    continue_clip_solve(part, runtime.workspace(part.rig));
    runtime.rates.advance(part);
    if (!modified) workspace.saved = workspace.document;
}

}  // namespace tendril::app
