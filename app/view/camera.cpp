#include "app/view/camera.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace tendril::app {
namespace {

constexpr float quarter_turn = camera_range::pitch;

float bounded(float value, float low, float high, float fallback) {
    return std::isfinite(value) ? std::clamp(value, low, high) : fallback;
}

/// Clamps a pose to its valid range, so that no scene file or gesture can break the picture.
CameraPose in_range(CameraPose pose) {
    for (int i = 0; i < 3; ++i)
        pose.target[i] = bounded(pose.target[i], -camera_range::target, camera_range::target, 0.0f);
    pose.yaw = std::isfinite(pose.yaw) ? std::remainder(pose.yaw, glm::two_pi<float>()) : 0.0f;
    pose.pitch = bounded(pose.pitch, -quarter_turn, quarter_turn, 0.0f);
    pose.distance = bounded(pose.distance, static_cast<float>(camera_range::nearest),
                            static_cast<float>(camera_range::farthest), 10.0f);
    pose.field_of_view = bounded(pose.field_of_view, camera_range::narrowest, camera_range::widest, 0.70f);
    return pose;
}

Rect in_range(const Rect& viewport) {
    constexpr float max_pixels = 1e5f;
    const auto pixels = [](glm::vec2 p) {
        return glm::vec2(bounded(p.x, -max_pixels, max_pixels, 0.0f),
                         bounded(p.y, -max_pixels, max_pixels, 0.0f));
    };
    const glm::vec2 low = pixels(viewport.min);
    return {low, glm::max(pixels(viewport.max), low + 1.0f)};
}

/// Tangent of half the vertical field of view. Views narrower than 5:4 keep the field's width instead of its
/// height, so that a scene that fits a wide window still fits when panels or large text make the view narrow.
float half_field(const CameraPose& pose, float aspect) {
    constexpr float narrow = 1.25f, widest = 4.0f;
    return std::tan(0.5f * pose.field_of_view) * std::clamp(narrow / aspect, 1.0f, widest);
}

}  // namespace

Camera::Camera(const CameraPose& pose, const Rect& viewport)
    : pose_(in_range(pose)), viewport_(in_range(viewport)) {
    const float sin_yaw = std::sin(pose_.yaw), cos_yaw = std::cos(pose_.yaw);
    const float sin_pitch = std::sin(pose_.pitch), cos_pitch = std::cos(pose_.pitch);
    // Computed from the angles rather than by cross products with world up, so that looking straight down is
    // no special case.
    forward_ = {-sin_yaw * cos_pitch, -sin_pitch, -cos_yaw * cos_pitch};
    right_ = {cos_yaw, 0.0f, -sin_yaw};
    up_ = {-sin_yaw * sin_pitch, cos_pitch, -cos_yaw * sin_pitch};
    eye_ = pose_.target - forward_ * pose_.distance;
    view_ = glm::mat4(
        glm::vec4(right_.x, up_.x, -forward_.x, 0.0f), glm::vec4(right_.y, up_.y, -forward_.y, 0.0f),
        glm::vec4(right_.z, up_.z, -forward_.z, 0.0f),
        glm::vec4(-glm::dot(right_, eye_), -glm::dot(up_, eye_), glm::dot(forward_, eye_), 1.0f));

    const glm::vec2 size = viewport_.size();
    const float aspect = size.x / size.y;
    const float field = half_field(pose_, aspect);
    metres_per_pixel_at_one_ = 2.0f * field / size.y;
    if (pose_.orthographic) {
        // A parallel projection has no eye point, so nothing in front is clipped either.
        const float half = pose_.distance * field, reach = 100.0f * pose_.distance;
        near_ = -reach;
        projection_ = glm::ortho(-half * aspect, half * aspect, -half, half, -reach, reach);
    } else {
        near_ = 0.01f * pose_.distance;
        projection_ = glm::perspective(2.0f * std::atan(field), aspect, near_, 1000.0f * pose_.distance);
    }
}

float Camera::depth(glm::vec3 point) const {
    return glm::dot(point - eye_, forward_);
}

