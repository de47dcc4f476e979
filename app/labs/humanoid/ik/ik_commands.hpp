// How a command changes what IK does.
#pragma once

#include "app/labs/humanoid/humanoid_commands.hpp"
#include "app/labs/humanoid/humanoid_runtime.hpp"

namespace tendril::app {

/// What a change may look at: the part is not in place yet.
struct IkNow {
    const ShownPose& shown;
    Solvers& solvers;
};

/// Changes the part; IK then remembers where that brings it.
Command ik_command(const char* name, const char* title, std::vector<Argument> arguments, const char* help,
                   void (*change)(const IkNow&, HumanoidPart&, const Arguments&));

/// Of a Point, with all its digits.
glm::dvec3 exact_point(const Json& json);
/// Throws std::invalid_argument that says why there is no body.
void require_body(const IkNow& now, const HumanoidPart& part);

void add_hand_commands(CommandTable& table);

}  // namespace tendril::app
