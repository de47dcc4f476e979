// Included first into every source of the library, by its CMakeLists.txt. It deletes GLM's common functions
// that multiply and add, for the reason given in point.hpp; GLM's constructors still work. Use vector.hpp and
// rotation.hpp instead. These overloads are more constrained than GLM's own, so the compiler picks them. MSVC
// does not include this. Not installed.
#pragma once

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>

namespace glm {

// clang-format off
template <length_t L, class T, qualifier Q> requires true T dot(const vec<L, T, Q>&, const vec<L, T, Q>&) = delete;
template <length_t L, class T, qualifier Q> requires true T length(const vec<L, T, Q>&) = delete;
template <length_t L, class T, qualifier Q> requires true T distance(const vec<L, T, Q>&, const vec<L, T, Q>&) = delete;
template <length_t L, class T, qualifier Q> requires true vec<L, T, Q> normalize(const vec<L, T, Q>&) = delete;
template <class T, qualifier Q> requires true vec<3, T, Q> cross(const vec<3, T, Q>&, const vec<3, T, Q>&) = delete;
template <class T, qualifier Q> requires true T dot(const qua<T, Q>&, const qua<T, Q>&) = delete;
template <class T, qualifier Q> requires true T length(const qua<T, Q>&) = delete;
template <class T, qualifier Q> requires true qua<T, Q> normalize(const qua<T, Q>&) = delete;
template <class T, qualifier Q> requires true qua<T, Q> inverse(const qua<T, Q>&) = delete;
template <class T, qualifier Q> requires true qua<T, Q> angleAxis(const T&, const vec<3, T, Q>&) = delete;
template <class T, qualifier Q> requires true qua<T, Q> operator*(const qua<T, Q>&, const qua<T, Q>&) = delete;
template <class T, qualifier Q> requires true vec<3, T, Q> operator*(const qua<T, Q>&, const vec<3, T, Q>&) = delete;
template <class T, qualifier Q> requires true vec<3, T, Q> operator*(const mat<3, 3, T, Q>&, const vec<3, T, Q>&) = delete;
template <class T, qualifier Q> requires true mat<3, 3, T, Q> operator*(const mat<3, 3, T, Q>&, const mat<3, 3, T, Q>&) = delete;
template <class T, qualifier Q> requires true mat<4, 4, T, Q> operator*(const mat<4, 4, T, Q>&, const mat<4, 4, T, Q>&) = delete;
template <class T, qualifier Q> requires true vec<4, T, Q> operator*(const mat<4, 4, T, Q>&, const vec<4, T, Q>&) = delete;
template <class T, qualifier Q> requires true mat<3, 3, T, Q> mat3_cast(const qua<T, Q>&) = delete;
template <class T, qualifier Q> requires true qua<T, Q> slerp(const qua<T, Q>&, const qua<T, Q>&, T) = delete;
template <class T, qualifier Q> requires true qua<T, Q> rotate(const qua<T, Q>&, const T&, const vec<3, T, Q>&) = delete;
template <length_t L, class T, class U, qualifier Q> requires true vec<L, T, Q> mix(const vec<L, T, Q>&, const vec<L, T, Q>&, U) = delete;
template <length_t C, length_t R, class T, qualifier Q> requires true T determinant(const mat<C, R, T, Q>&) = delete;
template <length_t C, length_t R, class T, qualifier Q> requires true mat<C, R, T, Q> inverse(const mat<C, R, T, Q>&) = delete;
// clang-format on

}  // namespace glm
