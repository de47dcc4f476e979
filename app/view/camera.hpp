// The camera of one rectangle of the window: world to pixels and back, and the user's camera moves. Pixels
// are window coordinates from the top left, like the mouse's and those in --state.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "app/document/camera_pose.hpp"

namespace tendril::app {

struct Rect {
    glm::vec2 min{0.0f};
    glm::vec2 max{0.0f};
    glm::vec2 size() const { return max - min; }
    glm::vec2 centre() const { return 0.5f * (min + max); }
    bool contains(glm::vec2 p) const { return p.x >= min.x && p.y >= min.y && p.x < max.x && p.y < max.y; }
    bool operator==(const Rect&) const = default;
};

struct Ray {
    glm::vec3 origin{0.0f};
    glm::vec3 direction{0.0f, 0.0f, -1.0f};  ///< unit length
};

class Camera {
  public:
    Camera(const CameraPose& pose, const Rect& viewport);

    const CameraPose& pose() const { return pose_; }
    const Rect& viewport() const { return viewport_; }
    const glm::mat4& view() const { return view_; }
    const glm::mat4& projection() const { return projection_; }
    glm::vec3 eye() const { return eye_; }
    glm::vec3 forward() const { return forward_; }
    glm::vec3 right() const { return right_; }
    glm::vec3 up() const { return up_; }
    float near_plane() const { return near_; }

    /// The pixel of a point; none if it is behind the eye.
    std::optional<glm::vec2> project(glm::vec3 point) const;
    /// Distance along the viewing direction.
    float depth(glm::vec3 point) const;
    /// The line of sight through a pixel.
    Ray ray(glm::vec2 pixel) const;
    /// Metres per pixel at the point's depth; positive even behind the eye.
    float metres_per_pixel(glm::vec3 point) const;
    /// The point where the pixel's ray meets the plane; none if they are parallel or it is behind the eye.
    std::optional<glm::vec3> on_plane(glm::vec2 pixel, glm::vec3 through, glm::vec3 normal) const;

  private:
    CameraPose pose_;
    Rect viewport_;
    glm::mat4 view_{1.0f};
    glm::mat4 projection_{1.0f};
    glm::vec3 eye_{0.0f}, forward_{0.0f}, right_{0.0f}, up_{0.0f};
    float near_ = 0.01f;
    float metres_per_pixel_at_one_ = 0.0f;  ///< at a depth of 1 m; orthographic: multiply by the distance
};

/// Camera moves; each returns the new pose, clamped to its valid range. Pixels are mouse movements.
CameraPose orbited(const CameraPose& pose, glm::vec2 pixels);
CameraPose panned(const Camera& camera, glm::vec2 pixels);
/// One notch is a factor of 1.15; the point under the cursor in the target's plane stays in place.
CameraPose zoomed(const Camera& camera, glm::vec2 cursor, float notches);
/// Fits the sphere into the viewport, keeping the direction. A radius of 0 only moves the target.
CameraPose framed(const CameraPose& pose, const Rect& viewport, glm::vec3 centre, float radius);

enum class FixedView { Front, Side, Top };
CameraPose turned_to(const CameraPose& pose, FixedView view);

}  // namespace tendril::app
