#include "ik/solve/validate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/checks.hpp"
#include "math/vector.hpp"
#include "tendril/ik/options.hpp"

namespace tendril::ik::detail {
namespace {

using namespace tendril::detail;

constexpr float over_zero = std::numeric_limits<float>::denorm_min();

constexpr struct {
    const char* name;
    float Options::*member;
    float low, high;
    const char* range;
} numbers[]{{"snap_back", &Options::snap_back, 0.0f, 1.0f, "from 0 to 1"},
            {"soft_zone", &Options::soft_zone, 0.0f, 1.0f, "from 0 to 1"},
            {"damping", &Options::damping, over_zero, 10.0f, "over 0 to 10"},
            {"start_stretch_ratio", &Options::start_stretch_ratio, over_zero, 1.0f, "over 0 to 1"},
            {"max_stretch_scale", &Options::max_stretch_scale, 1.0f, 100.0f, "from 1 to 100"},
            {"weight", &Options::weight, 0.0f, 1.0f, "from 0 to 1"},
            {"twist", &Options::twist, -max_magnitude, max_magnitude, "at most 1e9 in magnitude"}};

}  // namespace

bool are_points(std::span<const glm::vec3> points) noexcept {
    return std::all_of(points.begin(), points.end(), is_point);
}

Result check(const Options& options, std::size_t bones) noexcept {
    if (const float tolerance = options.tolerance.value_or(0.0f); !within(tolerance, 0.0f, max_magnitude))
        return refused("solve", "tolerance", "from 0 to 1e9", tolerance);
    for (const auto& [name, member, low, high, range] : numbers)
        if (!within(options.*member, low, high)) return refused("solve", name, range, options.*member);
    if (options.max_iterations < 1 || options.max_iterations > 1'000'000)
        return refused("solve", "max_iterations", "from 1 to 1000000", options.max_iterations);
    if (options.restarts && (*options.restarts < 0 || *options.restarts > 1000))
        return refused("solve", "restarts", "from 0 to 1000", *options.restarts);
    if (options.pole_turn > PoleTurn::EachJoint)
        return refused("solve", "pole_turn", "0 or 1", static_cast<int>(options.pole_turn));
    if (options.pole && !is_point(*options.pole)) return refused_point("solve", "pole", *options.pole);
    if (const auto& q = options.tip_orientation; q && !is_unit(*q))
        return refused("solve", "tip_orientation", "of length 1",
                       std::sqrt(q->w * q->w + q->x * q->x + q->y * q->y + q->z * q->z));
    if (!options.limits.empty() && options.limits.size() != bones)
        return refused_count("solve", "limits", options.limits.size(), bones);
    if (!options.plane) return {};
    if (!options.limits.empty())
        return refused_count("solve", "limits beside a plane", options.limits.size(), 0);
    return check(*options.plane, bones);
}

Result check(const Plane& plane, std::size_t bones) noexcept {
    if (!is_point(plane.normal)) return refused_point("solve", "plane.normal", plane.normal);
    if (const float size = math::length(plane.normal); !(size > 1e-6f))
        return refused("solve", "plane.normal", "longer than 1e-6", size);
    if (plane.bend > Side::Right)
        return refused("solve", "plane.bend", "0 to 2", static_cast<int>(plane.bend));
    if (!plane.limits.empty() && plane.limits.size() != bones)
        return refused_count("solve", "plane.limits", plane.limits.size(), bones);
    for (std::size_t i = 0; i < plane.limits.size(); ++i)
        if (const char* const wrong = fault(plane.limits[i]))
            return refused("solve", {"plane.limits", i}, "a valid limit", wrong);
    return {};
}

bool is_valid(const State& state, std::size_t bones) noexcept {
    if (state.rotations.size() != bones || state.pole.joints.size() != bones + 1) return false;
    if (!std::all_of(state.rotations.begin(), state.rotations.end(), is_unit)) return false;
    if (state.side > Side::Right) return false;
    if (state.limits.valid && !within(state.limits.damping, 0.0f, 100.0f)) return false;
    return !state.pole.valid || static_cast<bool>(check(state, bones));
}

bool takes(Method method, std::size_t bones) noexcept {
    if (method > Method::TwoBone) return false;
    return method != Method::TwoBone || bones == 2;
}

}  // namespace tendril::ik::detail
