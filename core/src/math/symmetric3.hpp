// Symmetric 3x3 matrices. J J' of any number of ball joints has three rows, so the Jacobian solvers need none
// that is bigger: no library for matrices is linked, and the bits are the same under every compiler. Doubles,
// for J J' squares what it is made of. Not installed.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>

#include "math/wide.hpp"

namespace tendril::math {

struct Symmetric3 {
    double xx = 0.0, yy = 0.0, zz = 0.0, xy = 0.0, xz = 0.0, yz = 0.0;
};

static inline double trace(const Symmetric3& m) noexcept {
    return m.xx + m.yy + m.zz;
}

static inline glm::dvec3 product(const Symmetric3& m, const glm::dvec3& v) noexcept {
    return {m.xx * v.x + m.xy * v.y + m.xz * v.z, m.xy * v.x + m.yy * v.y + m.yz * v.z,
            m.xz * v.x + m.yz * v.y + m.zz * v.z};
}

/// x with m x = v, for a positive definite m: Cholesky's decomposition in the form L D L', which needs
/// neither roots nor pivots (Golub, Van Loan, "Matrix Computations", 4th ed. 2013, 4.1 and 4.2).
static inline glm::dvec3 solution(const Symmetric3& m, const glm::dvec3& v) noexcept {
    const double l_yx = m.xy / m.xx, l_zx = m.xz / m.xx;
    const double d_y = m.yy - l_yx * m.xy;
    const double rest = m.yz - l_zx * m.xy;
    const double l_zy = rest / d_y;
    const double d_z = m.zz - l_zx * m.xz - l_zy * rest;
    const double y = v.y - l_yx * v.x;
    const double z = (v.z - l_zx * v.x - l_zy * y) / d_z;
    const double solved_y = y / d_y - l_zy * z;
    return {v.x / m.xx - l_yx * solved_y - l_zx * z, solved_y, z};
}

struct Eigen3 {
    std::array<double, 3> values;       ///< in no order
    std::array<glm::dvec3, 3> vectors;  ///< of length 1, at right angles to each other
};

/// Jacobi's method (Golub, Van Loan, 8.5), which finds small eigenvalues of a positive semidefinite matrix as
/// well as large ones. Its convergence is quadratic: a handful of sweeps, and eight at most.
Eigen3 eigen(const Symmetric3& m) noexcept;

}  // namespace tendril::math
