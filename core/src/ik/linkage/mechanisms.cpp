#include "tendril/ik/mechanisms.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "ik/math.hpp"
#include "math/checks.hpp"
#include "tendril/elementary.hpp"

namespace tendril::ik {

using tendril::detail::refused;

namespace {

using Point2 = glm::dvec2;

Point2 point_at_angle(double radius, double radians) noexcept {
    const math::SineCosine turn = math::sine_cosine(radians);
    return {radius * turn.cosine, radius * turn.sine};
}

/// The crossing of two circles left of the line from `a` to `b`; their nearest approach if they do not cross.
Point2 left_crossing(const Point2& a, double radius_a, const Point2& b, double radius_b) noexcept {
    const Point2 line{b.x - a.x, b.y - a.y};
    const double square = std::max(line.x * line.x + line.y * line.y, 1e-300);
    const double along = 0.5 * (1.0 + (radius_a * radius_a - radius_b * radius_b) / square);
    const double height = std::sqrt(std::max(radius_a * radius_a / square - along * along, 0.0));
    return {a.x + along * line.x - height * line.y, a.y + along * line.y + height * line.x};
}

constexpr SketchHold pinned = SketchHold::Pinned;

double point_distance(const Point2& a, const Point2& b) noexcept {
    return std::sqrt((b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y));
}
/// True if bars of the lengths `a` and `b` can join two points `apart`, within rounding.
bool closes_triangle(double apart, double a, double b) noexcept {
    const double slack = 1e-12 * (a + b + apart);
    return apart <= a + b + slack && apart >= std::abs(a - b) - slack;
}

}  // namespace

Expected<LinkageSketch> four_bar(const FourBar& lengths) {
    const auto& [ground, crank, coupler, rocker, coupler_point] = lengths;
    if (const Result bad = check_fields("four_bar", lengths); !bad) return bad;
    // Range of the distance BD that crank and ground allow, and coupler and rocker too. If the crank cannot
    // be at 0, or if the linkage would be flat there or B on D, it is drawn in the middle of that range.
    const double low = std::max(std::abs(ground - crank), std::abs(coupler - rocker)),
                 high = std::min(ground + crank, coupler + rocker);
    if (!(low <= high)) {
        const double longest = std::max({ground, crank, coupler, rocker});
        const char* name = longest == ground    ? "ground"
                           : longest == crank   ? "crank"
                           : longest == coupler ? "coupler"
                                                : "rocker";
        return refused("four_bar", name, "at most the other three together", longest);
    }
    double angle = 0.0;
    const double at_0 = std::abs(ground - crank), slack = 1e-6 * (coupler + rocker);
    if (!(at_0 > std::abs(coupler - rocker) + slack && at_0 < coupler + rocker - slack && at_0 > slack)) {
        const double apart = 0.5 * (low + high);
        const double cosine = (ground * ground + crank * crank - apart * apart) / (2.0 * ground * crank);
        angle = math::arctangent(std::sqrt(std::max(1.0 - cosine * cosine, 0.0)), cosine);
    }
    const Point2 b = point_at_angle(crank, angle), d{ground, 0.0};
    const Point2 c = left_crossing(b, coupler, d, rocker);
    const double x = (c.x - b.x) / coupler, y = (c.y - b.y) / coupler;
    const Point2& p = coupler_point;
    LinkageSketch sketch;
    sketch.points = {{"A", {0.0, 0.0}, pinned},
                     {"B", b},
                     {"C", c},
                     {"D", d, pinned},
                     {"P", {b.x + p.x * x - p.y * y, b.y + p.x * y + p.y * x}}};
    sketch.bars = {{"crank", {0, 1}}, {"coupler", {1, 2, 4}}, {"rocker", {3, 2}}};
    sketch.motors = {{"crank", 0, 0}};
    return sketch;
}

Expected<LinkageSketch> slider_crank(const SliderCrank& lengths) {
    const auto& [crank, rod, offset] = lengths;
    if (const Result bad = check_fields("slider_crank", lengths); !bad) return bad;
    if (!(std::abs(offset) <= crank + rod))
        return refused("slider_crank", "offset", "at most crank and rod together", offset);
    // If the rod does not reach down from a crank at 0, turn the crank towards the slider's line.
    const double lift = std::abs(offset) <= rod
                            ? 0.0
                            : offset - std::copysign(0.5 * (rod + std::abs(offset) - crank), offset);
    const Point2 b{std::sqrt(std::max(crank * crank - lift * lift, 0.0)), lift};
    const double reach = rod * rod - (offset - lift) * (offset - lift);
    LinkageSketch sketch;
    sketch.points = {{"A", {0.0, 0.0}, pinned},
                     {"B", b},
                     {"S", {b.x + std::sqrt(std::max(reach, 0.0)), offset}, SketchHold::Guided}};
    sketch.bars = {{"crank", {0, 1}}, {"rod", {1, 2}}};
    sketch.motors = {{"crank", 0, 0}};
    return sketch;
}

Expected<LinkageSketch> peaucellier(const Peaucellier& lengths) {
    if (const Result bad = check_fields("peaucellier", lengths); !bad) return bad;
    if (!closes_triangle(2.0 * lengths.crank, lengths.long_bar, lengths.short_bar))
        return refused("peaucellier", "crank", "such that long and short bars join O and C, 2 crank apart",
                       lengths.crank);
    // Drawn with C on +X, where O, C and P are on one line.
    const Point2 o{0.0, 0.0}, c{2.0 * lengths.crank, 0.0};
    const Point2 a = left_crossing(o, lengths.long_bar, c, lengths.short_bar), b{a.x, -a.y};
    LinkageSketch sketch;
    sketch.points = {{"O", o, pinned}, {"Q", {lengths.crank, 0.0}, pinned}, {"A", a}, {"B", b},
                     {"C", c},         {"P", {2.0 * a.x - c.x, 0.0}}};
    sketch.bars = {{"crank", {1, 4}}, {"OA", {0, 2}}, {"OB", {0, 3}}, {"AC", {2, 4}},
                   {"BC", {3, 4}},    {"AP", {2, 5}}, {"BP", {3, 5}}};
    sketch.motors = {{"crank", 1, 0}};
    return sketch;
}

Expected<LinkageSketch> pantograph(const Pantograph& lengths) {
    // D on OA and E on AP; D-A-E-T is a parallelogram, so that T stays on OP.
    if (const Result bad = check_fields("pantograph", lengths); !bad) return bad;
    const double part = 1.0 / lengths.scale;
    const Point2 a = point_at_angle(lengths.arm, math::pi / 3.0), p{lengths.arm, 0.0};
    LinkageSketch sketch;
    sketch.points = {{"O", {0.0, 0.0}, pinned},
                     {"A", a},
                     {"P", p},
                     {"D", {part * a.x, part * a.y}},
                     {"E", {a.x + part * (p.x - a.x), a.y + part * (p.y - a.y)}},
                     {"T", {part * p.x, part * p.y}}};
    sketch.bars = {{"OA", {0, 3, 1}}, {"AP", {1, 4, 2}}, {"DT", {3, 5}}, {"ET", {4, 5}}};
    return sketch;
}

Expected<LinkageSketch> scissor_lift(const ScissorLift& lengths) {
    const std::size_t stages = lengths.stages;
    if (const Result bad = check_fields("scissor_lift", lengths); !bad) return bad;
    const Point2 across = point_at_angle(lengths.bar, lengths.angle);
    LinkageSketch sketch;
    sketch.points = {{"L0", {0.0, 0.0}, pinned}, {"R0", {across.x, 0.0}, SketchHold::Guided}};
    std::size_t left = 0, right = 1;
    for (std::size_t k = 0; k < stages; ++k) {
        const std::string below = std::to_string(k), above = std::to_string(k + 1);
        const double y = static_cast<double>(k) * across.y;
        const std::size_t next = sketch.points.size();
        sketch.points.push_back({"L" + above, {0.0, y + across.y}});
        sketch.points.push_back({"R" + above, {across.x, y + across.y}});
        sketch.points.push_back({"M" + below, {0.5 * across.x, y + 0.5 * across.y}});
        sketch.bars.push_back({"up" + below, {left, next + 2, next + 1}});
        sketch.bars.push_back({"down" + below, {right, next + 2, next}});
        left = next, right = next + 1;
    }
    sketch.motors = {{"lift", 0, 0}};
    return sketch;
}

Expected<LinkageSketch> jansen(const Jansen& lengths) {
    const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m] = lengths;
    if (const Result bad = check_fields("jansen", lengths); !bad) return bad;
    const Point2 crank{m, 0.0}, pivot{-a, -l};
    const Point2 upper = left_crossing(pivot, b, crank, j), lower = left_crossing(crank, k, pivot, c);
    const Point2 back = left_crossing(pivot, d, upper, e), knee = left_crossing(lower, g, back, f);
    const Point2 foot = left_crossing(lower, i, knee, h);
    const struct {
        const char* names;
        double apart, one, other;
    } triangles[] = {{"j", point_distance(pivot, crank), b, j},
                     {"k", point_distance(pivot, crank), k, c},
                     {"e", b, d, e},
                     {"g", point_distance(lower, back), g, f},
                     {"h", g, i, h}};
    for (const auto& each : triangles)
        if (!closes_triangle(each.apart, each.one, each.other))
            return refused("jansen", each.names, "such that its triangle closes with the crank at 0",
                           each.other);
    LinkageSketch sketch;
    sketch.points = {{"axis", {0.0, 0.0}, pinned},
                     {"pivot", pivot, pinned},
                     {"crank", crank},
                     {"upper", upper},
                     {"lower", lower},
                     {"back", back},
                     {"knee", knee},
                     {"foot", foot}};
    sketch.bars = {{"m", {0, 2}}, {"j", {2, 3}}, {"k", {2, 4}},     {"bde", {1, 3, 5}},
                   {"c", {1, 4}}, {"f", {5, 6}}, {"ghi", {4, 6, 7}}};
    sketch.motors = {{"motor", 0, 0}};
    return sketch;
}

