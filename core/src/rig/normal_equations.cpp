#include "rig/normal_equations.hpp"

#include <algorithm>
#include <cmath>

namespace tendril::rig {
namespace {

constexpr std::size_t unroll = 4;
/// The cost of writing or copying a matrix entry, in multiplications.
constexpr std::uint64_t cost_per_entry = 4;

}  // namespace

void NormalEquations::plan(const std::vector<std::vector<double>>& columns) {
    count_ = columns.size();
    first_.assign(count_, 0);
    assembly_cost_ = solve_cost_ = cost_per_entry * count_ * count_;
    if (count_ == 0) return;
    // A matrix entry is nonzero only if its two columns have a nonzero row in common.
    std::vector<std::size_t> leads(columns.front().size(), count_);
    for (std::size_t i = 0; i < count_; ++i) {
        std::size_t first = i, rows = 0;
        for (std::size_t k = 0; k < leads.size(); ++k) {
            if (columns[i][k] == 0.0) continue;
            leads[k] = std::min(leads[k], i);
            first = std::min(first, leads[k]);
            ++rows;
        }
        first_[i] = first;
        assembly_cost_ += leads.size() + (i + 1) * rows;
        solve_cost_ += (i - first) * (i - first) / 2 + i;
    }
}

void NormalEquations::assemble(const std::vector<std::vector<double>>& columns,
                               const std::vector<double>& residuals) {
    normal_.assign(count_ * count_, 0.0);
    gradient_.assign(count_, 0.0);
    for (std::size_t i = 0; i < count_; ++i) {
        const double* const column = columns[i].data();
        rows_.clear();
        for (std::size_t k = 0; k < residuals.size(); ++k)
            if (column[k] != 0.0) rows_.push_back(static_cast<std::uint32_t>(k));
        for (const std::uint32_t k : rows_) gradient_[i] += column[k] * residuals[k];
        double* const row = &normal_[i * count_];
        std::size_t j = 0;
        for (; j + unroll <= i + 1; j += unroll) {
            const double *const a = columns[j].data(), *const b = columns[j + 1].data(),
                                *const c = columns[j + 2].data(), *const d = columns[j + 3].data();
            double sum_a = 0.0, sum_b = 0.0, sum_c = 0.0, sum_d = 0.0;
            for (const std::uint32_t k : rows_) {
                sum_a += column[k] * a[k];
                sum_b += column[k] * b[k];
                sum_c += column[k] * c[k];
                sum_d += column[k] * d[k];
            }
            row[j] = sum_a;
            row[j + 1] = sum_b;
            row[j + 2] = sum_c;
            row[j + 3] = sum_d;
        }
        for (; j <= i; ++j)
            for (const std::uint32_t k : rows_) row[j] += column[k] * columns[j][k];
    }
}

bool NormalEquations::solve(double damping, const std::vector<bool>& fixed, std::vector<double>& step) {
    double largest = 0.0;
    for (std::size_t i = 0; i < count_; ++i) largest = std::max(largest, normal_[i * count_ + i]);
    if (!(largest > 0.0)) return false;
    matrix_ = normal_;
    step = gradient_;
    // All parameters get the same damping: scaled per column, the least influential would move furthest.
    for (std::size_t i = 0; i < count_; ++i) matrix_[i * count_ + i] += damping * largest;
    for (std::size_t i = 0; i < count_; ++i) {
        if (!fixed[i]) continue;
        for (std::size_t k = 0; k <= i; ++k) matrix_[i * count_ + k] = 0.0;
        for (std::size_t k = i; k < count_; ++k) matrix_[k * count_ + i] = 0.0;
        matrix_[i * count_ + i] = 1.0;
        step[i] = 0.0;
    }
    if (!factor()) return false;
    for (std::size_t i = 0; i < count_; ++i) {
        const double* const row = &matrix_[i * count_];
        for (std::size_t k = first_[i]; k < i; ++k) step[i] -= row[k] * step[k];
        step[i] /= row[i];
    }
    for (std::size_t i = count_; i-- > 0;) {
        for (std::size_t k = i + 1; k < count_; ++k) step[i] -= matrix_[k * count_ + i] * step[k];
        step[i] /= matrix_[i * count_ + i];
    }
    return true;
}

/// Cholesky factorisation in place, row by row.
bool NormalEquations::factor() {
    for (std::size_t i = 0; i < count_; ++i) {
        double* const row = &matrix_[i * count_];
        const std::size_t first = first_[i];
        std::size_t j = first;
        for (; j + unroll <= i; j += unroll) {
            const double *const a = &matrix_[j * count_], *const b = a + count_, *const c = b + count_,
                                *const d = c + count_;
            double sum_a = row[j], sum_b = row[j + 1], sum_c = row[j + 2], sum_d = row[j + 3];
            for (std::size_t k = first; k < j; ++k) {
                sum_a -= row[k] * a[k];
                sum_b -= row[k] * b[k];
                sum_c -= row[k] * c[k];
                sum_d -= row[k] * d[k];
            }
            row[j] = sum_a / a[j];
            row[j + 1] = (sum_b - row[j] * b[j]) / b[j + 1];
            row[j + 2] = (sum_c - row[j] * c[j] - row[j + 1] * c[j + 1]) / c[j + 2];
            row[j + 3] = (sum_d - row[j] * d[j] - row[j + 1] * d[j + 1] - row[j + 2] * d[j + 2]) / d[j + 3];
        }
        for (; j < i; ++j) {
            const double* const other = &matrix_[j * count_];
            double sum = row[j];
            for (std::size_t k = first; k < j; ++k) sum -= row[k] * other[k];
            row[j] = sum / other[j];
        }
        double sum = row[i];
        for (std::size_t k = first; k < i; ++k) sum -= row[k] * row[k];
        if (!(sum > 0.0)) return false;
        row[i] = std::sqrt(sum);
    }
    return true;
}

}  // namespace tendril::rig
