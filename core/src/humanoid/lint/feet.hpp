// Where the feet of a clip are, frame by frame. Not installed.
#pragma once

#include <cmath>
#include <vector>

#include "humanoid/limb.hpp"
#include "humanoid/lint/lint.hpp"

namespace tendril::humanoid::lint_detail {

using detail::Limb;

/// A point of the sole: a node of the foot, put down by as much as it is above the ground when the foot
/// stands flat. It is not turned with the foot, so that what is not known of the sole adds nothing where the
/// foot is tilted. That is why these are not find_soles()'s heel and toe, which foot IK has to turn along:
/// those are guessed from the rest pose, and a clip is not to be blamed for a guess.
struct SolePoint {
    std::size_t node;
    double above;  ///< metres
};

struct Foot {
    std::int32_t node = -1;
    std::vector<SolePoint> points{};  ///< ankle, ball and tip, as far as they are there
    glm::dvec3 flat{0.0, 1.0, 0.0};   ///< which way is up in the foot's own space when it stands flat
    // By frame:
    std::vector<glm::dvec3> positions{};  ///< of all points
    std::vector<glm::dvec3> ups{};        ///< which way is up in the foot's own space
    std::vector<double> speed{};          ///< of the point that moves the least, m/s
    std::vector<double> jolt{};           ///< m/s to the frame and from it, the slower: it stands apart
    std::vector<bool> still{};            ///< it does not move, up and down neither
    std::vector<double> height{};         ///< of the lowest point
    std::vector<double> tilt{};           ///< against how it stands flat, degrees

    const glm::dvec3& at(std::size_t point, std::size_t frame) const noexcept {
        return positions[frame * points.size() + point];
    }
};

struct FeetMotion {
    std::vector<Foot> feet{};        ///< none, one or two
    std::vector<glm::dvec3> hips{};  ///< by frame
    glm::dvec3 treadmill{0.0};       ///< the ground's velocity under a figure that walks in place, m/s
    bool always_slides = false;      ///< no foot is ever still
    bool rests_on_ground = false;    ///< the figure stands flat on height 0 when it rests
    bool knows_soles = false;        ///< it stands as it rests: how it rests tells where the soles are
};
FeetMotion feet_motion(const Check& check);

/// The floor that feet stand on: where the figure rests on the ground that, if feet stand there in the clip
/// for a fifth of the time in which they stand at all; or else where they stand most. None where they hardly
/// do.
std::optional<double> floor_of(const FeetMotion& motion, double rate);
/// How the point of the sole moves that moves the least between the frame before and this one, the ground's
/// own way taken away.
glm::dvec3 smallest_move(const Foot& foot, std::size_t frame, const glm::dvec3& ground);
/// What ends in that foot; none where thigh or shin are missing.
std::optional<Limb> leg_of(const Skeleton& skeleton, const BoneMap& map, std::int32_t foot);

/// Metres, seen from above.
inline double level(const glm::dvec3& v) noexcept {
    return std::sqrt(v.x * v.x + v.z * v.z);
}
/// The middle of the densest `width` of sorted values, of which there is one.
double densest(const std::vector<double>& sorted, double width);

}  // namespace tendril::humanoid::lint_detail
