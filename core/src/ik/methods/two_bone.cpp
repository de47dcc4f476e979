// Method::TwoBone: law of cosines, bend side, stretch.
#include "ik/methods/methods.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "ik/math.hpp"
#include "ik/pole/pole.hpp"
#include "ik/solve/validate.hpp"
#include "math/checks.hpp"
#include "math/ranges.hpp"
#include "tendril/elementary.hpp"
#include "tendril/ik/options.hpp"
#include "tendril/ik/two_bone.hpp"

namespace tendril::ik {
namespace {

using namespace detail;

constexpr double equal = 1e-6;    ///< fraction of the reach: the precision of a sum of lengths in floats
constexpr double no_side = 1e-6;  ///< fraction of the reach: smaller offsets are rounding

/// The triangle of root, mid and tip, in metres.
struct Triangle {
    double scale = 1.0;   ///< factor of both bones
    double along = 0.0;   ///< from root to mid, on the line to the target
    double height = 0.0;  ///< height of mid above that line
    double span = 0.0;    ///< from root to tip, along that line
    bool reaches = true;  ///< the tip is exactly at the target
    Status status = Status::Converged;
};

Triangle triangle(double upper, double lower, double distance, const TwoBoneOptions& options) noexcept {
    Triangle t;
    const double reach = upper + lower;
    const double start = static_cast<double>(options.start_stretch_ratio) * reach;
    if (distance > start && start > 0.0) {
        t.scale = std::min(distance / start, static_cast<double>(options.max_stretch_scale));
        // Scaling bones of different lengths scales their difference too: limits the scale so that they still
        // fold to the target.
        const double folded = std::abs(upper - lower);
        if (folded <= distance && folded * t.scale > distance) t.scale = distance / folded;
    }
    const double a = upper * t.scale, b = lower * t.scale;
    const double maximum = a + b, minimum = std::abs(a - b);
    t.span = std::clamp(distance, minimum, maximum);
    t.reaches = t.span == distance;
    if (distance > maximum + equal * reach) t.status = Status::Stretched;
    if (distance < minimum - equal * reach) t.status = Status::TooClose;
    // As products of differences, to avoid cancellation near full reach and when folded.
    t.along = t.span > 0.0 ? 0.5 * (t.span + (a - b) * (a + b) / t.span) : 0.0;
    const double squared = (a - t.along) * (a + t.along);
    t.height = t.span > 0.0 ? std::sqrt(std::max(squared, 0.0)) : a;
    return t;
}

/// The limb as given, relative to its root.
struct Given {
    glm::dvec3 mid, tip, target;
    double reach;
};

/// The limb's direction: to the target, or if that is at the root, its current one.
glm::dvec3 limb_line(const Given& given) noexcept {
    if (const auto ahead = direction_of(given.target, 0.0)) return *ahead;
    if (const auto present = direction_of(given.tip, no_side * given.reach)) return *present;
    // Folded onto itself: any line perpendicular to the bones.
    if (const auto bone = direction_of(given.mid, 0.0)) return perpendicular(*bone);
    return {1.0, 0.0, 0.0};
}

/// Applies to `v`, perpendicular to `from`, the minimal rotation that takes `from` to `to`.
glm::dvec3 transported(const glm::dvec3& v, const glm::dvec3& from, const glm::dvec3& to) noexcept {
    const double w = 1.0 + dot(from, to);
    if (w < 1e-12) return v;  // half a turn, about v itself
    return minus(v, times(plus(from, to), dot(v, to) / w));
}

/// The current bend side, transported to the new line; none for a straight limb.
std::optional<glm::dvec3> present_side(const Given& given, const glm::dvec3& line) noexcept {
    const double minimum = no_side * given.reach;
    const auto from = direction_of(given.tip, minimum);
    if (!from) return direction_of(across(given.mid, line), minimum);
    const auto side = direction_of(across(given.mid, *from), minimum);
    if (!side) return std::nullopt;
    return direction_of(across(transported(*side, *from, line), line), 0.0);
}

glm::dvec3 turned(const glm::dvec3& side, const glm::dvec3& line, double angle) noexcept {
    return plus(times(side, math::cosine(angle)), times(cross(line, side), math::sine(angle)));
}

/// The new bend side. `maximum`: how far it may differ from the current one if there is a pole, radians.
glm::dvec3 side_of(const Given& given, const glm::dvec3& line, const TwoBoneOptions& options,
                   const glm::dvec3& root, double maximum) noexcept {
    const auto present = present_side(given, line);
    const auto twist = static_cast<double>(options.twist);
    std::optional<glm::dvec3> pole;
    if (options.pole) {
        const glm::dvec3 arm = minus(wide(*options.pole), root);
        pole = direction_of(across(arm, line), no_side * std::max(given.reach, length(arm)));
    }
    // A pole on the line defines no side: keep the current one, which already includes the twist.
    if (options.pole && !pole && present) return *present;
    const glm::dvec3 start = pole ? *pole : present ? *present : perpendicular(line);
    const glm::dvec3 wanted = twist != 0.0 ? turned(start, line, twist) : start;
    if (!pole || !present) return wanted;
    const double angle = math::arctangent(dot(cross(*present, wanted), line), dot(*present, wanted));
    return std::abs(angle) <= maximum ? wanted : turned(*present, line, std::copysign(maximum, angle));
}

/// `allowance`: how far the pole may move the middle joint, metres.
TwoBoneResult solve(const TwoBone& limb, const glm::vec3& target, const TwoBoneOptions& options,
                    double allowance) noexcept {
    const glm::dvec3 root = wide(limb.root);
    const double upper = static_cast<double>(limb.upper), lower = static_cast<double>(limb.lower);
    const Given given{minus(wide(limb.mid), root), minus(wide(limb.tip), root), minus(wide(target), root),
                      upper + lower};
    const Triangle t = triangle(upper, lower, length(given.target), options);
    const glm::dvec3 line = limb_line(given);
    const double maximum = t.height > 0.0 ? allowance / t.height : allowance;
    const glm::dvec3 side = side_of(given, line, options, root, maximum);
    const glm::dvec3 mid = plus(times(line, t.along), times(side, t.height));
    TwoBoneResult result;
    result.status = t.status;
    result.mid = narrow(plus(root, mid));
    result.tip = t.reaches ? target : narrow(plus(root, times(line, t.span)));
    result.scale = static_cast<float>(t.scale);
    result.residual = static_cast<float>(length(minus(wide(result.tip), wide(target))));
    return result;
}

constexpr FieldRange bone_lengths{0.0, max_magnitude};
constexpr Field limb_rows[] = {
    field<&TwoBone::root>("root", anywhere, "m"), field<&TwoBone::mid>("mid", anywhere, "m"),
    field<&TwoBone::tip>("tip", anywhere, "m"), field<&TwoBone::upper>("upper", bone_lengths, "m"),
    field<&TwoBone::lower>("lower", bone_lengths, "m")};
constexpr Field two_bone_rows[] = {
    field<&TwoBoneOptions::pole>("pole", {-max_magnitude, max_magnitude}, "m"),
    field<&TwoBoneOptions::start_stretch_ratio>("start_stretch_ratio", stretch_starts).over(),
    field<&TwoBoneOptions::max_stretch_scale>("max_stretch_scale", stretch_scales),
    field<&TwoBoneOptions::twist>("twist", {-max_magnitude, max_magnitude}, "rad")};

Result check_limb(const TwoBone& limb, const glm::vec3& target, const TwoBoneOptions& options) noexcept {
    using namespace tendril::detail;
    constexpr const char* op = "two_bone";
    if (!are_in_range<limb_rows>(&limb)) return check_fields(op, limb, "limb");
    if (const Result bad = check_point(op, "target", target); !bad) return bad;
    return are_in_range<two_bone_rows>(&options) ? Result() : check_fields(op, options);
}

}  // namespace

TwoBoneResult two_bone(const TwoBone& limb, glm::vec3 target, const TwoBoneOptions& options) noexcept {
    if (const Result bad = check_limb(limb, target, options); !bad) {
        auto unmoved = detail::refusal<TwoBoneResult>(bad);
        unmoved.mid = limb.mid, unmoved.tip = limb.tip;
        return unmoved;
    }
    return solve(limb, target, options, std::numeric_limits<double>::infinity());
}

namespace detail {

std::optional<glm::vec3> pole_of_limb(const Problem& problem) noexcept {
    if (!problem.options.plane) return problem.options.pole;
    const glm::dvec3 root = wide(problem.root()), to_target = minus(wide(problem.target), root);
    const glm::dvec3 line =
        limb_line({minus(wide(problem.joints[1]), root), minus(wide(problem.joints[2]), root), to_target,
                   static_cast<double>(problem.scratch.reach)});
    return narrow(plus(root, times(planar_side(problem, line), static_cast<double>(problem.scratch.reach))));
}

template <class Watch>
Report two_bone_solve(Problem& problem, Watch watch) noexcept {
    if (problem.bones() != 2) return refusal<Report>(check_takes(Method::TwoBone, problem.bones()));
    const Options& options = problem.options;
    const std::span<glm::vec3> joints = problem.joints;
    const TwoBone limb{joints[0], joints[1], joints[2], problem.lengths()[0], problem.lengths()[1]};
    const double allowance = options.pole ? pole_allowance(problem) : std::numeric_limits<double>::infinity();
    const TwoBoneResult result =
        solve(limb, problem.target,
              {pole_of_limb(problem), options.start_stretch_ratio, options.max_stretch_scale, options.twist},
              allowance);
    watch.moved(problem.iteration, Phase::Analytic, 1, 0, joints[1], result.mid);
    watch.moved(problem.iteration, Phase::Analytic, 2, 1, joints[2], result.tip);
    watch.next_step();
    joints[1] = result.mid;
    joints[2] = result.tip;
    remember_pose(problem);
    const bool there = result.residual <= problem.tolerance && result.status == Status::Converged;
    problem.closed_form = true;
    problem.stretch = result.scale;
    return problem.report(there ? Status::Converged : result.status, result.residual);
}

template Report two_bone_solve(Problem&, Unwatched) noexcept;
template Report two_bone_solve(Problem&, Watched) noexcept;

}  // namespace detail
}  // namespace tendril::ik

template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::TwoBone>() noexcept {
    return ik::limb_rows;
}
template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::TwoBoneResult>() noexcept {
    using ik::TwoBoneResult;
    static const Field rows[] = {
        field<&TwoBoneResult::status>("status", field_of<&ik::Report::status>().choices),
        field<&TwoBoneResult::mid>("mid", ik::detail::anywhere, "m"),
        field<&TwoBoneResult::tip>("tip", ik::detail::anywhere, "m"),
        field<&TwoBoneResult::scale>("scale", {1.0, 100.0}),
        field<&TwoBoneResult::residual>("residual", {0.0, std::numeric_limits<double>::infinity()}, "m")};
    return rows;
}
template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::TwoBoneOptions>() noexcept {
    return ik::two_bone_rows;
}
