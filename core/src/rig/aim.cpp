#include "tendril/rig/aim.hpp"

#include "rig/checks.hpp"
#include "rig/math.hpp"

namespace tendril::rig {
namespace {

using namespace detail;
using Direction = std::optional<glm::dvec3>;

constexpr double min_length = 1e-9, min_sine = 1e-6;

struct Target {
    Direction direction;
    double weight;
};

Target target_of(const AimPart& part, const Transform& item, double total_weight) noexcept {
    const glm::dvec3 offset =
        part.kind == AimTarget::Location ? minus(part.target, item.translation) : part.target;
    return {direction_of(offset, min_length), weight(part.weight) * total_weight};
}

/// `from` blended towards `to` along the chord. Halfway to the opposite direction the chord passes through
/// zero; the result is then a quarter turn about the axis of the half turn.
glm::dvec3 blend_direction(const glm::dvec3& from, const glm::dvec3& to, double part,
                           const glm::dvec3& side) noexcept {
    if (part == 1.0) return to;
    return direction_of(mix(from, to, part), min_length).value_or(cross(side, from));
}

AimWarning turn_primary(glm::dquat& rotation, const glm::dvec3& axis, const Target& target) noexcept {
    const Direction from = direction_of(rotated(rotation, axis), min_length);
    if (!from) return AimWarning::ZeroAxis;
    if (!target.direction) return AimWarning::TargetAtItem;
    const glm::dvec3 to = blend_direction(*from, *target.direction, target.weight, perpendicular(*from));
    rotation = normalised(math::compose(minimal_rotation(*from, to), rotation));
    return AimWarning::None;
}

/// The rotation about `about` from one unit vector to another, both perpendicular to it.
glm::dquat roll_between(const glm::dvec3& from, const glm::dvec3& to, const glm::dvec3& about) noexcept {
    const double w = 1.0 + dot(from, to), sine = dot(cross(from, to), about);
    if (w < math::nearly_opposite<double>) return {0.0, about.x, about.y, about.z};
    return unit_quaternion(w, about.x * sine, about.y * sine, about.z * sine);
}

/// Rolls the rotation about `about`, the primary axis after the primary part.
AimWarning roll_secondary(glm::dquat& rotation, const glm::dvec3& axis, const Target& target,
                          const glm::dvec3& about) noexcept {
    const Direction along = direction_of(rotated(rotation, axis), min_length);
    if (!along) return AimWarning::ZeroAxis;
    if (!target.direction) return AimWarning::TargetAtItem;
    const Direction from = direction_of(across(*along, about), min_sine);
    if (!from) return AimWarning::AxesParallel;
    const Direction to = direction_of(across(*target.direction, about), min_sine);
    if (!to) return AimWarning::TargetOnAxis;
    const glm::dvec3 goal = blend_direction(*from, *to, target.weight, about);
    const glm::dquat roll = roll_between(*from, goal, about);
    rotation = normalised(math::compose(roll, rotation));
    return AimWarning::None;
}

/// `from` turned towards `to` by at most `radians`; `from` if that is negative or NaN.
glm::dquat limited(const glm::dquat& from, const glm::dquat& to, double radians) noexcept {
    const double angle = 2.0 * half_angle_between(from, to);
    return angle <= radians ? to : blend(from, to, radians / angle);
}

Result check_axis(std::string_view operation, std::string_view argument, const glm::dvec3& axis) noexcept {
    const double size = length(axis);
    return size > min_length ? Result() : refused(operation, argument, "longer than 1e-9", size);
}

}  // namespace

Result check(const AimOptions& options, const char* operation) noexcept {
    if (const Result bad = check_fields(operation, options); !bad) return bad;
    if (const Result bad = check_axis(operation, "primary.axis", options.primary.axis); !bad) return bad;
    return check_axis(operation, "secondary.axis", options.secondary.axis);
}

AimResult aim(const Transform& item, const AimOptions& options, double dt) noexcept {
    AimResult result{item, AimWarning::None, AimWarning::None};
    const double total_weight = weight(options.weight);
    const Target first = target_of(options.primary, item, total_weight);
    const Target second = target_of(options.secondary, item, total_weight);
    glm::dquat rotation = item.rotation;
    if (first.weight > 0.0) result.primary = turn_primary(rotation, options.primary.axis, first);
    if (second.weight > 0.0) {
        const Direction about = direction_of(rotated(rotation, options.primary.axis), min_length);
        result.secondary =
            about ? roll_secondary(rotation, options.secondary.axis, second, *about) : AimWarning::ZeroAxis;
    }
    if (options.max_speed < std::numeric_limits<double>::infinity()) {
        const double radians = std::max(options.max_speed, 0.0) * dt;
        rotation = limited(item.rotation, rotation, radians);
    }
    result.transform.rotation = rotation;
    return result;
}

const char* name(AimWarning warning) noexcept {
    constexpr const char* texts[] = {"", "the axis is zero", "the target is at the item itself",
                                     "the second target is on the primary axis",
                                     "the secondary axis is the primary one"};
    const auto index = static_cast<std::size_t>(warning);
    return index < std::size(texts) ? texts[index] : "";
}

}  // namespace tendril::rig

template <>
std::span<const tendril::Field> tendril::fields<tendril::rig::AimPart>() noexcept {
    using rig::AimPart;
    static constexpr const char* kinds[] = {"location", "direction"};
    static constexpr FieldRange anywhere{-max_magnitude, max_magnitude};
    static constexpr Field rows[] = {field<&AimPart::axis>("axis", anywhere),
                                     field<&AimPart::target>("target", anywhere, "m"),
                                     field<&AimPart::kind>("kind", kinds), field<&AimPart::weight>("weight")};
    return rows;
}

template <>
std::span<const tendril::Field> tendril::fields<tendril::rig::AimOptions>() noexcept {
    using rig::AimOptions;
    static constexpr double unlimited = std::numeric_limits<double>::infinity();
    static constexpr Field rows[] = {nested<&AimOptions::primary>("primary"),
                                     nested<&AimOptions::secondary>("secondary"),
                                     field<&AimOptions::weight>("weight"),
                                     field<&AimOptions::max_speed>("max_speed", {0.0, unlimited}, "rad/s")};
    return rows;
}
