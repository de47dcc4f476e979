#include "app/labs/humanoid/ik/ik_command.hpp"

#include <stdexcept>

#include "app/document/json_complete.hpp"

namespace tendril::app {

Command ik_command(const char* name, std::vector<Argument> arguments, const char* help,
                   void (*change)(const IkNow&, HumanoidPart&, const Arguments&)) {
    return {.name = name,
            .arguments = std::move(arguments),
            .help = help,
            .effect = Effect::Edit,
            .apply = [change](Workspace& workspace, const Arguments& given) {
                const IkNow now{shown_pose(workspace), humanoid_runtime(workspace).solvers};
                change_part<HumanoidPart>(workspace, humanoid_lab,
                                          [&](HumanoidPart& part, const HumanoidPart& old) {
                                              change(now, part, given);
                                              if (!(part == old)) part.quiet_ticks = 0;
                                          });
                solve_now(workspace);
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