namespace {

/// A rod on two crossed hinges, so that it points anywhere but does not spin: `name`_yoke and `name`. Returns
/// the rod's link.
std::size_t add_universal(Linkage& linkage, const std::string& name, std::size_t parent, const glm::dvec3& at,
                          const glm::dvec3& first_axis, const glm::dvec3& along) {
    linkage.links.push_back({name + "_yoke", parent, LinkJoint::Hinge, at, first_axis});
    linkage.links.push_back(
        {name, linkage.links.size() - 1, LinkJoint::Hinge, at, detail::cross(along, first_axis)});
    return linkage.links.size() - 1;
}

/// Hangs the platform on the first rod by a ball; the other rods close on it.
void join_platform(Linkage& linkage, std::size_t& platform, std::size_t rod, const std::string& name,
                   const glm::dvec3& at) {
    if (platform != ground_link) {
        linkage.closures.push_back({name, ClosureKind::Point, rod, platform, at, at});
        return;
    }
    platform = linkage.links.size();
    linkage.links.push_back({"platform", rod, LinkJoint::Ball, at});
}

glm::dvec3 in_base(const Point2& flat, double z) noexcept {
    return {flat.x, flat.y, z};
}

}  // namespace

Expected<Linkage> delta(const Delta& lengths) {
    const auto& [base_radius, platform_radius, upper_arm, forearm, width] = lengths;
    if (const Result bad = check_fields("delta", lengths); !bad) return bad;
    // Drawn with the arms 30 degrees down.
    constexpr double down = math::pi / 6.0;
    const double elbow_radius = base_radius + upper_arm * std::sqrt(0.75);
    const double aside = elbow_radius - platform_radius, elbow_z = -0.5 * upper_arm;
    if (!(std::abs(aside) <= 0.999 * forearm))
        return refused("delta", "forearm", "long enough to join elbow and platform 30 degrees down", forearm);
    const double wrist_z = elbow_z - std::sqrt(forearm * forearm - aside * aside);
    Linkage linkage;
    std::size_t platform = ground_link;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::string number = std::to_string(i);
        const Point2 out = point_at_angle(1.0, static_cast<double>(i) * 2.0 * math::pi / 3.0);
        const glm::dvec3 tangent{-out.y, out.x, 0.0};
        const auto at_radius = [&](double radius, double z) {
            return glm::dvec3(radius * out.x, radius * out.y, z);
        };
        const glm::dvec3 elbow = at_radius(elbow_radius, elbow_z),
                         wrist = at_radius(lengths.platform_radius, wrist_z);
        const std::size_t motor = linkage.links.size();
        linkage.links.push_back({"motor_" + number, ground_link, LinkJoint::Hinge,
                                 at_radius(lengths.base_radius, 0.0), tangent, down});
        for (const double side : {-0.5, 0.5}) {
            const glm::dvec3 aside_by = detail::times(tangent, side * lengths.width);
            const std::string name = "forearm_" + number + (side < 0.0 ? "a" : "b");
            const glm::dvec3 far = detail::plus(wrist, aside_by);
            const std::size_t rod = add_universal(linkage, name, motor, detail::plus(elbow, aside_by),
                                                  tangent, detail::minus(wrist, elbow));
            join_platform(linkage, platform, rod, name, far);
        }
        linkage.points.push_back({"elbow_" + number, motor, elbow});
        linkage.points.push_back({"wrist_" + number, platform, wrist});
    }
    linkage.points.push_back({"platform", platform, {0.0, 0.0, wrist_z}});
    if (const Result bad = check(linkage); !bad) return bad;
    return linkage;
}