std::optional<glm::vec2> Camera::project(glm::vec3 point) const {
    const glm::vec3 from_eye = point - eye_;
    const float along = glm::dot(from_eye, forward_);
    if (!pose_.orthographic && !(along > 0.0f)) return std::nullopt;
    const glm::vec2 side(glm::dot(from_eye, right_), -glm::dot(from_eye, up_));
    const float away = pose_.orthographic ? pose_.distance : along;
    const glm::vec2 pixel = viewport_.centre() + side / (metres_per_pixel_at_one_ * away);
    if (!std::isfinite(pixel.x) || !std::isfinite(pixel.y)) return std::nullopt;
    return pixel;
}

float Camera::metres_per_pixel(glm::vec3 point) const {
    const float away = pose_.orthographic ? pose_.distance : std::max(depth(point), near_);
    return metres_per_pixel_at_one_ * away;
}

Ray Camera::ray(glm::vec2 pixel) const {
    const glm::vec2 side = (pixel - viewport_.centre()) * metres_per_pixel_at_one_;
    const glm::vec3 offset = right_ * side.x - up_ * side.y;
    if (pose_.orthographic) return {eye_ + offset * pose_.distance, forward_};
    return {eye_, glm::normalize(forward_ + offset)};
}

std::optional<glm::vec3> Camera::on_plane(glm::vec2 pixel, glm::vec3 through, glm::vec3 normal) const {
    const Ray sight = ray(pixel);
    const float slope = glm::dot(sight.direction, normal);
    // Edge-on, one pixel would span kilometres.
    if (!(std::abs(slope) > 1e-4f * glm::length(normal))) return std::nullopt;
    const float along = glm::dot(through - sight.origin, normal) / slope;
    if (!std::isfinite(along) || (along <= 0.0f && !pose_.orthographic)) return std::nullopt;
    return sight.origin + sight.direction * along;
}

CameraPose orbited(const CameraPose& pose, glm::vec2 pixels) {
    constexpr float radians_per_pixel = 0.006f;
    CameraPose moved = in_range(pose);
    moved.yaw -= radians_per_pixel * pixels.x;
    moved.pitch += radians_per_pixel * pixels.y;
    return in_range(moved);
}

CameraPose panned(const Camera& camera, glm::vec2 pixels) {
    CameraPose moved = camera.pose();
    const float scale = camera.metres_per_pixel(moved.target);
    moved.target += scale * (camera.up() * pixels.y - camera.right() * pixels.x);
    return in_range(moved);
}

CameraPose zoomed(const Camera& camera, glm::vec2 cursor, float notches) {
    const CameraPose& pose = camera.pose();
    CameraPose moved = pose;
    moved.distance = in_range(CameraPose{.distance = pose.distance * std::pow(1.15f, -notches)}).distance;
    // Everything in the target's plane scales uniformly: keep the point under the cursor fixed.
    const glm::vec2 offset = (cursor - camera.viewport().centre()) * camera.metres_per_pixel(pose.target);
    const float left = 1.0f - moved.distance / pose.distance;
    moved.target += left * (camera.right() * offset.x - camera.up() * offset.y);
    return in_range(moved);
}

CameraPose framed(const CameraPose& pose, const Rect& viewport, glm::vec3 centre, float radius) {
    constexpr float margin = 1.12f;
    CameraPose moved = in_range(pose);
    moved.target = centre;
    const glm::vec2 size = in_range(viewport).size();
    const float aspect = size.x / size.y;
    const float tangent = half_field(moved, aspect) * std::min(1.0f, aspect);
    // In perspective the line of sight is tangent to the ball's outline: use the sine of the half angle.
    const float sine = tangent / std::sqrt(1.0f + tangent * tangent);
    if (radius > 0.0f) moved.distance = margin * radius / (moved.orthographic ? tangent : sine);
    return in_range(moved);
}

CameraPose turned_to(const CameraPose& pose, FixedView view) {
    CameraPose moved = in_range(pose);
    moved.yaw = view == FixedView::Side ? quarter_turn : 0.0f;
    moved.pitch = view == FixedView::Top ? quarter_turn : 0.0f;
    return moved;
}

}  // namespace tendril::app
