// Linkages: rigid links joined by hinges, sliders and balls into closed loops. A four-bar, a walking leg, a
// Stewart platform.
//
//     const Linkage linkage = *linkage_from(*four_bar({.ground = 3, .crank = 1, .coupler = 2.5}));
//     LinkageSolver solver = *LinkageSolver::make(linkage);
//     LinkageState state = solver.initial_state();
//     const LinkDriver crank{*linkage.find_link("crank"), angle};
//     const LinkageReport report = solver.solve(state, {.drivers = {&crank, 1}});
//     draw(solver.point(*linkage.find_point("P")));
//
// The links form a tree: one joint attaches each to an earlier link or to the ground. Closures close the
// loops: two points or two frames coincide. Drivers give a joint a value; targets pull points to positions.
//
// A solve satisfies, in order of priority: closures and the joints' ranges; drivers; exact targets; weighted
// targets. Each gets only the freedom that those before it leave. Method: Newton's steps of minimal norm on
// the closures, rows orthogonalised in order of priority (B. Siciliano, J.-J. Slotine, "A general framework
// for managing multiple tasks in highly redundant robotic systems", 1991); targets by Newton's steps in the
// null space of these, with the second derivatives of targets and closures (J. Nocedal, S. Wright, "Numerical
// Optimization", 2006, 18.1), or damped Gauss-Newton steps (Levenberg 1944, Marquardt 1963) where these lead
// to no minimum, each followed by a return to the closures; ranges by an active set. A driver goes to its
// value in substeps: one is taken only if it ends where the tangent led (E. Allgower, K. Georg, "Introduction
// to Numerical Continuation Methods", 2003, on step control). So a linkage stays in its assembly mode while a
// driver glides, and stops at a dead point. Where branches cross, as in a parallelogram folded onto one line,
// it continues its last motion; branches within 1e-4 radians or sizes of each other count as crossing. In
// space a driver can change branches near a crossing without a report: it did in 13 of 330 000 random steps
// of two hinges and a coupler between balls.
//
// Targets have no such guard. A small step of a target can make the nearest point of the path vanish. The
// pulled point then jumps to another part of its path, and the report says so.
//
// Cost: O(m^2 n) an iteration with m equations of closures and n degrees of freedom of the joints, and with
// targets O(m n^2 + n^3) more. A frame of a glide takes two or three iterations: a four-bar 1 us, Jansen's
// leg 4 us, a Stewart platform 13 us. With a target, 19 frames in 20 take at most 15 iterations
// (tests/core/ik_linkage_verdict_test.cpp); more where it jumps or meets a range (a delta robot at the end of
// its reach up to 80). Solving does not allocate or throw; same input, same bits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tendril/fields.hpp"
#include "tendril/quat.hpp"
#include "tendril/result.hpp"
#include "tendril/vec3.hpp"

namespace tendril::ik {

/// The ground, in place of a link's index. It does not move.
inline constexpr std::size_t ground_link = static_cast<std::size_t>(-1);

enum class LinkJoint : std::uint8_t {
    Hinge,   ///< turns about an axis
    Slider,  ///< moves along an axis, without turning
    Ball     ///< turns about a point
};
/// "hinge", "slider", "ball"
const char* name(LinkJoint joint) noexcept;

/// A rigid link and the joint to its parent. All positions are in world space, in the pose as drawn.
struct Link {
    std::string name{};
    std::size_t parent = ground_link;  ///< an earlier link
    LinkJoint joint = LinkJoint::Hinge;
    glm::dvec3 at{0.0};              ///< position of the joint, metres
    glm::dvec3 axis{0.0, 0.0, 1.0};  ///< axis of a hinge or slider; any length but 0
    /// The joint's value as drawn: radians for a hinge, metres for a slider; no effect for a ball.
    double rest = 0.0;
    /// Range of the value. A ball has only a maximum: its turn from the pose as drawn, radians, 0 to pi.
    double minimum = -std::numeric_limits<double>::infinity();
    double maximum = std::numeric_limits<double>::infinity();

    bool operator==(const Link&) const = default;
};

/// A point that moves with a link, or stays with the ground.
struct LinkPoint {
    std::string name{};
    std::size_t link = ground_link;
    glm::dvec3 at{0.0};  ///< as drawn, metres

    bool operator==(const LinkPoint&) const = default;
};

enum class ClosureKind : std::uint8_t {
    Point,  ///< two points coincide
    Frame   ///< two points coincide, and the links keep their relative rotation as drawn
};

/// Closes a loop: a point of one link coincides with a point of another. As drawn they may be apart.
struct Closure {
    std::string name{};
    ClosureKind kind = ClosureKind::Point;
    std::size_t first = ground_link, second = ground_link;  ///< links
    glm::dvec3 first_at{0.0}, second_at{0.0};               ///< as drawn, metres

