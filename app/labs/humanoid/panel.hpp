// The sections that make up the panels of the Humanoid lab.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "app/labs/humanoid/humanoid_runtime.hpp"
#include "app/labs/kit/panel_rows.hpp"
#include "app/view/palette.hpp"
#include "app/widgets/emit.hpp"

namespace tendril::app {

/// The inputs of a section.
struct HumanoidPanel {
    const Workspace& workspace;
    const HumanoidPart& part;
    HumanoidRuntime& runtime;
    const Palette& colours;
    Emit& emit;
};
HumanoidPanel humanoid_panel(const Workspace& workspace, Emit& emit);

/// Says whether the character is usable and reaches its targets.
Verdict humanoid_verdict(const Workspace& workspace);

/// Maps the waiting bone to the node (none if negative) and selects that node. If the bone had no node, the
/// next unmapped bone then waits, so that each click maps one.
void map_waiting_bone(const HumanoidPart& part, std::optional<humanoid::Bone>& waiting, std::int32_t node,
                      Emit& emit);

// Left panel.
// / The file, and notes on how it was read.
void character_rows(const HumanoidPanel& panel);
/// Each bone with its node and the confidence of the match.
void bone_rows(const HumanoidPanel& panel, bool open_at_first);
/// The clip and its playback.
void clip_rows(const HumanoidPanel& panel);
/// A clip of another character.
void motion_note(const HumanoidPanel& panel);
/// Effectors and their targets.
void target_rows(const HumanoidPanel& panel);
/// The source of joint limits.
void limit_rows(const HumanoidPanel& panel);
/// Settings and Remove for the spring or curve that begins at the node, which is `argument` of `command`.
void settings_row(const HumanoidPanel& panel, const std::string& node, const char* command,
                  const char* argument, const char* help);
/// Springs on ears, antennae, a tail.
void spring_rows(const HumanoidPanel& panel);
/// Curves that a tail or the spine bends along.
void curve_rows(const HumanoidPanel& panel);
/// Attachments, their wind, and the order of a tick.
void attachment_rows(const HumanoidPanel& panel);
/// The ground, and foot IK.
void ground_rows(const HumanoidPanel& panel);
/// Hand IK, and look-at.
void hand_rows(const HumanoidPanel& panel);
void look_rows(const HumanoidPanel& panel);
/// Progress of the command's background work; nothing if there is none.
void progress_row(const HumanoidPanel& panel, const char* command);
/// The findings of the motion lint, with their cures.
void lint_rows(const HumanoidPanel& panel);
/// Where to write the clip.
void export_rows(const HumanoidPanel& panel);
/// Saving and loading bone maps.
void map_rows(const HumanoidPanel& panel);

// Right panel.
// Fields set all selected items; readings are those of the active one.
/// The springs on the selected nodes, or offers to add some.
void spring_inspector(const HumanoidPanel& panel);
/// The curve through the active node, or offers to add one.
void curve_inspector(const HumanoidPanel& panel);
/// The rotations and ranges of the selected joints.
void limit_inspector(const HumanoidPanel& panel);

}  // namespace tendril::app
