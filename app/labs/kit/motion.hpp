// A path that moves an object over time: the target in the Chain lab, a collider in the Rope lab. It shows
// how a method follows a steady movement, and can be paused and stepped.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "app/fields/fields.hpp"
#include "app/io/json.hpp"
#include "app/io/names.hpp"

namespace tendril::app {

class JsonPlace;

inline constexpr float min_period = 0.1f, max_period = 600.0f;  ///< seconds per round

/// The angle after `seconds`, 0 to 2 pi.
double round_angle(double seconds, float period);

struct Motion {
    enum class Path { Still, Circle, FigureEight, Sweep } path = Path::Still;
    glm::vec3 centre{0.0f};
    float radius = 2.0f;      ///< metres
    float period = 4.0f;      ///< seconds per round
    std::uint32_t ticks = 0;  ///< since the motion started
    bool operator==(const Motion&) const = default;
};
inline constexpr float max_motion_radius = 1e4f;  ///< metres

inline constexpr EnumNames<Motion::Path, 4> motion_paths{"path",
                                                         {{"still", "stands still"},
                                                          {"circle", "in a circle"},
                                                          {"figure_eight", "in a figure eight"},
                                                          {"sweep", "along X"}}};

/// Throws std::invalid_argument, "the target's path would reach farther than 1e9 m", if any point within
/// `span` of the centre is that far out.
void check_path(glm::vec3 centre, glm::vec3 span, const char* what);

/// The point after `ticks` ticks. Circles and figure eights start right of the centre, sweeps at the centre.
glm::vec3 motion_point(const Motion& motion, std::uint32_t ticks);
std::uint32_t ticks_per_round(const Motion& motion);

Motion load_motion(const JsonPlace& place);

}  // namespace tendril::app

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::Motion>() noexcept;
/// The fields path, radius and period.
template <>
std::span<const tendril::app::FieldText> tendril::app::field_texts<tendril::app::Motion>();
