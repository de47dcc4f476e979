#include "ik/pole/pole.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "ik/math.hpp"
#include "ik/tunables.hpp"
#include "tendril/elementary.hpp"
#include "tendril/ik/options.hpp"

namespace tendril::ik::detail {
namespace {

using namespace tune::pole;

constexpr double unlimited = std::numeric_limits<double>::infinity();

constexpr double min_offset = 1e-6;  ///< fraction of the reach: smaller offsets are rounding

/// Direction and size of the chain's offset from a line through its root.
struct Bend {
    glm::dvec3 side{0.0};  ///< sum of the offsets, weighted by the adjacent lengths
    double furthest = 0.0;
};

Bend bend_of(const Problem& problem, const glm::dvec3& line) noexcept {
    const glm::dvec3 root = wide(problem.root());
    const double whole = 2.0 * static_cast<double>(problem.scratch.reach);
    Bend bend;
    for (std::size_t i = 1; i < problem.bones(); ++i) {
        const glm::dvec3 offset = across(minus(wide(problem.joints[i]), root), line);
        const double adjacent =
            static_cast<double>(problem.lengths()[i - 1]) + static_cast<double>(problem.lengths()[i]);
        bend.side = plus(bend.side, times(offset, adjacent / whole));
        bend.furthest = std::max(bend.furthest, dot(offset, offset));
    }
    bend.furthest = std::sqrt(bend.furthest);
    return bend;
}

bool lies_along(const Problem& problem, const std::optional<glm::dvec3>& line) noexcept {
    return line && bend_of(problem, *line).furthest <= straight * static_cast<double>(problem.scratch.reach);
}

/// True if the chain lies on the line to its target. In a plane, also true if it is folded up on any other
/// line with its tip at its root: such a chain was not turned to its target and would zigzag all the way
/// there. Its offsets from the line from root to tip cancel out, so rounding would decide its side and mirror
/// it again and again.
bool is_on_line(const Problem& problem, const glm::dvec3& to_target) noexcept {
    if (lies_along(problem, to_target)) return true;
    const glm::vec3 root = problem.root(), tip = minus(problem.joints.back(), root);
    const double reach = static_cast<double>(problem.scratch.reach);
    if (!problem.options.plane || length(wide(tip)) > closed_tip * reach) return false;
    glm::dvec3 furthest(0.0);
    for (const glm::vec3& joint : problem.joints) {
        const glm::dvec3 arm = wide(minus(joint, root));
        if (dot(arm, arm) > dot(furthest, furthest)) furthest = arm;
    }
    return lies_along(problem, direction_of(furthest, min_offset * reach));
}

/// The angle about `line` from one vector to another, -pi to pi, ignoring their components along the line.
double angle_about(const glm::dvec3& line, const glm::dvec3& from, const glm::dvec3& to) noexcept {
    return math::arctangent(dot(cross(from, to), line), dot(from, to) - dot(from, line) * dot(to, line));
}

/// Rotates a vector about a unit axis.
struct AxisAngle {
    glm::dvec3 axis;
    double sine, cosine;

