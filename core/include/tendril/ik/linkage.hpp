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
// The links form a tree: each hangs on an earlier one, or on the ground, by one joint. Loops are closed by
// closures, two points or two frames that coincide. Drivers give a joint a value; targets pull points to
// positions.
//
// A solve meets, in this order: closures and the joints' ranges; drivers; exact targets; the others,
// weighted. What comes later gets what freedom is left. Method: Newton's steps of minimal norm on the
// closures, rows orthogonalised in order of priority (B. Siciliano, J.-J. Slotine, "A general framework for
// managing multiple tasks in highly redundant robotic systems", 1991); targets by Newton's steps in the null
// space of these, with the second derivatives of targets and closures (J. Nocedal, S. Wright, "Numerical
// Optimization", 2006, 18.1), or damped Gauss-Newton steps (Levenberg 1944, Marquardt 1963) where these lead
// to no minimum, each followed by a return to the closures; ranges by an active set. A driver goes to its
// value in substeps: one is taken only if it ends where the tangent led (E. Allgower, K. Georg, "Introduction
// to Numerical Continuation Methods", 2003, on step control). So a linkage stays in its assembly mode while a
// driver glides, and stops at a dead point. Where branches cross, as in a parallelogram folded onto one line,
// it goes on as it last moved; branches that come within 1e-4 radians or sizes of each other count as
// crossing. In space a driver has changed branches near such a place without a report, in 13 of 330 000
// random steps of two hinges and a coupler between balls.
//
// Targets have no such guard. A small step of a target can make its nearest place vanish. The point then
// jumps to another part of its path, and the report says so.
//
// Cost: O(m^2 n) an iteration with m equations of closures and n degrees of freedom of the joints, and with
// targets O(m n^2 + n^3) more. A frame of a glide takes two or three iterations: a four-bar 1 us, Jansen's
// leg 4 us, a Stewart platform 13 us. With a target, 19 frames in 20 take at most 15 iterations
// (tests/bench/linkage.cpp); more where it jumps or meets a range (a delta robot at the end of its reach up
// to 80). Solving does not allocate or throw; same input, same bits.
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

/// In place of a link's index: what does not move.
inline constexpr std::size_t ground_link = static_cast<std::size_t>(-1);

enum class LinkJoint : std::uint8_t {
    Hinge,   ///< turns about an axis
    Slider,  ///< moves along an axis, without turning
    Ball     ///< turns about a point
};
/// "hinge", "slider", "ball"
const char* name(LinkJoint joint) noexcept;

/// A rigid link, and the joint by which it hangs on its parent. All positions are the world's, in the pose in
/// which the linkage is drawn.
struct Link {
    std::string name{};
    std::size_t parent = ground_link;  ///< an earlier link
    LinkJoint joint = LinkJoint::Hinge;
    glm::dvec3 at{0.0};              ///< the joint; metres
    glm::dvec3 axis{0.0, 0.0, 1.0};  ///< of a hinge or slider; any length but 0
    /// The value that the joint has as drawn: radians, or metres. A ball has none.
    double rest = 0.0;
    /// Range of the value. A ball's maximum is how far it turns from the pose as drawn, radians, 0 to pi.
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
    Frame   ///< and the links turn together: the angle between them stays as drawn
};

/// Closes a loop: a point of one link coincides with a point of another. As drawn they may be apart.
struct Closure {
    std::string name{};
    ClosureKind kind = ClosureKind::Point;
    std::size_t first = ground_link, second = ground_link;  ///< links
    glm::dvec3 first_at{0.0}, second_at{0.0};               ///< as drawn, metres

    bool operator==(const Closure&) const = default;
};

/// A linkage as drawn: a plain value.
struct Linkage {
    std::vector<Link> links{};  ///< parents before children
    std::vector<LinkPoint> points{};
    std::vector<Closure> closures{};

