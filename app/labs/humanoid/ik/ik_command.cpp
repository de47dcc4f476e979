#include "app/labs/humanoid/ik/ik_command.hpp"

#include <algorithm>
#include <stdexcept>

#include "app/document/json_complete.hpp"
#include "app/labs/humanoid/ik/release.hpp"

namespace tendril::app {

namespace {

/// Where a target has been let go. `settings` and `pose` are of before. Hand IK that is switched has its
/// curves and cone of view to ease by, and is at once what it is set to.
void let_go(Workspace& workspace, const IkSettings& settings, const std::vector<rig::Transform>& pose) {
    const HumanoidPart& part = humanoid_part(workspace);
    const bool loses = std::ranges::any_of(all_effectors, [&](humanoid::Effector each) {
        return settings.target(each) && !part.ik.target(each);
    });
    const bool plays = workspace.clock.playing && goes_on(part.playback, *part.loaded);
    if (!loses || !(plays || part.ik.has_targets())) return;
    const auto set = [&](Release release) {
        workspace.document.edit<HumanoidPart>(humanoid_lab).ik_state.release = std::move(release);
    };
    set({.left = release_seconds});
    if (plays)
        set(release_between(pose, shown_pose(workspace).before_springs,
                            humanoid_part(workspace).node_of(humanoid::Bone::Hips)));
}

}  // namespace

Command ik_command(const char* name, const char* title, std::vector<Argument> arguments, const char* help,
                   void (*change)(const IkNow&, HumanoidPart&, const Arguments&)) {
    return {.name = name,
            .title = title,
            .arguments = std::move(arguments),
            .help = help,
            .effect = Effect::Edit,
            .apply = [change](Workspace& workspace, const Arguments& given) {
                const IkNow now{shown_pose(workspace), humanoid_runtime(workspace).solvers};
                const IkSettings settings = humanoid_part(workspace).ik;
                const std::vector<rig::Transform> pose = now.shown.before_springs;
                change_part<HumanoidPart>(workspace, humanoid_lab,
                                          [&](HumanoidPart& part, const HumanoidPart& old) {
                                              change(now, part, given);
                                              if (!(part == old)) part.quiet_ticks = 0;
                                          });
                solve_now(workspace);
                let_go(workspace, settings, pose);
            }};
}

glm::dvec3 exact_point(const Json& json) {
    return {json[0].get<double>(), json[1].get<double>(), json[2].get<double>()};
}

void require_body(const IkNow& now, const HumanoidPart& part) {
    const std::string& why = now.solvers.why_no_body(part);
    if (!why.empty()) throw std::invalid_argument("the body solve is off: " + why);
}

}  // namespace tendril::app
