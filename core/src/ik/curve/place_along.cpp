#include <algorithm>
#include <cmath>

#include "ik/curve/path.hpp"
#include "ik/solve/validate.hpp"
#include "math/checks.hpp"
#include "math/ranges.hpp"
#include "tendril/elementary.hpp"
#include "tendril/ik/curve.hpp"

namespace tendril::ik {
namespace detail {
namespace {

using namespace tendril::detail;

constexpr std::size_t max_control_points = 4096;

bool is_unit(const glm::dvec3& v) noexcept {
    return std::abs(dot(v, v) - 1.0) <= 2e-3;
}

constexpr const char* curve_kinds[] = {"hermite", "b_spline"};
constexpr FieldRange roll_range{-1e6, 1e6};
constexpr Field curve_rows[] = {field<&CurveOptions::kind>("kind", curve_kinds),
                                field<&CurveOptions::fit>("fit"),
                                field<&CurveOptions::max_factor>("max_factor", {1.0, 100.0}).over(),
                                field<&CurveOptions::up>("up", {-max_magnitude, max_magnitude}),
                                field<&CurveOptions::roll_start>("roll_start", roll_range, "rad"),
                                field<&CurveOptions::roll_end>("roll_end", roll_range, "rad"),
                                field<&CurveOptions::weight>("weight"),
                                list<&CurveOptions::weights>("weights")};

Result check_input(std::span<const glm::vec3> points, const CurveChain& chain,
                   std::span<const glm::vec3> joints, const State& state, const CurveMemory& memory,
                   const CurveOptions& options) noexcept {
    constexpr const char* op = "place_along";
    const std::size_t bones = chain.lengths.size(), rests = chain.rest_directions.size();
    if (bones == 0) return refused(op, "chain.lengths", "at least one", "none");
    if (const Result bad = check_count(op, "joints", joints.size(), bones + 1); !bad) return bad;
    if (const Result bad = check_count(op, "state.rotations", state.bones(), bones); !bad) return bad;
    if (!memory.at.empty() && memory.at.size() != bones + 1)
        return refused_count(op, "memory.at", memory.at.size(), bones + 1);
    if (rests > 0 && rests != bones) return refused_count(op, "chain.rest_directions", rests, bones);
    if (!options.weights.empty() && options.weights.size() != bones)
        return refused_count(op, "weights", options.weights.size(), bones);
    if (points.size() < 2 || points.size() > max_control_points)
        return refused(op, "points", "2 to 4096 in number", points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
        if (!is_point(points[i])) return refused_point(op, {"points", i}, points[i]);
    for (std::size_t i = 0; i < joints.size(); ++i)
        if (!is_point(joints[i])) return refused_point(op, {"joints", i}, joints[i]);
    for (std::size_t i = 0; i < bones; ++i)
        if (!is_length(chain.lengths[i])) return refused_length(op, {"chain.lengths", i}, chain.lengths[i]);
    for (std::size_t i = 0; i < rests; ++i)
        if (!is_point(chain.rest_directions[i]) || !is_unit(wide(chain.rest_directions[i])))
            return refused(op, {"chain.rest_directions", i}, "a unit vector", "one of another length");
    for (std::size_t i = 0; i < bones; ++i)
        if (!detail::is_unit(state.rotations[i]))
            return refused(op, {"state.rotations", i}, "a unit quaternion", "one of another length");
    if (!are_in_range<curve_rows>(&options)) return check_fields(op, options);
    for (std::size_t i = 0; i < options.weights.size(); ++i)
        if (!(options.weights[i] >= 0.0f && options.weights[i] <= 1.0f))
            return refused(op, {"weights", i}, "0 to 1", options.weights[i]);
    return {};
}

/// Distance of the tip beyond the end of the path with all bones scaled by `factor`, metres; negative if it
/// falls short.
double overshoot(Path& path, std::span<const float> lengths, double factor) noexcept {
    PathParam param;
    glm::dvec3 joint = path.point(param);
    for (const float each : lengths) {
        param = path.next(param, joint, factor * static_cast<double>(each));
        joint = path.point(param);
    }
    return path.on_ray(param) ? param.t : -length(minus(path.end(), joint));
}

/// The factor at which the tip lies on the end of the path, or the nearer bound. Regula falsi (Illinois: M.
/// Dowell, P. Jarratt, 1971), with a bisection every fourth step. Where the tip jumps over the end, returns
/// the better side of the jump.
double fitted_factor(Path& path, std::span<const float> lengths, double most) noexcept {
    struct Fit {
        double factor, overshoot;
    };
    const auto at = [&](double factor) { return Fit{factor, overshoot(path, lengths, factor)}; };
    Fit low = at(1.0 / most), high = at(most);
    if (low.overshoot >= 0.0) return low.factor;
    if (high.overshoot <= 0.0) return high.factor;
    double below = low.overshoot, above = high.overshoot;
    int side = 0;
    for (int i = 0; i < 60 && high.factor - low.factor > 1e-9 * low.factor; ++i) {
        const Fit found = at(i % 4 == 3 ? 0.5 * (low.factor + high.factor)
                                        : (low.factor * above - high.factor * below) / (above - below));
        if (found.overshoot == 0.0) return found.factor;
        if (found.overshoot < 0.0) {
            low = found, below = found.overshoot;
            if (side < 0) above *= 0.5;
            side = -1;
        } else {
            high = found, above = found.overshoot;
            if (side > 0) below *= 0.5;
            side = 1;
        }
    }
    return -low.overshoot < high.overshoot ? low.factor : high.factor;
}

/// A point of the path with its tangent and a normal that turns as little as possible along the path.
struct Frame {
    glm::dvec3 at, tangent, normal;

    /// Double reflection. Skips a point that is too near to give a direction.
    void move_to(const PathPoint& next) noexcept {
        const glm::dvec3 step = minus(next.at, at);
        const double squared = dot(step, step);
        if (squared > 0.0) {
            const glm::dvec3 side = minus(normal, times(step, 2.0 / squared * dot(step, normal)));
            const glm::dvec3 ahead = minus(tangent, times(step, 2.0 / squared * dot(step, tangent)));
            const glm::dvec3 turn = minus(next.tangent, ahead);
            const double turned = dot(turn, turn);
            normal = turned > 0.0 ? minus(side, times(turn, 2.0 / turned * dot(turn, side))) : side;
        } else {
            normal = rotated(minimal_rotation(tangent, next.tangent), normal);
        }
        at = next.at, tangent = next.tangent;
    }
    /// Removes rounding from the normal.
    void straighten() noexcept {
        const auto kept = direction_of(across(normal, tangent), 0.0);
        normal = kept ? *kept : perpendicular(tangent);
    }
};

void transport(Frame& frame, Path& path, const PathParam& from, const PathParam& to) noexcept {
    constexpr double samples = 8.0;  // a piece
    for (std::size_t k = from.piece; k <= to.piece; ++k) {
        const double start = k == from.piece ? from.t : 0.0;
        const double stop = k == to.piece ? to.t : 1.0;
        const int count = k < path.pieces() ? 1 + static_cast<int>(samples * (stop - start)) : 1;
        for (int i = 1; i <= count; ++i) {
            const PathParam param{k, start + (stop - start) * i / count};
            frame.move_to(path.sample(param, frame.tangent));
        }
    }
    frame.straighten();
}

glm::dvec3 up_side(const glm::dvec3& up, const glm::dvec3& along) noexcept {
    const auto side = direction_of(across(up, along), 1e-6 * length(up));
    return side ? *side : perpendicular(along);
}

/// Applies to `side`, perpendicular to the unit vector `from`, the minimal rotation from there to `to`.
glm::dvec3 turned_along(const glm::dvec3& side, const glm::dvec3& from, const glm::dvec3& to) noexcept {
    const double w = 1.0 + dot(from, to);
    if (w < nearly_opposite<double>) return rotated(minimal_rotation(from, to), side);
    return minus(side, times(plus(from, to), dot(side, to) / w));
}
/// The rotation that takes the unit vector `from` to `axis`, and `from_side`, perpendicular to it, to `side`.
glm::dquat rotation_to(const glm::dvec3& axis, const glm::dvec3& side, const glm::dvec3& from,
                       const glm::dvec3& from_side) noexcept {
    // The minimal rotation, then a twist about the axis: quaternions that are normalised only at the end.
    const glm::dvec3 swung = turned_along(from_side, from, axis);
    const double twist = 1.0 + dot(swung, side), swing = 1.0 + dot(from, axis);
    const double sine = dot(cross(swung, side), axis);
    const bool half_turn = twist < nearly_opposite<double>;
    const glm::dquat about = half_turn ? glm::dquat(0.0, axis.x, axis.y, axis.z)
                                       : glm::dquat(twist, axis.x * sine, axis.y * sine, axis.z * sine);
    const glm::dvec3 by = cross(from, axis);
    const glm::dquat to =
        compose(about, swing < nearly_opposite<double> ? minimal_rotation(from, axis)
                                                       : glm::dquat(swing, by.x, by.y, by.z));
    return unit_quaternion(to.w, to.x, to.y, to.z);
}

/// Compares the joints' positions on the path with the last call's, and stores them for the next.
class Jumps {
  public:
    Jumps(Path& path, std::span<const glm::vec3> points, CurveMemory& memory) noexcept
        : path_(path), memory_(memory), comparable_(memory.points == points.size() && !memory.at.empty()) {
        memory_.points = points.size();
    }

    void root(const PathParam& param) noexcept {
        if (!memory_.at.empty()) remember(0, param);
    }
    /// Compares the bone from joint i - 1 to joint i. Joints beyond the first jump move with it.
    void bone(std::size_t i, const PathParam& from, const glm::dvec3& start, const PathParam& param,
              double length) noexcept {
        if (memory_.at.empty()) return;
        if (comparable_ && !jumped && length > 0.0 && !same_crossing(i, from, start, param, length))
            jumped = i;
        remember(i, param);
    }

    std::optional<std::size_t> jumped{};

  private:
    void remember(std::size_t i, const PathParam& param) noexcept {
        memory_.at[i] = static_cast<double>(param.piece) + param.t;
    }
    /// The rule of CurveReport::jumped.
    bool same_crossing(std::size_t i, const PathParam& from, const glm::dvec3& start, const PathParam& param,
                       double length) noexcept {
        const auto before = [](const PathParam& a, const PathParam& b) {
            return a.piece != b.piece ? a.piece < b.piece : a.t < b.t;
        };
        const double at = std::max(0.0, memory_.at[i]);
        const auto piece = static_cast<std::size_t>(std::min(at, static_cast<double>(path_.pieces())));
        PathParam was{piece, at - static_cast<double>(piece)};
        if (before(was, from)) was = from;
        return before(was, param) ? path_.distance_grows(was, param, start, length)
                                  : path_.distance_grows(param, was, start, length);
    }

    Path& path_;
    CurveMemory& memory_;
    bool comparable_;
};

}  // namespace
}  // namespace detail

const char* name(CurveKind kind) noexcept {
    return detail::curve_kinds[static_cast<std::size_t>(kind)];
}

bool CurveOptions::operator==(const CurveOptions& other) const noexcept {
    return kind == other.kind && fit == other.fit && max_factor == other.max_factor && up == other.up &&
           roll_start == other.roll_start && roll_end == other.roll_end && weight == other.weight &&
           std::ranges::equal(weights, other.weights);
}

glm::vec3 curve_point(std::span<const glm::vec3> points, CurveKind kind, float at) noexcept {
    using namespace detail;
    if (points.size() < 2 || !(at >= 0.0f)) return glm::vec3(0.0f);
    const std::size_t last = points.size() - 2;
    const std::size_t piece = at < static_cast<float>(last) ? static_cast<std::size_t>(at) : last;
    Path path(points, kind, {1.0, 0.0, 0.0});
    return narrow(path.point({piece, std::min(1.0, static_cast<double>(at) - static_cast<double>(piece))}));
}

CurveReport place_along(std::span<const glm::vec3> points, const CurveChain& chain,
                        std::span<glm::vec3> joints, State& state, CurveMemory& memory,
                        const CurveOptions& options) noexcept {
    using namespace detail;
    if (const Result bad = check_input(points, chain, joints, state, memory, options); !bad)
        return refusal<CurveReport>(bad);
    const auto rest_direction = [&](std::size_t i) {
        return chain.rest_directions.empty() ? glm::dvec3(1.0, 0.0, 0.0)
                                             : *direction_of(wide(chain.rest_directions[i]), 0.0);
    };
    Path path(points, options.kind, rest_direction(0));
    const std::span<const float> lengths = chain.lengths;
    const std::size_t bones = lengths.size();
    double reach = 0.0;
    for (const float each : lengths) reach += static_cast<double>(each);

    CurveReport report;
    report.collapsed = path.collapsed();
    const double factor = options.fit && !path.collapsed() && reach > 0.0
                              ? fitted_factor(path, lengths, static_cast<double>(options.max_factor))
                              : 1.0;
    report.factor = static_cast<float>(factor);

    Jumps jumps(path, points, memory);
    PathParam param;
    glm::dvec3 on_path = path.point(param);
    jumps.root(param);
    const glm::dvec3 up = wide(options.up);
    const glm::dvec3 first_tangent = path.sample(param, rest_direction(0)).tangent;
    Frame frame{on_path, first_tangent, up_side(up, first_tangent)};
    glm::dvec3 rest_before = rest_direction(0), rest_side = up_side(up, rest_before);

    const double last_length = static_cast<double>(lengths.back());
    const double roll_start = static_cast<double>(options.roll_start);
    const double roll_end = static_cast<double>(options.roll_end);
    const bool rolls = roll_start != 0.0 || roll_end != 0.0;
    double along = 0.0;           // metres of bones before this one
    bool on_curve = true;         // all bones so far lie on the path
    glm::vec3 given = joints[0];  // this bone's near joint in the given pose
    if (options.weight < 1.0f) on_curve = false;
    joints[0] = on_curve ? narrow(on_path)
                         : narrow(plus(wide(given), times(minus(on_path, wide(given)),
                                                          static_cast<double>(options.weight))));
    for (std::size_t i = 0; i < bones; ++i) {
        const double bone = factor * static_cast<double>(lengths[i]);
        const PathParam next = path.next(param, on_path, bone);
        const glm::dvec3 next_on_path = path.point(next);
        jumps.bone(i + 1, param, on_path, next, bone);
        if (path.on_ray(next)) ++report.bones_past_end;

        // The bone's side: transported along the rest pose, then along the path, then rolled.
        const glm::dvec3 rest = rest_direction(i);
        if (rest != rest_before) rest_side = turned_along(rest_side, rest_before, rest);
        rest_before = rest;
        const glm::dvec3 direction =
            direction_of(minus(next_on_path, on_path), 1e-12 * reach).value_or(frame.tangent);
        const glm::dvec3 side = turned_along(frame.normal, frame.tangent, direction);
        glm::dquat target = rotation_to(direction, side, rest, rest_side);
        if (rolls) {
            const double share = reach > last_length ? along / (reach - last_length) : 0.0;
            target = compose(rotation_about(direction, roll_start + share * (roll_end - roll_start)), target);
        }

        const float weight = options.weight * (options.weights.empty() ? 1.0f : options.weights[i]);
        const glm::vec3 given_next = joints[i + 1];
        if (weight < 1.0f) {
            const glm::quat& old = state.rotations[i];
            const glm::vec3 was = rotated(old, narrow(rest));
            const glm::quat from =
                compose(minimal_rotation(was, math::direction(given, given_next, was)), old);
            state.rotations[i] = math::slerp(from, narrow(target), weight);
            on_curve = false;
        } else {
            state.rotations[i] = narrow(target);
        }
        const double length_drawn =
            static_cast<double>(lengths[i]) * (1.0 + static_cast<double>(weight) * (factor - 1.0));
        joints[i + 1] =
            on_curve ? narrow(next_on_path)
                     : math::moved(joints[i], wide(rotated(state.rotations[i], narrow(rest))), length_drawn);
        transport(frame, path, param, next);
        along += static_cast<double>(lengths[i]);
        given = given_next, param = next, on_path = next_on_path;
    }
    report.jumped = jumps.jumped;
    const double off = length(minus(on_path, path.end()));
    if (path.on_ray(param)) {
        report.past_end = static_cast<float>(param.t);
        if (param.t > 1e-6 * reach) report.status = Status::Stretched;
    } else {
        report.short_of_end = static_cast<float>(off);
    }
    return report;
}

}  // namespace tendril::ik

template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::CurveOptions>() noexcept {
    return ik::detail::curve_rows;
}
