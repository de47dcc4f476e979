// Plans the feet of a retargeted motion, and the movement of the hips for them. Not installed.
//
// Each leg starts out pointing like the source's. While the source's foot stands, the ankle is displaced so
// that the sole stays on the ground; between stances, one displacement blends into the next.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "humanoid/limb.hpp"
#include "humanoid/lint/feet.hpp"

namespace tendril::humanoid::detail {

/// A foot of the target in one frame, before it is displaced.
struct PointedFoot {
    glm::dvec3 hip{0.0}, ankle{0.0};
    double leg = 0.0;                  ///< length of thigh and shin
    std::array<glm::dvec3, 3> sole{};  ///< from the ankle to heel, ball and tip of the toes
    double source_low = 0.0;           ///< height of the lowest point of the source's sole, source metres
};
struct PointedFrame {
    glm::dvec3 hips{0.0};
    std::array<PointedFoot, 2> feet{};  ///< left, right
};

/// The parts of both figures that the plan needs.
struct FootingTask {
    const lint_detail::FeetMotion& motion;  ///< the source's feet
    const std::vector<PointedFrame>& frames;
    double rate = 30.0;                    ///< frames per second
    double scale = 1.0;                    ///< target metres per source metre
    double leg = 1.0;                      ///< the target's leg length
    double floor = 0.0;                    ///< the target's floor
    double shift = 0.0;                    ///< lift of the hips if no foot stands
    std::optional<double> source_floor{};  ///< floor of the source's clip; none if feet hardly stand
    double ground = 0.0;                   ///< the source's floor at rest
    glm::dquat turn{1.0, 0.0, 0.0, 0.0};   ///< from the source's space to the target's
};

struct Footing {
    double hips = 0.0;                 ///< lift of the hips, metres
    std::array<glm::dvec3, 2> feet{};  ///< moves of the ankles, metres
};

/// One for each frame.
std::vector<Footing> plan_feet(const FootingTask& task);

}  // namespace tendril::humanoid::detail
