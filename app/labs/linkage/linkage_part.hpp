// The Linkage lab's part of the document: a linkage, its pose, its drivers and its targets; and the presets.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <tendril/ik/linkage.hpp>
#include <tendril/ik/linkage_sketch.hpp>
#include <tendril/ik/mechanisms.hpp>
#include <variant>
#include <vector>

#include "app/document/document.hpp"
#include "app/document/workspace.hpp"
#include "app/fields/fields.hpp"
#include "app/io/names.hpp"

namespace tendril::app {

// The Linkage lab's presets: the library's mechanisms, with their lengths as tables of fields.

/// Twelve of Jansen's legs on one crank, at 1/100 scale: six pairs, a sixth of a turn apart.
struct JansenWalker : ik::Jansen {
    JansenWalker();
};

/// The lengths of a mechanism; std::monostate: drawn by hand.
using Mechanism = std::variant<std::monostate, ik::FourBar, ik::SliderCrank, ik::Peaucellier, ik::Pantograph,
                               ik::ScissorLift, ik::Jansen, JansenWalker, ik::Delta, ik::Stewart>;

struct MechanismKind {
    const char* name;
    const char* title;
    const char* help;
    Mechanism (*blank)();
    std::span<const Field> fields;
    std::vector<FieldText> texts;
    const char* traced;        ///< the point whose path is shown at first; empty: none
    const char* drivers = "";  ///< in space: name prefix of the driven links
};

/// In the order of the variant's alternatives, starting with the second.
const std::vector<MechanismKind>& mechanism_kinds();
/// Throws std::invalid_argument for an unknown name.
const MechanismKind& mechanism_kind(std::string_view name);
/// Null if it was drawn by hand.
const MechanismKind* kind_of(const Mechanism& mechanism);

/// The table and the lengths; an empty table if it was drawn by hand.
FieldsOf mechanism_fields(const Mechanism& mechanism);
FieldsIn mechanism_fields(Mechanism& mechanism);

inline constexpr const char* linkage_lab = "linkage";
inline constexpr std::size_t max_linkage_points = 200, max_linkage_bars = 200;
inline constexpr double max_motor_rate = 3600.0;   ///< degrees or metres per second
inline constexpr double max_linkage_extent = 1e6;  ///< metres

/// The action of the mouse in the view.
enum class LinkageTool : std::uint8_t { Move, Draw, Pin, Motor };
inline constexpr EnumNames<LinkageTool, 4> linkage_tools{
    "tool",
    {{"move", "Move", "Drag a joint: the linkage follows. A click selects it."},
     {"draw", "Draw", "Drag from one place to another: a bar. A click adds a joint, on a bar or beside it."},
     {"pin", "Pin", "A click on a joint pins it to the ground, or unpins it."},
     {"motor", "Motor",
      "A click on a joint adds a motor, on its pin or between its two bars, or removes it."}}};

/// The range of a hinge or slider, identified by the name of its link.
struct LinkageRange {
    std::string joint;
    double minimum = -std::numeric_limits<double>::infinity();  ///< radians or metres
    double maximum = std::numeric_limits<double>::infinity();
    bool operator==(const LinkageRange&) const = default;
};

/// A motor's crank, its coupler, and the rocker or slider that the coupler drives: three rigid bodies of one
/// or more bars. Indices into the sketch.
struct DrivenLoop {
    std::size_t motor = 0;
    std::size_t tip = 0;                ///< where the crank meets the coupler
    std::size_t end = 0;                ///< where the coupler meets the rocker or slider
    std::size_t pin = ik::ground_link;  ///< the rocker's pin; a slider has none
    bool has_rocker() const { return pin != ik::ground_link; }
};

/// A linkage as drawn. Never changed in place: parts and their history share it.
struct LinkageShape {
    Mechanism mechanism{};               ///< the preset; none once edited by hand
    ik::LinkageSketch sketch{};          ///< empty for a mechanism in space
    std::vector<bool> floating{};        ///< per sketch bar: whether nothing holds it yet
    std::vector<std::size_t> bodies{};   ///< per sketch bar: its rigid body, from ik::rigid_bodies()
    std::vector<DrivenLoop> driven{};    ///< loops driven by motors that push against the ground
    std::size_t loops = 0;               ///< number of loops of the bodies; floating bars have none
    std::vector<LinkageRange> ranges{};  ///< ranges set by hand; the mechanism may have its own
    ik::Linkage linkage{};               ///< built from the held bars, with all ranges
    ik::LinkageFreedom loose{};          ///< degrees of freedom of the floating bars

