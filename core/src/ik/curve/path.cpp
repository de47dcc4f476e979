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
Cubic part_after(Cubic cubic, double t) noexcept {
    for (std::size_t level = 3; level > 0; --level)
        for (std::size_t i = 0; i < level; ++i) cubic[i] = mix_points(cubic[i], cubic[i + 1], t);
    return cubic;
}

/// The part of a cubic up to `t`.
Cubic part_before(Cubic cubic, double t) noexcept {
    for (std::size_t level = 1; level <= 3; ++level)
        for (std::size_t i = 3; i >= level; --i) cubic[i] = mix_points(cubic[i - 1], cubic[i], t);
    return cubic;
}

/// The cubic relative to a centre.
Cubic relative_to(const glm::dvec3& centre, const Cubic& cubic) noexcept {
    return {minus(cubic[0], centre), minus(cubic[1], centre), minus(cubic[2], centre),
            minus(cubic[3], centre)};
}

/// |cubic(t)|^2 - square
Sextic distance_excess(const Cubic& cubic, double square) noexcept {
    // B_i^3 B_j^3 = C(3, i) C(3, j) / C(6, i + j) B_(i + j)^6
    const auto& [p, q, r, s] = cubic;
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

/// The parameter where the cubic crosses the sphere about the origin, between `low` (inside) and `high`
/// (outside). Newton's steps; bisection where they leave the bracket.
double crossing(const Powers& cubic, double radius, double low, double high) noexcept {
    const double square = radius * radius;
    // The first step treats the cubic as a straight line along its slope at `low`.
    const glm::dvec3 from = cubic.at(low), along = cubic.slope(low);
    const double a = dot(along, along), b = dot(from, along), c = dot(from, from) - square;
    double t = low + (std::sqrt(std::max(0.0, b * b - a * c)) - b) / a;
    if (!(t > low && t < high)) t = 0.5 * (low + high);
    for (int i = 0; i < 60 && high - low > 1e-15; ++i) {
        const glm::dvec3 at = cubic.at(t);
        const double excess = dot(at, at) - square;
        (excess < 0.0 ? low : high) = t;
        const glm::dvec3 slope = cubic.slope(t);
        const double change = excess / (-2.0 * dot(at, slope)), newton = t + change;
        const bool bracketed = newton > low && newton < high;
        // The error of a step is about its square: 1e-6 of the radius leaves 1e-12.
        if (bracketed && dot(slope, slope) * change * change < 1e-12 * square) return newton;
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

/// The parameter at which the cubic first leaves the sphere about the origin, in which it begins; negative if
/// it does not. A cubic that touches the sphere from inside, within rounding, stays in it.
double first_crossing(const Cubic& cubic, double radius) noexcept {
    const double square = radius * radius;
    const auto inside = [&](std::size_t i) { return dot(cubic[i], cubic[i]) < square; };
    if (inside(3) && inside(2) && inside(1) && inside(0)) return -1.0;  // and so is everything between them
    constexpr int deepest = 40;
    struct Interval {
        Sextic c;
        double from, size;
    };
    std::array<Interval, deepest + 2> pending;  // at most one right half waits per depth
    std::size_t count = 0;
    pending[count++] = {distance_excess(cubic, square), 0.0, 1.0};
    while (count > 0) {
        Interval& top = pending[count - 1];
        if (top.c[0] >= 0.0) return top.from;
        const int changes = sign_changes(top.c);
        if (changes == 1) return crossing(Powers(cubic), radius, top.from, top.from + top.size);
        if (changes == 0 && top.c[degree] == 0.0) return top.from + top.size;
        if (changes == 0 || count > deepest) {
            --count;
            continue;
        }
        const Sextic left = split(top.c);
        top.size *= 0.5;
        pending[count++] = {left, top.from, top.size};
        top.from += top.size;
    }
    return -1.0;
}

/// True if the distance always increases, judged by the signs of its slope's Bernstein coefficients.
bool is_increasing(Sextic c, double slack, int splits = 0) noexcept {
    constexpr int most = 24;
    bool all = true;
    for (std::size_t i = 0; i < degree; ++i) all = all && c[i + 1] - c[i] >= -slack;
    if (all || splits == most) return true;
    if (c[1] - c[0] < -slack || c[degree] - c[degree - 1] < -slack) return false;  // the slopes at the ends
    const Sextic left = split(c);
    return is_increasing(left, slack, splits + 1) && is_increasing(c, slack, splits + 1);
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
    // Beyond the ends, mirrors the neighbour: tangents there are one-sided, and a B-spline reaches its ends.
    const auto count = static_cast<std::ptrdiff_t>(points_.size());
    const auto at = [&](std::ptrdiff_t i) { return wide(points_[static_cast<std::size_t>(i)]); };
    if (index < 0) return minus(times(at(0), 2.0), at(1));
    if (index >= count) return minus(times(at(count - 1), 2.0), at(count - 2));
    return at(index);
}

const Path::Piece& Path::piece(std::size_t index) noexcept {
    Piece& piece = pieces_[index % 2];
    if (index == piece.index) return piece;
    piece.index = index;
    const auto k = static_cast<std::ptrdiff_t>(index);
    const glm::dvec3 before = control(k - 1), a = control(k), b = control(k + 1), after = control(k + 2);
    if (kind_ == CurveKind::BSpline) {
        piece.cubic = {times(plus(plus(before, times(a, 4.0)), b), 1.0 / 6.0),
                       times(plus(times(a, 2.0), b), 1.0 / 3.0), times(plus(a, times(b, 2.0)), 1.0 / 3.0),
                       times(plus(plus(a, times(b, 4.0)), after), 1.0 / 6.0)};
    } else {
        piece.cubic = {a, plus(a, times(minus(b, before), 1.0 / 6.0)),
                       minus(b, times(minus(after, a), 1.0 / 6.0)), b};
    }
    const Cubic& p = piece.cubic;
    piece.powers = Powers(p);
    // The derivatives are within the hulls of their own control points.
    const glm::dvec3 first = minus(p[1], p[0]), second = minus(p[2], p[1]), third = minus(p[3], p[2]);
    piece.speed = 3.0 * std::sqrt(std::max({dot(first, first), dot(second, second), dot(third, third)}));
    const glm::dvec3 early = minus(second, first), late = minus(third, second);
    piece.bend = 6.0 * std::sqrt(std::max(dot(early, early), dot(late, late)));
    return piece;
}

glm::dvec3 Path::point(const PathParam& param) noexcept {
    if (on_ray(param)) return plus(end_, times(ray_, param.t));
    return piece(param.piece).powers.at(param.t);
}

PathPoint Path::sample(const PathParam& param, const glm::dvec3& before) noexcept {
    if (on_ray(param)) return {plus(end_, times(ray_, param.t)), ray_};
    const Piece& p = piece(param.piece);
    const glm::dvec3 at = p.powers.at(param.t), slope = p.powers.slope(param.t);
    const double squared = dot(slope, slope);
    // If the slope vanishes, as at a cusp, use a short chord into the longer part of the piece.
    if (squared > 1e-18 * p.speed * p.speed) return {at, times(slope, 1.0 / std::sqrt(squared))};
    const glm::dvec3 chord =
        param.t < 0.5 ? minus(p.powers.at(param.t + 1e-3), at) : minus(at, p.powers.at(param.t - 1e-3));
    return {at, direction_of(chord, 0.0).value_or(before)};
}

PathParam Path::next(const PathParam& from, const glm::dvec3& joint, double length) noexcept {
    if (length == 0.0) return from;
    if (on_ray(from)) return {from.piece, from.t + length};
    double start = from.t;
    for (std::size_t k = from.piece; k < pieces(); ++k, start = 0.0) {
        const Cubic& whole = piece(k).cubic;
        const Cubic rest = relative_to(joint, start > 0.0 ? part_after(whole, start) : whole);
        if (const double t = first_crossing(rest, length); t >= 0.0) return {k, start + (1.0 - start) * t};
    }
    // The end is nearer than the length, so the ray leaves the sphere once: |end + t ray - joint| = length.
    const glm::dvec3 to_end = minus(end_, joint);
    const double along = dot(to_end, ray_);
    const double off = std::max(0.0, along * along - dot(to_end, to_end) + length * length);
    return {pieces(), std::max(0.0, std::sqrt(off) - along)};
}

bool Path::distance_grows(const PathParam& from, const PathParam& to, const glm::dvec3& centre,
                          double length) noexcept {
    const double slack = 1e-9 * length * length;
    double start = from.t;
    for (std::size_t k = from.piece; k < pieces() && k <= to.piece; ++k, start = 0.0) {
        const double stop = k == to.piece ? to.t : 1.0, by = stop - start;
        if (!(by > 0.0)) continue;
        const Piece& p = piece(k);
        if (from.piece == to.piece) {
            // The slope of half the squared distance falls by at most the distance times the second
            // derivative.
            const glm::dvec3 arm = minus(p.powers.at(start), centre);
            if (dot(arm, p.powers.slope(start)) >= by * (length + by * p.speed) * p.bend) return true;
        }
        Cubic cubic = part_after(p.cubic, start);
        if (stop < 1.0) cubic = part_before(cubic, by / (1.0 - start));
        if (!is_increasing(distance_excess(relative_to(centre, cubic), 0.0), slack)) return false;
    }
    if (!on_ray(to)) return true;
    const double first = on_ray(from) ? from.t : 0.0;
    return dot(plus(minus(end_, centre), times(ray_, first)), ray_) * (to.t - first) >= -slack;
}

}  // namespace tendril::ik::detail
