// Makes a child follow the weighted mean of several parents, none of which need be its parent in the tree.
//
// With maintain_offset each parent's goal for the child is the child's transform if it had been attached to
// that parent in the initial pose, so only the parent's motion since then is passed on. Without it the goal
// is the parent itself. Goals are averaged by weight: translations and scales linearly; rotations as
// quaternions in the hemisphere of the first parent's, then normalised. So the child moves continuously while
// weights change, including through zero, as long as one of them is not zero.
//
// The filter passes translation, rotation and scale axis by axis, in the local space of the child's parent in
// the tree; rotation as Euler angles (euler.hpp). A rotation with all three angles passed, or none, is not
// decomposed. At the pole (second angle at 90 degrees) the first and third angles turn about the same line; a
// filter that separates them jumps there, as in every comparable tool.
//
// All in double precision and absolute coordinates: exact to 1e-11 m at 10 km from the origin. O(parents),
// about 60 ns each; a filter on the rotation adds 130 ns.
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "tendril/fields.hpp"
#include "tendril/result.hpp"
#include "tendril/rig/transform.hpp"

namespace tendril::rig {

struct ConstraintParent {
    Transform global{};          ///< now
    Transform initial_global{};  ///< in the initial pose; for maintain_offset
    double weight = 1.0;         ///< 0 or more, relative to the others'; less, or NaN, counts as 0
};

/// The axes that the filter passes.
struct TransformFilter {
    std::array<bool, 3> translation{true, true, true};
    std::array<bool, 3> rotation{true, true, true};
    std::array<bool, 3> scale{true, true, true};
    bool operator==(const TransformFilter&) const = default;
};

struct ParentConstraintOptions {
    bool maintain_offset = true;
    TransformFilter filter{};
    double weight = 1.0;  ///< 0 to 1, clamped; 0: the child stays, bit for bit
};

/// The child, in global space.
struct ConstraintChild {
    Transform global{};          ///< now
    Transform initial_global{};  ///< in the initial pose; for maintain_offset
    Transform space{};           ///< global transform of its parent in the tree; the identity for a root
};

/// The child's new global transform. Without parents, with all weights 0, or with a filter that passes
/// nothing, it is unchanged, bit for bit.
Transform parent_constraint(const ConstraintChild& child, std::span<const ConstraintParent> parents,
                            const ParentConstraintOptions& options = {}) noexcept;

/// `from`, with the components that the filter passes taken from `to`; both in the same space.
Transform filtered(const Transform& from, const Transform& to, const TransformFilter& filter) noexcept;

}  // namespace tendril::rig

template <>
std::span<const tendril::Field> tendril::fields<tendril::rig::TransformFilter>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::rig::ParentConstraintOptions>() noexcept;