std::optional<std::array<double, 3>> delta_motors(const Delta& lengths, const glm::dvec3& platform) noexcept {
    std::array<double, 3> motors{};
    for (std::size_t i = 0; i < 3; ++i) {
        const Point2 out = point_at_angle(1.0, static_cast<double>(i) * 2.0 * math::pi / 3.0);
        // The wrist from the hinge: x along the arm's plane, y across it, z up.
        const double x =
            platform.x * out.x + platform.y * out.y + lengths.platform_radius - lengths.base_radius;
        const double y = platform.y * out.x - platform.x * out.y, z = platform.z, arm = lengths.upper_arm;
        const double sum = x * x + y * y + z * z + arm * arm - lengths.forearm * lengths.forearm;
        // sum = 2 arm (x cos - z sin)
        const double reach = 2.0 * arm * std::sqrt(x * x + z * z);
        if (!(std::abs(sum) <= reach) || reach == 0.0) return std::nullopt;
        motors[i] = math::arctangent(-z, x) - math::arctangent(std::sqrt(reach * reach - sum * sum), sum);
    }
    return motors;
}

namespace {

struct StewartEnds {
    glm::dvec3 base, top;  ///< the top is relative to the platform's centre
};
StewartEnds ends_of_leg(const Stewart& lengths, std::size_t leg) noexcept {
    const double third = static_cast<double>(leg / 2) * 2.0 * math::pi / 3.0, side = leg % 2 ? 1.0 : -1.0;
    const double base = third + side * lengths.base_angle;
    const double top = third + side * (math::pi / 3.0 - lengths.platform_angle);
    return {in_base(point_at_angle(lengths.base_radius, base), 0.0),
            in_base(point_at_angle(lengths.platform_radius, top), 0.0)};
}

}  // namespace

