// The camera's pose: plain data, saved with a scene. The mathematics is in view/camera.hpp.
#pragma once

#include <glm/vec3.hpp>

namespace tendril::app {

struct CameraPose {
    glm::vec3 target{0.0f};       ///< the camera orbits this point
    float yaw = 0.0f;             ///< radians about +Y; 0 looks along -Z
    float pitch = 0.0f;           ///< radians above the horizon, in [-pi/2, pi/2]
    float distance = 10.0f;       ///< metres from the target, > 0
    float field_of_view = 0.70f;  ///< vertical, radians; widened if the view is narrower than 5:4
    bool orthographic = false;    ///< the target's plane is shown at the same size as in perspective
    bool operator==(const CameraPose&) const = default;
};

/// Limits that commands, files and the camera itself enforce. Metres and radians.
namespace camera_range {
inline constexpr double nearest = 1e-3, farthest = 1e7;
inline constexpr float target = 1e7f;  ///< largest magnitude of a coordinate
inline constexpr float pitch = 1.5707964f;
inline constexpr float narrowest = 0.05f, widest = 2.6f;
}  // namespace camera_range

}  // namespace tendril::app