    /// nullopt if there is none of that name.
    std::optional<std::size_t> find_link(std::string_view name) const noexcept;
    std::optional<std::size_t> find_point(std::string_view name) const noexcept;
    bool operator==(const Linkage&) const = default;
};
/// InvalidArgument, with the name of the list, the index and the value, for a parent that does not come
/// before, a coordinate that is not finite or over max_magnitude, an axis of no length, an empty range, a
/// rest outside it, a link that is not there, two links of one name (but ""), or more than max_links links,
/// points or closures.
Result check(const Linkage& linkage) noexcept;
inline constexpr std::size_t max_links = 512;

/// Where one joint is: a hinge's angle (radians, not wrapped) or a slider's travel (metres); a ball's
/// rotation from the pose as drawn.
struct JointPlace {
    double value = 0.0;
    glm::dquat turn{1.0, 0.0, 0.0, 0.0};
    /// How far the value moved in the last substep of a drive, whether driven or not. A linkage goes on like
    /// that through poses in which its motion is ambiguous: a parallelogram folded onto one line.
    double last = 0.0;
    bool operator==(const JointPlace&) const = default;
};
/// All that a linkage remembers from frame to frame. One JointPlace for each link.
struct LinkageState {
    std::vector<JointPlace> joints{};
    bool operator==(const LinkageState&) const = default;
};

/// Gives a hinge or slider a value, radians or metres. A hinge may be given any number of turns.
struct LinkDriver {
    std::size_t link = 0;
    double value = 0.0;
};
/// Pulls a point to a position. In a planar linkage only the part in its plane counts.
struct LinkTarget {
    std::size_t point = 0;
    glm::dvec3 to{0.0};   ///< metres
    double weight = 1.0;  ///< over 0 to max_magnitude; only ratios matter
    bool exact = false;   ///< before all that are not; the weight counts among exact ones
};
/// No link is driven twice, and no point has two targets.
struct LinkageGoals {
    std::span<const LinkDriver> drivers{};
    std::span<const LinkTarget> targets{};
};

enum class LinkageStatus : std::uint8_t {
    Reached,         ///< closed, drivers at their values and targets reached, to 1e-6
    TargetMissed,    ///< closed and driven, but a target is out of reach
    Limited,         ///< a range stops a driver or target
    DeadPoint,       ///< a driver cannot go on
    Open,            ///< no pose that closes the linkage was found: its closures contradict each other
    IterationLimit,  ///< not there when the iterations were used up; the next solve goes on
    InvalidInput     ///< a number is not finite or out of range: nothing was moved
};
/// "Reached", "TargetMissed"...
const char* name(LinkageStatus status) noexcept;

struct LinkageReport {
    LinkageStatus status = LinkageStatus::Reached;
    int iterations = 0;
    /// Metres, the largest distance between points that should coincide; the angle between frames counts by
    /// the size.
    double closed_to = 0.0;
    double residual = 0.0;         ///< metres, the largest distance of a point from its target
    double driver_residual = 0.0;  ///< radians or metres, how far a driver is from its value at most
    int freedom = 0;               ///< degrees of freedom that drivers and active ranges leave
    /// The driver that cannot go on, a link, and the value where it stopped.
    std::optional<std::size_t> stopped{};
    double stopped_at = 0.0;
    /// A target pulled the linkage past a dead point of its drivers (of `watched`, if nothing is driven): it
    /// switched to another assembly mode. Drivers alone never do that.
    bool passed_dead_point = false;
    /// The target whose point jumped: the place it was nearest to vanished, and it ran on to another part of
    /// its path. An index of the targets. Not set if the point arrives at its target. Also set after a large
    /// step round a bend: compare `jump` with that step. Where there are exact targets, all are measured
    /// against the pull of these.
    std::optional<std::size_t> jumped{};
    double jump = 0.0;  ///< metres, how far that point moved

    bool operator==(const LinkageReport&) const = default;
};

struct LinkageOptions {
    int max_iterations = 1000;  ///< 1 to 1 000 000
    /// Metres; by default 1e-10 of the size. Targets count as reached at 1e-6 of the size.
    std::optional<double> tolerance{};
    /// Links whose joints would drive the linkage: while targets move it, a passage through a dead point of
    /// these is reported.
    std::span<const std::size_t> watched{};
};