Expected<Linkage> stewart(const Stewart& lengths) {
    if (const Result bad = check_fields("stewart", lengths); !bad) return bad;
    if (!(lengths.minimum <= lengths.maximum))
        return refused("stewart", "minimum", "at most the maximum", lengths.minimum);
    Linkage linkage;
    std::size_t platform = ground_link;
    const glm::dvec3 centre{0.0, 0.0, lengths.height};
    for (std::size_t i = 0; i < 6; ++i) {
        const StewartEnds ends = ends_of_leg(lengths, i);
        const glm::dvec3 top = detail::plus(ends.top, centre), along = detail::minus(top, ends.base);
        const std::string name = "leg_" + std::to_string(i), number = std::to_string(i);
        // Horizontal, across the leg.
        const glm::dvec3 level{-along.y, along.x, 0.0};
        const bool upright = !(detail::length(level) > 1e-9);
        const std::size_t rod = add_universal(linkage, "swivel_" + number, ground_link, ends.base,
                                              upright ? glm::dvec3(1.0, 0.0, 0.0) : level, along);
        const double drawn = detail::length(along);
        if (!(lengths.minimum <= drawn && drawn <= lengths.maximum))
            return refused("stewart", "height", "such that legs are from minimum to maximum", lengths.height);
        const std::size_t leg = linkage.links.size();
        linkage.links.push_back(
            {name, rod, LinkJoint::Slider, ends.base, along, drawn, lengths.minimum, lengths.maximum});
        join_platform(linkage, platform, leg, name, top);
        linkage.points.push_back({"base_" + number, ground_link, ends.base});
        linkage.points.push_back({"top_" + number, platform, top});
    }
    linkage.points.push_back({"platform", platform, centre});
    if (const Result bad = check(linkage); !bad) return bad;
    return linkage;
}

std::array<double, 6> stewart_legs(const Stewart& lengths, const glm::dvec3& platform,
                                   const glm::dquat& rotation) noexcept {
    std::array<double, 6> legs{};
    for (std::size_t i = 0; i < 6; ++i) {
        const StewartEnds ends = ends_of_leg(lengths, i);
        legs[i] = detail::length(
            detail::minus(detail::plus(platform, detail::rotated(rotation, ends.top)), ends.base));
    }
    return legs;
}

}  // namespace tendril::ik

