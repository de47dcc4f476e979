// Positions of a clip's feet, frame by frame. Not installed.
#pragma once

#include <cmath>
#include <vector>

#include "humanoid/limb.hpp"
#include "humanoid/lint/lint.hpp"

namespace tendril::humanoid::lint_detail {

using detail::Limb;

inline constexpr double min_stance = 0.15;  // seconds

struct Foot {
    std::int32_t node = -1;
    std::vector<SolePoint> points{};  ///< ankle, ball and tip, if present
    glm::dvec3 flat{0.0, 1.0, 0.0};   ///< up, in the foot's own space, when it stands flat
    // By frame:
    std::vector<glm::dvec3> positions{};  ///< positions of all points
    std::vector<glm::dvec3> ups{};        ///< up, in the foot's own space
    std::vector<double> speed{};          ///< speed of the point that moves the least, m/s
    std::vector<double> min_speed{};      ///< the slower of the speeds into and out of the frame, m/s
    std::vector<bool> still{};            ///< no movement, not even vertically
    std::vector<bool> upright{};          ///< the hips are up: the figure neither sits nor lies
    std::vector<double> height{};         ///< height of the lowest point
    std::vector<double> tilt{};           ///< from standing flat, degrees

    bool is_loaded(std::size_t frame) const { return still[frame] && upright[frame]; }
    const glm::dvec3& at(std::size_t point, std::size_t frame) const noexcept {
        return positions[frame * points.size() + point];
    }
};

struct FeetMotion {
    std::vector<Foot> feet{};        ///< none, one or two
    std::vector<glm::dvec3> hips{};  ///< by frame
    glm::dvec3 treadmill{0.0};       ///< the ground's velocity under a figure that walks in place, m/s
    bool always_slides = false;      ///< no foot is ever still
    bool rests_on_ground = false;    ///< in the rest pose the feet stand flat near height 0
    bool has_soles = false;          ///< feet stand as in the rest pose, which then gives the soles
    /// Height of the floor that feet stand on: near 0 if the figure rests on the ground and at least a fifth
    /// of the still frames are there, otherwise the most common height. If it rests on the ground, still feet
    /// elsewhere are ignored while it sits or lies. nullopt if feet hardly stand.
    std::optional<double> floor{};
};
/// If the check's report has the whole clip's feet, only positions and speeds are those of the judged frames.
FeetMotion feet_motion(const Check& check);
struct FrameRange {
    std::size_t first, last;  // frames
};
/// Frames in which the foot stands on the floor.
std::vector<FrameRange> stances_of(const Foot& foot, double floor, double rate);
/// The motion, since the frame before, of the point of the sole that moves the least, minus `ground`, the
/// ground's own motion.
glm::dvec3 smallest_move(const Foot& foot, std::size_t frame, const glm::dvec3& ground);
/// The leg that ends in that foot; nullopt if hips, thigh or shin are missing or not connected.
std::optional<Limb> leg_of(const Skeleton& skeleton, const BoneMap& map, std::int32_t foot);

/// Horizontal length.
inline double level(const glm::dvec3& v) noexcept {
    return std::sqrt(v.x * v.x + v.z * v.z);
}
/// The middle value of the densest range of `width` in sorted values, at least one.
double densest(const std::vector<double>& sorted, double width);

}  // namespace tendril::humanoid::lint_detail