/// Gruebler's (Kutzbach's) count of the degrees of freedom, beside the true one in the given pose. They
/// differ where closures are redundant (a double parallelogram, Bennett's linkage) or the pose is
/// singular.
struct LinkageFreedom {
    int counted = 0;  ///< joints' freedoms less closures' equations; in the plane if the linkage is planar
    int actual = 0;   ///< the rank's
    bool operator==(const LinkageFreedom&) const = default;
};

/// Where a link is: a point drawn at p is at rotation * p + shift.
struct LinkPlace {
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
    glm::dvec3 shift{0.0};
    glm::dvec3 point(const glm::dvec3& drawn) const noexcept;
};

/// Solves one linkage. Holds its constants and scratch memory; all that persists is in the LinkageState.
class LinkageSolver {
  public:
    /// Fails if check() does.
    static Expected<LinkageSolver> make(const Linkage& linkage);
    ~LinkageSolver();
    LinkageSolver(LinkageSolver&&) noexcept;
    LinkageSolver& operator=(LinkageSolver&&) noexcept;

    const Linkage& linkage() const noexcept;
    /// All hinges turn about one direction, all sliders are across it, and there are no balls.
    bool planar() const noexcept;
    /// The largest extent of the linkage as drawn, metres. If all is drawn in one place, a slider's range,
    /// or 1.
    double size() const noexcept;
    /// As drawn. It need not be closed: the first solve closes it.
    LinkageState initial_state() const;

    /// Moves the state to the best pose there is. InvalidInput, and nothing is changed, for a state of
    /// another linkage, a number that is not finite or out of range, a link or point that is not there, a
    /// link that is driven twice or is a ball's, two targets of one point.
    ///
    /// If it ends Open, the sum of squared distances of the closures is minimal; if at a dead point with
    /// several drivers, they are as near to their values as they can be from here.
    LinkageReport solve(LinkageState& state, const LinkageGoals& goals = {},
                        const LinkageOptions& options = {}) noexcept;

    /// Switches to another assembly mode: another closed pose with the drivers' joints where they are. False,
    /// and nothing is changed, if none is found, or if the drivers leave freedom: what moves freely is in no
    /// mode. Deterministic; called again, it finds the way back or a third.
    bool other_mode(LinkageState& state, std::span<const LinkDriver> drivers) noexcept;

    /// In this pose, without drivers.
    LinkageFreedom freedom(const LinkageState& state) noexcept;

    /// Finds the forces that balance a torque or force of 1 on a joint, in this pose, with the joints of
    /// `held` fixed. For each closure, the force on its first link (the second gets the opposite), in N per
    /// N m, or N per N on a slider; a frame's torque is left out. Returns the part that nothing balances, 0
    /// to 1: 0 at a dead point of the joint. 1, and `forces` is unchanged, for a state, a link or a size of
    /// `forces` that does not fit, and for a ball.
    double balance(const LinkageState& state, std::size_t link, std::span<const std::size_t> held,
                   std::span<glm::dvec3> forces) noexcept;

    // The pose of the last solve, or of place().

    /// Computes places for a state, as saved or scrubbed to. False for a state of another linkage.
    bool place(const LinkageState& state) noexcept;
    std::span<const LinkPlace> links() const noexcept;
    /// Position of Linkage::points[index], metres; the origin if there is no such point.
    glm::dvec3 point(std::size_t index) const noexcept;
    /// A joint's position and axis in the world (unit; zero for a ball).
    glm::dvec3 joint(std::size_t link) const noexcept;
    glm::dvec3 axis(std::size_t link) const noexcept;

    // Why not: of the last solve. Valid until the next, or other_mode().

    /// Metres, one for each target.
    std::span<const double> residuals() const noexcept;
    /// Links whose joints are at the end of their range, and pressed against it.
    std::span<const std::size_t> active() const noexcept;
    /// The closures that are apart, if it ended Open or short of iterations: all of these, since which of
    /// them contradict each other is not known.
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