namespace tendril {
namespace {

constexpr FieldRange bar_length{1e-9, max_magnitude}, radius_length{0.0, max_magnitude},
    any_length{-max_magnitude, max_magnitude};

}  // namespace

template <>
std::span<const Field> fields<ik::FourBar>() noexcept {
    using ik::FourBar;
    static constexpr Field rows[] = {field<&FourBar::ground>("ground", bar_length, "m"),
                                     field<&FourBar::crank>("crank", bar_length, "m"),
                                     field<&FourBar::coupler>("coupler", bar_length, "m"),
                                     field<&FourBar::rocker>("rocker", bar_length, "m"),
                                     field<&FourBar::coupler_point>("coupler_point", any_length, "m")};
    return rows;
}

template <>
std::span<const Field> fields<ik::SliderCrank>() noexcept {
    using ik::SliderCrank;
    static constexpr Field rows[] = {field<&SliderCrank::crank>("crank", bar_length, "m"),
                                     field<&SliderCrank::rod>("rod", bar_length, "m"),
                                     field<&SliderCrank::offset>("offset", any_length, "m")};
    return rows;
}

template <>
std::span<const Field> fields<ik::Peaucellier>() noexcept {
    using ik::Peaucellier;
    static constexpr Field rows[] = {field<&Peaucellier::long_bar>("long_bar", bar_length, "m"),
                                     field<&Peaucellier::short_bar>("short_bar", bar_length, "m"),
                                     field<&Peaucellier::crank>("crank", bar_length, "m")};
    return rows;
}

template <>
std::span<const Field> fields<ik::Pantograph>() noexcept {
    using ik::Pantograph;
    static constexpr Field rows[] = {field<&Pantograph::arm>("arm", bar_length, "m"),
                                     field<&Pantograph::scale>("scale", {1.0, max_magnitude}).over()};
    return rows;
}

template <>
std::span<const Field> fields<ik::ScissorLift>() noexcept {
    using ik::ScissorLift;
    static constexpr Field rows[] = {field<&ScissorLift::stages>("stages", {1.0, 32.0}),
                                     field<&ScissorLift::bar>("bar", bar_length, "m"),
                                     field<&ScissorLift::angle>("angle", {1e-6, 1.570795}, "rad")};
    return rows;
}

template <>
std::span<const Field> fields<ik::Jansen>() noexcept {
    using ik::Jansen;
    static constexpr Field rows[] = {
        field<&Jansen::a>("a", any_length, "m"), field<&Jansen::b>("b", bar_length, "m"),
        field<&Jansen::c>("c", bar_length, "m"), field<&Jansen::d>("d", bar_length, "m"),
        field<&Jansen::e>("e", bar_length, "m"), field<&Jansen::f>("f", bar_length, "m"),
        field<&Jansen::g>("g", bar_length, "m"), field<&Jansen::h>("h", bar_length, "m"),
        field<&Jansen::i>("i", bar_length, "m"), field<&Jansen::j>("j", bar_length, "m"),
        field<&Jansen::k>("k", bar_length, "m"), field<&Jansen::l>("l", any_length, "m"),
        field<&Jansen::m>("m", bar_length, "m")};
    return rows;
}

template <>
std::span<const Field> fields<ik::Delta>() noexcept {
    using ik::Delta;
    static constexpr Field rows[] = {field<&Delta::base_radius>("base_radius", radius_length, "m"),
                                     field<&Delta::platform_radius>("platform_radius", radius_length, "m"),
                                     field<&Delta::upper_arm>("upper_arm", bar_length, "m"),
                                     field<&Delta::forearm>("forearm", bar_length, "m"),
                                     field<&Delta::width>("width", bar_length, "m")};
    return rows;
}

template <>
std::span<const Field> fields<ik::Stewart>() noexcept {
    using ik::Stewart;
    static constexpr Field rows[] = {
        field<&Stewart::base_radius>("base_radius", bar_length, "m"),
        field<&Stewart::platform_radius>("platform_radius", bar_length, "m"),
        field<&Stewart::height>("height", bar_length, "m"),
        field<&Stewart::base_angle>("base_angle", {-math::pi, math::pi}, "rad"),
        field<&Stewart::platform_angle>("platform_angle", {-math::pi, math::pi}, "rad"),
        field<&Stewart::minimum>("minimum", radius_length, "m"),
        field<&Stewart::maximum>("maximum", bar_length, "m")};
    return rows;
}

}  // namespace tendril
