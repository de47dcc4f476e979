// The tables of Options and Plane, and the checks of a solve's input.
#include "ik/solve/validate.hpp"

#include <algorithm>

#include "math/checks.hpp"
#include "math/ranges.hpp"
#include "math/vector.hpp"
#include "tendril/ik/options.hpp"

namespace tendril::ik {
namespace {

constexpr const char* sides[] = {"free", "left", "right"};

constexpr std::uint16_t bit(Method method) noexcept {
    return static_cast<std::uint16_t>(1u << static_cast<unsigned>(method));
}
constexpr std::uint16_t none = 0, fabrik = bit(Method::Fabrik), two_bone = bit(Method::TwoBone),
                        damped = bit(Method::Dls) | bit(Method::SvdDls), damped_or_two = damped | two_bone,
                        all = bit(Method::TwoBone) * 2 - 1, iterating = all - two_bone;

constexpr Field option_rows[] = {
    field<&Options::tolerance>("tolerance", {0.0, max_magnitude}, "m"),
    field<&Options::max_iterations>("max_iterations", {1, 1'000'000}).by(iterating, all),
    field<&Options::every_iteration>("every_iteration").by(iterating, all),
    list<&Options::limits>("limits"),
    nested<&Options::plane>("plane"),
    field<&Options::pole>("pole", detail::anywhere, "m"),
    field<&Options::pole_turn>("pole_turn", detail::turn_names).by(iterating, none),
    field<&Options::snap_back>("snap_back").by(iterating, all),
    field<&Options::tip_orientation>("tip_orientation", unit_length),
    field<&Options::soft_zone>("soft_zone"),
    field<&Options::damping>("damping", {0.0, 10.0}).over().by(damped, damped_or_two),
    field<&Options::start_stretch_ratio>("start_stretch_ratio", detail::stretch_starts)
        .over()
        .by(two_bone, none),
    field<&Options::max_stretch_scale>("max_stretch_scale", detail::stretch_scales).by(two_bone, none),
    field<&Options::twist>("twist", detail::anywhere, "rad").by(two_bone, two_bone),
    field<&Options::weight>("weight"),
    field<&Options::restarts>("restarts", {0, 1000}).by(none, fabrik),
    field<&Options::rotations>("rotations").by(all, none),
    list<&Options::residuals>("residuals", {0.0, max_magnitude}, "m")};
constexpr Field plane_rows[] = {field<&Plane::normal>("normal", detail::anywhere),
                                field<&Plane::bend>("bend", sides), list<&Plane::limits>("limits")};

}  // namespace

const char* name(Side side) noexcept {
    return sides[static_cast<std::size_t>(side)];
}

bool honours(Method method, const Field& option, bool within_limits) noexcept {
    return ((within_limits ? option.within_limits : option.without_limits) & bit(method)) != 0;
}

Result check_takes(Method method, std::size_t bones) noexcept {
    using namespace tendril::detail;
    if (method > Method::TwoBone)
        return refused("solve", "method", "one of all_methods", static_cast<int>(method));
    if (method != Method::TwoBone || bones == 2) return {};
    return {ErrorCode::InvalidArgument, "Two-bone needs exactly two bones"};
}

}  // namespace tendril::ik

template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::Options>() noexcept {
    return ik::option_rows;
}

template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::Plane>() noexcept {
    return ik::plane_rows;
}

namespace tendril::ik::detail {

using namespace tendril::detail;

bool are_points(std::span<const glm::vec3> points) noexcept {
    return std::all_of(points.begin(), points.end(), is_point);
}

Result check(const Options& options, std::size_t bones) noexcept {
    if (!are_in_range<option_rows>(&options)) return check_fields("solve", options);
    if (!options.limits.empty() && options.limits.size() != bones)
        return refused_count("solve", "limits", options.limits.size(), bones);
    if (!options.plane) return {};
    if (!options.limits.empty())
        return refused_count("solve", "limits beside a plane", options.limits.size(), 0);
    return check(*options.plane, bones);
}

Result check(const Plane& plane, std::size_t bones) noexcept {
    if (!are_in_range<plane_rows>(&plane)) return check_fields("solve: plane", plane);
    if (const float size = math::length(plane.normal); !(size > 1e-6f))
        return refused("solve", "plane.normal", "longer than 1e-6", size);
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