    bool operator==(const Closure&) const = default;
};

/// A linkage as drawn; a plain value.
struct Linkage {
    std::vector<Link> links{};  ///< parents before children
    std::vector<LinkPoint> points{};
    std::vector<Closure> closures{};

    /// nullopt for an unknown name.
    std::optional<std::size_t> find_link(std::string_view name) const noexcept;
    std::optional<std::size_t> find_point(std::string_view name) const noexcept;
    bool operator==(const Linkage&) const = default;
};
/// InvalidArgument, naming the list, the index and the value, for a parent that does not come before its
/// child, a coordinate that is not finite or over max_magnitude, a zero axis, an empty range, a rest value
/// outside it, a missing link, a closure of a link with itself, two links of one name (except ""), or more
/// than max_links links, points or closures.
Result check(const Linkage& linkage) noexcept;
inline constexpr std::size_t max_links = 512;

/// State of one joint: `value` is a hinge's angle (radians, not wrapped) or a slider's travel (metres),
/// `turn` a ball's rotation from the pose as drawn.
struct JointPlace {
    double value = 0.0;
    glm::dquat turn{1.0, 0.0, 0.0, 0.0};
    /// Change of the value in the last substep of a drive, whether driven or not. A linkage continues that
    /// way through poses in which its motion is ambiguous, such as a parallelogram folded onto one line.
    double last = 0.0;
    bool operator==(const JointPlace&) const = default;
};
/// All state that a linkage keeps from frame to frame: one JointPlace per link.
struct LinkageState {
    std::vector<JointPlace> joints{};
    bool operator==(const LinkageState&) const = default;
};

/// Gives a hinge or slider a value, radians or metres. A hinge takes any number of turns.
struct LinkDriver {
    std::size_t link = 0;
    double value = 0.0;
};
/// Pulls a point to a position. A planar linkage ignores the part across its plane.
struct LinkTarget {
    std::size_t point = 0;
    glm::dvec3 to{0.0};   ///< metres
    double weight = 1.0;  ///< over 0 to max_magnitude; only ratios matter
    bool exact = false;   ///< takes priority over targets that are not; weights apply among exact ones
};
/// At most one driver per link and one target per point.
struct LinkageGoals {
    std::span<const LinkDriver> drivers{};
    std::span<const LinkTarget> targets{};
};

enum class LinkageStatus : std::uint8_t {
    Reached,         ///< closed, drivers at their values and targets reached, to 1e-6
    TargetMissed,    ///< closed and driven, but a target is out of reach
    Limited,         ///< a range stops a driver or target
    DeadPoint,       ///< a driver cannot go further
    Open,            ///< no pose that closes the linkage was found: its closures contradict each other
    IterationLimit,  ///< iterations used up on the way; the next solve continues
    InvalidInput     ///< a number is not finite or out of range: nothing was moved
};
/// "Reached", "TargetMissed"...
const char* name(LinkageStatus status) noexcept;

struct LinkageReport {
    LinkageStatus status = LinkageStatus::Reached;
    int iterations = 0;
    /// The largest closure error, metres: the distance of points that should coincide, or the angle between
    /// frames times the size.
    double closed_to = 0.0;
    double residual = 0.0;  ///< the largest distance of a point from its target, metres; infinite if refused
    double driver_residual = 0.0;  ///< the largest error of a driver, radians or metres
    int freedom = 0;               ///< degrees of freedom that drivers and active ranges leave
    /// The link of the driver that cannot go further, and the value where it stopped.
    std::optional<std::size_t> stopped{};
    double stopped_at = 0.0;
    /// A target pulled the linkage past a dead point of its drivers (of `watched`, if nothing is driven): it
    /// switched to another assembly mode. Drivers alone never do that.
    bool passed_dead_point = false;
    /// Index of the target whose point jumped: the point of the path nearest to the target vanished, and it
    /// moved on to another part of the path. Not set if the point reaches its target. Also set after a large
    /// step round a bend: compare `jump` with that step. With exact targets, only their pull decides what is
    /// a jump.
    std::optional<std::size_t> jumped{};
    double jump = 0.0;  ///< distance that point moved, metres
    Result accepted{};  ///< why the status is InvalidInput
    bool operator==(const LinkageReport&) const = default;
};

struct LinkageOptions {
    int max_iterations = 1000;  ///< 1 to 1 000 000
    /// Metres; by default 1e-10 of the size. Targets count as reached at 1e-6 of the size.
    std::optional<double> tolerance{};
    /// Links whose hinges or sliders would drive the linkage: while targets move it, passing a dead point of
    /// these is reported.
    std::span<const std::size_t> watched{};
};

/// Degrees of freedom: Gruebler's (Kutzbach's) count, and the true number in the given pose. They differ
/// where closures are redundant (a double parallelogram, Bennett's linkage) or the pose is singular.
struct LinkageFreedom {
    int counted = 0;  ///< the joints' freedoms minus the closures' equations; in the plane if planar
    int actual = 0;   ///< the joints' freedoms minus the rank of the closures
    bool operator==(const LinkageFreedom&) const = default;
};

/// Pose of a link: a point drawn at p is at rotation * p + shift.
struct LinkPlace {
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
    glm::dvec3 shift{0.0};
    glm::dvec3 point(const glm::dvec3& drawn) const noexcept;
};

/// The assembly mode to which other_mode() switches.
enum class OtherMode : std::uint8_t {
    Next,    ///< the next in a fixed order: repeated calls visit all modes and return to the first
    Nearest  ///< the mode whose joints differ least; next to a dead point, the one that meets this mode there
};

/// Solves one linkage. Holds its constants and scratch memory; persistent state is in LinkageState.
class LinkageSolver {
  public:
    /// Fails if check() does.
    static Expected<LinkageSolver> make(const Linkage& linkage);
    ~LinkageSolver();
    LinkageSolver(LinkageSolver&&) noexcept;
    LinkageSolver& operator=(LinkageSolver&&) noexcept;

