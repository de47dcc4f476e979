// The Chain lab's part of the document.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <tendril/chain/chain.hpp>
#include <vector>

#include "app/document/document.hpp"
#include "app/labs/chain/curve.hpp"
#include "app/labs/chain/reach.hpp"
#include "app/labs/chain/study.hpp"
#include "app/labs/kit/flips.hpp"
#include "app/labs/kit/motion.hpp"
#include "app/labs/kit/selection.hpp"

namespace tendril::app {

inline constexpr const char* chain_lab = "chain";
inline constexpr std::size_t max_segments = 500'000;          ///< larger scenes would make too large a file
inline constexpr std::size_t max_limited_segments = 100'000;  ///< with limits, for the same reason

/// How the chain follows its target: the library's four modes, Reach, which pins the head and iterates, and
/// Curve, whose target is the curve's last control point.
enum class ChainMode { Forward, Backward, Fixed, WithIndex, Reach, Curve };

/// Selectable points other than joints.
enum class ChainPoint { Target, Pole };
inline constexpr EnumNames<ChainPoint, 2> chain_points{
    "point",
    {{"target", "Target", "What the chain follows."}, {"pole", "Pole target", "What it bends towards."}}};

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
    std::optional<ChainPoint> chosen_point;  ///< selected instead of joints
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
     {"fixed", "Fixed", "The head reaches for the target; the tail stays where it is."},
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
/// Entering a trailing mode puts the target on its led joint; entering Reach restores the target it last had.
void enter_mode(ChainPart& part, ChainMode mode);

/// Clamps the microscope's step to the length of its trace.
void keep_step(ChainPart& part, ChainRuntime& runtime);

/// Deviation of bone `index` from its length, in metres; 0 for the head.
float length_error(const Chain& chain, std::size_t index);

}  // namespace tendril::app

/// The values that scenes have as they are; the others have JSON of their own.
template <>
std::span<const tendril::Field> tendril::fields<tendril::app::ChainPart>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::app::ReachResult>() noexcept;
