#include "tendril/rig/euler.hpp"

#include <cmath>

#include "rig/euler_choice.hpp"
#include "rig/math.hpp"
#include "tendril/elementary.hpp"
#include "tendril/rig/transform.hpp"

namespace tendril::rig {
namespace {

using namespace detail;

/// Wraps a sum or difference of two angles in (-pi, pi] into that range.
double wrapped(double angle) noexcept {
    return angle > pi ? angle - 2.0 * pi : angle <= -pi ? angle + 2.0 * pi : angle;
}

/// Cosine and sine of an angle.
struct CosSin {
    double cosine, sine;
};
constexpr double pole = 1e-9;  ///< below it, one of the two angles in to_euler() is undefined

/// Cosine and sine of half the angle, which is in (-pi, pi].
CosSin half(double cosine, double sine) noexcept {
    const double larger = std::sqrt(0.5 * (1.0 + std::abs(cosine)));
    const double smaller = 0.5 * std::abs(sine) / larger;
    const CosSin turn = cosine < 0.0 ? CosSin{smaller, larger} : CosSin{larger, smaller};
    return {turn.cosine, sine < 0.0 ? -turn.sine : turn.sine};
}

/// Cosine and sine of half of each Euler angle: to_euler() without its arctangents.
std::array<CosSin, 3> half_angles(const glm::dquat& q) noexcept {
    CosSin difference{q.w + q.y, q.z - q.x}, sum{q.w - q.y, q.z + q.x};
    const auto make_unit = [](CosSin& turn) {
        const double size = std::sqrt(turn.cosine * turn.cosine + turn.sine * turn.sine);
        if (size >= pole) turn = {turn.cosine / size, turn.sine / size};
        return size;
    };
    const double plus_size = make_unit(difference), minus_size = make_unit(sum);
    if (minus_size < pole) sum = {difference.cosine, -difference.sine};
    if (plus_size < pole) difference = {sum.cosine, -sum.sine};
    const double cc = sum.cosine * difference.cosine, ss = sum.sine * difference.sine;
    const double sc = sum.sine * difference.cosine, cs = sum.cosine * difference.sine;
    return {half(cc + ss, sc - cs), CosSin{0.5 * (plus_size + minus_size), 0.5 * (plus_size - minus_size)},
            half(cc - ss, sc + cs)};
}

/// Rz * Ry * Rx.
glm::dquat rotation_of(const std::array<CosSin, 3>& halves) noexcept {
    const auto& [x, y, z] = halves;
    const double cc = y.cosine * z.cosine, ss = y.sine * z.sine;
    const double cs = y.cosine * z.sine, sc = y.sine * z.cosine;
    return unit_quaternion(x.cosine * cc + x.sine * ss, x.sine * cc - x.cosine * ss,
                           x.cosine * sc + x.sine * cs, x.cosine * cs - x.sine * sc);
}

}  // namespace

glm::dquat detail::choose_angles(const glm::dquat& from, const glm::dquat& to,
                                 const std::array<bool, 3>& chosen) noexcept {
    std::array<CosSin, 3> halves = half_angles(from);
    const std::array<CosSin, 3> others = half_angles(to);
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (chosen[axis]) halves[axis] = others[axis];
    return rotation_of(halves);
}

glm::dvec3 to_euler(const glm::dquat& q) noexcept {
    // With the half angles: (w + y, z - x) is cos(y/2) + sin(y/2) times the unit vector at angle (z - x)/2,
    // and (w - y, z + x) is cos(y/2) - sin(y/2) times the one at (z + x)/2.
    const double plus_size = std::sqrt((q.w + q.y) * (q.w + q.y) + (q.z - q.x) * (q.z - q.x));
    const double minus_size = std::sqrt((q.w - q.y) * (q.w - q.y) + (q.z + q.x) * (q.z + q.x));
    const double y = 2.0 * arctangent(plus_size, minus_size) - 0.5 * pi;
    double difference = arctangent(q.z - q.x, q.w + q.y);
    double sum = arctangent(q.z + q.x, q.w - q.y);
    if (minus_size < pole) sum = -difference;
    if (plus_size < pole) difference = -sum;
    return {wrapped(sum - difference), y, wrapped(sum + difference)};
}

glm::dquat from_euler(const glm::dvec3& angles) noexcept {
    const auto half = [](double angle) {
        const auto [sine, cosine] = math::sine_cosine(0.5 * angle);
        return CosSin{cosine, sine};
    };
    return rotation_of({half(angles.x), half(angles.y), half(angles.z)});
}

}  // namespace tendril::rig
