#include "ik/curve/path.hpp"

#include <algorithm>

namespace tendril::ik::detail {
namespace {

/// A polynomial of degree six on 0 to 1, by its Bernstein coefficients.
using Sextic = std::array<double, 7>;

constexpr std::size_t degree = 6;

glm::dvec3 mix_points(const glm::dvec3& a, const glm::dvec3& b, double t) noexcept {
    return plus(times(a, 1.0 - t), times(b, t));
}

/// The part of a cubic from `t` on.
Cubic rest_of(Cubic cubic, double t) noexcept {
    for (std::size_t level = 3; level > 0; --level)
        for (std::size_t i = 0; i < level; ++i) cubic[i] = mix_points(cubic[i], cubic[i + 1], t);
    return cubic;
}

/// |cubic(t) - centre|^2 - radius^2
Sextic distance_excess(const Cubic& cubic, const glm::dvec3& centre, double radius) noexcept {
    // B_i^3 B_j^3 = C(3, i) C(3, j) / C(6, i + j) B_(i + j)^6
    const glm::dvec3 p = minus(cubic[0], centre), q = minus(cubic[1], centre), r = minus(cubic[2], centre),
                     s = minus(cubic[3], centre);
    const double square = radius * radius;
    return {dot(p, p) - square,
            dot(p, q) - square,
            0.4 * dot(p, r) + 0.6 * dot(q, q) - square,
            0.1 * dot(p, s) + 0.9 * dot(q, r) - square,
            0.4 * dot(q, s) + 0.6 * dot(r, r) - square,
            dot(r, s) - square,
            dot(s, s) - square};
}

/// Splits at the middle: `all` becomes the right half, the left one is returned.
Sextic split(Sextic& all) noexcept {
    Sextic left;
    for (std::size_t level = degree; level > 0; --level) {
        left[degree - level] = all[0];
        for (std::size_t i = 0; i < level; ++i) all[i] = 0.5 * (all[i] + all[i + 1]);
    }
    left[degree] = all[0];
    return left;
}

/// A cubic in powers of t, as seen from a centre.
struct Powers {
    glm::dvec3 a, b, c, d;