    const Linkage& linkage() const noexcept;
    /// True if all hinges turn about one direction, all sliders are perpendicular to it, and there are no
    /// balls.
    bool planar() const noexcept;
    /// The largest extent of the linkage as drawn, metres. If drawn at one point, a slider's range, or 1.
    double size() const noexcept;
    /// As drawn. It need not be closed: the first solve closes it.
    LinkageState initial_state() const;

    /// Moves the state to the pose that best meets the goals. InvalidInput, changing nothing, for a state of
    /// another linkage, a number that is not finite or out of range, a missing link or point, a driver of a
    /// ball, two drivers of one link, two targets of one point.
    ///
    /// If it ends Open, the sum of squared closure errors is minimal; if at a dead point with several
    /// drivers, they are as near to their values as they can get from here.
    LinkageReport solve(LinkageState& state, const LinkageGoals& goals = {},
                        const LinkageOptions& options = {}) noexcept;

    /// Switches to another assembly mode: another closed pose with the drivers' joints where they are.
    /// NotFound, changing nothing, if there is none, or if the drivers leave freedom: a linkage that moves
    /// freely has no modes. InvalidArgument for what solve() refuses. Deterministic. Costs some hundred
    /// solves.
    Result other_mode(LinkageState& state, std::span<const LinkDriver> drivers,
                      OtherMode which = OtherMode::Next) noexcept;

    /// The degrees of freedom in this pose, without drivers.
    LinkageFreedom freedom(const LinkageState& state) noexcept;

    /// Finds the forces that balance a torque or force of 1 on a joint, in this pose, with the joints of
    /// `held` fixed: for each closure, the force on its first link (the second gets the opposite), in N per N
    /// m, or N per N on a slider, without a frame's torque. Returns the unbalanced part, 0 to 1: 0 at a dead
    /// point of the joint. If state, link or size of `forces` do not fit, or for a ball, returns 1 and leaves
    /// `forces` alone.
    double balance(const LinkageState& state, std::size_t link, std::span<const std::size_t> held,
                   std::span<glm::dvec3> forces) noexcept;

    // The pose of the last solve, or of place().

    /// Computes the links' poses for a state, such as a saved one. Refuses a state of another linkage.
    Result place(const LinkageState& state) noexcept;
    std::span<const LinkPlace> links() const noexcept;
    /// Position of Linkage::points[index], metres; the origin if there is no such point.
    glm::dvec3 point(std::size_t index) const noexcept;
    /// A joint's position and axis in the world (unit; zero for a ball).
    glm::dvec3 joint(std::size_t link) const noexcept;
    glm::dvec3 axis(std::size_t link) const noexcept;

    // Reasons why the last solve missed its goals. Valid until the next one, or other_mode().

    /// The distance of each target from its point, metres.
    std::span<const double> residuals() const noexcept;
    /// Links whose joints are pressed against the end of their range.
    std::span<const std::size_t> active() const noexcept;
    /// All closures that are apart, if it ended Open or ran out of iterations. It is not known which of them
    /// contradict each other.
    std::span<const std::size_t> open_closures() const noexcept;

  private:
    struct Parts;
    explicit LinkageSolver(std::unique_ptr<Parts> parts) noexcept;
    std::unique_ptr<Parts> parts_;
};

}  // namespace tendril::ik

template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::LinkageOptions>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::Link>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::LinkPoint>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::Closure>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::Linkage>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::JointPlace>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::LinkageState>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::LinkageReport>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::LinkageFreedom>() noexcept;
