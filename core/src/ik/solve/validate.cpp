#include "ik/solve/validate.hpp"

#include <algorithm>
#include <cmath>

#include "math/checks.hpp"
#include "math/vector.hpp"
#include "tendril/ik/options.hpp"

namespace tendril::ik::detail {
namespace {

bool over_zero(float value, float maximum) noexcept {
    return value > 0.0f && value <= maximum;
}

}  // namespace

bool are_points(std::span<const glm::vec3> points) noexcept {
    return std::all_of(points.begin(), points.end(), tendril::detail::is_point);
}

bool are_valid(const Options& options, std::size_t bones) noexcept {
    if (options.tolerance && !within(*options.tolerance, 0.0f, max_magnitude)) return false;
    if (options.max_iterations < 1 || options.max_iterations > 1'000'000) return false;
    if (!options.limits.empty() && options.limits.size() != bones) return false;
    if (options.pole && !tendril::detail::is_point(*options.pole)) return false;
    if (options.pole_turn > PoleTurn::EachJoint) return false;
    if (!within(options.snap_back, 0.0f, 1.0f)) return false;
    if (options.tip_orientation && !is_unit(*options.tip_orientation)) return false;
    if (!within(options.soft_zone, 0.0f, 1.0f)) return false;
    if (!over_zero(options.damping, 10.0f)) return false;
    if (!over_zero(options.start_stretch_ratio, 1.0f)) return false;
    if (!within(options.max_stretch_scale, 1.0f, 100.0f)) return false;
    if (!within(options.weight, 0.0f, 1.0f)) return false;
    if (options.restarts && (*options.restarts < 0 || *options.restarts > 1000)) return false;
    if (options.plane && (!options.limits.empty() || !is_valid(*options.plane, bones))) return false;
    return within(options.twist, -max_magnitude, max_magnitude);
}

bool is_valid(const Plane& plane, std::size_t bones) noexcept {
    if (!tendril::detail::is_point(plane.normal) || !(math::length(plane.normal) > 1e-6f)) return false;
    if (plane.bend > Side::Right || (!plane.limits.empty() && plane.limits.size() != bones)) return false;
    return std::none_of(plane.limits.begin(), plane.limits.end(),
                        [](const AngleLimit& limit) { return fault(limit) != nullptr; });
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
