// The Linkage lab's part of the document: a linkage, its pose, and what it is asked for.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <tendril/ik/linkage.hpp>
#include <tendril/ik/linkage_sketch.hpp>
#include <vector>

#include "app/document/document.hpp"
#include "app/document/names.hpp"
#include "app/document/workspace.hpp"
#include "app/labs/linkage/mechanism.hpp"

namespace tendril::app {

inline constexpr const char* linkage_lab = "linkage";
inline constexpr std::size_t max_linkage_points = 200, max_linkage_bars = 200;
inline constexpr double max_motor_rate = 3600.0;   ///< degrees or metres a second
inline constexpr double max_linkage_extent = 1e6;  ///< metres

/// What the mouse does in the view.
enum class LinkageTool : std::uint8_t { Move, Draw, Pin, Motor };
inline constexpr EnumNames<LinkageTool, 4> linkage_tools{
    "tool",
    {{"move", "Move", "Drag a joint: the linkage follows. A click selects it."},
     {"draw", "Draw", "Drag from one place to another: a bar. A click adds a joint, on a bar or beside it."},
     {"pin", "Pin", "A click on a joint pins it to the ground, or lets it move again."},
     {"motor", "Motor",
      "A click on a joint puts a motor there, on its pin or between its two bars, or takes it away."}}};

/// How far a hinge or slider may go, by the name of its link.
struct LinkageRange {
    std::string joint;
    double minimum = -std::numeric_limits<double>::infinity();  ///< radians or metres
    double maximum = std::numeric_limits<double>::infinity();
    bool operator==(const LinkageRange&) const = default;
};

/// A motor's crank, its coupler, and the rocker or slider that the coupler drives. Each is a rigid body of
/// one or more bars. Indices into the sketch.
struct DrivenLoop {
    std::size_t motor = 0;
    std::size_t tip = 0;                ///< of the crank, where the coupler is
    std::size_t end = 0;                ///< of the coupler
    std::size_t pin = ik::ground_link;  ///< of the rocker; a slider has none
    bool has_rocker() const { return pin != ik::ground_link; }
};

/// A linkage as drawn. Never changed in place: parts and their history share it.
struct LinkageShape {
    Mechanism mechanism{};               ///< what it was made from; none once it is edited by hand
    ik::LinkageSketch sketch{};          ///< empty for a mechanism in space
    std::vector<bool> floating{};        ///< of the sketch's bars: nothing holds it yet
    std::vector<std::size_t> bodies{};   ///< of the sketch's bars: ik::rigid_bodies()
    std::vector<DrivenLoop> driven{};    ///< all by motors against the ground
    std::size_t loops = 0;               ///< of its bodies; what floats has none
    std::vector<LinkageRange> ranges{};  ///< set by hand; the mechanism may have its own
    ik::Linkage linkage{};               ///< of the bars that are held, with all ranges
    ik::LinkageFreedom loose{};          ///< of the bars that float

    bool in_plane() const { return !sketch.points.empty() || linkage.links.empty(); }
};

/// A joint that is driven, by the name of its link.
struct LinkageDrive {
    std::string joint;
    double value = 0.0;  ///< radians or metres: asked for, if it is held, else where the joint is
    double rate = 0.0;   ///< of a motor, a second
    bool held = false;   ///< at this value; else it follows the others
    bool operator==(const LinkageDrive&) const = default;
};

struct LinkageTarget {
    std::string point;
    glm::dvec3 to{0.0};
    double weight = 1.0;
    bool exact = false;
    bool operator==(const LinkageTarget&) const = default;
};

/// The linkage once more, at another angle of its motor: a leg of a walker.
struct LinkageCopy {
    double phase = 0.0;     ///< of the motor, radians
    bool mirrored = false;  ///< through the plane x = 0
    double depth = 0.0;     ///< along Z, metres
    ik::LinkageState state{};
    std::vector<ik::LinkPlace> links{};
    bool operator==(const LinkageCopy& other) const { return phase == other.phase && state == other.state; }
};

/// What the last solve says. Indices of the linkage.
struct LinkageResult {
    ik::LinkageReport report{};
    ik::LinkageFreedom freedom{};
    std::vector<std::size_t> active{};         ///< links at the end of their range
    std::vector<std::size_t> open_closures{};  ///< that contradict each other
    bool operator==(const LinkageResult&) const = default;
};

struct LinkagePart final : Part {
    std::shared_ptr<const LinkageShape> shape = std::make_shared<const LinkageShape>();
    ik::LinkageState state{};
    std::vector<ik::LinkPlace> links{};  ///< follows from `state`
    std::vector<LinkageCopy> copies{};   ///< of a walker
    double walked = 0.0;                 ///< metres that the ground has passed under it
    std::vector<LinkageDrive> drives{};
    std::vector<LinkageTarget> targets{};
    std::optional<LinkageTarget> drag{};  ///< by the mouse: while it lasts, drivers follow
    LinkageResult result{};               ///< of the last solve
    double time = 0.0;                    ///< seconds
    LinkageTool tool = LinkageTool::Move;
    std::string selected{};  ///< a point; empty: none