    Powers(const Cubic& p, const glm::dvec3& centre) noexcept
        : a(minus(p[0], centre)),
          b(times(minus(p[1], p[0]), 3.0)),
          c(times(plus(minus(p[0], times(p[1], 2.0)), p[2]), 3.0)),
          d(plus(minus(p[3], p[0]), times(minus(p[1], p[2]), 3.0))) {}
    glm::dvec3 at(double t) const noexcept {
        return plus(a, times(plus(b, times(plus(c, times(d, t)), t)), t));
    }
    glm::dvec3 slope(double t) const noexcept {
        return plus(b, times(plus(times(c, 2.0), times(d, 3.0 * t)), t));
    }
};

/// The place between `low` and `high`, inside and outside the sphere, where the cubic crosses it: Newton's
/// steps, bisection where they leave the bracket.
double crossing(const Powers& cubic, double radius, double low, double high, double t) noexcept {
    for (int i = 0; i < 60 && high - low > 1e-15; ++i) {
        const glm::dvec3 at = cubic.at(t);
        const double excess = dot(at, at) - radius * radius;
        (excess < 0.0 ? low : high) = t;
        const glm::dvec3 slope = cubic.slope(t);
        const double change = excess / (-2.0 * dot(at, slope)), newton = t + change;
        const bool bracketed = newton > low && newton < high;
        // The error of a step is about its square: 1e-6 of the radius leaves 1e-12.
        if (bracketed && dot(slope, slope) * change * change < 1e-12 * radius * radius) return newton;
        t = bracketed ? newton : 0.5 * (low + high);
    }
    return t;
}

int sign_changes(const Sextic& c) noexcept {
    int changes = 0;
    bool negative = c[0] < 0.0;
    for (const double each : c) {
        if (each == 0.0 || (each < 0.0) == negative) continue;
        ++changes;
        negative = !negative;
    }
    return changes;
}

/// Where the cubic first leaves the sphere around `centre`, in which it begins; negative if it does not.
/// Touching the sphere from inside, within rounding, counts as staying.
double first_crossing(const Cubic& cubic, const glm::dvec3& centre, double radius) noexcept {
    constexpr int deepest = 40;
    struct Interval {
        Sextic c;
        double from, size;
    };
    std::array<Interval, deepest + 2> waiting;  // of each depth at most one right half waits
    std::size_t count = 0;
    waiting[count++] = {distance_excess(cubic, centre, radius), 0.0, 1.0};
    while (count > 0) {
        Interval& top = waiting[count - 1];
        if (top.c[0] >= 0.0) return top.from;
        const int changes = sign_changes(top.c);
        if (changes == 1)
            return crossing(Powers(cubic, centre), radius, top.from, top.from + top.size,
                            top.from + top.size * (top.c[0] / (top.c[0] - top.c[degree])));
        if (changes == 0 && top.c[degree] == 0.0) return top.from + top.size;
        if (changes == 0 || count > deepest) {
            --count;
            continue;
        }
        const Sextic left = split(top.c);
        top.size *= 0.5;
        waiting[count++] = {left, top.from, top.size};
        top.from += top.size;
    }
    return -1.0;
}

}  // namespace

Path::Path(std::span<const glm::vec3> points, CurveKind kind, const glm::dvec3& fallback) noexcept
    : points_(points), kind_(kind), end_(wide(points.back())), ray_(fallback) {
    // With one-sided tangents both kinds of curve end along the last two points.
    for (std::size_t i = points.size() - 1; i-- > 0;)
        if (const auto direction = direction_of(between(points[i], points.back()), 0.0)) {
            ray_ = *direction;
            return;
        }
    collapsed_ = true;
}

glm::dvec3 Path::control(std::ptrdiff_t index) const noexcept {
    // Beyond the ends, the neighbour mirrored: tangents there are one-sided, and a B-spline reaches its ends.
    const auto count = static_cast<std::ptrdiff_t>(points_.size());
    const auto at = [&](std::ptrdiff_t i) { return wide(points_[static_cast<std::size_t>(i)]); };
    if (index < 0) return minus(times(at(0), 2.0), at(1));
    if (index >= count) return minus(times(at(count - 1), 2.0), at(count - 2));
    return at(index);
}

const Cubic& Path::piece(std::size_t index) noexcept {
    if (index == index_) return cubic_;
    index_ = index;
    const auto k = static_cast<std::ptrdiff_t>(index);
    const glm::dvec3 before = control(k - 1), a = control(k), b = control(k + 1), after = control(k + 2);
    if (kind_ == CurveKind::BSpline) {
        cubic_ = {times(plus(plus(before, times(a, 4.0)), b), 1.0 / 6.0),
                  times(plus(times(a, 2.0), b), 1.0 / 3.0), times(plus(a, times(b, 2.0)), 1.0 / 3.0),
                  times(plus(plus(a, times(b, 4.0)), after), 1.0 / 6.0)};
    } else {
        cubic_ = {a, plus(a, times(minus(b, before), 1.0 / 6.0)), minus(b, times(minus(after, a), 1.0 / 6.0)),
                  b};
    }
    return cubic_;
}

glm::dvec3 Path::point(const Place& place) noexcept {
    if (on_ray(place)) return plus(end_, times(ray_, place.t));
    const Cubic& p = piece(place.piece);
    const double t = place.t, s = 1.0 - t;
    return plus(plus(times(p[0], s * s * s), times(p[1], 3.0 * s * s * t)),
                plus(times(p[2], 3.0 * s * t * t), times(p[3], t * t * t)));
}

glm::dvec3 Path::tangent(const Place& place, const glm::dvec3& before) noexcept {
    if (on_ray(place)) return ray_;
    const Cubic& p = piece(place.piece);
    const glm::dvec3 slope = Powers(p, p[0]).slope(place.t);
    const double size =
        std::max({dot(minus(p[1], p[0]), minus(p[1], p[0])), dot(minus(p[2], p[0]), minus(p[2], p[0])),
                  dot(minus(p[3], p[0]), minus(p[3], p[0]))});
    const double squared = dot(slope, slope);
    // Where the curve halts, as at a cusp, its direction is that from the nearer half of the piece.
    if (squared > 1e-18 * size) return times(slope, 1.0 / std::sqrt(squared));
    const Place beside{place.piece, place.t < 0.5 ? place.t + 1e-3 : place.t - 1e-3};
    const glm::dvec3 chord =
        place.t < 0.5 ? minus(point(beside), point(place)) : minus(point(place), point(beside));
    return direction_of(chord, 0.0).value_or(before);
}

Place Path::next(const Place& from, const glm::dvec3& joint, double length) noexcept {
    if (length == 0.0) return from;
    if (on_ray(from)) return {from.piece, from.t + length};
    double start = from.t;
    for (std::size_t k = from.piece; k < pieces(); ++k, start = 0.0) {
        const Cubic cubic = rest_of(piece(k), start);
        if (const double t = first_crossing(cubic, joint, length); t >= 0.0)
            return {k, start + (1.0 - start) * t};
    }
    // The end is nearer than the length, so the ray leaves the sphere once: |end + t ray - joint| = length.
    const glm::dvec3 to_end = minus(end_, joint);
    const double along = dot(to_end, ray_);
    const double off = std::max(0.0, along * along - dot(to_end, to_end) + length * length);
    return {pieces(), std::max(0.0, std::sqrt(off) - along)};
}

}  // namespace tendril::ik::detail
