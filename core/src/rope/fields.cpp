// The field tables of the rope headers.
#include "tendril/fields.hpp"

#include <limits>

#include "tendril/magnitude.hpp"
#include "tendril/rope/body.hpp"
#include "tendril/rope/collider.hpp"
#include "tendril/rope/hair_roots.hpp"
#include "tendril/rope/settings.hpp"
#include "tendril/rope/state.hpp"
#include "tendril/rope/tie.hpp"

namespace tendril {
namespace {

constexpr const char* solvers[] = {"relaxation", "xpbd", "direct"};
constexpr const char* pins[] = {"none", "corners", "row"};

constexpr FieldRange anywhere{-max_magnitude, max_magnitude}, any_size{0.0, max_magnitude};
constexpr double most_particles = static_cast<double>(rope::max_particles);
constexpr FieldRange particles{0.0, most_particles - 1.0}, seconds{0.0, 1e9};
/// Newtons. Not limited to the usual range: stopping a heavy body at once can need more.
constexpr FieldRange any_force{-std::numeric_limits<float>::max(), std::numeric_limits<float>::max()};

}  // namespace

template <>
std::span<const Field> fields<rope::Settings>() noexcept {
    using namespace rope;
    constexpr FieldRange acceleration{-max_acceleration, max_acceleration};
    static constexpr Field rows[] = {
        field<&Settings::substep>("substep", {min_substep, max_substep}, "s"),
        field<&Settings::iterations>("iterations", {1, max_iterations}),
        field<&Settings::solver>("solver", solvers),
        field<&Settings::damping>("damping", {0.0, max_rate}, "1/s"),
        field<&Settings::gravity>("gravity", acceleration, "m/s^2"),
        field<&Settings::gravity_scale>("gravity_scale", {-max_scale, max_scale}),
        field<&Settings::external>("external", acceleration, "m/s^2"),
        field<&Settings::wind>("wind", {-max_wind, max_wind}, "m/s"),
        field<&Settings::gusts>("gusts", {0.0, 1.0}),
        field<&Settings::still_air>("still_air"),
        field<&Settings::compliance>("compliance", {0.0, max_compliance}, "1/N"),
        field<&Settings::friction>("friction", {0.0, max_friction}),
        field<&Settings::longest_frame>("longest_frame", {min_longest_frame, max_longest_frame}, "s")};
    return rows;
}

template <>
std::span<const Field> fields<rope::TieShape>() noexcept {
    using rope::TieShape;
    static constexpr Field rows[] = {field<&TieShape::length>("length", any_size, "m"),
                                     field<&TieShape::strength>("strength", any_size, "N")};
    return rows;
}

template <>
std::span<const Field> fields<rope::RopeShape>() noexcept {
    using rope::RopeShape;
    static constexpr Field rows[] = {
        field<&RopeShape::from>("from", anywhere, "m"),
        field<&RopeShape::to>("to", anywhere, "m"),
        field<&RopeShape::segments>("segments", {1, most_particles - 1}),
        field<&RopeShape::length>("length", any_size, "m"),
        field<&RopeShape::radius>("radius", any_size, "m"),
        field<&RopeShape::density>("density", {rope::min_density, max_magnitude}, "kg/m"),
        field<&RopeShape::bending>("bending", any_size, "N m^2"),
        field<&RopeShape::pin_start>("pin_start"),
        field<&RopeShape::pin_end>("pin_end")};
    return rows;
}

template <>
std::span<const Field> fields<rope::ClothShape>() noexcept {
    using rope::ClothShape;
    static constexpr Field rows[] = {
        field<&ClothShape::corner>("corner", anywhere, "m"),
        field<&ClothShape::along>("along", anywhere, "m"),
        field<&ClothShape::down>("down", anywhere, "m"),
        field<&ClothShape::columns>("columns", {2, most_particles}),
        field<&ClothShape::rows>("rows", {2, most_particles}),
        field<&ClothShape::radius>("radius", any_size, "m"),
        field<&ClothShape::density>("density", {rope::min_density, max_magnitude}, "kg/m^2"),
        field<&ClothShape::shear>("shear", any_size, "m/N"),
        field<&ClothShape::bend>("bend", any_size, "m/N"),
        field<&ClothShape::tear>("tear", any_size),
        field<&ClothShape::pins>("pins", pins)};
    return rows;
}

template <>
std::span<const Field> fields<rope::HairShape>() noexcept {
    using rope::HairShape;
    static constexpr Field rows[] = {
        field<&HairShape::length>("length", {rope::min_hair_length, max_magnitude}, "m"),
        field<&HairShape::segments>("segments", {2, most_particles - 1}),
        field<&HairShape::radius>("radius", any_size, "m"),
        field<&HairShape::density>("density", {rope::min_density, max_magnitude}, "kg/m"),
        field<&HairShape::bend>("bend", any_size, "m/N")};
    return rows;
}

template <>
std::span<const Field> fields<rope::HairPatch>() noexcept {
    using rope::HairPatch;
    static constexpr Field rows[] = {field<&HairPatch::centre>("centre", anywhere, "m"),
                                     field<&HairPatch::direction>("direction", anywhere),
                                     field<&HairPatch::strands>("strands", {1, most_particles}),
                                     field<&HairPatch::spread>("spread", any_size, "m")};
    return rows;
}

template <>
std::span<const Field> fields<rope::Sphere>() noexcept {
    using rope::Sphere;
    static constexpr Field rows[] = {field<&Sphere::centre>("centre", anywhere, "m").needed(),
                                     field<&Sphere::radius>("radius", any_size, "m").needed()};
    return rows;
}

template <>
std::span<const Field> fields<rope::Capsule>() noexcept {
    using rope::Capsule;
    static constexpr Field rows[] = {field<&Capsule::a>("a", anywhere, "m").needed(),
                                     field<&Capsule::b>("b", anywhere, "m").needed(),
                                     field<&Capsule::radius>("radius", any_size, "m").needed()};
    return rows;
}

template <>
std::span<const Field> fields<rope::Plane>() noexcept {
    using rope::Plane;
    constexpr auto normal = [] {
        Field row = field<&Plane::normal>("normal", anywhere).needed();
        row.usual = {-1.0, 1.0};
        return row;
    };
    static constexpr Field rows[] = {field<&Plane::point>("point", anywhere, "m").needed(), normal()};
    return rows;
}

template <>
std::span<const Field> fields<rope::Box>() noexcept {
    using rope::Box;
    static constexpr Field rows[] = {field<&Box::centre>("centre", anywhere, "m").needed(),
                                     field<&Box::half_extents>("half_extents", any_size, "m").needed(),
                                     field<&Box::rotation>("rotation", {1e-6, 1e6})};
    return rows;
}

template <>
std::span<const Field> fields<rope::Drive>() noexcept {
    using rope::Drive;
    static constexpr Field rows[] = {
        field<&Drive::velocity>("velocity", {-rope::max_drive, rope::max_drive}, "m/s"),
        field<&Drive::axis>("axis", anywhere),
        field<&Drive::spin>("spin", {-rope::max_spin, rope::max_spin}, "rad/s")};
    return rows;
}

template <>
std::span<const Field> fields<rope::Collider>() noexcept {
    using rope::Collider;
    static constexpr Field rows[] = {
        kinds<&Collider::shape>("kind", rope::shape_kinds).as_member("shape"),
        field<&Collider::goal>("goal", anywhere, "m").needed(),
        field<&Collider::seconds>("seconds", seconds, "s"),
        field<&Collider::half_goal>("half_goal", {2.0 * anywhere.low, 2.0 * anywhere.high}, "m"),
        nested<&Collider::drive>("drive")};
    return rows;
}

template <>
std::span<const Field> fields<rope::Body>() noexcept {
    using rope::Body;
    static constexpr Field rows[] = {field<&Body::kind>("kind", rope::body_kinds).needed(),
                                     field<&Body::first>("first", {0.0, most_particles}).needed(),
                                     field<&Body::count>("count", {0.0, most_particles}).needed(),
                                     field<&Body::row>("row", {0.0, most_particles}).needed(),
                                     list<&Body::cells>("cells", particles).up_to(rope::max_particles),
                                     field<&Body::radius>("radius", any_size, "m").needed(),
                                     field<&Body::tear>("tear", any_size),
                                     field<&Body::bending>("bending", any_size, "N m^2"),
                                     field<&Body::friction>("friction", {0.0, rope::max_friction}),
                                     field<&Body::stretch>("stretch", any_size)};
    return rows;
}

template <>
std::span<const Field> fields<rope::Pin>() noexcept {
    using rope::Pin;
    static constexpr Field rows[] = {
        field<&Pin::particle>("particle", particles).needed(),
        field<&Pin::goal>("goal", {2.0 * anywhere.low, 2.0 * anywhere.high}, "m").needed(),
        field<&Pin::seconds>("seconds", seconds, "s")};
    return rows;
}

template <>
std::span<const Field> fields<rope::Tie>() noexcept {
    using rope::Tie;
    static constexpr Field rows[] = {field<&Tie::a>("a", particles).needed(),
                                     field<&Tie::b>("b", particles).needed(),
                                     field<&Tie::length>("length", any_size, "m").needed(),
                                     field<&Tie::strength>("strength", any_size, "N").needed(),
                                     field<&Tie::now>("now", any_size, "m").needed(),
                                     field<&Tie::tension>("tension", any_force, "N")};
    return rows;
}

namespace rope {

const char* name(Solver solver) noexcept {
    const auto at = static_cast<std::size_t>(solver);
    return at < std::size(solvers) ? solvers[at] : "";
}

Result check(const char* operation, const Settings& settings) noexcept {
    return check_fields(operation, settings);
}

}  // namespace rope
}  // namespace tendril