    bool in_plane() const { return !sketch.points.empty() || linkage.links.empty(); }
};

/// A driven joint, identified by the name of its link.
struct LinkageDrive {
    std::string joint;
    double value = 0.0;      ///< radians or metres: the wanted value if held, else the present one
    double rate = 0.0;       ///< motor speed, radians or metres per second; 0: stopped
    bool held = false;       ///< keeps this value; otherwise the joint follows the others
    double last_rate = 0.0;  ///< the speed it last ran at; 0: none yet
    bool operator==(const LinkageDrive&) const = default;
};

struct LinkageTarget {
    std::string point;
    glm::dvec3 to{0.0};
    double weight = 1.0;
    bool exact = false;
    bool operator==(const LinkageTarget&) const = default;
};

/// Another copy of the linkage at a different angle of its motor: a leg of a walker.
struct LinkageCopy {
    double phase = 0.0;     ///< added to the motor's angle, radians
    bool mirrored = false;  ///< mirrored in the plane x = 0
    double depth = 0.0;     ///< offset along Z, metres
    ik::LinkageState state{};
    std::vector<ik::LinkPlace> links{};
    bool operator==(const LinkageCopy& other) const { return phase == other.phase && state == other.state; }
};

/// The result of the last solve. Indices refer to the linkage.
struct LinkageResult {
    ik::LinkageReport report{};
    ik::LinkageFreedom freedom{};
    std::vector<std::size_t> active{};         ///< links at the end of their range
    std::vector<std::size_t> open_closures{};  ///< closures that contradict each other
    bool operator==(const LinkageResult&) const = default;
};

struct LinkagePart final : Part {
    std::shared_ptr<const LinkageShape> shape = std::make_shared<const LinkageShape>();
    ik::LinkageState state{};
    std::vector<ik::LinkPlace> links{};  ///< follows from `state`
    std::vector<LinkageCopy> copies{};   ///< a walker's other legs
    double walked = 0.0;                 ///< metres that the ground has moved beneath a walker
    std::vector<LinkageDrive> drives{};
    std::vector<LinkageTarget> targets{};
    std::optional<LinkageTarget> drag{};  ///< the mouse's; drivers follow while it lasts
    LinkageResult result{};               ///< result of the last solve
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
    /// Present position of a point of the linkage, or of one of its copies.
    glm::dvec3 at(std::size_t point) const;
    glm::dvec3 at(std::size_t point, const LinkageCopy& copy) const;
    /// The height of a walker's lowest foot; 0 for other linkages.
    double lowest_foot() const;
    const LinkageDrive* find_drive(std::string_view joint) const;
    /// The joint's present value; at a dead point it differs from the wanted one.
    double value_of(std::string_view joint) const { return state.joints[*linkage().find_link(joint)].value; }
};

/// The lab's initial linkage: a four-bar.
LinkagePart first_linkage();

inline const LinkagePart& linkage_part(const Workspace& workspace) {
    return workspace.document.get<LinkagePart>(linkage_lab);
}

/// All poses that the leading joint can drive the linkage through in its assembly mode: a full turn, or its
/// whole travel.
struct LinkageTurn {
    struct Pose {
        double value = 0.0;                  ///< value of the leading joint
        std::vector<double> joints{};        ///< values of all joints, one per link
        std::vector<ik::LinkPlace> links{};  ///< as in LinkagePart
    };
    std::size_t joint = ik::ground_link;  ///< the leading joint, as a link index
    bool whole = false;                   ///< it turns all the way round: the first pose follows the last
    std::vector<Pose> poses{};            ///< in order of `value`; closer where the linkage is fast
};
/// A point of a path: its position, and its speed in metres per second at the leading motor's speed or, if it
/// is stopped, at the usual one.
struct PathPoint {
    glm::dvec3 at{0.0};
    double speed = 0.0;
};

/// A crank length, metres, at which the motor turns all the way round.
struct RoundCrank {
    double length = 0.0;
    double longest = 0.0;          ///< beyond it, the linkage folds
    std::optional<double> from{};  ///< the motor value at which to set it; none: the present one
};

/// The solver of the lab's linkage, created once for each shape, and caches derived from it.
class LinkageRuntime final : public Runtime {
  public:
    ik::LinkageSolver& solver(const std::shared_ptr<const LinkageShape>& shape);
    /// Empty unless the linkage has exactly one degree of freedom.
    const LinkageTurn& turn(const LinkagePart& part);
    /// The selected point's path through the turn; empty if there is none.
    std::vector<PathPoint> path(const LinkagePart& part);
    /// The nearest shorter crank for the leading motor, in this pose or, if the linkage is folded there, in
    /// the middle of its travel. None if no length works, the crank has other bars or joints on it, or the
    /// linkage has other degrees of freedom.
    std::optional<RoundCrank> round_crank(const LinkagePart& part, std::size_t motor);

