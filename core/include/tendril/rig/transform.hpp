// Translation, rotation and scale, as engines have them: no shear ever arises. All in double precision, so
// that a rig ten kilometres from the origin moves as it does near it.
//
//     global = compose(parent_global, local);     // scaled, then turned, then added
//     local = relative(parent_global, global);    // undoes exactly that
//
// Composing is not matrix multiplication: scales multiply component by component, whatever rotation is
// between them, so where scales differ from axis to axis compose(compose(a, b), c) and compose(a, compose(b,
// c)) are two things. A global transform is always composed from the root down.
//
// What comes in from outside passes checked(). What these functions are given after that is finite, and so is
// what they answer with, however deep a tree multiplies: no number grows beyond 1e100. Rotations come out as
// unit quaternions. Composing and its inverse take some 20 ns, blending 250.
#pragma once

#include <string_view>
#include <type_traits>

#include "tendril/quat.hpp"
#include "tendril/result.hpp"
#include "tendril/vec3.hpp"

namespace tendril::rig {

struct Transform {
    glm::dvec3 translation{0.0, 0.0, 0.0};    ///< metres
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};  ///< unit (in GLM's constructor w stands first)
    glm::dvec3 scale{1.0, 1.0, 1.0};          ///< negative mirrors
};
static_assert(sizeof(Transform) == 10 * sizeof(double) && std::is_trivially_copyable_v<Transform>);

/// The same numbers; a rotation and its negative, which turn alike, are not the same.
bool operator==(const Transform& a, const Transform& b) noexcept;

/// `input` as it may come in, its rotation made unit length (one that is so already keeps its bits). Refuses
/// what is not finite or over max_magnitude, a rotation shorter than 1e-6 and a scale of 0. `operation` and
/// `argument` are for the message: "set: transform.scale.y must be other than 0, got 0".
Expected<Transform> checked(const Transform& input, std::string_view operation,
                            std::string_view argument = "transform") noexcept;

/// Where a child with that local transform is, in the space that `parent` is in.
Transform compose(const Transform& parent, const Transform& child) noexcept;
/// The local transform of what is at `global` below `parent`: compose() undone. The inverse of a scale of 0
/// (or under 1e-100) counts as 0.
Transform relative(const Transform& parent, const Transform& global) noexcept;

/// Part of the way from `a` to `b`: translation and scale along a straight line, rotation the short way round
/// (K. Shoemake, "Animating rotation with quaternion curves", SIGGRAPH 1985). `part` 0 or less, or NaN: `a`
/// to the bit; 1 or more: `b`.
Transform blend(const Transform& a, const Transform& b, double part) noexcept;

/// Part of the short way round, as blend() does it.
glm::dquat blend(const glm::dquat& a, const glm::dquat& b, double part) noexcept;

/// Unit length; left to the bit where it is that already. Zero becomes the identity.
glm::dquat normalised(const glm::dquat& rotation) noexcept;

}  // namespace tendril::rig
