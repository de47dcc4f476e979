#include "app/labs/rig/settings.hpp"

#include "app/labs/rig/panels.hpp"
#include "app/labs/rig/past.hpp"
#include "app/labs/rig/rig_lab.hpp"

namespace tendril::app {

LabSetting rig_axes_setting() {
    return {.key = "bone_axes",
            .command = "view.bone_axes",
            .title = "Show or hide bone axes",
            .argument = "show",
            .help = "Shows or hides the axes of every bone",
            .choices = {{"shown", "Axes at every bone"}, {"hidden", "No axes at bones"}}};
}

LabSetting rig_pending_setting() {
    return {
        .key = "pending_rings",
        .command = "view.pending_rings",
        .title = "Show or hide pending rings",
        .argument = "show",
        .help = "Draws a ring around what the last edit or solve left pending",
        .choices = {{"hidden", "No rings around pending poses"}, {"shown", "Rings around pending poses"}}};
}

LabSetting rig_figures_setting() {
    return {.key = "figures",
            .command = "view.figures",
            .title = "Show or hide heads and blobs",
            .argument = "show",
            .help = "Shows or hides heads and blobs, so that the bones within are seen",
            .choices = {{"shown", "Heads and blobs drawn"}, {"hidden", "Bones only"}}};
}

LabSetting rig_strip_setting() {
    return {.key = "rig_strip",
            .command = "view.rig_strip",
            .title = "Show the take or the past",
            .argument = "of",
            .help = "Shows the take below the scene of the Rig lab, or its last ten seconds",
            .choices = {{"take", "The take below the scene"}, {"past", "The last ten seconds below it"}}};
}

std::vector<LabSetting> RigLab::settings() const {
    return {rig_axes_setting(),  rig_figures_setting(), pending_marks(),  rig_pending_setting(),
            rig_strip_setting(), rig_past().plot,       rig_past().ghosts};
}

}  // namespace tendril::app