    std::shared_ptr<Part> clone() const override { return std::make_shared<LinkagePart>(*this); }
    Json save() const override;
    std::shared_ptr<Part> load(const Json& json, const std::string& where) const override;
    std::shared_ptr<const Part> after_undo() const override;
    std::shared_ptr<const Part> at_moment(std::shared_ptr<const Part> then) const override;
    std::size_t bytes() const override;
    /// Compares shapes by pointer.
    bool operator==(const LinkagePart& other) const;

    const ik::Linkage& linkage() const { return shape->linkage; }
    /// Where a point of the linkage is now, or the same of a copy.
    glm::dvec3 at(std::size_t point) const;
    glm::dvec3 at(std::size_t point, const LinkageCopy& copy) const;
    /// The height of a walker's lowest foot; 0 of others.
    double lowest_foot() const;
    const LinkageDrive* find_drive(std::string_view joint) const;
    /// Where a joint is: at a dead point not where it is asked to be.
    double value_of(std::string_view joint) const { return state.joints[*linkage().find_link(joint)].value; }
};

/// The lab begins with a four-bar.
LinkagePart first_linkage();

inline const LinkagePart& linkage_part(const Workspace& workspace) {
    return workspace.document.get<LinkagePart>(linkage_lab);
}

/// Every pose that one joint drives the linkage through in its assembly mode: all round, or between the ends
/// of its travel.
struct LinkageTurn {
    struct Pose {
        double value = 0.0;                  ///< of the joint
        std::vector<double> joints{};        ///< values, one for each link
        std::vector<ik::LinkPlace> links{};  ///< as in LinkagePart
    };
    std::size_t joint = ik::ground_link;  ///< a link
    bool whole = false;                   ///< it goes all round: after the last pose comes the first
    std::vector<Pose> poses{};            ///< by value
};
/// A point of a path: where, and how fast for each radian or metre of the joint that moves it.
struct PathPoint {
    glm::dvec3 at{0.0};
    double speed = 0.0;
};

/// The solver of the lab's linkage, made once for each shape, and its poses.
class LinkageRuntime final : public Runtime {
  public:
    ik::LinkageSolver& solver(const std::shared_ptr<const LinkageShape>& shape);
    /// No poses unless the linkage has one degree of freedom.
    const LinkageTurn& turn(const LinkagePart& part);
    /// The path of the selected point through that turn. Empty where there is none.
    std::vector<PathPoint> path(const LinkagePart& part);

  private:
    std::shared_ptr<const LinkageShape> of_, turn_of_;
    std::optional<ik::LinkageSolver> solver_;
    LinkageTurn turn_;
};
/// The joint that moves along a path: a motor's, or else any that the ground holds.
std::optional<std::size_t> leading_joint(const LinkagePart& part);

/// Moves the linkage to what is asked of it: held drivers and targets, or the mouse's drag alone. All drivers
/// are watched.
void solve_linkage(LinkagePart& part, LinkageRuntime& runtime, ik::LinkageOptions options = {});
/// The report of a solve from the pose, which stays, to the bit, as do the drivers' values.
void report_in_pose(LinkagePart& part);
/// A new shape: what was drawn by hand in its own pose, a mechanism in the present one as far as its names
/// go. Drivers, targets, ranges and selection stay where their names do, and held drivers at their values; a
/// motor that is taken away takes its driver along.
void take_shape(LinkagePart& part, LinkageShape shape, LinkageRuntime& runtime);
void take_shape(LinkagePart& part, LinkageShape shape, std::vector<LinkageRange> ranges,
                LinkageRuntime& runtime);
/// Sets the ranges of the joints that there are. Throws std::invalid_argument if one leaves out the pose in
/// which the linkage is drawn.
void set_ranges(LinkageShape& shape, std::vector<LinkageRange> ranges);
/// A hinge's value, by whole turns nearest to another, or in its range.
double turned_near(double value, double other, const ik::Link& link);
/// The link of a bar of the sketch: it has the bar's name, or that of the motor that turns it. None: the bar
/// floats.
std::optional<std::size_t> link_of_bar(const ik::Linkage& linkage, const ik::LinkageSketch& sketch,
                                       std::size_t bar);
/// How many bars of a sketch lie between each and the ground; ik::ground_link: it floats.
std::vector<std::size_t> bars_from_ground(const ik::LinkageSketch& sketch);
/// Of a sketch's bars: whether neither a pin nor a guide reaches it, directly or through other bars.
std::vector<bool> floating_bars(const ik::LinkageSketch& sketch);
/// The shape of a sketch. Bars that nothing holds are left out of the linkage. Throws std::invalid_argument
/// for a sketch that the library refuses.
LinkageShape shape_of(ik::LinkageSketch sketch);
/// The shape of a mechanism. Throws std::invalid_argument as the library refuses its lengths.
LinkageShape shape_of(const Mechanism& mechanism);
/// The other legs of a walker, all in this state, each a few steps of its motor from where it belongs; none
/// of others.
std::vector<LinkageCopy> copies_of(const LinkageShape& shape, const ik::LinkageState& state);
/// A mechanism at rest. The tool stays.
void open_mechanism(LinkagePart& part, const Mechanism& mechanism, LinkageRuntime& runtime);
/// The sketch in the present pose, to be edited. Throws Refused for a mechanism in space.
ik::LinkageSketch present_sketch(const LinkagePart& part);

}  // namespace tendril::app
