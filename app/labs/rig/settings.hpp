// What the Rig lab's picture leaves to the person.
#pragma once

#include "app/labs/kit/setting.hpp"

namespace tendril::app {

LabSetting rig_axes_setting();     ///< the axes of every bone: shown, hidden
LabSetting rig_pending_setting();  ///< which poses are pending: hidden, shown
LabSetting rig_figures_setting();  ///< heads and blobs: shown, hidden
LabSetting rig_strip_setting();    ///< below the scene: the take, the last ten seconds

}  // namespace tendril::app
