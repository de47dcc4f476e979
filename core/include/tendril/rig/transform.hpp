// Translation, rotation and scale, as in engines: shear never arises. In double precision, so that a rig ten
// kilometres from the origin moves as it does near it.
//
//     global = compose(parent_global, local);     // scale, rotate, translate
//     local = relative(parent_global, global);    // the exact inverse
//
// Composing is not matrix multiplication: scales multiply component by component, whatever the rotation
// between them. So with non-uniform scales compose(compose(a, b), c) and compose(a, compose(b, c)) differ. A
// global transform is always composed from the root down.
//
// Input from outside must pass checked(). From then on all results are finite, however deep the tree: no
// number grows beyond 1e100. Rotations come out as unit quaternions. Composing and its inverse take about 20
// ns, blending 250.
#pragma once

#include <string_view>
#include <type_traits>

#include "tendril/quat.hpp"
#include "tendril/result.hpp"
#include "tendril/vec3.hpp"

namespace tendril::rig {

struct Transform {
    glm::dvec3 translation{0.0, 0.0, 0.0};    ///< metres
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};  ///< unit; GLM's constructor takes w first
    glm::dvec3 scale{1.0, 1.0, 1.0};          ///< negative mirrors
};
static_assert(sizeof(Transform) == 10 * sizeof(double) && std::is_trivially_copyable_v<Transform>);

/// Compares the numbers: a rotation and its negative, the same turn, are different.
bool operator==(const Transform& a, const Transform& b) noexcept;

/// `input` with its rotation made unit length (a unit one keeps its bits). Refuses numbers that are not
/// finite or over max_magnitude, a rotation shorter than 1e-6, and a scale of 0. `operation` and `argument`
/// are for the message: "set: transform.scale.y must be non-zero, got 0".
Expected<Transform> checked(const Transform& input, std::string_view operation,
                            std::string_view argument = "transform") noexcept;

/// The transform of a child with this local transform, in the space in which `parent` is given.
Transform compose(const Transform& parent, const Transform& child) noexcept;
/// The inverse of compose(): the local transform below `parent` of an element at `global`. The inverse of a
/// scale under 1e-100 is taken as 0.
Transform relative(const Transform& parent, const Transform& global) noexcept;

/// Interpolates from `a` to `b`: translation and scale linearly, rotation the short way round (K. Shoemake,
/// "Animating rotation with quaternion curves", SIGGRAPH 1985). `part` at or below 0, or NaN: exactly `a`; at
/// or above 1: exactly `b`.
Transform blend(const Transform& a, const Transform& b, double part) noexcept;

/// Interpolates a rotation as blend() above does.
glm::dquat blend(const glm::dquat& a, const glm::dquat& b, double part) noexcept;

/// Unit length; a unit quaternion keeps its bits. Zero becomes the identity.
glm::dquat normalised(const glm::dquat& rotation) noexcept;

}  // namespace tendril::rig
