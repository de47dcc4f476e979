// Dense symmetric systems of any size. Not installed.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace tendril::math {

/// Solves `matrix * x = right` for a symmetric, positive definite matrix, of which the lower half counts; row
/// by row. `right` becomes x and `matrix` its Cholesky factor. False where the matrix is not positive
/// definite.
inline bool solve_cholesky(std::vector<double>& matrix, std::vector<double>& right) noexcept {
    const std::size_t n = right.size();
    const auto at = [&](std::size_t row, std::size_t column) -> double& { return matrix[row * n + column]; };
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j <= i; ++j) {
            double sum = at(i, j);
            for (std::size_t k = 0; k < j; ++k) sum -= at(i, k) * at(j, k);
            if (i != j) {
                at(i, j) = sum / at(j, j);
            } else {
                if (!(sum > 0.0)) return false;
                at(i, i) = std::sqrt(sum);
            }
        }
    }
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t k = 0; k < i; ++k) right[i] -= at(i, k) * right[k];
        right[i] /= at(i, i);
    }
    for (std::size_t i = n; i-- > 0;) {
        for (std::size_t k = i + 1; k < n; ++k) right[i] -= at(k, i) * right[k];
        right[i] /= at(i, i);
    }
    return true;
}

}  // namespace tendril::math
