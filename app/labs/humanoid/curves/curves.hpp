// Tails, spines and tentacles of the character along curves (tendril/humanoid/bent_chain.hpp).
//
// Curves are applied right after the clip, before IK. Their control points are in the space of the chain's
// parent node, so a tail's curve moves with hips that IK moves, and hands still reach their targets from a
// bent spine. Springs come last and swing about the curve.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <tendril/humanoid/bent_chain.hpp>
#include <vector>

#include "app/labs/kit/curve.hpp"

namespace tendril::app {

struct HumanoidPart;
struct ShownPose;
class Solvers;

inline constexpr std::size_t max_bone_curves = 16, max_bone_curve_points = 64;
/// Control points of a new curve.
inline constexpr std::size_t new_curve_points = 4;

/// No two curves turn the same node.
struct BoneCurve {
    std::string first, last;  ///< nodes, by name; the last one is the end
    CurveShape shape;         ///< the control points after the first node, in the space of its parent
    /// The chain's joint that jumped to another crossing when the points last changed.
    std::optional<std::size_t> jumped{};
    bool operator==(const BoneCurve&) const = default;
};

/// A chain of nodes that a user may want to bend.
struct BoneChain {
    std::size_t first = 0, last = 0;
};
/// The nodes of a curve; empty if the character does not have them.
std::optional<BoneChain> chain_of(const HumanoidPart& part, const BoneCurve& curve);
/// The spine, and every chain of at least two bones beside the body: tails, ears, hair; not fingers.
std::vector<BoneChain> bendable_chains(const HumanoidPart& part);
/// "tail_1 to tail_6"
std::string title_of(const HumanoidPart& part, const BoneChain& chain);
/// The end of the chain from `first`: as in bendable_chains() or, failing that, of the longest path.
std::size_t end_of_chain(const HumanoidPart& part, std::size_t first);

/// The index of the curve that begins at the node.
std::optional<std::size_t> curve_from(const HumanoidPart& part, std::size_t first);
/// The index of the curve whose chain has the node.
std::optional<std::size_t> curve_through(const HumanoidPart& part, std::size_t node);
/// Why the chain cannot get a new curve: another curve turns one of its nodes. Empty if it can. The last node
/// must be below the first, and the chain must have some length.
std::string why_no_curve(const HumanoidPart& part, const BoneChain& chain);

/// One per curve; null if the character has no such chain.
using BentChains = std::vector<std::unique_ptr<humanoid::BentChain>>;

/// Bends the pose along all curves. One report each; an empty one if the chain is missing.
std::vector<ik::CurveReport> bend(const HumanoidPart& part, const BentChains& chains,
                                  std::vector<rig::Transform>& pose);
/// The joint that jumps to another crossing if the curve's points become `points`.
std::optional<std::size_t> jump_between(const HumanoidPart& part, humanoid::BentChain& chain,
                                        const CurveShape& before, const std::vector<glm::vec3>& points);

// In the view

/// The curve in the character's space: its control points, and before them the chain's first joint.
std::vector<glm::vec3> shown_curve(const HumanoidPart& part, Solvers& solvers, const ShownPose& shown,
                                   std::size_t curve);

/// The picked part of a curve: a control point, or a place on shown_curve() as for ik::curve_point().
struct PickedCurve {
    std::size_t curve = 0;
    std::optional<std::size_t> control{};  ///< index into the shape's points
    float at = 0.0f;
};
std::optional<PickedCurve> picked_curve(const HumanoidPart& part, PickId pick);
std::vector<Handle> curve_handles(const HumanoidPart& part, Solvers& solvers, const ShownPose& shown);
std::string curve_hint(const HumanoidPart& part, const PickedCurve& picked);
void draw_bone_curves(const View& view, DrawList& list, const HumanoidPart& part, Solvers& solvers,
                      const ShownPose& shown);
/// For the mouse: moves a control point, removes it, or adds one where the curve was clicked.
void drag_control(const HumanoidPart& part, Solvers& solvers, const ShownPose& shown,
                  const PickedCurve& picked, glm::vec3 to, Emit& emit);
void remove_control(const HumanoidPart& part, const PickedCurve& picked, Emit& emit);
void click_curve(const HumanoidPart& part, Solvers& solvers, const ShownPose& shown,
                 const PickedCurve& picked, Emit& emit);

// Files and --state.

Json curves_json(const HumanoidPart& part);
/// Throws std::runtime_error that begins with the JSON path.
void read_curves(const JsonPlace& place, HumanoidPart& part);
Json curves_state(const HumanoidPart& part, Solvers& solvers, const ShownPose& shown);

}  // namespace tendril::app