  private:
    std::shared_ptr<const LinkageShape> of_, turn_of_, crank_of_;
    ik::LinkageState crank_at_;
    std::size_t crank_motor_ = 0;
    std::optional<RoundCrank> crank_;
    std::optional<ik::LinkageSolver> solver_;
    LinkageTurn turn_;
};
/// The joint that drives the turn: the first driver's or, without drivers, the first one on the ground.
std::optional<std::size_t> leading_joint(const LinkagePart& part);

/// Moves the linkage to its held drivers and targets, or only to the mouse's drag. Watches all drivers.
void solve_linkage(LinkagePart& part, LinkageRuntime& runtime, ik::LinkageOptions options = {});
/// Computes a solve's report from this pose; pose and driver values do not change, to the bit.
void report_in_pose(LinkagePart& part);
/// Replaces the shape. A linkage drawn by hand takes the pose it is drawn in; a mechanism of the same kind
/// keeps its present pose as far as names match. Drivers, targets, ranges and selection stay if their names
/// still exist, and held drivers keep their values; removing a motor removes its driver.
void take_shape(LinkagePart& part, LinkageShape shape, LinkageRuntime& runtime);
void take_shape(LinkagePart& part, LinkageShape shape, std::vector<LinkageRange> ranges,
                LinkageRuntime& runtime);
/// Sets the ranges of joints that exist. Throws std::invalid_argument if a range excludes the pose in which
/// the linkage is drawn.
void set_ranges(LinkageShape& shape, std::vector<LinkageRange> ranges);
/// A hinge's value plus whole turns: nearest to `other`, or within the link's range.
double turned_near(double value, double other, const ik::Link& link);
/// The link of a sketch bar, named after the bar or the motor that turns it. None if the bar floats.
std::optional<std::size_t> link_of_bar(const ik::Linkage& linkage, const ik::LinkageSketch& sketch,
                                       std::size_t bar);
/// For each bar of a sketch, the number of bars between it and the ground; ik::ground_link: it floats.
std::vector<std::size_t> bars_from_ground(const ik::LinkageSketch& sketch);
/// For each bar of a sketch, whether no pin and no guide reaches it, directly or through other bars.
std::vector<bool> floating_bars(const ik::LinkageSketch& sketch);
/// Builds the shape of a sketch; floating bars are not part of the linkage. Throws std::invalid_argument if
/// the library refuses the sketch.
LinkageShape shape_of(ik::LinkageSketch sketch);
/// Builds the shape of a mechanism. Throws std::invalid_argument if the library refuses its lengths.
LinkageShape shape_of(const Mechanism& mechanism);
/// A walker's other legs in this state, each a few motor steps from its own pose; empty for other linkages.
std::vector<LinkageCopy> copies_of(const LinkageShape& shape, const ik::LinkageState& state);
/// Opens a mechanism at rest; keeps the tool.
void open_mechanism(LinkagePart& part, const Mechanism& mechanism, LinkageRuntime& runtime);
/// The sketch in the present pose, for editing. Throws Refused for a mechanism in space.
ik::LinkageSketch present_sketch(const LinkagePart& part);

}  // namespace tendril::app

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::LinkageTarget>() noexcept;
