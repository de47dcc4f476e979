// The sections that make up the panels of the Rig lab.
#pragma once

#include "app/labs/kit/panel_rows.hpp"
#include "app/labs/rig/rig_runtime.hpp"
#include "app/labs/rig/unit_inputs.hpp"
#include "app/view/palette.hpp"
#include "app/widgets/emit.hpp"

namespace tendril::app {

/// The inputs of a section.
struct RigPanel {
    const Workspace& workspace;
    const RigPart& part;
    RigRuntime& runtime;
    const rig::Hierarchy& now;  ///< nothing pending
    const Palette& colours;
    Emit& emit;

    /// Emits a command that changes the rig and, while the simulation is paused, a solve in the same undo
    /// step.
    void edit(const char* command, const ArgumentList& arguments) const;
};
RigPanel rig_panel(const Workspace& workspace, Emit& emit);

// Left panel.
/// Every element, indented below its parent; a click selects.
void element_tree(const RigPanel& panel);
/// Every unit in order; the inspector shows the selected one.
void unit_list(const RigPanel& panel);
void switch_box(const RigPanel& panel, const rig::Unit& unit);
void curve_rows(const RigPanel& panel);
void solve_rows(const RigPanel& panel);

// Right panel.
/// Whether every unit ran.
Verdict rig_verdict(const RigPart& part);
/// The selected elements: the active one's kind, with fields for a control's value.
void element_inspector(const RigPanel& panel);
/// Poses of the active element, pending ones, and fields for its input pose; an edit sets all of its kind.
void pose_rows(const RigPanel& panel);
/// The value of the active element if it is a control.
void control_rows(const RigPanel& panel);
/// The selected elements that a field edits: controls of the active one's kind, or all bones and nulls.
std::vector<std::size_t> selected_alike(const RigPart& part);
/// Says how many elements a field edits, if several are selected. `what` names them: "position controls".
void scope_note(const RigPart& part, std::size_t alike, const std::string& what);
/// Each unit's contribution to the active element.
void why_rows(const RigPanel& panel);
/// The selected unit: fields for its literals, current values for other inputs.
void unit_inspector(const RigPanel& panel);

/// Why a unit, or part of it, was skipped; draws nothing if it was not.
void warning_line(const RigPanel& panel, rig::Warning warning, float margin = 0.0f);

/// The name of an element or a unit; Enter renames it by that command.
void name_field(const RigPanel& panel, const char* command, const std::string& name, const char* help);

/// Names the elements in a command: "name" for one, "names" for several.
NamedArgument which(const RigPart& part, const std::vector<std::size_t>& elements);

/// Selects one element or unit; keeps the selection of the other kind.
void select_element(const RigPanel& panel, const std::string& name);
void select_unit(const RigPanel& panel, const std::string& name);

/// The edited vector; components that were not edited keep their double precision.
glm::dvec3 edited_vector(const glm::dvec3& before, glm::vec3 shown, glm::vec3 edited);

/// A field for a rotation, as Euler angles. Returns true in frames in which the user changed it.
bool rotation_field(const RigPanel& panel, const char* name, glm::dquat& rotation);
/// Fields for translation, rotation and scale. Returns the changed members as JSON, or nothing.
std::optional<SharedJson> transform_fields(const RigPanel& panel, const rig::Transform& transform,
                                           glm::vec3 low, glm::vec3 high);

}  // namespace tendril::app
