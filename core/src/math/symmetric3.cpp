#include "math/symmetric3.hpp"

#include <algorithm>

namespace tendril::math {
namespace {

using Matrix = std::array<std::array<double, 3>, 3>;

/// Rotates in the plane of axes p and q so that m[p][q] becomes zero; `vectors` holds one eigenvector per
/// row.
void rotate(Matrix& m, std::array<glm::dvec3, 3>& vectors, std::size_t p, std::size_t q) noexcept {
    const double off = m[p][q];
    if (off == 0.0) return;
    // The smaller of the two solutions: t = tan, from t^2 + 2 t cot(2 angle) - 1 = 0.
    const double half_cot = (m[q][q] - m[p][p]) / (2.0 * off);
    const double t =
        (half_cot >= 0.0 ? 1.0 : -1.0) / (std::abs(half_cot) + std::sqrt(half_cot * half_cot + 1.0));
    const double c = 1.0 / std::sqrt(t * t + 1.0), s = t * c;
    const std::size_t r = 3 - p - q;
    m[p][p] -= t * off;
    m[q][q] += t * off;
    m[p][q] = m[q][p] = 0.0;
    const double rp = m[r][p], rq = m[r][q];
    m[r][p] = m[p][r] = c * rp - s * rq;
    m[r][q] = m[q][r] = s * rp + c * rq;
    const glm::dvec3 a = vectors[p], b = vectors[q];
    vectors[p] = minus(times(a, c), times(b, s));
    vectors[q] = plus(times(a, s), times(b, c));
}

}  // namespace

Eigen3 eigen(const Symmetric3& given) noexcept {
    Matrix m{
        {{given.xx, given.xy, given.xz}, {given.xy, given.yy, given.yz}, {given.xz, given.yz, given.zz}}};
    Eigen3 result{{}, {{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}}};
    for (int sweep = 0; sweep < 8; ++sweep) {
        const double off = std::abs(m[0][1]) + std::abs(m[0][2]) + std::abs(m[1][2]);
        if (off <= 1e-18 * trace(given)) break;
        rotate(m, result.vectors, 0, 1);
        rotate(m, result.vectors, 0, 2);
        rotate(m, result.vectors, 1, 2);
    }
    result.values = {m[0][0], m[1][1], m[2][2]};
    return result;
}

glm::dvec3 filtered_solution(const Symmetric3& m, const glm::dvec3& v, double damping, double small,
                             double floor) noexcept {
    const Eigen3 e = eigen(m);
    glm::dvec3 result(0.0);
    for (std::size_t k = 0; k < 3; ++k) {
        const double squared = std::max(e.values[k], 0.0);
        const double part = std::max(1.0 - squared / (small * small), 0.0);
        const double divisor = squared + std::max(damping * part, floor);
        if (divisor > 0.0) result = plus(result, times(e.vectors[k], dot(e.vectors[k], v) / divisor));
    }
    return result;
}

}  // namespace tendril::math
