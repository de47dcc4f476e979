// Symmetric 3x3 matrices. J J' of any number of ball joints has three rows, so the Jacobian solvers need
// nothing bigger: no matrix library is linked, and the bits are the same under every compiler. In double,
// because J J' squares the condition number of J. Not installed.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>

#include "math/vector.hpp"

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

/// m += by * v v'
static inline void add_square(Symmetric3& m, const glm::dvec3& v, double by) noexcept {
    const double x = by * v.x, y = by * v.y, z = by * v.z;
    m.xx += x * v.x, m.yy += y * v.y, m.zz += z * v.z;
    m.xy += x * v.y, m.xz += x * v.z, m.yz += y * v.z;
}
/// m += weight (|v|^2 I - v v'): adds a ball joint's contribution to J J', `v` from the joint to the tip.
static inline void add_ball_joint(Symmetric3& m, const glm::dvec3& v, double weight = 1.0) noexcept {
    const glm::dvec3 w{weight * v.x, weight * v.y, weight * v.z};
    const double x = w.x * v.x, y = w.y * v.y, z = w.z * v.z;
    m.xx += y + z, m.yy += x + z, m.zz += x + y;
    m.xy -= w.x * v.y, m.xz -= w.x * v.z, m.yz -= w.y * v.z;
}

/// Solves (m + diagonal I) x = v for a positive definite m: Cholesky decomposition in the form L D L', which
/// needs neither roots nor pivots (Golub, Van Loan, "Matrix Computations", 4th ed. 2013, 4.1 and 4.2).
/// Inversion by cofactors would lose precision along a tree's straight branch, where the stiffness across the
/// bones is a millionth of that along them.
class Factors3 {
  public:
    explicit Factors3(const Symmetric3& m, double diagonal = 0.0) noexcept {
        i0_ = 1.0 / (m.xx + diagonal);
        l10_ = m.xy * i0_;
        l20_ = m.xz * i0_;
        i1_ = 1.0 / (m.yy + diagonal - l10_ * m.xy);
        const double rest = m.yz - l20_ * m.xy;
        l21_ = rest * i1_;
        i2_ = 1.0 / (m.zz + diagonal - l20_ * m.xz - l21_ * rest);
    }
    glm::dvec3 solve(const glm::dvec3& v) const noexcept {
        const double below = v.y - l10_ * v.x;
        const double z = (v.z - l20_ * v.x - l21_ * below) * i2_;
        const double y = below * i1_ - l21_ * z;
        return {v.x * i0_ - l10_ * y - l20_ * z, y, z};
    }

  private:
    double l10_, l20_, l21_, i0_, i1_, i2_;
};

struct Eigen3 {
    std::array<double, 3> values;       ///< unsorted
    std::array<glm::dvec3, 3> vectors;  ///< orthonormal
};

/// Jacobi's method (Golub, Van Loan, 8.5), which finds small eigenvalues of a positive semidefinite matrix as
/// accurately as large ones. It converges quadratically, usually in a handful of sweeps; eight is the
/// maximum.
Eigen3 eigen(const Symmetric3& m) noexcept;

/// m^-1 v, damped along eigenvectors whose singular value s is under `small`: by (1 - (s / small)^2) times
/// `damping`, and by at least `floor`, so that null directions give zero instead of huge values (after S.
/// Chiaverini, B. Siciliano, O. Egeland 1994, see ik/methods/jacobian.cpp).
glm::dvec3 filtered_solution(const Symmetric3& m, const glm::dvec3& v, double damping, double small,
                             double floor) noexcept;

}  // namespace tendril::math
