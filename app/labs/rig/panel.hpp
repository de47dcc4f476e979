// The pieces that the Rig lab's panels are put together from.
#pragma once

#include "app/labs/kit/panel_rows.hpp"
#include "app/labs/kit/setting.hpp"
#include "app/labs/rig/rig_runtime.hpp"
#include "app/labs/rig/unit_inputs.hpp"
#include "app/view/palette.hpp"
#include "app/widgets/emit.hpp"

namespace tendril::app {

/// All that a section reads.
struct RigPanel {
    const Workspace& workspace;
    const RigPart& part;
    RigRuntime& runtime;
    const rig::Hierarchy& now;  ///< all poses worked out
    const Palette& colours;
    Emit& emit;

    /// Emits what changes the rig. While the simulation is paused no tick solves, so this does, in the same
    /// step to undo.
    void edit(const char* command, const ArgumentList& arguments) const;
};
RigPanel rig_panel(const Workspace& workspace, Emit& emit);

/// Whether the tree marks what is pending.
LabSetting pending_marks();

// left
/// Every element, indented below its parent; what is clicked is selected.
void element_tree(const RigPanel& panel);
/// Every unit in order; below the selected one what it reads and hands out.
void unit_list(const RigPanel& panel);
void curve_rows(const RigPanel& panel);
void solve_rows(const RigPanel& panel);

// right
/// Whether every unit ran.
Verdict rig_verdict(const RigPart& part);
/// The selected elements: what the active one is, and fields for the value of a control.
void element_inspector(const RigPanel& panel);
/// Its poses, what is pending, and fields for the pose that a solve begins with; that one is set on all.
void pose_rows(const RigPanel& panel);
/// The value of the active one, if it is a control.
void control_rows(const RigPanel& panel);
/// Those selected that a field sets: controls of the active one's kind, or bones and nulls as it is one.
std::vector<std::size_t> selected_alike(const RigPart& part);
/// Says which those are, where several are selected. `what` they are: "position controls".
void scope_note(const RigPart& part, std::size_t alike, const std::string& what);
/// What each unit added to the active element.
void why_rows(const RigPanel& panel);
/// The selected unit: fields for its literals, and what the rest is now.
void unit_inspector(const RigPanel& panel);

/// Why a unit, or a part of it, was left out; nothing where it was not.
void warning_line(const RigPanel& panel, rig::Warning warning, float margin = 0.0f);

/// Which elements a command is about: "name" of one, "names" of several.
NamedArgument which(const RigPart& part, const std::vector<std::size_t>& elements);

/// Selects the one, and leaves the other kind of thing selected as it is.
void select_element(const RigPanel& panel, const std::string& name);
void select_unit(const RigPanel& panel, const std::string& name);

/// Two small bars for local and global, filled where that waits to be worked out. `at`: their middle.
void draw_pending(rig::Pending pending, glm::vec2 at, const Palette& colours);
/// "global pending"
const char* pending_text(rig::Pending pending);

/// What was edited in float, but for the parts that were not touched: those keep all their digits.
glm::dvec3 edited_vector(const glm::dvec3& before, glm::vec3 shown, glm::vec3 edited);

/// A field for a rotation, as Euler angles. True in a frame in which a person changed it.
bool rotation_field(const RigPanel& panel, const char* name, glm::dquat& rotation);
/// Fields for translation, rotation and scale; gives the members that were changed, as JSON, else nothing.
std::optional<SharedJson> transform_fields(const RigPanel& panel, const rig::Transform& transform,
                                           glm::vec3 low, glm::vec3 high);

}  // namespace tendril::app
