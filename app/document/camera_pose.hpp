// Where one looks from: plain data, saved with a scene. The mathematics is view/camera.hpp.
#pragma once

#include <glm/vec3.hpp>

namespace tendril::app {

struct CameraPose {
    glm::vec3 target{0.0f};       ///< what the camera turns about
    float yaw = 0.0f;             ///< radians about +Y; 0 looks along -Z
    float pitch = 0.0f;           ///< radians above the horizon, in [-pi/2, pi/2]
    float distance = 10.0f;       ///< metres from the target, > 0
    float field_of_view = 0.70f;  ///< vertical, radians, where the view is wide enough
    bool orthographic = false;    ///< shows the target's plane at the same size as perspective does
    bool operator==(const CameraPose&) const = default;
};

}  // namespace tendril::app
