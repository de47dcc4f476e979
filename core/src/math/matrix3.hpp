// Symmetric systems of three: a step's normal equations. In doubles, for they square the numbers. Not
// installed.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>

namespace tendril::math {

struct Matrix3 {
    double at[3][3];
};

static inline Matrix3 diagonal(float value) noexcept {
    const double d = value;
    return {{{d, 0, 0}, {0, d, 0}, {0, 0, d}}};
}

/// matrix += a b'
static inline void add_product(Matrix3& matrix, const glm::vec3& a, const glm::vec3& b) noexcept {
    const double p[] = {a.x, a.y, a.z}, q[] = {b.x, b.y, b.z};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t k = 0; k < 3; ++k) matrix.at[i][k] += p[i] * q[k];
    }
}

static inline Matrix3 product(const Matrix3& a, const Matrix3& b) noexcept {
    Matrix3 c = diagonal(0.0f);
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            c.at[i][k] = a.at[i][0] * b.at[0][k] + a.at[i][1] * b.at[1][k] + a.at[i][2] * b.at[2][k];
        }
    }
    return c;
}

static inline Matrix3 transposed(const Matrix3& a) noexcept {
    Matrix3 c = a;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t k = 0; k < 3; ++k) c.at[i][k] = a.at[k][i];
    }
    return c;
}

static inline Matrix3 difference(const Matrix3& a, const Matrix3& b) noexcept {
    Matrix3 c = a;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t k = 0; k < 3; ++k) c.at[i][k] -= b.at[i][k];
    }
    return c;
}

static inline glm::vec3 times(const Matrix3& a, const glm::vec3& v) noexcept {
    const double x = v.x, y = v.y, z = v.z;
    return {static_cast<float>(a.at[0][0] * x + a.at[0][1] * y + a.at[0][2] * z),
            static_cast<float>(a.at[1][0] * x + a.at[1][1] * y + a.at[1][2] * z),
            static_cast<float>(a.at[2][0] * x + a.at[2][1] * y + a.at[2][2] * z)};
}

/// By cofactors; zero where the matrix has no inverse. Damping keeps those that come here away from that.
static inline Matrix3 inverse(const Matrix3& a) noexcept {
    const auto& m = a.at;
    Matrix3 c = {{{m[1][1] * m[2][2] - m[1][2] * m[2][1], m[0][2] * m[2][1] - m[0][1] * m[2][2],
                   m[0][1] * m[1][2] - m[0][2] * m[1][1]},
                  {m[1][2] * m[2][0] - m[1][0] * m[2][2], m[0][0] * m[2][2] - m[0][2] * m[2][0],
                   m[0][2] * m[1][0] - m[0][0] * m[1][2]},
                  {m[1][0] * m[2][1] - m[1][1] * m[2][0], m[0][1] * m[2][0] - m[0][0] * m[2][1],
                   m[0][0] * m[1][1] - m[0][1] * m[1][0]}}};
    const double determinant = m[0][0] * c.at[0][0] + m[0][1] * c.at[1][0] + m[0][2] * c.at[2][0];
    const double scale = determinant != 0.0 ? 1.0 / determinant : 0.0;
    for (auto& row : c.at) {
        for (double& value : row) value *= scale;
    }
    return c;
}

}  // namespace tendril::math
