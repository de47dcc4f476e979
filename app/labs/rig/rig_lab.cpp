#include "app/labs/rig/rig_lab.hpp"

#include "app/labs/rig/code.hpp"
#include "app/labs/rig/panel.hpp"
#include "app/labs/rig/presets.hpp"
#include "app/labs/rig/rig_commands.hpp"

namespace tendril::app {
std::shared_ptr<Part> RigLab::blank() const {
    return std::make_shared<RigPart>(first_rig());
}

std::string RigLab::invitation(const Workspace& workspace) const {
    return rig_part(workspace).rig.definition().elements.empty() ? "Add an element, or take a preset."
                                                                 : "Drag an orange shape.";
}

CameraPose RigLab::first_view() const {
    return rig_presets().front().view;
}

void RigLab::add_commands(CommandTable& table) const {
    add_solve_commands(table);
    add_element_commands(table);
    add_unit_commands(table);
    add_time_commands(table);
}

std::string RigLab::code(const Workspace& workspace) const {
    return rig_code(rig_part(workspace));
}

/// The head follows a control that circles above it, blinks and speaks: a control beside the face moves its
/// mouth and lids, by curves of its x and z.
std::vector<CommandCall> RigLab::opening() const {
    return rig_script("opening");
}

/// Stops with the eyes open and the mouth closed.
std::vector<CommandCall> RigLab::calm() const {
    return rig_script("calm");
}

}  // namespace tendril::app
