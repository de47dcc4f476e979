// Shared by the commands that change IK.
#pragma once

#include "app/labs/humanoid/humanoid_commands.hpp"
#include "app/labs/humanoid/humanoid_runtime.hpp"

namespace tendril::app {

/// What a change may read while the part is being changed.
struct IkNow {
    const ShownPose& shown;
    Solvers& solvers;
};

/// Changes the part, then solves so that IK remembers the resulting state.
Command ik_command(const char* name, const char* title, std::vector<Argument> arguments, const char* help,
                   void (*change)(const IkNow&, HumanoidPart&, const Arguments&));

/// A Point with double precision.
glm::dvec3 exact_point(const Json& json);
/// Throws std::invalid_argument with the reason if there is no body.
void require_body(const IkNow& now, const HumanoidPart& part);

void add_hand_commands(CommandTable& table);

}  // namespace tendril::app
