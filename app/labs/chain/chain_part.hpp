// The Chain lab's part of the document, with its mode Curve; and the solvers that its runtime keeps.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <list>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <tendril/chain/chain.hpp>
#include <vector>

#include "app/document/document.hpp"
#include "app/document/workspace.hpp"
#include "app/io/json_place.hpp"
#include "app/labs/chain/reach.hpp"
#include "app/labs/chain/study.hpp"
#include "app/labs/kit/curve.hpp"
#include "app/labs/kit/flips.hpp"
#include "app/labs/kit/motion.hpp"
#include "app/labs/kit/selection.hpp"

namespace tendril::ik {
class Solver;
}

namespace tendril::app {

struct ChainPart;

// Mode Curve: the chain lies along a curve through control points (tendril/ik/curve.hpp). The last control
// point is the mode's target: moving the target moves it.
//
// The given chain, with its own bone lengths and pose, is stored separately. Every placement starts from it,
// so equal settings place it equally however often it was placed before. Edits and scene files use it; the
// placed chain follows.

inline constexpr std::size_t max_control_points = 4096;

/// Has no control points, or at least two.
struct CurveSettings : CurveShape {
    bool operator==(const CurveSettings&) const = default;
};

/// State that only mode Curve keeps; blank in other modes.
struct AlongCurve {
    Chain given;
    Selection selection;  ///< selected control points
    ik::CurveMemory memory;
    std::optional<ik::CurveReport> report;  ///< report of the last placement; none for fewer than two joints

    bool operator==(const AlongCurve&) const = default;
};

/// The chain that is edited and saved; in mode Curve, the given one.
const Chain& own_chain(const ChainPart& part);
/// Places the given chain along the curve; without control points, first draws the curve through the chain.
/// Throws std::invalid_argument if the library refuses.
void follow_curve(ChainPart& part);
/// Call after an edit that changed the given chain, not the placed one: places it again if needed and, in
/// other modes, clears AlongCurve.
void keep_on_curve(ChainPart& part, const ChainPart& before);

/// Removes the selected control points. Throws Refused if fewer than two would be left.
void remove_selected_points(ChainPart& part);

/// Why the joint jumped to another crossing.
std::string jump_cause(const ChainPart& before, const ChainPart& after);

Json save_curve(const CurveSettings& settings);
CurveSettings load_curve(const JsonPlace& place);

inline constexpr const char* chain_lab = "chain";
inline constexpr std::size_t max_segments = 500'000;          ///< limits the size of scene files
inline constexpr std::size_t max_limited_segments = 100'000;  ///< lower, because limits take more space

/// How the chain follows its target: the library's four modes, Reach, which pins the head and iterates, and
/// Curve, whose target is the curve's last control point.
enum class ChainMode { Forward, Backward, Fixed, WithIndex, Reach, Curve };

/// Selectable points other than joints.
enum class ChainPoint { Target, Pole };
inline constexpr EnumNames<ChainPoint, 2> chain_points{
    "point",
    {{"target", "Target", "The point that the chain follows."},
     {"pole", "Pole target", "The point that it bends towards."}}};

struct ShownTrace;
/// A frame of an engine's trace, and Tendril's solve of the same input as a ghost with as many joints.
struct TracedPose {
    std::vector<glm::vec3> joints, ghost;
    std::shared_ptr<const ShownTrace> trace{};
    std::uint64_t frame = 0;  ///< in the trace, counted from 0
};

struct ChainPart final : Part {
    Chain chain;
    ChainMode mode = ChainMode::Backward;
    std::size_t index = 0;                      ///< the segment that WithIndex pulls
    std::optional<glm::vec3> reach_target{};    ///< Reach's target while another mode is on
    std::array<int, 4> iterations{1, 1, 1, 1};  ///< per pull mode; only Fixed iterates
    float tolerance = 1e-4f;                    ///< metres, for Fixed
    glm::vec3 target{0.0f};
    Selection selection;                     ///< selected joints
    std::optional<ChainPoint> chosen_point;  ///< selected in place of joints
    Motion motion;
    ReachSettings reach;
    std::optional<ReachResult> result;  ///< of the last solve; empty once the chain moved otherwise
    CurveSettings curve;
    AlongCurve along;
    Study study;
    FlipRule flips;
    std::shared_ptr<const TracedPose> traced{};  ///< neither saved nor compared

