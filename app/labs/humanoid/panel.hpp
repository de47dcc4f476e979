// The pieces that the Humanoid lab's panels are put together from.
#pragma once

#include "app/labs/humanoid/humanoid_runtime.hpp"
#include "app/labs/kit/panel_rows.hpp"
#include "app/view/palette.hpp"
#include "app/widgets/emit.hpp"

namespace tendril::app {

/// All that a section reads.
struct HumanoidPanel {
    const Workspace& workspace;
    const HumanoidPart& part;
    HumanoidRuntime& runtime;
    const Palette& colours;
    Emit& emit;
};
HumanoidPanel humanoid_panel(const Workspace& workspace, Emit& emit);

/// What can be done with the character, and whether it reaches what it is to reach.
Verdict humanoid_verdict(const Workspace& workspace);

// left
/// Which file it is, and what was done to it.
void character_rows(const HumanoidPanel& panel);
/// The bones of a body, each with its node and how sure that is.
void bone_rows(const HumanoidPanel& panel);
/// Which clip, and how it plays.
void clip_rows(const HumanoidPanel& panel);
/// The effectors with their targets.
void target_rows(const HumanoidPanel& panel);
/// Where the limits of joints come from.
void limit_rows(const HumanoidPanel& panel);
/// Springs on its own ears, antennae, tail.
void spring_rows(const HumanoidPanel& panel);
/// What hangs on it, and the order in which a tick goes.
void attachment_rows(const HumanoidPanel& panel);
/// What it walks on, and how its feet take that.
void ground_rows(const HumanoidPanel& panel);
/// Hands that a clip moves, and what the head looks at.
void hand_rows(const HumanoidPanel& panel);
void look_rows(const HumanoidPanel& panel);
/// What the motion lint has found in the clip, with its cures.
void lint_rows(const HumanoidPanel& panel);
/// Where the clip is written to.
void export_rows(const HumanoidPanel& panel);
/// Bone maps that are saved and loaded.
void map_rows(const HumanoidPanel& panel);

// right
/// How far effectors are from their targets.
void target_inspector(const HumanoidPanel& panel);
// What is set here is set on all that is selected; what can only be read is that of the active one.
/// The selected nodes.
void node_inspector(const HumanoidPanel& panel);
/// The springs that turn the selected nodes, or could.
void spring_inspector(const HumanoidPanel& panel);
/// How far the selected joints are turned, and may be.
void limit_inspector(const HumanoidPanel& panel);
/// The character in numbers.
void character_inspector(const HumanoidPanel& panel);

}  // namespace tendril::app
