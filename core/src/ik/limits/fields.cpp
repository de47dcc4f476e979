// The field table of ik::Limit.

#include "ik/limits/joint.hpp"
#include "tendril/ik/plane.hpp"
#include "tendril/magnitude.hpp"

namespace tendril::ik {
namespace {

constexpr double half_turn = static_cast<double>(detail::pi);
constexpr FieldRange any_angle{-half_turn, half_turn}, half_angle{0.0, half_turn};

template <auto member>
constexpr Field angle(const char* name, FieldRange range) noexcept {
    return field<member>(name, range, "rad");
}

constexpr Field kind = field<&Limit::kind>("kind", detail::kind_names);
constexpr Field axis = field<&Limit::axis>("axis", {-max_magnitude, max_magnitude});
constexpr Field min = angle<&Limit::min>("min", any_angle), max = angle<&Limit::max>("max", any_angle);
constexpr Field up = angle<&Limit::up>("up", half_angle), down = angle<&Limit::down>("down", half_angle),
                left = angle<&Limit::left>("left", half_angle),
                right = angle<&Limit::right>("right", half_angle);
constexpr Field twist_min = angle<&Limit::twist_min>("twist_min", any_angle),
                twist_max = angle<&Limit::twist_max>("twist_max", any_angle);
constexpr Field stiffness = field<&Limit::stiffness>("stiffness", {0.0, max_stiffness});

}  // namespace

const char* name(JointKind of) noexcept {
    return detail::kind_names[static_cast<std::size_t>(of)];
}

std::span<const Field> limit_fields(JointKind of) noexcept {
    static constexpr Field free[] = {kind, stiffness};
    static constexpr Field hinge[] = {kind, axis, min, max, stiffness};
    static constexpr Field cone[] = {kind, axis, up, down, left, right, twist_min, twist_max, stiffness};
    if (of == JointKind::Free) return free;
    if (of == JointKind::Hinge) return hinge;
    return cone;
}

}  // namespace tendril::ik

template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::AngleLimit>() noexcept {
    using ik::AngleLimit;
    static constexpr const char* from[] = {"bone", "base"};
    static constexpr Field rows[] = {field<&AngleLimit::min>("min", ik::any_angle, "rad"),
                                     field<&AngleLimit::max>("max", ik::any_angle, "rad"),
                                     field<&AngleLimit::from>("from", from)};
    return rows;
}

template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::Limit>() noexcept {
    using namespace ik;
    static constexpr Field rows[] = {kind, axis,  min,       max,       up,       down,
                                     left, right, twist_min, twist_max, stiffness};
    return rows;
}