    std::shared_ptr<Part> clone() const override { return std::make_shared<ChainPart>(*this); }
    Json save() const override;
    std::shared_ptr<Part> load(const Json& json, const std::string& where) const override;
    void upgrade(Json& json, int version) const override;
    std::shared_ptr<const Part> at_moment(std::shared_ptr<const Part> then) const override;
    std::shared_ptr<const Part> without_past() const override;
    std::size_t bytes() const override;
    std::vector<std::filesystem::path> files() const override;
};

/// The lab's initial chain: eight segments of 1 m along +X, the target on the tail.
ChainPart first_chain();

/// In the panel's order.
inline constexpr EnumNames<ChainMode, 6> chain_modes{
    "mode",
    {{"forward", "Forward", "Pulls by the head: it goes to the target, the rest trails."},
     {"backward", "Backward", "Pulls by the tail: it goes to the target, the rest trails."},
     {"fixed", "Fixed", "The head reaches for the target; the tail stays in place."},
     {"with_index", "With index", "Pulls by one segment; both sides trail."},
     {"reach", "Reach", "The root stays; the tip reaches for the target."},
     {"curve", "Curve", "Every joint lies on a curve through control points."}}};
/// Each mode that iterates has its own number of iterations; Curve does not.
int& iterations_of(ChainPart& part, ChainMode mode);
int iterations_of(const ChainPart& part, ChainMode mode);

bool operator==(const ChainPart& a, const ChainPart& b);

/// Throws std::invalid_argument if a point has left the range of scene files: a saved chain must open again.
void check_range(const ChainPart& part);

/// Moves the target and applies the mode once, except in Curve, where follow_curve() does. While a study is
/// open, Reach solves from the study's start.
void reach_for(ChainPart& part, glm::vec3 target, ChainRuntime& runtime);
/// The joint that a trailing mode moves to the target.
std::size_t led_joint(const ChainPart& part);
/// Does nothing outside the trailing modes, or while the target follows a path.
void put_target_on_led_joint(ChainPart& part);
/// Entering a trailing mode puts the target on its led joint; entering Reach restores Reach's last target.
void enter_mode(ChainPart& part, ChainMode mode);

/// Clamps the microscope's step to the length of its trace.
void keep_step(ChainPart& part, ChainRuntime& runtime);

/// Deviation of bone `index` from its length, in metres; 0 for the head.
float length_error(const Chain& chain, std::size_t index);

/// The lab's solvers, reused between solves as their header asks: one for the chain, and one for each section
/// that a drag solves separately. Also caches the result of the open study.
class ChainRuntime final : public Runtime {
  public:
    ChainRuntime();
    ~ChainRuntime() override;

    /// A cached or new solver for these bones. The reference is valid until the next call. Throws
    /// std::invalid_argument for invalid lengths.
    ik::Solver& solver(std::span<const float> lengths, glm::vec3 rest_direction);
    ik::Solver& solver(const Chain& chain);

    /// The result of the open study; empty if none is open. Recomputed only when its inputs change.
    Studied studied(const ChainPart& part);

    /// Number of solvers created, for tests.
    std::size_t made() const { return made_; }

  private:
    static constexpr std::size_t most =
        4;  ///< a chain, the two sections that a drag splits it into, and a spare
    struct Kept;
    std::list<Kept> kept_;  ///< most recently used first
    std::size_t made_ = 0;
    std::shared_ptr<const ChainPart> studied_part_;  ///< the inputs of `studied_`
    Studied studied_;
};

}  // namespace tendril::app

/// The values that scenes store as plain fields; the others have their own JSON.
template <>
std::span<const tendril::Field> tendril::fields<tendril::app::ChainPart>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::app::ReachResult>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::app::CurveSettings>() noexcept;
template <>
std::span<const tendril::app::FieldText> tendril::app::field_texts<tendril::app::CurveSettings>();