    AxisAngle(const glm::dvec3& about, double angle) noexcept
        : axis(about), sine(math::sine(angle)), cosine(math::cosine(angle)) {}
    glm::dvec3 operator()(const glm::dvec3& v) const noexcept {
        const glm::dvec3 along = times(axis, dot(axis, v));
        return plus(along, plus(times(minus(v, along), cosine), times(cross(axis, v), sine)));
    }
};

/// Limits the angle so that a point at distance `arm` from the axis moves no further than the allowance.
double limited(double angle, double arm, double allowance) noexcept {
    if (std::abs(angle) * arm <= allowance) return angle;
    return std::copysign(allowance / arm, angle);
}

/// Half-angle h, for which an arc of length 1 and radius 1 / 2h spans sin(h) / h = `span`, 0 to 1. Newton's
/// method on a function that is convex between the start and the root.
double half_angle_of_arc(double span) noexcept {
    double h = std::sqrt(6.0 * std::max(1.0 - span, 0.0));
    for (int step = 0; step < 6 && h > 1e-6; ++step) {
        h -= (math::sine(h) - span * h) / (math::cosine(h) - span);
    }
    return h;
}

/// Direction of the pole from `from`, perpendicular to the line; none if the pole is on the line, within
/// rounding. In a plane: the chosen side of the line.
std::optional<glm::dvec3> pole_side(const Problem& problem, const glm::dvec3& from,
                                    const glm::dvec3& line) noexcept {
    if (problem.options.plane) return planar_side(problem, line);
    const glm::dvec3 arm = minus(wide(*problem.options.pole), from);
    const double minimum = 10.0 * min_offset * static_cast<double>(problem.scratch.reach);
    return direction_of(across(arm, line), std::max(minimum, min_offset * length(arm)));
}

/// The angle about `line` by which the whole chain turns to face its pole, limited by the allowance, which it
/// uses up.
double whole_angle(Problem& problem, const glm::dvec3& line) noexcept {
    const Bend bend = bend_of(problem, line);
    const double minimum = min_offset * static_cast<double>(problem.scratch.reach);
    const std::optional<glm::dvec3> to = pole_side(problem, wide(problem.root()), line);
    if (!to || !direction_of(bend.side, minimum)) return 0.0;
    const double angle =
        limited(angle_about(line, bend.side, *to), bend.furthest, problem.scratch.pole.allowance);
    problem.scratch.pole.allowance -= std::abs(angle) * bend.furthest;
    return angle;
}

template <class Watch>
void place(Problem& problem, std::size_t joint, std::size_t about, const glm::dvec3& at,
           Watch watch) noexcept {
    const glm::vec3 from = problem.joints[joint];
    problem.joints[joint] = narrow(at);
    watch.moved(problem.iteration, Phase::Pole, joint, about, from, problem.joints[joint]);
}

/// Rotates the chain rigidly about its root. Restores the lengths of bones on the way; otherwise they would
/// drift in solves that move a chain in no other way.
template <class Watch>
void rotate_chain(Problem& problem, const AxisAngle& rotation, Watch watch) noexcept {
    glm::vec3 before = problem.root();
    for (std::size_t i = 0; i < problem.bones(); ++i) {
        const glm::dvec3 bone = rotation(minus(wide(problem.joints[i + 1]), wide(before)));
        const double size = length(bone), wanted = static_cast<double>(problem.lengths()[i]);
        before = problem.joints[i + 1];
        const glm::dvec3 with_length = size > 0.0 ? times(bone, wanted / size) : glm::dvec3(wanted, 0.0, 0.0);
        place(problem, i + 1, 0, plus(wide(problem.joints[i]), with_length), watch);
    }
    watch.next_step();
}

/// Rotates all joints except root and tip about a line through the root.
template <class Watch>
void swivel(Problem& problem, const AxisAngle& rotation, Watch watch) noexcept {
    const glm::dvec3 root = wide(problem.root());
    for (std::size_t i = 1; i < problem.bones(); ++i) {
        place(problem, i, 0, plus(root, rotation(minus(wide(problem.joints[i]), root))), watch);
    }
    watch.next_step();
}

template <class Watch>
void face_with_whole_chain(Problem& problem, Watch watch) noexcept {
    // With the tip at the root, the tolerance decides in which direction a line in the plane points.
    const double minimum =
        (problem.options.plane ? closed_tip : min_offset) * static_cast<double>(problem.scratch.reach);
    const std::optional<glm::dvec3> line =
        direction_of(minus(wide(problem.joints.back()), wide(problem.root())), minimum);
    if (!line) return;
    const double angle = whole_angle(problem, *line);
    if (angle != 0.0) swivel(problem, AxisAngle(*line, angle), watch);
}

/// Turns one joint about the line through its neighbours. Returns the angle, radians.
template <class Watch>
double face_with_joint(Problem& problem, std::size_t joint, Watch watch) noexcept {
    const double minimum = min_offset * static_cast<double>(problem.scratch.reach);
    std::vector<glm::dvec3>& joints = problem.scratch.pole.wide_joints;
    const glm::dvec3 before = joints[joint - 1];
    const std::optional<glm::dvec3> line = direction_of(minus(joints[joint + 1], before), minimum);
    if (!line) return 0.0;
    const glm::dvec3 arm = minus(joints[joint], before), offset = across(arm, *line);
    const std::optional<glm::dvec3> to = pole_side(problem, before, *line);
    if (!to || !direction_of(offset, minimum)) return 0.0;
    const double angle =
        limited(angle_about(*line, offset, *to), length(offset), problem.scratch.pole.allowance);
    if (angle == 0.0) return 0.0;
    joints[joint] = plus(before, AxisAngle(*line, angle)(arm));
    place(problem, joint, joint - 1, joints[joint], watch);
    watch.next_step();
    return std::abs(angle);
}

template <class Watch>
void face_with_each_joint(Problem& problem, Watch watch) noexcept {
    // In double throughout: floats would be rounded in every sweep, and bones would drift.
    std::transform(problem.joints.begin(), problem.joints.end(), problem.scratch.pole.wide_joints.begin(),
                   [](const glm::vec3& joint) { return wide(joint); });
    const int sweeps = problem.scratch.pole.allowance < unlimited ? 1 : max_sweeps;
    for (int sweep = 0; sweep < sweeps; ++sweep) {
        double largest = 0.0;
        for (std::size_t i = 1; i < problem.bones(); ++i) {
            largest = std::max(largest, face_with_joint(problem, i, watch));
        }
        if (largest < at_rest) return;
    }
}

}  // namespace

template <class Watch>
bool bend_to_pole(Problem& problem, Watch watch) noexcept {
    if (!problem.options.pole && !problem.options.plane) return false;
    const double reach = static_cast<double>(problem.scratch.reach);
    const glm::dvec3 root = wide(problem.root()), arm = minus(wide(problem.target), root);
    const std::optional<glm::dvec3> line = direction_of(arm, min_offset * reach);
    if (!line || !is_on_line(problem, *line)) return false;
    const std::optional<glm::dvec3> side = pole_side(problem, root, *line);
    if (!side) return false;
    const double half = half_angle_of_arc(length(arm) / reach);
    double before = 0.0;
    glm::dvec3 at = root;
    for (std::size_t i = 0; i < problem.bones(); ++i) {
        const auto size = static_cast<double>(problem.lengths()[i]);
        const double angle = half * (1.0 - (2.0 * before + size) / reach);
        before += size;
        at = plus(at, times(plus(times(*line, math::cosine(angle)), times(*side, math::sine(angle))), size));
        place(problem, i + 1, i, at, watch);
    }
    watch.next_step();
    return true;
}

double pole_allowance(const Problem& problem) noexcept {
    const PoleMemory& last = problem.state.pole;
    if (problem.options.plane || !last.valid || last.turn != problem.options.pole_turn) return unlimited;
    const glm::vec3 root = problem.root();
    double joints = 0.0;
    for (std::size_t i = 1; i < problem.joints.size(); ++i) {
        const glm::dvec3 by = minus(wide(minus(problem.joints[i], root)), wide(last.joints[i]));
        joints = std::max(joints, dot(by, by));
    }
    const double changed = std::sqrt(joints) +
                           length(minus(wide(minus(problem.target, root)), wide(last.target))) +
                           length(minus(wide(minus(*problem.options.pole, root)), wide(last.pole)));
    const double reach = static_cast<double>(problem.scratch.reach);
    const double twisted = std::abs(static_cast<double>(problem.options.twist - last.twist)) * reach;
    const double all = changed + twisted;
    return all <= jump * reach ? free_part * reach + tune::pole::follow * all : unlimited;
}

void remember_pose(Problem& problem) noexcept {
    problem.scratch.pole.allowance = unlimited;
    PoleMemory& memory = problem.state.pole;
    memory.valid = problem.options.pole.has_value();
    if (!memory.valid) return;
    const glm::vec3 root = problem.root();
    memory.turn = problem.options.pole_turn;
    memory.pole = minus(*problem.options.pole, root);
    memory.target = minus(problem.target, root);
    memory.twist = problem.options.twist;
    for (std::size_t i = 0; i < problem.joints.size(); ++i) memory.joints[i] = minus(problem.joints[i], root);
}

template <class Watch>
void transport_to_pole(Problem& problem, Watch watch) noexcept {
    if (!problem.options.pole && !problem.options.plane) {
        problem.state.pole.valid = false;
        return;
    }
    problem.scratch.pole.allowance = pole_allowance(problem);
    const double minimum =
        (problem.options.plane ? closed_tip : 1e-4) * static_cast<double>(problem.scratch.reach);
    const glm::dvec3 root = wide(problem.root());
    const std::optional<glm::dvec3> from = direction_of(minus(wide(problem.joints.back()), root), minimum);
    const std::optional<glm::dvec3> to = direction_of(minus(wide(problem.target), root), minimum);
    if (!from || !to) return;
    const glm::dvec3 normal = cross(*from, *to);
    const double sine = length(normal);
    // For opposite directions any perpendicular axis will do.
    const glm::dvec3 axis = sine > 1e-9 ? times(normal, 1.0 / sine) : perpendicular(*from);
    const double angle = math::arctangent(sine, dot(*from, *to));
    if (angle > 1e-9) rotate_chain(problem, AxisAngle(axis, angle), watch);
    if (problem.options.pole_turn == PoleTurn::EachJoint) return;
    const double about = whole_angle(problem, *to);
    if (about != 0.0) rotate_chain(problem, AxisAngle(*to, about), watch);
}

template <class Watch>
void face_pole(Problem& problem, Watch watch) noexcept {
    if (problem.options.pole && problem.options.pole_turn == PoleTurn::EachJoint) {
        face_with_each_joint(problem, watch);
    } else if (problem.options.pole || problem.options.plane) {
        face_with_whole_chain(problem, watch);
    }
    remember_pose(problem);
}

glm::dvec3 planar_side(const Problem& problem, const glm::dvec3& line) noexcept {
    const double sign = problem.options.plane->bend == Side::Right ? -1.0 : 1.0;
    return {sign * line.z, 0.0, -sign * line.x};
}

Side planar_side(const Problem& problem) noexcept {
    const double reach = static_cast<double>(problem.scratch.reach);
    const std::optional<glm::dvec3> line =
        direction_of(minus(wide(problem.joints.back()), wide(problem.root())), closed_tip * reach);
    if (!line) return Side::Free;
    const glm::dvec3 side = bend_of(problem, *line).side;
    const double left = side.x * line->z - side.z * line->x;
    return std::abs(left) <= 1e-4 * reach ? Side::Free : left > 0.0 ? Side::Left : Side::Right;
}

glm::vec3 side_of(const Problem& problem, const glm::vec3& line) noexcept {
    if (problem.options.plane) return narrow(planar_side(problem, wide(line)));
    if (problem.options.pole) {
        const glm::vec3 arm = minus(*problem.options.pole, problem.root());
        const glm::vec3 off = minus(arm, times(line, dot(arm, line)));
        const float far = length(off);
        if (far > 1e-5f * problem.scratch.reach) return times(off, 1.0f / far);
    }
    return perpendicular(line);
}

template void transport_to_pole(Problem&, Unwatched) noexcept;
template void transport_to_pole(Problem&, Watched) noexcept;
template bool bend_to_pole(Problem&, Unwatched) noexcept;
template bool bend_to_pole(Problem&, Watched) noexcept;
template void face_pole(Problem&, Unwatched) noexcept;
template void face_pole(Problem&, Watched) noexcept;

}  // namespace tendril::ik::detail
