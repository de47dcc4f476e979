#include "app/labs/humanoid/attachments/wearing.hpp"

namespace tendril::app {
namespace {

void carry_attachments(Workspace& workspace) {
    if (humanoid_part(workspace).attachments.list.empty()) return;
    HumanoidRuntime& runtime = humanoid_runtime(workspace);
    const ShownPose shown = shown_pose(workspace);
    Attachments attachments = humanoid_part(workspace).attachments;
    carry(attachments, wearer_of(humanoid_part(workspace), runtime.solvers, shown), runtime.ropes);
    if (attachments == humanoid_part(workspace).attachments) return;
    workspace.document.edit<HumanoidPart>(humanoid_lab).attachments = std::move(attachments);
}

}  // namespace

Wearer wearer_of(const HumanoidPart& part, Solvers& solvers, const ShownPose& shown) {
    return {*part.loaded, *part.map, solvers.volume(part), shown.placed, part.ik.ground};
}

Command carrying(Command command) {
    if (command.effect != Effect::Edit) return command;
    const bool drags = command.name == "humanoid.target" || command.name == "humanoid.look_at";
    command.apply = [drags, apply = command.apply](Workspace& workspace, const Arguments& given) {
        apply(workspace, given);
        if (drags && workspace.clock.playing) return;
        carry_springs(workspace);
        carry_attachments(workspace);
    };
    return command;
}

void remake_attachments(Workspace& workspace, double scale) {
    if (humanoid_part(workspace).attachments.list.empty()) return;
    HumanoidRuntime& runtime = humanoid_runtime(workspace);
    const ShownPose shown = shown_pose(workspace);
    const HumanoidPart& part = humanoid_part(workspace);
    Attachments all = remade(part.attachments, wearer_of(part, runtime.solvers, shown), scale);
    workspace.document.edit<HumanoidPart>(humanoid_lab).attachments = std::move(all);
}

}  // namespace tendril::app
